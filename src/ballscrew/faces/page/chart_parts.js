// What charts show of answers: values in the units of the page.

import * as units from "./units.js";

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
