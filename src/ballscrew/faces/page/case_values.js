// What a case says as numbers: its fields by their paths, their values in SI, and the axes of curves around its point.

import * as units from "./units.js";

/** @typedef {{ axial_load: number, screw_speed: number }} Point */
/** @typedef {CaseModule["axes"][string][string]} CurveAxis */

/** Digits of a value of an axis, as the server has them. */
const DIGITS = 6;

/** A number as an answer has it; none of what is no number. @param {number | null | undefined} value */
export function plain(value) {
  return typeof value === "number" && Number.isFinite(value) ? value : null;
}

/**
 * Everything in tables by its path, as JSON. An empty table counts, too: ``bodies`` without sizes is elastic.
 *
 * @param {Record<string, unknown>} tables
 * @param {string} [above]
 * @param {Map<string, string>} [texts]
 */
export function textsOf(tables, above = "", texts = new Map()) {
  for (const [name, value] of Object.entries(tables)) {
    const isTable = value !== null && typeof value === "object" && !Array.isArray(value);
    if (isTable && Object.keys(value).length)
      textsOf(/** @type {Record<string, unknown>} */ (value), `${above}${name}.`, texts);
    else texts.set(`${above}${name}`, JSON.stringify(value));
  }
  return texts;
}

/**
 * The value in SI of what is typed in a field; none for what is no number, or beyond its bounds.
 *
 * @param {string} text as JSON
 * @param {CaseModule["places"][string]} place
 */
export function valueAt(text, { unit, above, at_least, below, at_most, whole }) {
  const written = JSON.parse(text);
  const parsed = typeof written === "number" ? { number: written, unit: "" } : units.parse(written, unit);
  if (!parsed) return undefined;
  const value = typeof written === "number" ? written : units.toSI(parsed.number, parsed.unit, unit);
  const isWithin =
    value > (above ?? Number.NEGATIVE_INFINITY) &&
    value >= (at_least ?? Number.NEGATIVE_INFINITY) &&
    value < (below ?? Number.POSITIVE_INFINITY) &&
    value <= (at_most ?? Number.POSITIVE_INFINITY);
  return isWithin && (!whole || Number.isInteger(value)) ? value : undefined;
}

/**
 * The values of an axis around a value: from a share of its far end to it, and their negatives where that is negative.
 *
 * @param {CurveAxis} axis
 * @param {number} value
 */
function axisAround({ share, points, points_of_sign, far: otherwise }, value) {
  const far = 2 * value || otherwise;
  const count = far < 0 ? points_of_sign : points;
  const [end, first] = [Math.abs(far), Math.abs(far) / share];
  const sizes = Array.from({ length: count }, (_, place) =>
    Number((first + (place * (end - first)) / (count - 1)).toPrecision(DIGITS)),
  );
  return far < 0 ? [...sizes.toReversed().map((size) => -size), ...sizes] : sizes;
}

/**
 * The axes of the curves around a point.
 *
 * @param {CaseModule["axes"]} axes
 * @param {Point} point
 * @returns {Record<string, Record<string, number[]>>} values by the curve and the axis
 */
export function axesAround(axes, point) {
  return Object.fromEntries(
    Object.entries(axes).map(([curve, own]) => [
      curve,
      Object.fromEntries(
        Object.entries(own).map(([name, axis]) => [name, axisAround(axis, point[/** @type {keyof Point} */ (name)])]),
      ),
    ]),
  );
}
