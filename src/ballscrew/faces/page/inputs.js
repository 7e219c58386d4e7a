// The inputs of the design on the page: the form, the tabs of the designs above it, and the faults of an answer in them.

import { consequences } from "./consequences.js";
import * as designs from "./designs.js";
import { byId, element, keepFocus } from "./dom.js";
import * as form from "./form.js";
import { fieldOf, fieldsOf } from "./schema.js";
import { LETTERS, valueAt } from "./state.js";
import { store } from "./store.js";
import * as units from "./units.js";
import { vocabulary } from "./vocabulary.js";

/** @typedef {import("./state.js").Tables} Tables */

/**
 * Follow an input of the form: another start, another unit, or another text of a field.
 *
 * @param {import("./fields.js").Change} change
 */
export function change({ path = "", text = "", unit, start, reset, rebuild }) {
  if (start !== undefined) startFrom(start);
  else if (reset) designs.reset();
  else if (unit !== undefined) designs.chooseUnit(path, unit);
  else changeText(path, text, rebuild);
}

/**
 * Put another screw in the place of that of the current design. Load, speed and oil go on to be shown in the units that are
 * seen: what is typed next is in the same unit as before.
 *
 * @param {string} start
 */
export async function startFrom(start) {
  const results = byId("results");
  results.setAttribute("aria-busy", "true");
  results.dataset.start = start;
  const { show } = store.state;
  const before = designs.tablesOf(designs.current());
  const after = await designs.startOf(start).catch(() => ({})); // why it is not there is said where it is shown
  if (results.dataset.start !== start || store.state.show !== show) return; // another was asked for meanwhile
  const paths = designs.OF_USE.flatMap((section) => Object.keys(fieldsOf(section)).map((name) => `${section}.${name}`));
  const kept = paths.flatMap((path) => {
    const [seen, next] = [before, after].map((tables) => unitAt(tables, path));
    return seen && next && seen !== next && units.currentSystem() === "metric" ? [[path, seen]] : [];
  });
  designs.startFrom(start, { ...Object.fromEntries(kept), ...store.state.fields });
}

/** The unit of a number of a case, as it is written. @param {Tables} tables @param {string} path */
function unitAt(tables, path) {
  return units.parse(valueAt(tables, path), fieldOf(path)?.["x-si-unit"])?.unit;
}

/**
 * @param {string} path
 * @param {string} text
 * @param {boolean} [rebuild]
 */
function changeText(path, text, rebuild) {
  const tables = designs.tablesOf(designs.current());
  const others = consequences(path, text, (one) => valueAt(tables, one), vocabulary.nuts);
  // a speed of the nut is shown through the lead
  const isWider = rebuild || Object.keys(others).length > 0 || path === "screw.lead";
  designs.change({ ...others, [path]: text }, { rebuild: isWider, path });
}

/**
 * Show the form of the current design, and the tabs of all.
 *
 * @param {Run | undefined} answer that on the page, whose values stand where nothing is typed
 */
export async function show(answer) {
  const { state } = store;
  /** @type {HTMLSelectElement} */ (byId("system")).value = units.currentSystem();
  /** @type {HTMLInputElement} */ (byId("band")).checked = state.band;
  /** @type {HTMLInputElement} */ (byId("own")).checked = state.own;
  const design = designs.current();
  await designs.startOf(design.start);
  if (design !== designs.current()) return; // another one was chosen in the meantime
  const tables = designs.tablesOf(design);
  // a text stays as it was typed while typing goes on: 0.10 may become 0.107
  /** @param {string} path */
  const given = (path) => {
    const changed = design.changes[path];
    return changed ? changed : valueAt(tables, path);
  };
  /** @param {string} path */
  const lawOf = (path) => {
    const known = valueAt(answer?.inputs, path);
    return typeof known === "string" ? { law: known } : known;
  };
  const rebuild = () => {
    form.build({ state, given, lawOf, onChange: change });
    byId("form").dataset.laws = lawsOf(answer);
    form.showValues(effective(answer));
    showTabs();
  };
  keepFocus(rebuild, () => byId(`design-${LETTERS[store.state.show]}`));
}

/** Show that the texts of the current design were changed, without a form that is made anew. @param {string} path */
export function mark(path) {
  const { changes } = designs.current();
  form.mark(path, path in changes);
  byId("reset").hidden = !Object.keys(changes).length;
}

/**
 * Say on the first view that its numbers are of an example, as long as no other screw was chosen, and that they are of the
 * operating point alone where a cycle has loads of its own.
 */
export function showOrigin() {
  const { axis, motion } = designs.tablesOf(designs.current());
  byId("of-point").hidden = !(axis && motion);
  const example = designs.exampleOf(designs.current());
  const place = byId("example");
  place.hidden = example === undefined;
  if (example === undefined) return;
  place.textContent = `Example, until you choose something else: ${vocabulary.starts[example].title}.`;
}

/**
 * Show the values of an answer where nothing is typed. The laws of the model are known with it, and so is the lead.
 *
 * @param {Run} answer
 */
export function showAnswer(answer) {
  if (keepLead(answer) || lawsOf(answer) !== byId("form").dataset.laws) show(answer);
  form.showValues(effective(answer));
  form.showFaults([]);
}

/**
 * Show the faults of a case that is refused beside their fields.
 *
 * @param {FaultLine[]} faults
 */
export function showFaults(faults) {
  form.showValues({});
  return form.showFaults(faults);
}

/** The laws of the model of an answer, as text. @param {Run | undefined} answer */
function lawsOf(answer) {
  return answer ? JSON.stringify([answer.inputs.model, answer.inputs.losses]) : "";
}

/**
 * Keep the lead that the design on the page was computed with, where it is no plain number. Returns whether it is new.
 *
 * @param {Run} answer
 */
function keepLead(answer) {
  const lead = valueAt(answer.inputs, "screw.lead");
  const { given, computed } = designs.currentLead();
  if (units.parse(given, "m") || typeof lead !== "number" || computed === lead) return false;
  designs.keepLead(lead);
  return true;
}

/** The values in SI that count: those of the answer, and the usual limits. @param {Run | undefined} answer @returns {Tables} */
function effective(answer) {
  const { inputs } = answer ?? {};
  const given = /** @type {Record<string, unknown>} */ (inputs?.limits ?? {});
  const limits = Object.entries(vocabulary.limits).map(([name, usual]) => [name, given[name] ?? usual]);
  return { ...inputs, limits: { ...given, ...Object.fromEntries(limits) } };
}

function showTabs() {
  const { designs: all, show: shown } = store.state;
  const buttons = all.map((one, place) =>
    element(
      "button",
      {
        type: "button",
        class: "tab",
        id: `design-${LETTERS[place]}`,
        "aria-pressed": String(place === shown),
        onclick: () => designs.show(place),
      },
      element("span", { class: "long" }, "Design "),
      LETTERS[place],
      " ", // a space within a block of its own is not seen
      one.name ? element("span", { class: "own-name" }, one.name) : null,
    ),
  );
  const add = () => designs.duplicate(store.state.show);
  const remove = () => designs.remove(store.state.show);
  byId("designs").replaceChildren(
    ...buttons,
    element("button", { type: "button", id: "add", disabled: !designs.hasRoom(), onclick: add }, "Add design"),
    element("button", { type: "button", id: "remove", disabled: all.length === 1, onclick: remove }, "Remove"),
  );
}
