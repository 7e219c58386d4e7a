// Faults and names of fields in words.

import { labelIn, words } from "./fields.js";
import { OF_CARDS, SECTIONS } from "./schema.js";
import { textOr } from "./texts.js";

/**
 * The name of a field as the form labels it.
 *
 * @param {string} path
 */
export function labelOf(path) {
  const parts = path.split(".");
  const name = labelIn(path);
  return parts.length > 1
    ? `${name} (${SECTIONS[parts[0]] ?? OF_CARDS[parts[0]] ?? words(parts[0]).replaceAll("-", " ")})`
    : name;
}

/**
 * A fault in words: what the page says of this field, or what is wrong, the value, and what to do.
 *
 * @param {FaultLine} fault
 */
export function inWords({ where, problem, given, remedy }) {
  const own = textOr(`fault.${where}: ${problem}`, textOr(`fault.${problem}`, ""));
  return own || `${problem}${given ? ` (${given})` : ""}${remedy ? `: ${remedy}` : ""}`;
}

/** Places of faults that are keys, such as ``own-nut.preload``, and those that are files. */
const KEY = /^[a-z][\w-]*(?:\.[a-z_]+)+$/;
const FILE = /\.(?:csv|json|toml|txt|xlsx)$/;

/**
 * A fault that names no field of the form: its place, in words or as a file or an option has it, and the fault in words.
 *
 * @param {FaultLine} fault
 */
export function withPlace(fault) {
  const place = fault.where.startsWith("--") ? fault.where.slice(2) : fault.where;
  return `${KEY.test(place) && !FILE.test(place) ? labelOf(place) : place}: ${inWords(fault)}`;
}
