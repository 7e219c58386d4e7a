// Numbers as they are written, without a unit.

/** Significant digits of a number, with a band as without: those of the command line. */
export const DIGITS = 4;
/** Digits beyond which a number is that of its rounding errors. */
const EXACT = 12;
const RAISED = "⁰¹²³⁴⁵⁶⁷⁸⁹";

/**
 * A number to some significant digits, without trailing zeros: to the nearest, or down or up.
 *
 * @param {number | null | undefined} value
 * @param {number} [toward] -1 and 1 for the ends of a band, which are rounded outward
 */
export function digits(value, count = DIGITS, toward = 0) {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  const rounded = toward ? directed(value, count, toward) : Number(value.toPrecision(count));
  return Math.abs(rounded) >= 1e6 || (rounded !== 0 && Math.abs(rounded) < 1e-4)
    ? rounded.toExponential().replace("e+", "e")
    : String(rounded);
}

/**
 * The next number of so many digits below or above.
 *
 * @param {number} value
 * @param {number} count
 * @param {number} toward
 */
function directed(value, count, toward) {
  const exact = Number(value.toPrecision(EXACT));
  const nearest = Number(exact.toPrecision(count));
  if ((exact - nearest) * toward <= 0) return nearest;
  // of the exact number: the nearest one may be a power of ten above it
  const exponent = Number(exact.toExponential().split("e")[1]);
  const step = 10 ** (exponent - count + 1);
  return Number((nearest + toward * step).toPrecision(count));
}

/**
 * A number with the exponent of programs as people write it: 9.56 · 10⁶.
 *
 * @param {string} written
 */
export function withPowers(written) {
  return written.replace(
    /e(\d+)/,
    (_, power) => `\u00a0·\u00a010${[...power].map((one) => RAISED[Number(one)]).join("")}`,
  );
}
