// Faults of the input in the words of the page: labels of its fields in place of keys of a file.

import { labelIn, words } from "./fields.js";
import { OF_CARDS, SECTIONS } from "./schema.js";
import { sentence, text, textOr } from "./texts.js";
import { inLanguage } from "./units.js";

/** What people read in place of a message for files: the field, what is wrong with it, and the text. */
/** @type {[RegExp, RegExp, import("./texts.js").Key][]} */
const OWN = [
  [/^lubricant\.viscosity$/, /^missing/, "fault.viscosity"],
  [/^lubricant\.kinematic/, /^missing/, "fault.kinematic_viscosity"],
  [/^lubricant\./, /^contradicts/, "fault.two_oils"],
  [/^lubricant\.temperature$/, /^needs/, "fault.temperature"],
  [/^nut\.preload$/, /^missing/, "fault.preload"],
  [/^nut\.preload$/, /not known/, "fault.preload_share"],
  [/^nut\.type$/, /^missing/, "fault.nut"],
  [/^nut\./, /^a nut of type/, "fault.not_of_nut"],
  [/^installation\.ends$/, /^missing/, "fault.ends"],
  [/^installation\.unsupported_length$/, /^missing/, "fault.unsupported_length"],
  [/./, /^missing/, "fault.missing"],
  [/./, /^unknown (key|section)/, "fault.unknown"],
];

/**
 * The name of a field as the form labels it.
 *
 * @param {string} path
 */
export function labelOf(path) {
  const parts = path.split(".");
  const name = labelIn(path);
  return parts.length > 1 ? `${name} (${SECTIONS[parts[0]] ?? OF_CARDS[parts[0]] ?? words(parts[0])})` : name;
}

/**
 * A remedy without what only files and programs have.
 *
 * @param {string} remedy
 */
export function plain(remedy) {
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
  if (own) return text(own[2]);
  const advice = plain(remedy);
  const value = given ? ` (${inLanguage(given)})` : "";
  return `${textOr(`problem.${problem}`, plain(problem))}${value}${advice ? `: ${sentence(advice)}` : ""}`;
}
