// Messages of the server: templates with their values, filled in the units of the page.

import { labelIn, words } from "./fields.js";
import { OF_CARDS, SECTIONS } from "./schema.js";
import { filledIn, textOr } from "./texts.js";
import { formattedIn, inSystem, symbol, withPowers } from "./units.js";

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
 * The name of a field, a law, a number of a fit or a condition of validity; a bare name is that of the first section that has such a field.
 *
 * @param {string} path
 */
function nameOf(path) {
  const name = path.slice(path.lastIndexOf(".") + 1);
  const sections = [...Object.keys(SECTIONS), ...Object.keys(OF_CARDS)];
  const keys = [path, name, ...sections.map((section) => `${section}.${name}`)].map((one) => `field.${one}.label`);
  return [...keys, `fit.number.${name}`].reduceRight((other, key) => textOr(key, other), words(name));
}

/**
 * A message with its numbers in the current units.
 *
 * @param {Message} message
 * @returns {string}
 */
export function said({ template, values }) {
  return filled(textOr(`message.${template}`, template), values);
}

/**
 * A text with the values of a message; a field without a value is one to fill in.
 *
 * @param {string} pattern
 * @param {Message["values"]} values
 */
function filled(pattern, values) {
  return filledIn(pattern, (name) => {
    if (Object.hasOwn(values, name)) return partOf(values[name]);
    return name.includes(".") ? setting(name) : undefined;
  });
}

/**
 * @param {Message["values"][string]} value
 * @returns {string}
 */
function partOf(value) {
  if (typeof value === "string") return value;
  if (Array.isArray(value)) return value.map(said).join(", ");
  if ("template" in value) return said(value);
  if ("field" in value) return setting(value.field);
  if ("name" in value) return nameOf(value.name);
  if ("unit_name" in value) return symbol(inSystem(value.unit_name));
  return withPowers(formattedIn(value.value, value.shown_in, value.unit, value.digits, value.toward));
}

/** @param {string} path */
function setting(path) {
  return `${labelOf(path)}: `;
}

/**
 * A record in words.
 *
 * @param {VerdictRecord} record
 */
export function ofRecord({ message }) {
  return said(message);
}

/**
 * A fault in words: what the page says of this field, or what is wrong, the value, and what to do.
 *
 * @param {FaultLine} fault
 */
export function inWords({ where, given, messages: { problem, given: told, remedy } }) {
  if (!problem) return "";
  const own = textOr(`fault.${where}: ${problem.template}`, textOr(`fault.${problem.template}`, ""));
  if (own) return filled(own, problem.values);
  const value = told ? said(told) : given;
  const advice = remedy ? said(remedy).trim() : "";
  return `${said(problem)}${value ? ` (${value})` : ""}${advice ? `: ${advice}` : ""}`;
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

/**
 * A literal text of the schema.
 *
 * @param {string} english
 */
export function translated(english) {
  return said({ template: english, values: {} });
}
