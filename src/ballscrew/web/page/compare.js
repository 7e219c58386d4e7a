// Designs side by side, and the case with other models and laws.

import * as charts from "./charts.js";
import { byId, element, scrolling, table } from "./dom.js";
import { data, greatestPressure, leastFilm, nameOf, numbersOf } from "./results.js";
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

/** An answer by letter, or the line that says why there is none. @typedef {Record<string, Run | string>} Answers */

/** @param {string[]} names */
function joined(names) {
  return [...new Set(names)].join(", ") || "–";
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
  /** @type {Record<string, Run>} */
  const computed = {};
  for (const [letter, answer] of Object.entries(answers)) if (typeof answer !== "string") computed[letter] = answer;
  if (letters.length < 2) {
    place.replaceChildren(element("p", {}, "Add a design above: up to four are shown here side by side."));
    byId("compare-chart").hidden = true;
    return;
  }
  /**
   * @param {string} words
   * @param {(answer: Run) => string | Node} read
   */
  const row = (words, read) => [words, ...letters.map((letter) => (computed[letter] ? read(computed[letter]) : "–"))];
  /** @param {string} name */
  const isKnown = (name) => Object.values(computed).some((answer) => numbersOf(answer)[name] !== undefined);
  const rows = [
    ["start", ...starts],
    row("case", (answer) => units.filled(answer.display.title)),
    ...Object.entries(ROWS)
      .filter(([name]) => isKnown(name))
      .map(([name, words]) => row(words, (answer) => data(name, numbersOf(answer)[name]))),
    row("least λ", (answer) => units.digits(leastFilm(answer), 3)),
    row("greatest pressure", (answer) => units.formatted("maximum_pressure", greatestPressure(answer))),
    row("verdict", (answer) => joined(answer.verdicts.map(nameOf))),
    ["beware", ...letters.map((letter) => warningsOf(answers[letter]))],
  ];
  const headings = ["", ...letters.map((letter) => `Design ${letter}`)];
  place.replaceChildren(scrolling("table of the designs", table("designs side by side", headings, rows)));
  if (Object.keys(computed).length) await charts.designs(computed, mechanisms);
}

/** @param {Run | string} answer */
function warningsOf(answer) {
  return typeof answer === "string" ? answer : joined(answer.warnings.map(nameOf));
}

/** @typedef {{ name: string, slot?: string, counts?: boolean } & Compare["case"]} ComparedRow */

/** @param {ComparedRow} row */
function validity({ counts, valid, not_valid_because: reasons }) {
  if (counts === false) return "printed form, breaks a balance";
  return valid ? "yes" : reasons.map((reason) => reason.replaceAll("_", " ")).join(", ");
}

/** @param {number | null} change */
function percentage(change) {
  return change ? `${change > 0 ? "+" : ""}${units.digits(100 * change, 3)} %` : "–";
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
