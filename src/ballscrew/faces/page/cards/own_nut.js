// The card of a nut of one's own: the few numbers of its catalogue page, what is estimated of it, and the design that they
// make.

import { menu, primaryButton, textField } from "../controls.js";
import * as designs from "../designs.js";
import { byId, element, scrollingTable } from "../dom.js";
import { labelOf } from "../messages.js";
import { Latest, linesOf, Problem, sendJson } from "../server.js";
import { LETTERS } from "../state.js";
import { store } from "../store.js";
import { currentSystem, formattedIn, inSystem, symbol, withPoint, withPowers } from "../units.js";
import { faultLines } from "./log_parts.js";
import { warningLines } from "./records.js";

/** Kinds of nut in words. @type {Record<string, string>} */
const KINDS_IN_WORDS = {
  double: "double nut",
  "offset-lead": "single nut, offset lead",
  "oversize-balls": "single nut, oversize balls",
  single: "single nut without preload",
  unknown: "not known",
};

/** Milliseconds after the last key. */
const REST = 300;
const DIGITS = 4;
const KINDS = /** @type {const} */ (["", "single", "double", "oversize-balls", "offset-lead"]);
/**
 * Fields by the names of the API, with their units; those that are needed come first.
 *
 * @type {[string, string, string, string][]}
 */
const FIELDS = [
  ["nominal_diameter", "Nominal diameter d0", "mm", "40"],
  ["lead", "Lead", "mm", "10"],
  ["turns", "Turns of one nut body", "", "2x2.5"],
  ["dynamic_load_rating", "Dynamic load rating Ca", "kN", ""],
  ["ball_diameter", "Ball diameter", "mm", ""],
  ["pitch_circle_diameter", "Pitch circle diameter", "mm", ""],
  ["root_diameter", "Root diameter", "mm", ""],
  ["starts", "Thread starts", "", ""],
  ["preload", "Preload, with its unit", "", "5 %"],
];
/** Labels of estimates that the form has under other names. @type {Record<string, string>} */
const PLACES = { ball_circle: "pitch_circle_diameter", conformity: "screw_conformity" };
const NEEDED = 3;

/**
 * The fields of a nut, what is estimated, and the button that makes a design of it.
 *
 * @param {HTMLElement} holder
 * @returns {import("../cards.js").Card}
 */
export function setUp(holder) {
  const latest = new Latest();
  let system = currentSystem();
  /** @type {OwnNutAnswer | undefined} */
  let answer;
  /** @type {ReturnType<typeof setTimeout> | undefined} */
  let timer;
  const inputs = FIELDS.map(([field, , , placeholder]) => {
    const inputmode = field === "turns" || field === "preload" ? "text" : "decimal";
    return textField("", () => {}, { id: `own-nut-${field}`, inputmode, autocomplete: "off", placeholder });
  });
  const name = textField("", () => {}, { id: "own-nut-name", maxlength: 60, autocomplete: "off" });
  /** @type {[string, string][]} */
  const kinds = KINDS.map((one) => [one, KINDS_IN_WORDS[one || "unknown"]]);
  const kind = menu(kinds, "", () => {}, { id: "own-nut-nut" });
  const result = element("div", { "aria-live": "polite" });
  const said = element("p", { "aria-live": "polite" });
  const use = primaryButton("own-nut-use", "Use this nut", () => answer && add(answer));
  use.disabled = true;
  const marks = FIELDS.map(() => element("span", { class: "unit" }));
  /** @param {HTMLElement} control @param {string} words @param {HTMLElement} [unit] */
  const line = (control, words, unit = element("span", { class: "unit" })) =>
    element("p", { class: "own-nut-field" }, element("label", { for: control.id }, words), control, unit);
  const fields = FIELDS.map(([, words], place) => line(inputs[place], words, marks[place]));
  const form = element(
    "form",
    { class: "own-nut" },
    element("fieldset", {}, element("legend", {}, "Needed"), ...fields.slice(0, NEEDED)),
    element(
      "fieldset",
      {},
      element("legend", {}, "Each of these makes it better"),
      ...fields.slice(NEEDED),
      line(kind, "Nut"),
      line(name, "Name"),
    ),
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
    element(
      "p",
      { class: "small" },
      "The numbers of one nut body as its catalogue prints them. A plain number has the unit beside it; another unit may be typed behind it.",
    ),
    form,
    result,
    element("p", { class: "card-start" }, use),
    said,
  );

  /** @param {OwnNutAnswer} found */
  async function add({ case: tables, name: words }) {
    const left = designs.add([await designs.ofCase(tables, { name: words })]);
    said.textContent = left
      ? `The page holds ${LETTERS.length} designs. There was no place for ${words}.`
      : `Added as design ${LETTERS[store.state.show]}: ${words}.`;
    if (!left) byId("results").scrollIntoView();
  }

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
  const headings = ["Number", "Value", "from", "to", "Where it is from"];
  const rows = estimates.map((one) => {
    const [value, low, high] = [one.value, one.low, one.high].map((number) =>
      withPowers(formattedIn(number, one.shown_in, one.unit, DIGITS)),
    );
    return [labelOf(`screw.${PLACES[one.name] ?? one.name}`), value, low, high, one.source];
  });
  const caption = "Estimated: the catalogue does not say";
  return [...warningLines(warnings), scrollingTable(caption, headings, rows)];
}
