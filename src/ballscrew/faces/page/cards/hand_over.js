// The card of a hand-over: a target, its choices, the error of what is made, its files, and the command for the same.

import { framed, labelled, namedButton, opened } from "../controls.js";
import * as designs from "../designs.js";
import { element, scrollingTable } from "../dom.js";
import { COLUMNS } from "../names.js";
import { save } from "../saving.js";
import { get } from "../server.js";
import * as units from "../units.js";
import { buttonCard } from "./button_card.js";
import { caseFile } from "./log_parts.js";
import { warningLines } from "./records.js";

/** Ranges that may be given, with an example. @type {Record<string, string>} */
const RANGES = { axial_load: "-5:5 kN", screw_speed: "-300:300 rpm" };

/**
 * @param {HTMLElement} holder
 * @returns {import("../cards.js").Card}
 */
export function setUp(holder) {
  /** @type {Targets["targets"]} */
  let targets = [];
  const select = element("select", { id: "hand-over-target" });
  const options = element("div", { class: "grid" });
  const result = element("div", { class: "card-result" });
  const card = buttonCard(holder, {
    name: "hand-over",
    id: "hand-over-make",
    words: "Make the files",
    parts: [labelled(select, "for"), framed("Options", options)],
    body: async () => ({ case: await designs.currentCase(), ...given() }),
    line: () => {
      const { to, ranges, options: choices } = given();
      /** @param {string} option @param {Record<string, string>} values */
      const words = (option, values) => Object.entries(values).flatMap(([name, value]) => [option, `${name}=${value}`]);
      return [caseFile(), "--to", to, "-o", "out", ...words("--range", ranges), ...words("--option", choices)];
    },
    result,
    show,
  });
  select.addEventListener("change", () => {
    showOptions();
    follow();
  });
  options.addEventListener("input", () => follow());

  function chosen() {
    return targets.find(({ name }) => name === select.value);
  }

  /** The fields that are filled in, of one kind. @param {string} kind */
  function filled(kind) {
    const inputs = [...options.querySelectorAll("input")].filter(
      (one) => one.dataset.kind === kind && one.value.trim(),
    );
    return Object.fromEntries(inputs.map((one) => [one.name, one.value.trim()]));
  }

  function given() {
    return { to: select.value, ranges: filled("range"), options: filled("option") };
  }

  function showOptions() {
    const target = chosen();
    /** @param {string} kind @param {string} name @param {string} label @param {string} example */
    const field = (kind, name, label, example) => {
      const id = `hand-over-${kind}-${name}`;
      const input = element("input", { type: "text", id, name, placeholder: example, "data-kind": kind });
      return element("p", {}, element("label", { for: id }, label), element("br"), input);
    };
    options.replaceChildren(
      ...Object.entries(RANGES).map(([name, example]) =>
        field("range", name, `range of: ${COLUMNS[name] ?? name}, such as ${example}`, "as wide as the target allows"),
      ),
      ...(target?.options ?? []).map((one) => field("option", one.name, one.meaning, one.default)),
    );
  }

  async function follow() {
    if (!targets.length) {
      /** @type {Targets} */
      const found = await get("targets");
      targets = found.targets;
      select.replaceChildren(
        ...targets.map(({ name, meaning }) => element("option", { value: name }, `${name}: ${meaning}`)),
      );
      showOptions();
    }
    await card.follow();
  }

  /** @param {HandOverAnswer} found */
  function show({ results, warnings, words: { ranges: inWords }, file }) {
    const worst = /** @type {Record<string, Record<string, any>>} */ (results.worst_error);
    const rows = Object.entries(worst).map(([name, one]) => [
      name.replaceAll("_", " "),
      element(
        "data",
        { value: String(one.value), "data-name": name },
        `${units.digits(one.value, 2)} ${one.unit === "1" ? "" : one.unit}`,
      ),
      one.of_largest === null || one.of_largest === undefined ? "–" : `${units.digits(100 * one.of_largest, 2)} %`,
    ]);
    const caption = "worst error against the model at random points of the range";
    const headings = ["output", "worst error", "of its largest value"];
    const bytes = Uint8Array.from(atob(file.base64), (letter) => letter.charCodeAt(0));
    const names = /** @type {string[]} */ (results.files);
    const download = namedButton("hand-over-download", "Download", () =>
      save(`-${file.name}`, new Blob([bytes], { type: file.media_type })),
    );
    const told = inWords.map((line) => element("li", {}, line));
    const ranges = opened("Ranges and errors in words", element("ul", {}, ...told));
    ranges.open = true;
    result.replaceChildren(
      element(
        "div",
        {},
        element("p", {}, `${names.join(", ")} (${Math.ceil(bytes.length / 1000)} kB)`),
        element("p", { class: "card-start" }, download),
        ...(rows.length ? [scrollingTable(caption, headings, rows)] : []),
        ...warningLines(warnings),
        ranges,
      ),
    );
  }

  return { follow };
}
