// The charts of sheets: curves with bands and lines, bars of parts, and maps, as figures in the units of the page.

import { LOW_AND_HIGH, VALUE } from "./figure_words.js";
import * as places from "./chart_place.js";
import { extent } from "./scale.js";
import { converted, digits, symbolOf, titled } from "./units.js";

/** @import { Mark as Drawn } from "./figure.js" */
/** @import { Block } from "./sheet.js" */
/** @import { Quantity } from "./units.js" */
/** @typedef {(number | null)[]} Values */
/** An axis of a chart. @typedef {{ name: string, quantity: Quantity, log: boolean, least: number | null }} Axis */
/** A curve. @typedef {{ name: string, x: Values, y: Values, colour: string, style: string, second: boolean, labels: string[] }} Curve */
/** The area between two curves. @typedef {{ name: string, x: Values, low: Values, high: Values, colour: string, solid: boolean }} Band */
/** A value of an axis that holds along the other one. @typedef {{ name: string, x?: number, y?: number, colour: string }} Level */
/** A bar and its parts. @typedef {{ name: string, parts: [string, number | null, string][], band: Values | null, text: string, hatched: boolean, start: number | null }} Bar */

/** Pixels: a row of bars, what stands above and below them, and the least height of a chart. */
const [ROW, FRAME, HEIGHT] = [26, 70, 260];
/** The colours of a map, from the least value to the greatest. */
const SHADES = ["#000004", "#57106e", "#bc3754", "#f98e09", "#fcffa4"];
/** Lines on a map. */
const ON_MAP = "#ffffff";

/**
 * Draw a block in its place.
 *
 * @param {string} id
 * @param {Block} block
 */
export function draw(id, block) {
  const chart = block.kind === "bars" ? barsOf(block) : block.kind === "map" ? mapOf(block) : chartOf(block);
  const height = Math.max(HEIGHT, FRAME + ROW * (chart.figure.y.names?.length ?? 0));
  document.getElementById(id)?.style.setProperty("--plot-height", `${height}px`);
  const name = slug(block.title).replaceAll("-", "_");
  places.draw(id, { name, caption: `${block.title}: numbers`, ...chart });
}

/** The name of a chart in addresses: letters, digits and hyphens. @param {string} words */
export function slug(words) {
  return words.toLowerCase().replaceAll(/[^a-z0-9]+/g, "-");
}

/** @param {Values} values @param {Axis} axis @returns {Values} */
function all(values, { quantity }) {
  return values.map((value) => converted(value, quantity));
}

/** An axis as figures have it. @param {Axis} axis @returns {import("./figure.js").Axis} */
function axisOf({ name, quantity, log, least }) {
  const title = titled(name, quantity);
  return least === null || (log && least <= 0)
    ? { title, log }
    : { title, log, from: Number(converted(least, quantity)) };
}

/** @param {Block} block */
function chartOf(block) {
  /** @type {{ title: string, x: Axis, y: Axis, second: Axis | null, marks: any[] }} */
  const { title, x, y, second, marks } = /** @type {any} */ (block);
  const found = marks.flatMap((mark) => markOf(mark, x, mark.second && second ? second : y, marks));
  const figure = { x: axisOf(x), y: axisOf(y), ...(second && { second: axisOf(second) }), marks: found };
  return { description: `${title}: ${figure.y.title} over ${figure.x.title}.`, figure };
}

/** A mark in the units of the page; none where its place is not known. @param {any} mark @param {Axis} x @param {Axis} y @param {any[]} marks @returns {Drawn[]} */
function markOf(mark, x, y, marks) {
  if ("style" in mark) return [curveOf(mark, x, y)];
  if ("low" in mark) {
    const { name, colour, solid, low, high } = /** @type {Band} */ (mark);
    return [{ kind: "band", name, x: all(mark.x, x), low: all(low, y), high: all(high, y), colour, solid }];
  }
  return levelOf(mark, x, y, marks);
}

/** @param {Curve} curve @param {Axis} x @param {Axis} y @returns {Drawn} */
function curveOf({ name, x: at, y: values, colour, style, second, labels }, x, y) {
  const size = style === "circles" ? { size: 7 } : {};
  return { kind: "curve", name, x: all(at, x), y: all(values, y), colour, style, second, labels, ...size };
}

/**
 * A level or a vertical line; one that has its name alone has its value beside it.
 *
 * @param {Level} level
 * @param {Axis} x
 * @param {Axis} y
 * @param {any[]} marks
 * @returns {Drawn[]}
 */
function levelOf({ name, colour, ...place }, x, y, marks) {
  const [along, axis] = /** @type {["x" | "y", Axis]} */ ("y" in place ? ["y", y] : ["x", x]);
  const value = place[along];
  if (typeof value !== "number") return [];
  const at = Number(converted(value, axis.quantity));
  const isAlone = marks.filter((mark) => mark.name === name).length === 1;
  const words = name && isAlone ? `${name} ${digits(at)} ${symbolOf(axis.quantity)}`.trim() : name;
  return [{ kind: "level", name: words, [along]: at, colour }];
}

