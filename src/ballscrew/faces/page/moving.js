// What is shown while something moves: numbers and curves of the module in the browser, in the form of the answers that
// the server sends when it rests.

import { plain } from "./case_values.js";
import { localEngine, pointOf, pointsOf } from "./local_engine.js";
import { FLOODED, FULL_BATH } from "./starvation.js";

/** @import { Found, Values } from "./engine.js" */
/** @import { Point } from "./local_engine.js" */
/** Sweeps by the name of their curve. @typedef {Record<string, Sweep>} Sweeps */

/** Results that are computed here, where the answer before has them; the others stay as they were. */
const RESULTS = [
  "drive_torque",
  "screw_torque",
  "nut_torque",
  "ideal_torque",
  "efficiency",
  "back_driving_efficiency",
  "holding_torque",
  "friction_coefficient",
  "friction_angle",
  "friction_power",
  "minimum_film_parameter",
  "maximum_pressure",
];

/**
 * An answer with the numbers of other inputs. Its sentences and checks are those of before.
 *
 * @param {Run} answer
 * @param {Values} values
 * @returns {Run}
 */
export function answerOf(answer, values) {
  const point = pointOf(values);
  const found = localEngine.at(values, [point, { ...point, axial_load: 0 }]);
  /** @type {Record<string, any>} */
  const results = { ...answer.results };
  for (const name of RESULTS) if (name in results && name in found) results[name] = plain(found[name][0]);
  results.valid = Boolean(found.valid[0]);
  if (typeof results.preload_drag === "number") results.preload_drag = plain(found.screw_torque[1]);
  results.contributions = changed(results.contributions, found, "contribution_");
  for (const side of ["screw", "nut"]) results[side] = changed(results[side], found, `${side}_`);
  const operation = { .../** @type {object} */ (answer.inputs.operation), ...point };
  return { ...answer, inputs: { ...answer.inputs, operation }, results: /** @type {Run["results"]} */ (results) };
}

/**
 * @param {Record<string, number | null>} before
 * @param {Found} found
 * @param {string} prefix
 */
function changed(before, found, prefix) {
  const names = Object.keys(before).filter((name) => `${prefix}${name}` in found);
  return { ...before, ...Object.fromEntries(names.map((name) => [name, plain(found[`${prefix}${name}`][0])])) };
}

/**
 * Curves for other inputs, in place of those of the answer before; those that take longer than there is time are left
 * out.
 *
 * @param {Sweeps} before
 * @param {Values} values
 * @param {boolean} isHeld whether the axes stay as they are
 * @param {number} time milliseconds that there are
 * @returns {Sweeps}
 */
export function curvesOf(before, values, isHeld, time) {
  const point = pointOf(values);
  const around = localEngine.axesAround(point);
  /** @type {[string, Record<string, number[]>, Point[]][]} */
  const wanted = [];
  let sum = 0;
  for (const [curve, { axes, outputs }] of Object.entries(before)) {
    const held = Object.entries(axes).map(([name, axis]) => [
      name,
      isHeld ? /** @type {number[]} */ (axis.values) : around[curve][name],
    ]);
    const own = Object.fromEntries(held);
    const along = pointsOf(point, own);
    sum += FLOODED in outputs ? 2 * along.length : along.length;
    if (wanted.length && localEngine.timeOf(sum) > time) break;
    wanted.push([curve, own, along]);
  }
  if (!wanted.length) return {};
  const points = wanted.flatMap(([, , own]) => own);
  const found = localEngine.at(values, points);
  if (wanted.some(([curve]) => FLOODED in before[curve].outputs))
    found[FLOODED] = localEngine.at(values, points, FULL_BATH).screw_torque;
  let from = 0;
  return Object.fromEntries(
    wanted.map(([curve, axes, { length }]) => {
      const sweep = sweepOf(before[curve], axes, found, from);
      from += length;
      return [curve, sweep];
    }),
  );
}

/**
 * A sweep like another one along other axes.
 *
 * @param {Sweep} before
 * @param {Record<string, number[]>} axes
 * @param {Found} found
 * @param {number} from its first point
 * @returns {Sweep}
 */
function sweepOf(before, axes, found, from) {
  const sizes = Object.values(axes).map((values) => values.length);
  const length = sizes.reduce((product, size) => product * size, 1);
  /** @param {string} name */
  const valuesOf = (name) => {
    const flat = Array.from(found[name].subarray(from, from + length), (value) =>
      name === "valid" ? Boolean(value) : plain(value),
    );
    if (sizes.length === 1) return flat;
    return Array.from({ length: sizes[0] }, (_, row) => flat.slice(row * sizes[1], (row + 1) * sizes[1]));
  };
  const outputs = Object.entries(before.outputs).filter(([name]) => name in found);
  return /** @type {Sweep} */ ({
    ...before,
    axes: Object.fromEntries(Object.entries(axes).map(([name, values]) => [name, { ...before.axes[name], values }])),
    outputs: Object.fromEntries(outputs.map(([name, output]) => [name, { ...output, values: valuesOf(name) }])),
  });
}
