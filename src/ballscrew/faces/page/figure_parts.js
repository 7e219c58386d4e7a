// Marks that many figures have: the operating point, and where the model does not hold.

/** @import { Curve, Outside, Point, Values } from "./figure.js" */

export const OUTSIDE = "outside the model's validity";

/**
 * The operating point: a diamond in front of the curves.
 *
 * @param {number | null | undefined} x
 * @param {number | null | undefined} y
 * @param {string} [colour]
 * @returns {Point}
 */
export function pointAt(x, y, colour = "ink") {
  return { kind: "point", name: "operating point", x, y, colour };
}

/** Where the model is not valid. @param {Values} x @param {boolean[]} valid @returns {Outside} */
export function outside(x, valid) {
  return { kind: "outside", name: OUTSIDE, x, valid };
}

/**
 * A curve, solid where the model is valid and dotted where it is not; both meet.
 *
 * @param {Values} x
 * @param {Values} y
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
