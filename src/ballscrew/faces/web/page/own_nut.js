// A nut of one's own: the few numbers of its catalogue page, what is estimated of it, and the case that they make.

import { faultLines } from "./cards/log_parts.js";
import { lines } from "./cards/records.js";
import { element, scrolling, table } from "./dom.js";
import { labelOf } from "./messages.js";
import { Latest, linesOf, Problem, sendJson } from "./server.js";
import { text } from "./texts.js";
import { currentSystem, formattedIn, inSystem, symbol, withPoint, withPowers } from "./units.js";

/** @typedef {import("./texts.js").Key} Key */

/** Milliseconds after the last key. */
const REST = 300;
const DIGITS = 4;
const KINDS = /** @type {const} */ (["", "single", "double", "oversize-balls", "offset-lead"]);
/**
 * Fields by the names of the API, with their units; those that are needed come first.
 *
 * @type {[string, Key, string, string][]}
 */
const FIELDS = [
  ["nominal_diameter", "own_nut.nominal_diameter", "mm", "40"],
  ["lead", "own_nut.lead_of_screw", "mm", "10"],
  ["turns", "own_nut.turns", "", "2x2.5"],
  ["dynamic_load_rating", "own_nut.dynamic", "kN", ""],
  ["ball_diameter", "own_nut.ball", "mm", ""],
  ["pitch_circle_diameter", "own_nut.circle", "mm", ""],
  ["root_diameter", "own_nut.root", "mm", ""],
  ["starts", "own_nut.starts", "", ""],
  ["preload", "own_nut.preload", "", "5 %"],
];
/** Labels of estimates that the form has under other names. @type {Record<string, string>} */
const PLACES = { ball_circle: "pitch_circle_diameter", conformity: "screw_conformity" };
const NEEDED = 3;

/**
 * The fields of a nut, what is estimated, and the button that hands the case on.
 *
 * @param {HTMLElement} holder
 * @param {(tables: import("./state.js").Tables, name: string) => void | Promise<void>} onCase
 */
export function ownNut(holder, onCase) {
  const latest = new Latest();
  let system = currentSystem();
  /** @type {OwnNutAnswer | undefined} */
  let answer;
  /** @type {ReturnType<typeof setTimeout> | undefined} */
  let timer;
  const name = element("input", { id: "own-nut-name", type: "text", maxlength: 60, autocomplete: "off" });
  const kind = element(
    "select",
    { id: "own-nut-nut" },
    ...KINDS.map((one) => element("option", { value: one }, text(`own_nut.kind.${one || "unknown"}`))),
  );
  const inputs = FIELDS.map(([field, , , hint]) =>
    element("input", {
      id: `own-nut-${field}`,
      type: "text",
      inputmode: field === "turns" || field === "preload" ? "text" : "decimal",
      autocomplete: "off",
      placeholder: hint || undefined,
    }),
  );
  const result = element("div", { "aria-live": "polite" });
  const use = element(
    "button",
    { type: "button", id: "own-nut-use", class: "primary", disabled: true },
    text("own_nut.use"),
  );
  use.addEventListener("click", async () => {
    if (answer) await onCase(answer.case, answer.name);
  });
  const marks = FIELDS.map(() => element("span", { class: "unit" }));
  const labelled = FIELDS.map(([field, key], place) =>
    element(
      "p",
      { class: "own-nut-field" },
      element("label", { for: `own-nut-${field}` }, text(key)),
      inputs[place],
      marks[place],
    ),
  );
  const rest = [
    element(
      "p",
      { class: "own-nut-field" },
      element("label", { for: "own-nut-nut" }, text("own_nut.kind")),
      kind,
      element("span", { class: "unit" }),
    ),
    element(
      "p",
      { class: "own-nut-field" },
      element("label", { for: "own-nut-name" }, text("own_nut.name")),
      name,
      element("span", { class: "unit" }),
    ),
  ];
  const form = element(
    "form",
    { class: "own-nut" },
    element("fieldset", {}, element("legend", {}, text("own_nut.needed")), ...labelled.slice(0, NEEDED)),
    element("fieldset", {}, element("legend", {}, text("own_nut.better")), ...labelled.slice(NEEDED), ...rest),
  );
  form.addEventListener("submit", (event) => event.preventDefault());
  form.addEventListener("input", () => {
    clearTimeout(timer);
    latest.cancel(); // an answer that is on its way is of other numbers
    answer = undefined;
    use.disabled = true;
    timer = setTimeout(ask, REST);
  });
  showUnits();
  holder.replaceChildren(
    element("p", { class: "small" }, text("own_nut.about")),
    form,
    result,
    element("p", { class: "card-start" }, use),
  );

  /** The unit beside each field, which a plain number has. */
  function showUnits() {
    for (const [place, [, , unit]] of FIELDS.entries()) marks[place].textContent = unit ? symbol(inSystem(unit)) : "";
  }

  /** Follow the units of the page: a plain number gets the one beside which it was typed. */
  function follow() {
    if (system === currentSystem()) return;
    for (const [place, [, , unit]] of FIELDS.entries()) {
      const typed = withPoint(inputs[place].value.trim());
      const before = marks[place].textContent;
      if (unit && typed && Number.isFinite(Number(typed)))
        inputs[place].value = `${inputs[place].value.trim()} ${before}`;
    }
    system = currentSystem();
    showUnits();
    if (answer) result.replaceChildren(...shown(answer));
  }

  /** What was typed, a plain number with the unit beside it. */
  function numbers() {
    /** @type {Record<string, string>} */
    const found = {};
    for (const [place, [field, , unit]] of FIELDS.entries()) {
      const typed = withPoint(inputs[place].value.trim());
      if (typed) found[field] = unit && Number.isFinite(Number(typed)) ? `${typed} ${inSystem(unit)}` : typed;
    }
    if (kind.value) found.nut = kind.value;
    if (name.value.trim()) found.name = name.value.trim();
    return found;
  }

  async function ask() {
    answer = undefined;
    if (inputs.slice(0, NEEDED).some((input) => !input.value.trim())) {
      result.replaceChildren();
      return;
    }
    try {
      const signal = latest.begin();
      /** @type {OwnNutAnswer} */
      const found = await sendJson("own-nut", { numbers: numbers() }, signal);
      if (signal.aborted) return;
      answer = found;
      result.replaceChildren(...shown(found));
      use.disabled = false;
    } catch (error) {
      if (error instanceof DOMException && error.name === "AbortError") return;
      const words = error instanceof Problem && error.faults.length ? faultLines(error.faults) : linesOf(error);
      result.replaceChildren(...words);
    }
  }

  return { follow };
}

/** What was estimated, and what does not go together. @param {OwnNutAnswer} found */
function shown({ estimates, warnings }) {
  const headings = /** @type {Key[]} */ ([
    "own_nut.number",
    "own_nut.value",
    "own_nut.low",
    "own_nut.high",
    "own_nut.source",
  ]);
  const rows = estimates.map((one) => {
    const [value, low, high] = [one.value, one.low, one.high].map((number) =>
      withPowers(formattedIn(number, one.shown_in, one.unit, DIGITS)),
    );
    return [labelOf(`screw.${PLACES[one.name] ?? one.name}`), value, low, high, one.source];
  });
  const caption = text("own_nut.estimated");
  const content = table(
    caption,
    headings.map((key) => text(key)),
    rows,
  );
  return [...lines([], warnings), scrolling(caption, content)];
}
