// Parts that several charts have: the operating point, axes, and the ranges where the model is not valid.

import { text } from "./texts.js";
import * as units from "./units.js";

/** @typedef {import("./plot.js").Colours} Colours */
/** @typedef {import("./plot.js").LegendEntry} LegendEntry */

/** Colour over the ranges where the model is not valid. */
export const INVALID = "#80808055";
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
 * @param {{ ink: string, panel: string }} colours
 * @param {number | null | undefined} x
 * @param {number | null | undefined} y
 */
export function pointAt({ ink, panel }, x, y) {
  return {
    x: [x],
    y: [y],
    name: text("chart.operating_point"),
    mode: "markers",
    marker: { symbol: "diamond", size: 11, color: panel, line: { color: ink, width: 2.5 } },
    hovertemplate: "%{y:.4g}",
  };
}

/**
 * @param {Colours} colours
 * @returns {LegendEntry}
 */
export function pointEntry({ ink }) {
  return { kind: "point", name: text("chart.operating_point"), colour: ink };
}

/**
 * Areas over the ranges where the model is not valid, each to half the distance to the next valid point.
 *
 * @param {number[]} x
 * @param {boolean[]} valid
 */
export function invalidRanges(x, valid) {
  /** @param {number} place */
  const edge = (place) => {
    if (place <= 0) return x[0];
    return place >= x.length ? x[x.length - 1] : (x[place - 1] + x[place]) / 2;
  };
  const starts = valid.flatMap((holds, place) => (!holds && (place === 0 || valid[place - 1]) ? [place] : []));
  return starts.map((start) => {
    const end = valid.indexOf(true, start);
    return {
      type: "rect",
      yref: "paper",
      y0: 0,
      y1: 1,
      x0: edge(start),
      x1: edge(end < 0 ? x.length : end),
      fillcolor: INVALID,
      line: { width: 0 },
      layer: "above",
    };
  });
}

/**
 * @param {boolean[]} valid
 * @returns {LegendEntry[]}
 */
export function invalidEntries(valid) {
  return valid.every(Boolean) ? [] : [{ kind: "area", name: OUTSIDE, colour: INVALID }];
}

/** @param {boolean} valid */
export function yesOrNo(valid) {
  return text(valid ? "chart.yes" : "chart.no");
}

/**
 * A curve, solid where the model is valid and dotted where it is not; both meet.
 *
 * @param {number[]} x
 * @param {(number | null)[]} y
 * @param {boolean[]} valid
 * @param {string} name
 * @param {string} colour
 */
export function linesByValidity(x, y, valid, name, colour) {
  /** @param {(place: number) => boolean} isShown @param {string} dash */
  const line = (isShown, dash) => ({
    x,
    y: y.map((value, place) => (isShown(place) ? value : null)),
    name,
    mode: "lines",
    line: { color: colour, width: 2, dash },
    hovertemplate: "%{y:.4g}",
  });
  const solid = line((place) => valid[place], "solid");
  if (valid.every(Boolean)) return [solid];
  const isBeside = (/** @type {number} */ place) => [place - 1, place, place + 1].some((one) => valid[one] === false);
  return [solid, { ...line(isBeside, "dot"), showlegend: false, hoverinfo: "skip", hovertemplate: undefined }];
}

/**
 * @param {boolean[]} valid
 * @param {string} colour
 * @returns {LegendEntry[]}
 */
export function dottedEntries(valid, colour) {
  return valid.every(Boolean) ? [] : [{ kind: "dot", name: OUTSIDE, colour }];
}
