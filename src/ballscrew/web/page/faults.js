// Faults of the input in the words of the page: labels of its fields in place of keys of a file.

import { words } from "./fields.js";
import { SECTIONS } from "./schema.js";

/** What people read in place of a message for files: the field, what is wrong with it, and the text. */
/** @type {[RegExp, RegExp, string][]} */
const OWN = [
  [/^lubricant\.viscosity$/, /^missing/, "Give a viscosity; or choose a grade, or give two kinematic viscosities."],
  [/^lubricant\.kinematic/, /^missing/, "Give both kinematic viscosities, at 40 °C and at 100 °C."],
  [/^lubricant\./, /^contradicts/, "This and another field tell the oil in two ways: empty one of the two."],
  [/^lubricant\.temperature$/, /^needs/, "A temperature needs an oil that follows it: choose a grade."],
  [
    /^nut\.preload$/,
    /^missing/,
    "Give the preload of this kind of nut: a force, or a share of the load rating such as 7 %.",
  ],
  [
    /^nut\.preload$/,
    /not known/,
    "A share needs the dynamic load rating of the screw: give that, or the preload as a force.",
  ],
  [/^nut\.type$/, /^missing/, "Choose the kind of nut."],
  [/^nut\./, /^a nut of type/, "This kind of nut has none: empty the field, or choose another kind."],
  [/^installation\.ends$/, /^missing/, "Choose how the ends of the shaft are held."],
  [/^installation\.unsupported_length$/, /^missing/, "Give the unsupported length."],
  [/./, /^missing/, "Give a value: nothing stands for it."],
  [/./, /^unknown (key|section)/, "There is no such field."],
];

/**
 * The name of a field as the form labels it.
 *
 * @param {string} path
 */
export function labelOf(path) {
  const parts = path.split(".");
  const name = words(parts[parts.length - 1]);
  return parts.length > 1 ? `${name} (${SECTIONS[parts[0]] ?? words(parts[0])})` : name;
}

/**
 * A remedy without what only files and programs have.
 *
 * @param {string} remedy
 */
function plain(remedy) {
  return remedy
    .replace(/,? in Python .*$/, "")
    .replace("in a file write", "write")
    .replace(/\bdegC\b/g, "°C")
    .replace(/\bum\b/g, "µm")
    .replace(/\s*see "ballscrew[^"]*"/, "")
    .replace(/^start from .*$/, "")
    .replace(/give a number without quotes/, "give a number")
    .replace(/add a table \[(\w+)\].*$/, (_, name) => `fill in the section ${SECTIONS[name] ?? words(name)}`)
    .replace(/\[(\w+)\]/g, (_, name) => `the section ${SECTIONS[name] ?? words(name)}`)
    .replace(/\badd \{/g, "fill in {")
    .replace(/\{([\w.]+)\}/g, (_, path) => `${labelOf(path)}: `)
    .replace(/\b(\w+) = "/g, (_, name) => `${words(name)} "`)
    .replaceAll('"', "")
    .replace(/\b[a-z]+(?:_[a-z0-9]+)+\b/g, (name) => words(name))
    .trim();
}

/**
 * A fault in words: what is wrong, the value, and what to do.
 *
 * @param {FaultLine} fault
 */
export function inWords({ where, problem, given, remedy }) {
  const own = OWN.find(([field, wrong]) => field.test(where) && wrong.test(problem));
  if (own) return own[2];
  const advice = plain(remedy);
  const value = given ? ` (${given})` : "";
  return `${plain(problem)}${value}${advice ? `: ${advice}` : ""}`;
}
