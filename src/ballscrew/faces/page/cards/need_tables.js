// The tables of a need, of the fields of the card of choosing and of what was opened.

import * as designs from "../designs.js";
import { LISTS, OF_MASS } from "../needs.js";

/** Fields that a duty has in its own way, and its sections. */
const OF_POINT = ["axial_load", "feed"];
const OF_DUTY = ["axis", "motion", "motor"];

/** @typedef {import("../state.js").Frozen<import("../state.js").Need>} FrozenNeed */

/**
 * The fields that do not count: a duty has load and speed in its own way, and a mass makes the force.
 *
 * @param {FrozenNeed} need
 */
export function leftOut({ texts, duty }) {
  if (duty) return [...OF_POINT, ...OF_MASS];
  return texts.mass ? ["axial_load"] : [];
}

/**
 * The fields that are still to be given: load and speed, or what makes a motion of a mass; none where a file says them.
 *
 * @param {FrozenNeed} need
 */
export function missingIn({ texts, rest, duty }) {
  if (duty || ["operation", ...OF_DUTY].some((name) => name in rest)) return [];
  const needed = texts.mass ? ["acceleration", "feed", "stroke"] : OF_POINT;
  return needed.filter((name) => !texts[name]);
}

/**
 * The tables of a need, as ``ballscrew select`` reads them.
 *
 * @param {FrozenNeed} need
 */
export async function tables(need) {
  const { texts, rest, duty } = need;
  const closed = leftOut(need);
  const given = Object.entries(texts).filter(([name, value]) => value && !closed.includes(name));
  const values = given.map(([name, value]) => [name, LISTS.includes(name) ? value.split(/;|,\s+/) : value]);
  const found = { ...rest, need: { .../** @type {object} */ (rest.need), ...Object.fromEntries(values) } };
  if (!duty) return found;
  const current = await designs.currentCase();
  const moving = OF_DUTY.filter((name) => name in current).map((name) => [name, current[name]]);
  return { ...found, ...Object.fromEntries(moving) };
}
