// Units. Inputs are kept as text with a unit, as they were typed; only what is displayed is converted.

import { currentLead } from "./designs.js";
import { DIGITS, digits } from "./digits.js";
import { store } from "./store.js";
import { vocabulary } from "./vocabulary.js";

export { DIGITS, digits, withPowers } from "./digits.js";

const NUMBER = /^\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?)\s*(.*?)\s*$/i;
const COMMA = /^(\s*[-+]?\d*),(\d+)/;
/** Results that have the units of another one. @type {Record<string, string>} */
const SAME_UNIT = { preload_drag: "screw_torque" };
/** How far the full-width forms stand behind those of ASCII. */
const FULL_WIDTH = 0xfee0;

/** @typedef {import("./schema.js").SchemaNode} SchemaNode */

/** SI units of the speed of the screw, and of the nut along it. */
const OF_SCREW = "rad/s";
const OF_NUT = "m/s";

/** The system of units on the page: that of its state, where there is such a one. */
export function currentSystem() {
  const { system } = store.state;
  return Object.hasOwn(vocabulary.systems, system) ? system : "metric";
}

/** The lead in SI of the current design, where it is known: one turn of the screw moves the nut by it. @returns {number | undefined} */
function lead() {
  const { given, computed } = currentLead();
  const found = parse(given, "m");
  return (found ? toSI(found.number, found.unit, "m") : computed) || undefined;
}

/**
 * A unit in its usual symbols: µm, °C, m/s², N·m.
 *
 * @param {string} unit
 */
export function symbol(unit) {
  return vocabulary.symbols[unit] ?? unit;
}

/**
 * The name of a unit that was typed by its symbol.
 *
 * @param {string} typed
 */
function nameOf(typed) {
  return Object.keys(vocabulary.symbols).find((unit) => vocabulary.symbols[unit] === typed) ?? typed;
}

/**
 * The unit that replaces another one in the current system.
 *
 * @param {string} unit
 */
export function inSystem(unit) {
  return vocabulary.systems[currentSystem()][unit] ?? unit;
}

/**
 * The units to choose from for a quantity, by its SI unit.
 *
 * @param {string | undefined} si
 * @returns {UnitChoice[]}
 */
export function choices(si) {
  return (si && vocabulary.units[si]) || [];
}

/**
 * True where a field, as the schema has it, may have a unit.
 *
 * @param {string} unit
 * @param {SchemaNode | undefined} field
 */
export function isUnit(unit, field) {
  return [...choices(field?.["x-si-unit"]), ...choices(field?.["x-through-lead"])].some((one) => one.unit === unit);
}

/**
 * The units to choose from for a field: those along the screw where the lead is known.
 *
 * @param {SchemaNode} field
 */
export function choicesOf(field) {
  const along = choices(field["x-through-lead"]);
  return [...choices(field["x-si-unit"]), ...(along.length && lead() ? along : [])].map((one) => one.unit);
}

/**
 * @param {string} unit
 * @param {string | undefined} si
 */
function conversion(unit, si) {
  const found = choices(si).find((one) => one.unit === unit);
  const along = found || si !== OF_SCREW ? undefined : choices(OF_NUT).find((one) => one.unit === unit);
  const turn = along && lead();
  return along && turn ? { ...along, factor: (along.factor * 2 * Math.PI) / turn } : found;
}

/**
 * @param {number} number
 * @param {string} unit
 * @param {string | undefined} si
 */
export function toSI(number, unit, si) {
  const one = conversion(unit, si);
  return one ? number * one.factor + one.offset : number;
}

/**
 * @param {number} value
 * @param {string} unit
 * @param {string | undefined} si
 */
export function fromSI(value, unit, si) {
  const one = conversion(unit, si);
  return one ? (value - one.offset) / one.factor : value;
}

/**
 * A number with a point in place of its decimal comma; as it is where the comma may stand between thousands.
 *
 * @param {string} text
 */
export function withPoint(text) {
  return text.replace(COMMA, (whole, before, after) =>
    after.length === 3 && /[1-9]/.test(before) ? whole : `${before}.${after}`,
  );
}

/**
 * A text with digits and signs as keyboards have them: a minus sign and full-width digits are read as well.
 *
 * @param {string} text
 */
export function inASCII(text) {
  return text
    .replaceAll("\u2212", "-")
    .replaceAll("\u3000", " ")
    .replace(/[\uff01-\uff5e]/g, (one) => String.fromCharCode(one.charCodeAt(0) - FULL_WIDTH));
}

/**
 * The number and the unit of an input; null where it is something else, such as a distribution.
 *
 * @param {unknown} text
 * @param {string | undefined} si
 */
