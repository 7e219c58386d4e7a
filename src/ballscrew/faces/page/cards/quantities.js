// Quantities of cards: lists and numbers in SI, shown in the units of the page.

import * as units from "../units.js";

/**
 * A quantity by its SI unit, and the metric unit in which it is shown.
 *
 * @param {string} si
 * @param {string} metric
 */
export function quantity(si, metric) {
  const unit = () => units.inSystem(metric);
  /** @param {number | null | undefined} value */
  const convert = (value) => (value === null || value === undefined ? null : units.fromSI(value, unit(), si));
  return {
    convert,
    /** @param {readonly (number | null)[]} values */
    all: (values) => values.map(convert),
    /** @param {string} words */
    titled: (words) => `${words} (${units.symbol(unit())})`,
    /** @param {number | null | undefined} value @param {number} [digits] */
    text: (value, digits = units.DIGITS) => units.formattedIn(value, metric, si, digits),
  };
}

export const POSITION = quantity("m", "mm");
export const TORQUE = quantity("N m", "N m");
