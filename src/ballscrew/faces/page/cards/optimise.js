// The card of an optimisation: what a screw for a need would look like, whose sizes are free within what is made: the
// front of the best, each design by the full model, and as a design to take. The need is that of the card of choosing.

import * as designs from "../designs.js";
import { button, primaryButton } from "../controls.js";
import { element } from "../dom.js";
import { labelOf } from "../messages.js";
import { FIELDS } from "../needs.js";
import { LETTERS } from "../state.js";
import { store } from "../store.js";
import * as views from "../views.js";
import { vocabulary } from "../vocabulary.js";
import { objective } from "./candidates.js";
import { commandLine, faultLines } from "./log_parts.js";
import { leftOut, tables } from "./need_tables.js";
import { flags, optionFields } from "./option_fields.js";
import { question } from "./question.js";

/** @typedef {OptimiseAnswer["candidates"][number]} Member */

/** Objectives of a search, those that are usual first. */
const OBJECTIVES = ["loss", "inertia", "life", "rigidity", "drive_torque", "preload_torque", "reflected_mass"];
const USUAL = OBJECTIVES.slice(0, 2);
/** The table of the sheet that has a row for each design. */
const FRONT = "front";

/**
 * @param {HTMLElement} holder
 * @returns {import("../cards.js").Card}
 */
export function setUp(holder) {
  /** @type {Record<string, any>} */
  let need = {};
  let isOwn = false;
  /** @type {OptimiseAnswer | undefined} */
  let answer;
  const asks = element("div", {});
  const problems = element("div", {});
  const command = element("div", {});
  const taken = element("p", { role: "status" });
  const asked = question({
    address: "optimise",
    beside: (table, row) => (table === FRONT ? takes(row) : undefined),
    show: (found) => {
      answer = found;
    },
    place: (faults) => {
      problems.replaceChildren(...faultLines(faults));
      return undefined;
    },
  });
  const options = vocabulary.options.optimise.filter(({ name }) => name !== "objectives");
  /** @type {import("./option_fields.js").Given} */
  const chosen = {};
  const boxes = OBJECTIVES.map((name) => {
    const box = element("input", { type: "checkbox", checked: USUAL.includes(name), value: name });
    box.addEventListener("change", () => {
      isOwn = true;
      follow();
    });
    return box;
  });
  const start = primaryButton("optimise-start", "Search the front", async () => {
    need = await tables(store.state.need);
    asked.follow(body(), 0);
  });
  holder.replaceChildren(
    asked.head,
    asks,
    element(
      "fieldset",
      { class: "card-fields" },
      element("legend", {}, "Objectives"),
      element(
        "div",
        { class: "filters" },
        ...boxes.map((box) => element("label", {}, box, ` ${objective(box.value)}`)),
      ),
    ),
    optionFields("optimise", options, chosen, follow),
    element("p", { class: "card-start" }, start),
    command,
    asked.line,
    problems,
    taken,
    asked.result,
  );
  asked.resume();

  function body() {
    const objectives = boxes.filter((box) => box.checked).map((box) => box.value);
    return { need, objectives, ...chosen };
  }

  async function follow() {
    need = await tables(store.state.need);
    asks.replaceChildren(element("p", {}, `The need: ${summary()}`), element("p", {}, toNeed()));
    const listed = need.optimise?.objectives;
    // those of the need, until others are chosen here
    if (!isOwn) for (const box of boxes) box.checked = (Array.isArray(listed) ? listed : USUAL).includes(box.value);
    const { objectives } = body();
    start.disabled = !objectives.length;
    const names =
      JSON.stringify(objectives) === JSON.stringify(listed ?? USUAL) ? [] : ["--objectives", objectives.join(",")];
    command.replaceChildren(commandLine(["ballscrew", "optimise", "need.toml", ...names, ...flags(options, chosen)]));
    asked.compare(body());
  }

  /** The button that takes a design of the front. @param {number} row */
  function takes(row) {
    const name = `Optimum ${row + 1}`;
    const onclick = () => answer && take(answer.candidates[row], name);
    return button("Take as design", onclick, { "aria-label": `Take ${name} as design` });
  }

  /** @param {Member} member @param {string} name */
  async function take(member, name) {
    if (!designs.hasRoom()) {
      taken.textContent = `The page holds ${LETTERS.length} designs: delete one first.`;
      return;
    }
    designs.add([await designs.ofCase(member.case, { name })]);
    taken.textContent = `${name} is design ${LETTERS[store.state.show]}.`;
  }

  return { follow };
}

/** What the need asks for, in words. */
function summary() {
  const { texts, duty } = store.state.need;
  const closed = leftOut(store.state.need);
  const given = Object.keys(FIELDS).flatMap((name) =>
    texts[name] && !closed.includes(name) ? [`${labelOf(FIELDS[name] || `need.${name}`)}: ${texts[name]}`] : [],
  );
  return (
    [...given, ...(duty ? ["by the duty of the design on the page, in place of force and feed"] : [])].join("; ") ||
    "nothing is given yet"
  );
}

/** A button to the card that has the fields of the need. */
function toNeed() {
  return button("Change the need", () => views.go("choose.rows"));
}
