// Designs side by side, and the case with other models and laws.

import * as charts from "./charts.js";
import { verdict } from "./checks.js";
import { byId, element, scrolling, table } from "./dom.js";
import { data, greatestPressure, leastFilm, nameOf, numbersOf, rounded } from "./results.js";
import * as units from "./units.js";

/** @type {Record<string, string>} */
const ROWS = {
  screw_torque: "friction torque",
  drive_torque: "drive torque",
  efficiency: "efficiency, screw drives",
  back_driving_efficiency: "efficiency, load drives",
  holding_torque: "torque that holds the load",
  friction_power: "heat",
  preload_drag: "torque without load",
};

/**
 * What is known of a design: its answer, its checks and its band, or the line that says why there is none.
 *
 * @typedef {{ run?: Run, checks?: Checks, band?: BandAnswer, reason?: string }} Known
 */
/** By letter. @typedef {Record<string, Known>} Answers */

/** @param {string[]} names */
function joined(names) {
  return [...new Set(names)].join(", ") || "–";
}

/**
 * The change of a result against that of the first design, in percent.
 *
 * @param {number | null | undefined} value
 * @param {number | null | undefined} first
 */
function delta(value, first) {
  if (typeof value !== "number" || typeof first !== "number" || first === 0) return null;
  return element("span", { class: "delta" }, percentage(value / first - 1, "±0 %"));
}

/**
 * A table of all designs, and their torques as bars.
 *
 * @param {Answers} answers
 * @param {string[]} starts
 * @param {Mechanisms} mechanisms
 */
export async function showDesigns(answers, starts, mechanisms) {
  const place = byId("compare");
  const letters = Object.keys(answers);
  byId("compare-at").hidden = letters.length < 2;
  if (letters.length < 2) {
    place.replaceChildren(element("p", {}, "Add a design above: up to four are shown here side by side."));
    byId("compare-chart").hidden = true;
    return;
  }
  /**
   * @param {string} words
   * @param {(run: Run, known: Known, isFirst: boolean) => import("./dom.js").Child} read
   */
  const row = (words, read) => [
    words,
    ...letters.map((letter, at) => {
      const { run } = answers[letter];
      return run ? read(run, answers[letter], at === 0) : "–";
    }),
  ];
  const first = answers[letters[0]].run;
  const runs = letters.flatMap((letter) => answers[letter].run ?? []);
  /** @param {string} name */
  const isKnown = (name) => runs.some((run) => numbersOf(run)[name] !== undefined);
  /** @param {string} name */
  const cell = (name) => (/** @type {Run} */ run, /** @type {Known} */ known, /** @type {boolean} */ isFirst) => {
    const value = numbersOf(run)[name];
    const change = isFirst || !first ? null : delta(value, numbersOf(first)[name]);
    return element("span", {}, data(name, value, rounded(name, value, known.band).text), change);
  };
  const rows = [
    ["start", ...starts],
    row("case", (run) => units.filled(run.display.title)),
    ...Object.entries(ROWS)
      .filter(([name]) => isKnown(name))
      .map(([name, words]) => row(words, cell(name))),
    row("band of the friction torque, 95 %", (run, { band }) => {
      return rounded("screw_torque", run.results.screw_torque, band).interval ?? "–";
    }),
    row("least λ", (run) => units.digits(leastFilm(run), units.DIGITS)),
    row("greatest pressure", (run) => units.formatted("maximum_pressure", greatestPressure(run), units.DIGITS)),
    row("checks", (_, { checks }) => (checks ? verdict(checks) : "–")),
    row("verdict", (run) => joined(run.verdicts.map(nameOf))),
    [
      "beware",
      ...letters.map((letter) => answers[letter].reason ?? joined((answers[letter].run?.warnings ?? []).map(nameOf))),
    ],
  ];
  const headings = ["", ...letters.map((letter) => `Design ${letter}`)];
  const caption = `designs side by side ${conditions(first)}; changes are against Design ${letters[0]}`;
  place.replaceChildren(scrolling("table of the designs", table(caption, headings, rows)));
  const computed = Object.fromEntries(
    letters.flatMap((letter) => {
      const { run } = answers[letter];
      return run ? [[letter, run]] : [];
    }),
  );
  if (runs.length) await charts.designs(computed, mechanisms);
}

/**
 * Where the designs are compared.
 *
 * @param {Run | undefined} first
 */
function conditions(first) {
  const own = /** @type {HTMLInputElement} */ (byId("own")).checked;
  const { axial_load: load, screw_speed: speed } = /** @type {Record<string, number>} */ (
    first?.inputs.operation ?? {}
  );
  if (own || load === undefined) return "each at its own load and speed";
  const shown = [units.formatted("axial_load", load), units.formatted("screw_speed", speed)].join(" and ");
  return `all at ${shown}`;
}

/** @typedef {{ name: string, slot?: string, counts?: boolean } & Compare["case"]} ComparedRow */

/** @param {ComparedRow} row */
function validity({ counts, valid, not_valid_because: reasons }) {
  if (counts === false) return "printed form, breaks a balance";
  return valid ? "yes" : reasons.map((reason) => reason.replaceAll("_", " ")).join(", ");
}

/** @param {number | null} change */
function percentage(change, none = "–") {
  return change ? `${change > 0 ? "+" : ""}${units.digits(100 * change, 3)} %` : none;
}

/**
 * All models and laws side by side.
 *
 * @param {Compare} found
 */
export function showModels(found) {
  /** @param {ComparedRow} row */
  const line = (row, name = row.slot ? `${row.slot.replaceAll("_", " ")}: ${row.name}` : row.name) => [
    name,
    data("screw_torque", row.screw_torque),
    percentage(row.change),
    data("efficiency", row.efficiency),
    validity(row),
  ];
  const rows = [
    line(found.case, "this case"),
    ...found.models.map((row) => line(row)),
    ...found.laws.map((row) => line(row)),
  ];
  const caption = "all models as they are, then this case with one law at a time in place of its own";
  const headings = ["model or law", "friction torque", "change", "efficiency", "valid here"];
  const rules = found.rules.map((rule) => [
    rule.title,
    units.formatted("screw_torque", rule.screw_torque),
    percentage(rule.change),
    units.formatted("efficiency", rule.efficiency),
    units.formatted("screw_torque", rule.drag_torque),
    rule.source,
  ]);
  const inPlace = "rules of one line that people use in place of a model";
  const columns = ["rule", "friction torque", "change", "efficiency", "torque without load", "source"];
  byId("models").replaceChildren(
    scrolling("models and laws", table(caption, headings, rows)),
    scrolling("rules of one line", table(inPlace, columns, rules)),
  );
}
