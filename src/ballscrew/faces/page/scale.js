// Scales of axes: where values lie on a chart, and the round numbers along them.

import { digits, withPowers } from "./digits.js";

/** Steps between round numbers. */
const STEPS = [1, 2, 5, 10];
/** Digits of the numbers along an axis. */
const DIGITS = 6;
/** Decades from which a logarithmic axis has powers of ten alone. */
const MANY = 3;
/** Rounding that a value may lie outside. */
const SMALL = 1e-9;

/** The values from one end of an axis to the other, and the pixels of both. */
export class Scale {
  /** @param {number} from @param {number} to @param {number} start @param {number} end @param {boolean} [isLog] */
  constructor(from, to, start, end, isLog = false) {
    this.from = from;
    this.to = to;
    this.start = start;
    this.end = end;
    this.isLog = isLog;
    this.low = this.#along(from);
    this.high = this.#along(to);
  }

  /** @param {number} value */
  #along(value) {
    return this.isLog ? Math.log10(value) : value;
  }

  /** The pixel of a value; not a number where it has none. @param {number | null | undefined} value */
  pixel(value) {
    if (value === null || value === undefined) return Number.NaN;
    const share = (this.#along(value) - this.low) / (this.high - this.low);
    return this.start + share * (this.end - this.start);
  }

  /** The value at a pixel, within both ends. @param {number} pixel */
  value(pixel) {
    const share = Math.min(1, Math.max(0, (pixel - this.start) / (this.end - this.start)));
    const along = this.low + share * (this.high - this.low);
    return this.isLog ? 10 ** along : along;
  }

  /** Round values along the axis, at most about so many. @param {number} most */
  ticks(most) {
    const [low, high] = [Math.min(this.low, this.high), Math.max(this.low, this.high)];
    return this.isLog ? powers(low, high, most) : multiples(low, high, stepOf((high - low) / Math.max(1, most)));
  }
}

/** The least round number that is not below another one. @param {number} least */
export function stepOf(least) {
  const power = 10 ** Math.floor(Math.log10(least));
  return power * (STEPS.find((step) => step * power >= least * (1 - SMALL)) ?? 10);
}

/** @param {number} low @param {number} high @param {number} step */
function multiples(low, high, step) {
  const [first, last] = [Math.ceil(low / step - SMALL), Math.floor(high / step + SMALL)];
  return Array.from({ length: last - first + 1 }, (_, place) =>
    Number(((first + place) * step).toPrecision(DIGITS * 2)),
  );
}

/** @param {number} low @param {number} high exponents of ten @param {number} most */
function powers(low, high, most) {
  const [first, last] = [Math.floor(low), Math.floor(high + SMALL)];
  const step = Math.max(1, Math.ceil((last - first) / most));
  const decades = Array.from({ length: last - first + 1 }, (_, place) => first + place);
  const within = (/** @type {number} */ value) => value >= 10 ** low * (1 - SMALL) && value <= 10 ** high * (1 + SMALL);
  if (high - low < 1) return multiples(10 ** low, 10 ** high, stepOf((10 ** high - 10 ** low) / Math.max(1, most)));
  if (high - low < MANY)
    return decades.flatMap((power) => [1, 2, 5].map((digit) => digit * 10 ** power)).filter(within);
  return decades
    .filter((power) => (power - first) % step === 0)
    .map((power) => 10 ** power)
    .filter(within);
}

/** A number along an axis. @param {number} value */
export function tickWords(value) {
  return withPowers(digits(value, DIGITS));
}

/** The least and the greatest of finite numbers; nothing where there is none. @param {Iterable<number | null | undefined>} values @returns {[number, number] | undefined} */
export function extent(values) {
  let [low, high] = [Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY];
  for (const value of values) {
    if (value === null || value === undefined || !Number.isFinite(value)) continue;
    if (value < low) low = value;
    if (value > high) high = value;
  }
  return low > high ? undefined : [low, high];
}
