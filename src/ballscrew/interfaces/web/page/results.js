// The answer in numbers and words: what one looks for first, then the contacts, with every warning beside what it concerns.

import { byId, element, table } from "./dom.js";
import * as units from "./units.js";

const FIRST = ["screw_torque", "drive_torque", "holding_torque", "efficiency", "back_driving_efficiency", "friction_power", "preload_drag"];
const CALLED = {
  screw_torque: "friction torque", drive_torque: "drive torque", holding_torque: "holding torque", efficiency: "efficiency, screw drives",
  back_driving_efficiency: "efficiency, load drives", friction_power: "heat", preload_drag: "torque without load",
};
const CONTACT = ["maximum_pressure", "minimum_film_thickness", "film_parameter", "friction_coefficient",
  "semi_major_axis", "semi_minor_axis", "pure_rolling_offset", "spin_parameter"];
const CONTACT_CALLED = {
  maximum_pressure: "greatest pressure", minimum_film_thickness: "film thickness", film_parameter: "film parameter λ",
  friction_coefficient: "friction coefficient", semi_major_axis: "semi-axis across", semi_minor_axis: "semi-axis along",
  pure_rolling_offset: "pure-rolling offset Y", spin_parameter: "spin parameter",
};
// where each warning belongs: the reasons are those of the program
const CONCERNS = {
  contact_pressure: "maximum_pressure", elastic_regime: "minimum_film_thickness", inlet_heating: "minimum_film_thickness",
  material_parameter: "minimum_film_thickness", radii_ratio: "semi_major_axis", pure_rolling_offset: "pure_rolling_offset",
  skid: "friction_coefficient",
};

/** An exact value, for programs, shown as people read it. */
export function data(name, value) {
  return element("data", { value: value === null || value === undefined ? "" : String(value), "data-name": name }, units.shown(name, value));
}

/** How the film separates the surfaces, in words. */
export function regime(film) {
  if (film === null || film === undefined) return "";
  if (film < 1) return "boundary: the asperities carry much of the load";
  return film < 3 ? "mixed: film and asperities share the load" : "full film";
}

function concern(warning) { return CONCERNS[warning.split(":")[0]]; }

function bandOf(band, name) {
  const one = band?.[name];
  if (!one || one.low === null || one.low === undefined) return null;
  return element("span", { class: "interval" }, `${units.digits(units.inShownUnit(name, one.low))} to ${units.shown(name, one.high)}`);
}

let sayLater;

/** Say it to those who listen, once typing has come to rest. */
function say(text) {
  clearTimeout(sayLater);
  sayLater = setTimeout(() => { byId("said").textContent = text; }, 700);
}

/** Everything of one answer but its pictures. */
export function show(answer, band) {
  const { results, words, warnings } = answer;
  byId("case").textContent = units.sentence(words.title);
  const torque = units.shown("screw_torque", results.screw_torque);
  const summary = `Friction torque ${torque}, efficiency ${units.digits(results.efficiency)}.`;
  byId("summary").textContent = summary;
  if (!byId("results").classList.contains("stale")) {
    say(summary);
    document.title = `${torque} · ballscrew`;
  }
  byId("verdicts").replaceChildren(...words.verdicts.map((line) =>
    element("p", { class: /^(self-locking|skids|preload lost)/.test(line) ? "verdict careful" : "verdict" }, units.sentence(line))));
  const here = warnings.filter((warning) => !concern(warning)), there = warnings.filter(concern).map((line) => line.split(":")[0].replaceAll("_", " "));
  if (there.length) {
    byId("verdicts").prepend(element("p", { class: "warning" }, element("strong", {}, "Outside the model's validity: "),
      `${there.join(", ")}. `, element("button", { type: "button", onclick: () => byId("contacts").scrollIntoView({ block: "center" }) }, "Why")));
  }
  byId("verdicts").append(...here.map((line) => warningOf(line)));
  byId("numbers").replaceChildren(element("dl", {}, ...FIRST.filter((name) => results[name] !== undefined).map((name) =>
    element("div", {}, element("dt", {}, CALLED[name]), element("dd", {}, data(name, results[name]), bandOf(band?.band, name))))));
  contacts(answer, warnings);
  byId("assumed").replaceChildren(element("ul", {}, ...words.assumed.map((line) => element("li", {}, units.sentence(line)))),
    element("p", { class: "small" }, `Model ${answer.provenance.model}, ballscrew ${answer.provenance.version}; sources: ${answer.provenance.references.join(", ")}.`));
  bandWords(band);
}

function warningOf(line) {
  const [reason, ...rest] = line.split(": ");
  return element("p", { class: "warning" }, element("strong", {}, `Beware, ${reason.replaceAll("_", " ")}: `), rest.join(": "));
}

function contacts({ results, loads }, warnings) {
  const names = CONTACT.filter((name) => results.screw[name] !== undefined && results.screw[name] !== null);
  const rows = names.map((name) => [CONTACT_CALLED[name], data(name, results.screw[name]), data(name, results.nut[name])]);
  const film = Math.min(results.screw.film_parameter, results.nut.film_parameter);
  const beside = warnings.filter((warning) => names.includes(concern(warning)) || concern(warning));
  byId("contacts").replaceChildren(
    element("p", { class: "regime" }, Number.isFinite(film) ? `λ = ${units.digits(film, 3)} at the least: ${regime(film)}` : "no film to speak of"),
    table(loads ? "contacts of the most loaded ball" : "contacts of each ball", ["", "ball and screw", "ball and nut"], rows),
    ...beside.map((line) => warningOf(line)));
}

function bandWords(band) {
  const place = byId("band-words");
  if (!band) { place.replaceChildren(); return; }
  if (band.pending) { place.replaceChildren(element("p", {}, "computing the band …")); return; }
  if (band.problem) { place.replaceChildren(element("p", { class: "warning" }, band.problem)); return; }
  place.replaceChildren(...band.words.sentences.map((line) => element("p", {}, units.sentence(line))), element("p", { class: "small" }, band.words.inputs),
    ...band.warnings.filter((line) => !concern(line)).map((line) => element("p", { class: "small" }, line)));
}

/** Nothing valid to show: say why, and dim what is from before. */
export function fail(lines) {
  const place = byId("faults");
  byId("results").classList.add("stale");
  byId("results").classList.toggle("empty", !byId("case").textContent);
  document.title = "not computed · ballscrew";
  const words = [...lines, byId("case").textContent ? "What stands below is of the input before." : null].filter(Boolean);
  if ([...place.children].map((one) => one.textContent).join("\n") === words.join("\n")) return; // said already
  place.replaceChildren(...words.map((line) => element("p", {}, line)));
  say(words.join(" "));
}

export function succeed() {
  byId("results").classList.remove("stale", "empty");
  byId("faults").replaceChildren();
}