export function parse(text, si) {
  const written = inASCII(String(text));
  const match = NUMBER.exec(withPoint(written));
  if (!match) return null;
  const digits = written.trimStart().slice(0, match[1].length); // as they were typed
  const unit = nameOf(match[2]);
  return conversion(unit, si) ? { number: Number(match[1]), digits, unit } : null;
}

/**
 * The digits of an input in another unit; as they were typed where it is the unit they were typed in.
 *
 * @param {unknown} text
 * @param {string} unit
 * @param {string | undefined} si
 */
export function digitsIn(text, unit, si) {
  const found = parse(text, si);
  if (!found) return null;
  if (found.unit === unit) return found.digits;
  return String(Number(fromSI(toSI(found.number, found.unit, si), unit, si).toPrecision(10)));
}

/** @param {string} name */
function resultOf(name) {
  return vocabulary.results[SAME_UNIT[name] ?? name];
}

/**
 * The unit in which a result is displayed; none for a plain number.
 *
 * @param {string} name
 */
export function unitOf(name) {
  const known = resultOf(name);
  return known && known.unit !== "1" ? inSystem(known.shown_in) : "";
}

/** As units.py has it, in m. */
const SMALLEST_LENGTH = 1e-15;

/**
 * The value of a result in the unit in which it is displayed.
 *
 * @template {number | null | undefined} Value
 * @param {string} name
 * @param {Value} value
 * @returns {Value | number}
 */
export function inDisplayUnit(name, value) {
  const known = resultOf(name);
  if (!known || known.unit === "1" || value === null || value === undefined) return value;
  // below the size of a nucleus a length is what rounding leaves of none
  const isNone = known.unit === "m" && Math.abs(value) < SMALLEST_LENGTH;
  return fromSI(isNone ? 0 : value, inSystem(known.shown_in), known.unit);
}

/**
 * @param {number | null | undefined} value
 * @param {string} unit
 * @param {number} count
 */
function withUnit(value, unit, count) {
  const text = digits(value, count);
  return unit && text !== "–" ? `${text}\u00a0${symbol(unit)}` : text; // units do not wrap
}

/**
 * A result as text with its unit.
 *
 * @param {string} name
 * @param {number | null | undefined} value
 */
export function formatted(name, value, count = DIGITS) {
  return withUnit(inDisplayUnit(name, value), unitOf(name), count);
}

/**
 * A number in SI as text in a unit, or in that which the current system has in its place.
 *
 * @param {number | null | undefined} value
 * @param {string} metric
 * @param {string} si
 */
export function formattedIn(value, metric, si, count = DIGITS) {
  if (si === "1") return digits(value, count);
  const unit = inSystem(metric);
  return withUnit(value === null || value === undefined ? value : fromSI(value, unit, si), unit, count);
}

/**
 * The ends of a band as numbers without a unit, rounded outward.
 *
 * @param {number} low
 * @param {number} high
 * @returns {[string, string]}
 */
export function ends(low, high) {
  return [digits(low, DIGITS, -1), digits(high, DIGITS, 1)];
}

/**
 * A heading of an axis or a column: a name and its unit.
 *
 * @param {string} name
 * @param {string} words
 */
export function heading(name, words) {
  const unit = unitOf(name);
  return unit ? `${words} (${symbol(unit)})` : words;
}

/** What the server says of a number beside its value. @typedef {{ unit: string, shown_in: string }} Quantity */

/** The metric unit in which a number is shown; that of its value where the page cannot convert it. @param {Quantity} quantity */
function metricOf({ unit, shown_in: metric }) {
  return choices(unit).some((one) => one.unit === metric) ? metric : unit;
}

/**
 * A value in SI in the unit in which it is displayed; a text is itself.
 *
 * @template {number | string | null} Value
 * @param {Value} value
 * @param {Quantity | null} quantity
 * @returns {Value | number}
 */
export function converted(value, quantity) {
  if (typeof value !== "number" || !quantity || quantity.unit === "1") return value;
  if (quantity.unit === "m" && Math.abs(value) < SMALLEST_LENGTH) return 0;
  return fromSI(value, inSystem(metricOf(quantity)), quantity.unit);
}

/** The symbol of the unit in which a number is displayed; none for a plain number. @param {Quantity} quantity */
export function symbolOf(quantity) {
  return quantity.unit === "1" ? "" : symbol(inSystem(metricOf(quantity)));
}

/** A name with the unit in which its values are displayed. @param {string} words @param {Quantity} quantity */
export function titled(words, quantity) {
  const unit = symbolOf(quantity);
  return unit ? `${words} (${unit})`.trimStart() : words;
}
