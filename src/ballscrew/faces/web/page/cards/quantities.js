// Quantities of cards: lists and numbers in SI, shown in the units of the page.

import { element } from "../dom.js";
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
    /**
     * A number as it is without a band, and the ends of its band; null without one.
     *
     * @param {number} value
     * @param {unknown} low
     * @param {unknown} high
     */
    within: (value, low, high) => {
      if (typeof low !== "number" || typeof high !== "number" || high <= low) return null;
      const [shown, ...ends] = [value, low, high].map((one) => units.fromSI(one, unit(), si));
      const [from, to] = units.ends(ends[0], ends[1]);
      const end = `\u00a0${units.symbol(unit())}`;
      return { text: `${units.digits(shown)}${end}`, low: from, high: `${to}${end}` };
    },
  };
}

export const POSITION = quantity("m", "mm");
export const TORQUE = quantity("N m", "N m");

/**
 * An exact number for programs, as text for people.
 *
 * @param {string} name
 * @param {number | null | undefined} value
 * @param {string} shown
 */
export function data(name, value, shown) {
  return element("data", { value: String(value ?? ""), "data-name": name }, shown);
}
