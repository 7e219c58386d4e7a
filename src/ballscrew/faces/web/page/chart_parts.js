// Parts that several charts have: the operating point, axes, and the ranges where the model is not valid.

import { text } from "./texts.js";
import * as units from "./units.js";

/** @typedef {import("./figure.js").Mark} Mark */
/** @typedef {import("./figure.js").Curve} Curve */
/** @typedef {import("./figure.js").Outside} Outside */
/** @typedef {import("./figure.js").Point} Point */

export const OUTSIDE = text("chart.outside");

/**
 * Values of a swept axis or output along one axis.
 *
 * @param {{ values: unknown[] } | undefined} column
 * @returns {number[]}
 */
export function valuesOf(column) {
  return /** @type {number[]} */ (column?.values ?? []);
}

/**
 * Values of a result in its display unit.
 *
 * @param {string} name
 * @param {{ values: unknown[] } | undefined} column
 */
export function converted(name, column) {
  return valuesOf(column).map((value) => units.inDisplayUnit(name, value));
}

/**
 * True where the model is valid, along one axis.
 *
 * @param {Sweep} swept
 */
export function validAlong(swept) {
  return /** @type {boolean[]} */ (swept.outputs.valid.values);
}

/**
 * Load and speed of an answer in SI.
 *
 * @param {Run} answer
 * @returns {{ axial_load: number, screw_speed: number }}
 */
export function operationOf(answer) {
  return /** @type {{ axial_load: number, screw_speed: number }} */ (answer.inputs.operation);
}

/**
 * The title of an axis: a name and its unit.
 *
 * @param {string} name
 * @param {string} words
 */
export function titled(name, words) {
  return `${words} (${units.symbol(units.unitOf(name))})`;
}

/**
 * The operating point: a diamond in front of the curves.
 *
 * @param {number | null | undefined} x
 * @param {number | null | undefined} y
 * @param {string} [colour]
 * @returns {Point}
 */
export function pointAt(x, y, colour = "ink") {
  return { kind: "point", name: text("chart.operating_point"), x, y, colour };
}

/** Where the model is not valid. @param {number[]} x @param {boolean[]} valid @returns {Outside} */
export function outside(x, valid) {
  return { kind: "outside", name: OUTSIDE, x, valid };
}

/**
 * A curve, solid where the model is valid and dotted where it is not; both meet.
 *
 * @param {number[]} x
 * @param {(number | null)[]} y
 * @param {boolean[]} valid
 * @param {string} name
 * @param {string} colour
 * @param {string} [style]
 * @returns {Curve[]}
 */
export function linesByValidity(x, y, valid, name, colour, style = "line") {
  const isBeside = (/** @type {number} */ place) => [place - 1, place, place + 1].some((one) => valid[one] === false);
  const [inside, beyond] = [(/** @type {number} */ place) => valid[place], isBeside].map((isShown) =>
    y.map((value, place) => (isShown(place) ? value : null)),
  );
  /** @type {Curve} */
  const solid = { kind: "curve", name, x, y: inside, colour, style };
  if (valid.every(Boolean)) return [solid];
  return [solid, { kind: "curve", name: OUTSIDE, x, y: beyond, colour, style: "dotted", width: 1.2, isQuiet: true }];
}
