// Designs side by side, and the case with other models and laws.

import * as charts from "./charts.js";
import { byId, element, table } from "./dom.js";
import { data } from "./results.js";
import * as units from "./units.js";

const ROWS = [
  ["screw_torque", "friction torque"], ["drive_torque", "drive torque"], ["efficiency", "efficiency, screw drives"],
  ["back_driving_efficiency", "efficiency, load drives"], ["holding_torque", "torque that holds the load"],
  ["friction_power", "heat"], ["preload_drag", "torque without load"],
];

/** A table of all designs, and their torques as bars; ``answers`` by letter, a text where there is none; ``names`` of their starts. */
export function showDesigns(answers, names, mechanisms) {
  const place = byId("compare");
  const letters = Object.keys(answers);
  const good = Object.fromEntries(Object.entries(answers).filter(([, answer]) => answer.results));
  if (letters.length < 2) {
    place.replaceChildren(element("p", {}, "Add a design above: up to four stand here side by side."));
    byId("compare-chart").hidden = true;
    return null;
  }
  const cell = (letter, read) => (good[letter] ? read(good[letter]) : "–");
  const lead = [
    ["start", ...names],
    ["what", ...letters.map((letter) => cell(letter, (answer) => units.sentence(answer.words.title)))],
    ...ROWS.filter(([name]) => letters.some((letter) => good[letter]?.results[name] !== undefined))
      .map(([name, words]) => [words, ...letters.map((letter) => cell(letter, (answer) => data(name, answer.results[name])))]),
    ["least λ", ...letters.map((letter) => cell(letter, ({ results }) => units.digits(Math.min(results.screw.film_parameter, results.nut.film_parameter), 3)))],
    ["greatest pressure", ...letters.map((letter) => cell(letter, ({ results }) => units.shown("maximum_pressure", results.maximum_pressure ?? Math.max(results.screw.maximum_pressure, results.nut.maximum_pressure))))],
    ["verdict", ...letters.map((letter) => cell(letter, (answer) => answer.words.verdicts.map((line) => line.split(":")[0].split(";")[0]).filter((line, at, all) => all.indexOf(line) === at).join("; ")))],
    ["beware", ...letters.map((letter) => (good[letter] ? good[letter].warnings.map((line) => line.split(":")[0].replaceAll("_", " ")).join(", ") || "–" : answers[letter]))],
  ];
  place.replaceChildren(element("div", { class: "scroll whole", tabindex: "0", role: "region", "aria-label": "table of the designs" },
    table("designs side by side", ["", ...letters.map((letter) => `Design ${letter}`)], lead)));
  if (Object.keys(good).length) return charts.designs(good, mechanisms);
  return null;
}

/** What all models and laws say of the case. */
export function showModels(found) {
  const line = (row) => [row.slot ? `${row.slot.replaceAll("_", " ")}: ${row.name}` : row.name, data("screw_torque", row.screw_torque),
    row.change === 0 ? "–" : `${row.change > 0 ? "+" : ""}${units.digits(100 * row.change, 3)} %`, data("efficiency", row.efficiency), row.counts === false ? "printed form, breaks a balance" : row.valid ? "yes" : row.not_valid_because.map((reason) => reason.replaceAll("_", " ")).join(", ")];
  const rows = [["this case", ...line({ ...found.case, slot: null }).slice(1)], ...found.models.map(line), ...found.laws.map(line)];
  byId("models").replaceChildren(element("div", { class: "scroll whole", tabindex: "0", role: "region", "aria-label": "models and laws" },
    table("all models as they are, then this case with one law at a time in place of its own", ["model or law", "friction torque", "change", "efficiency", "valid here"], rows)));
}
