// Numbers as the visitor reads them, with their units.

const RAISED = "⁰¹²³⁴⁵⁶⁷⁸⁹";
/** From here on a number has a power of ten. */
const LARGE = 1e5;
/** Digits in groups, with what stands behind their decimal sign: 4 000, 4.000,5 and 4,000.5. */
const GROUPED = [
  /^([-+]?\d{1,3}(?:[' \u00a0\u2009\u202f]\d{3})+)(?:[.,](\d*))?$/,
  /^([-+]?\d{1,3}(?:\.\d{3})+),(\d*)$/,
  /^([-+]?\d{1,3}(?:,\d{3})+)\.(\d*)$/,
];
const PLAIN_NUMBER = /^[-+]?(?:\d+\.?\d*|\.\d+)$/;
/** A number that could be two, where people write a decimal point: 4,000. */
const EITHER = /^[-+]?\d*[1-9]\d*,\d{3}$/;
const QUANTITY = /^([-+\d.,' \u00a0\u2009\u202f]*(?:e[-+]?\d+)?)(.*)$/i;

/** @type {Record<string, string>} */
let unitSigns = {};

/** @param {Record<string, string>} symbols of units by their names */
export function useSymbols(symbols) {
  unitSigns = symbols;
}

/** What is kept in this browser, if it keeps anything. @param {string} name */
export function kept(name) {
  try {
    return localStorage.getItem(name);
  } catch {
    return null; // a browser may forbid it
  }
}

/**
 * @param {string} name
 * @param {string} value
 */
export function keep(name, value) {
  try {
    localStorage.setItem(name, value);
  } catch {
    // it is asked again next time
  }
}

/** A name in words. @param {string} name */
export function spaced(name) {
  const words = (name.split(".").at(-1) ?? name).replaceAll("_", " ");
  return words.slice(0, 1).toUpperCase() + words.slice(1);
}

/**
 * A number of so many digits as it is read.
 *
 * @param {number} number
 * @param {number} [digits]
 */
export function digitsOf(number, digits = 4) {
  if (!Number.isFinite(number)) return "–";
  const text = number.toPrecision(digits);
  const plain = text.includes("e") ? String(Number(text)) : text;
  return plain.replace("-", "−");
}

/**
 * A number of three digits, a large one with a power of ten: 9.56 · 10⁶.
 *
 * @param {number} number
 */
export function powerOf(number) {
  if (Math.abs(number) < LARGE) return digitsOf(number, 3);
  const [digits, power] = number.toExponential(2).split("e+");
  return `${digits} · 10${[...power].map((one) => RAISED[Number(one)]).join("")}`;
}

/** A number without needless digits, for axes and fields. @param {number} number */
export function plainDigits(number) {
  return String(Number(number.toPrecision(12))).replace(/^-/, "−");
}

/** How units and digits of sentences are written here. */
export const inPlace = {
  sign: signOf,
  digits: (/** @type {string} */ text) => text.replace(/^-?[\d.]+e\+\d+/, (one) => String(Number(one))),
};

/** A number as somebody typed it, read as the program does; NaN where it is none or could be two. @param {string} text */
function numberIn(text) {
  const [mantissa, exponent = "0"] = text.trim().toLowerCase().split("e");
  const grouped = GROUPED.map((pattern) => pattern.exec(mantissa)).find((match) => match);
  if (!grouped && EITHER.test(mantissa)) return Number.NaN;
  const plain = grouped ? `${grouped[1].replace(/[^-+\d]/g, "")}.${grouped[2] ?? ""}` : mantissa.replace(",", ".");
  return PLAIN_NUMBER.test(plain) ? Number(`${plain}e${exponent}`) : Number.NaN;
}

/**
 * A quantity as somebody typed it, with or without a unit, in the unit that it is shown in: 4000, or 4 kN. NaN where it is
 * not understood.
 *
 * @param {string} text
 * @param {{ unit: string, factor: number, offset: number }} quantity
 * @param {Record<string, { unit: string, factor: number, offset: number }[]>} units by SI unit
 */
export function quantityIn(text, { unit, factor, offset }, units) {
  const [, digits, name] = QUANTITY.exec(text.trim().replace("−", "-")) ?? [];
  const number = numberIn(digits);
  if (!name) return number;
  const bare = (/** @type {string} */ one) => one.replaceAll(/[\s·]/g, "").replace(/[µμ]/, "u");
  const known = units[unit]?.find((one) => [one.unit, signOf(one.unit)].some((sign) => bare(sign) === bare(name)));
  return known ? Number(((number * known.factor + known.offset - offset) / factor).toPrecision(12)) : Number.NaN;
}

/** A unit as it is read; nothing for a plain number. @param {string} unit */
export function signOf(unit) {
  return unit === "1" ? "" : (unitSigns[unit] ?? unit);
}

/** The name of an axis with its unit. @param {string} words @param {string} unit */
export function withUnit(words, unit) {
  const sign = signOf(unit);
  return sign ? `${words} (${sign})` : words;
}