// -- bars -------------------------------------------------------------------------------------------

/** @param {Block} block */
function barsOf(block) {
  /** @type {{ title: string, quantity: Quantity, bars: Bar[], marks: Level[], origin: number }} */
  const { title, quantity, bars, marks, origin } = /** @type {any} */ (block);
  const axis = { name: "", quantity, log: false, least: null };
  /** @type {Drawn[]} */
  const parts = bars.flatMap((bar, row) =>
    partsOf(bars, row, quantity, Number(converted(bar.start ?? origin, quantity))),
  );
  const names = bars.map(({ name, parts: own }) => ({ words: name, isBold: own.length === 0 }));
  /** @type {Level[]} */
  const lines = [{ name: "", x: origin, colour: "grey" }, ...marks];
  return {
    description: `${title}: ${bars.length} bars.`,
    figure: {
      x: { title: titled("", quantity) },
      y: { title: "", names },
      marks: [...parts, ...lines.flatMap((mark) => levelOf(mark, axis, axis, marks))],
    },
    numbers: () => numbersOfBars(bars, quantity),
  };
}

/** The size of a part in the unit of the page: a difference, which no offset changes. @param {number | null} value @param {Quantity} quantity */
function sizeOf(value, quantity) {
  return value === null ? null : Number(converted(value, quantity)) - Number(converted(0, quantity));
}

/**
 * The parts of a bar from its origin, negative ones to the left, and the ends of its band where both are known.
 *
 * @param {Bar[]} bars
 * @param {number} row
 * @param {Quantity} quantity
 * @param {number} origin
 * @returns {Drawn[]}
 */
function partsOf(bars, row, quantity, origin) {
  const { parts, band, hatched } = bars[row];
  const ends = { left: origin, right: origin };
  /** @type {Drawn[]} */
  const found = parts.map(([name, value, colour], part) => {
    const width = sizeOf(value, quantity);
    const side = Number(width) < 0 ? "left" : "right";
    const base = ends[side];
    ends[side] += Number(width);
    return {
      kind: "bar",
      name,
      row,
      base,
      width,
      colour,
      isHatched: hatched,
      words: wordsOf(bars, row, part, quantity),
    };
  });
  if (!band || band.includes(null)) return found;
  const [low, high] = band.map((end) => Number(converted(end, quantity)));
  return [...found, { kind: "whisker", name: "", row, low, high, colour: "ink" }];
}

/** The name of a bar: one without is a second bar of the one above. @param {Bar[]} bars @param {number} row */
function nameOf(bars, row) {
  return bars.slice(0, row + 1).findLast(({ name }) => name)?.name ?? "";
}

/** What is read of a part of a bar. @param {Bar[]} bars @param {number} row @param {number} part @param {Quantity} quantity */
function wordsOf(bars, row, part, quantity) {
  const { parts, text: beside } = bars[row];
  const [words, value] = parts[part];
  const number = `${digits(sizeOf(value, quantity))} ${symbolOf(quantity)}`.trim();
  return [[nameOf(bars, row), words].filter(Boolean).join(", "), number, beside].filter(Boolean).join(": ");
}

/**
 * A row for each part; the ends of a band, which is of the sum of all parts, stand beside the last.
 *
 * @param {Bar[]} bars
 * @param {Quantity} quantity
 * @returns {import("./figure_words.js").Numbers}
 */
function numbersOfBars(bars, quantity) {
  const rows = bars.flatMap(({ parts, band, text: beside }, row) =>
    parts.map(([words, value], part) => [
      [nameOf(bars, row), words].filter(Boolean).join(", "),
      sizeOf(value, quantity),
      ...((part === parts.length - 1 && band) || [null, null]).map((end) => converted(end, quantity)),
      part ? "" : beside,
    ]),
  );
  return [["", titled(VALUE, quantity), ...LOW_AND_HIGH, ""], rows];
}

// -- maps -------------------------------------------------------------------------------------------

/** @param {Block} block */
function mapOf(block) {
  /** @type {{ title: string, x: Axis, y: Axis, value: Axis, places: [Values, Values], values: Values[], marks: any[] }} */
  const { title, x, y, value, places, values, marks } = /** @type {any} */ (block);
  const grid = values.map((row) => all(row, value));
  const [from, to] = extent(grid.flat()) ?? [0, 1];
  const shades = {
    from,
    to,
    title: titled(value.name, value.quantity),
    colours: SHADES,
  };
  const [across, up] = [all(places[0], x), all(places[1], y)].map((ends) => ends.map(Number));
  const others = marks.flatMap((mark) => markOf("style" in mark ? mark : { ...mark, colour: ON_MAP }, x, y, marks));
  const figure = {
    x: { ...axisOf(x), from: Math.min(...across), to: Math.max(...across) },
    y: { ...axisOf(y), from: Math.min(...up), to: Math.max(...up) },
    marks: /** @type {Drawn[]} */ ([
      { kind: "grid", name: value.name, x: across, y: up, values: grid, shades, colour: "" },
      ...others,
    ]),
  };
  return { description: `${title}: ${figure.y.title} over ${figure.x.title}.`, figure };
}
