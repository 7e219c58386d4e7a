// What is read of a figure: its legend, its numbers as a table, and what stands below a pointer.

import { digits } from "./digits.js";
import { element } from "./dom.js";
import { DOTS } from "./figure_marks.js";

/** @import { Band, Bar, Curve, Figure, Frame, Grid, Mark, Values } from "./figure.js" */
/** Headings and rows. @typedef {[string[], import("./dom.js").Cell[][]]} Numbers */
/** What is read below a pointer: where, and a line for each mark. @typedef {{ across: number | undefined, title: string, lines: { words: string, colour: string }[] }} Reading */

/** Keys of the legend, by the styles of curves. @type {Record<string, string>} */
const KEYS = {
  dashed: "dash",
  dotted: "dot",
  dashdot: "dashdot",
  area: "area",
  dots: "point",
  circles: "point",
  crosses: "point",
};
/** Headings of columns. */
export const [VALUE, LOW_AND_HIGH] = ["value", ["lower end", "upper end"]];
/** Pixels within which a dot is read. */
const NEAR = 14;

/** The marks that have names, each name once: curves, then what is stacked, from the top, and all else. @param {Figure} figure */
export function legendOf({ marks }) {
  const isStacked = (/** @type {Mark} */ mark) => mark.kind === "band" && mark.solid;
  const curves = marks.filter(({ kind }) => kind === "curve");
  const others = marks.filter((mark) => mark.kind !== "curve" && mark.kind !== "grid" && !isStacked(mark));
  const ordered = [...curves, ...marks.filter(isStacked).toReversed(), ...others].filter(isShown);
  const named = new Map(ordered.toReversed().map((mark) => [mark.name, mark]));
  return ordered
    .filter((mark) => named.get(mark.name) === mark)
    .map((mark) => ({
      kind: keyOf(mark),
      name: mark.name,
      colour: "colour" in mark ? mark.colour : "careful",
      value: mark.note,
    }));
}

/** Test whether a mark is in the legend. @param {Mark} mark */
function isShown(mark) {
  if (!mark.name) return false;
  if (mark.kind === "outside") return !mark.valid.every(Boolean);
  return mark.kind !== "bar" || Boolean(mark.width);
}

/** @param {Mark} mark */
function keyOf(mark) {
  if (mark.kind === "curve") return `${KEYS[mark.style] ?? "line"}${Number(mark.width ?? 2) < 1 ? " thin" : ""}`;
  if (mark.kind === "level") return "dot";
  if (mark.kind === "point") return "point diamond";
  if (mark.kind === "zone") return "area zone";
  return mark.kind === "band" && !mark.solid ? "area light" : "area";
}

// -- numbers ----------------------------------------------------------------------------------------

/** All numbers of a figure: of a map by its rows, of bars by their names, of curves beside one axis. @param {Figure} figure @returns {Numbers} */
export function numbersOf(figure) {
  const grid = /** @type {Grid | undefined} */ (figure.marks.find(({ kind }) => kind === "grid"));
  if (grid) {
    const headings = grid.x.map((at) => String(Number(at.toPrecision(6))));
    return [
      [`${figure.y.title} \\ ${figure.x.title}`, ...headings],
      grid.y.map((at, row) => [at, ...grid.values[row]]),
    ];
  }
  return numbersOfCurves(figure);
}

/**
 * Curves and bands as columns beside one horizontal axis, or one below the other where each has its own.
 *
 * @param {Figure} figure
 * @returns {Numbers}
 */
function numbersOfCurves({ x, y, second, marks }) {
  const columns = marks.flatMap((mark) => columnsOf(mark, y.title, second?.title ?? y.title));
  columns.sort((one, other) => one.order - other.order);
  const places = columns.map(({ x: own }) => own).reduce((most, own) => (own.length > most.length ? own : most), []);
  const rowOf = new Map(places.map((at, row) => [at, row]));
  if (rowOf.size === places.length && columns.every(({ x: own }) => own.every((at) => rowOf.has(at)))) {
    const cells = columns.map(({ x: own, values }) => new Map(own.map((at, place) => [at, values[place]])));
    const headings = columns.map(({ heading }) => heading);
    return [[x.title, ...headings], places.map((at) => [at, ...cells.map((column) => column.get(at) ?? null)])];
  }
  const rows = columns.flatMap(({ heading, values, x: own }) => own.map((at, row) => [heading, at, values[row]]));
  return [["", x.title, VALUE], rows];
}

/** @param {Mark} mark @param {string} title @param {string} other @returns {{ heading: string, x: Values, values: (import("./dom.js").Cell)[], order: number }[]} */
function columnsOf(mark, title, other) {
  if (mark.kind === "curve" && !mark.isQuiet) {
    const axis = mark.second ? other : title;
    return [
      { heading: mark.heading ?? (mark.name ? inUnitOf(mark.name, axis) : axis), x: mark.x, values: mark.y, order: 0 },
    ];
  }
  if (mark.kind === "band") {
    const column = (/** @type {string} */ name, /** @type {Values} */ values, /** @type {number} */ order) => ({
      heading: inUnitOf(name, title),
      x: mark.x,
      values,
      order,
    });
    // what is stacked is a part of a whole
    if (mark.solid) return [column(mark.name, partOf(mark), 2)];
    const [low, high] = mark.ends ?? LOW_AND_HIGH.map((end) => `${mark.name} ${end}`);
    return [column(low, mark.low, 1), column(high, mark.high, 1)];
  }
  if (mark.kind === "outside") return [{ heading: "valid", x: mark.x, values: mark.valid.map(yesOrNo), order: 3 }];
  return [];
}

/** A name with the unit that a title has. @param {string} name @param {string} title */
function inUnitOf(name, title) {
  const start = title.lastIndexOf(" (");
  return start < 0 ? name : `${name}${title.slice(start)}`;
}

/** @param {Band} band */
function partOf({ low, high }) {
  return high.map((value, place) => {
    const below = low[place];
    return value === null || below === null ? null : value - below;
  });
}

/** The ends of a band, as they are read. @param {string} low @param {string} high */
export function between(low, high) {
  return `${low} to ${high}`;
}

/** @param {boolean} valid */
export function yesOrNo(valid) {
  return valid ? "yes" : "no";
}

// -- below a pointer --------------------------------------------------------------------------------

/**
 * What is read at a place of a figure: of curves at the nearest of their points along the axis, of maps, bars and dots of what
 * is there; nothing where there is none.
 *
 * @param {Figure} figure
 * @param {Frame} frame
 * @param {number} across
 * @param {number} down
 * @returns {Reading | undefined}
 */
export function readingAt(figure, frame, across, down) {
  const { box, x, y } = frame;
  if (across < box.left || across > box.right || down < box.top || down > box.bottom) return undefined;
  const found =
    readDots(figure, frame, across, down) ??
    readGrid(figure, x.value(across), y.value(down)) ??
    readBars(figure, frame, across, down);
  if (found || figure.y.names || figure.marks.some(({ kind }) => kind === "grid")) return found;
  return readCurves(figure, frame, across);
}

/** @param {Figure} figure @param {Frame} frame @param {number} across @param {number} down @returns {Reading | undefined} */
function readDots({ x: axis, y: up, second: other, marks }, { x, y, second }, across, down) {
  /** @type {{ far: number, curve: Curve, place: number } | undefined} */
  let best;
  for (const curve of marks) {
    if (curve.kind !== "curve" || curve.isQuiet || !DOTS.includes(curve.style)) continue;
    const scale = (curve.second && second) || y;
    for (const [place, at] of curve.x.entries()) {
      const far = Math.hypot(x.pixel(at) - across, scale.pixel(curve.y[place]) - down);
      if (far < (best?.far ?? NEAR)) best = { far, curve, place };
    }
  }
  if (!best) return undefined;
  const { curve, place } = best;
  const words = curve.words?.[place];
  const own = `${inUnitOf(curve.name || up.title, curve.second && other ? other.title : up.title)}: ${digits(curve.y[place])}`;
  const lines = words ? [words] : [own];
  return {
    across: undefined,
    title: `${axis.title}: ${digits(curve.x[place])}`,
    lines: lines.map((line) => ({ words: line, colour: curve.colour })),
  };
}

/** @param {Figure} figure @param {number} x @param {number} y @returns {Reading | undefined} */
function readGrid({ x: axis, y: up, marks }, x, y) {
  const grid = /** @type {Grid | undefined} */ (marks.find(({ kind }) => kind === "grid"));
  if (!grid) return undefined;
  const nearest = (/** @type {number[]} */ places, /** @type {number} */ at) =>
    places.reduce((best, place, index) => (Math.abs(place - at) < Math.abs(places[best] - at) ? index : best), 0);
  const [column, row] = [nearest(grid.x, x), nearest(grid.y, y)];
  const value = `${grid.shades.title || grid.name}: ${digits(grid.values[row][column])}`;
  const place = `${axis.title}: ${digits(grid.x[column])}, ${up.title}: ${digits(grid.y[row])}`;
  return { across: undefined, title: place, lines: [{ words: value, colour: "ink" }] };
}

/** @param {Figure} figure @param {Frame} frame @param {number} across @param {number} down @returns {Reading | undefined} */
function readBars({ y: { names }, marks }, { x, y }, across, down) {
  const row = Math.round(y.value(down));
  const parts = /** @type {Bar[]} */ (marks.filter((mark) => mark.kind === "bar" && mark.row === row));
  if (!names || !parts.length) return undefined;
  const at = x.value(across);
  const under = parts.filter(({ base, width }) => (at - base) * (at - base - (width ?? 0)) <= 0);
  return {
    across: undefined,
    title: "",
    lines: (under.length ? under : parts).map(({ words, colour }) => ({ words, colour })),
  };
}

/** @param {Figure} figure @param {Frame} frame @param {number} across @returns {Reading | undefined} */
function readCurves({ x: axis, y, second, marks }, { x }, across) {
  const curves = /** @type {Curve[]} */ (
    marks.filter((mark) => mark.kind === "curve" && !mark.isQuiet && !DOTS.includes(mark.style))
  );
  const bands = /** @type {Band[]} */ (marks.filter((mark) => mark.kind === "band" && mark.name));
  const named = curves.some(({ name }) => name) ? curves.filter(({ name }) => name) : curves;
  const longest = [...named, ...bands].reduce(
    (/** @type {Values} */ most, { x: own }) => (own.length > most.length ? own : most),
    [],
  );
  const at = nearest(longest, x.value(across));
  if (at === null) return undefined;
  /** @param {string} name @param {string} title @param {string} value @param {string} colour */
  const line = (name, title, value, colour) => ({ words: `${name ? inUnitOf(name, title) : title}: ${value}`, colour });
  const lines = named.flatMap((mark) => {
    const value = valueAt(mark.x, mark.y, at);
    const title = mark.second && second ? second.title : y.title;
    return value === null ? [] : [line(mark.name, title, digits(value), mark.colour)];
  });
  const areas = [...bands.filter(({ solid }) => solid).toReversed(), ...bands.filter(({ solid }) => !solid)];
  for (const mark of areas) {
    const [low, high] = [mark.low, mark.high].map((values) => valueAt(mark.x, values, at));
    if (low === null || high === null) continue;
    const ends = between(digits(low), digits(high));
    lines.push(line(mark.name, y.title, mark.solid ? digits(high - low) : ends, mark.colour));
  }
  return lines.length ? { across: x.pixel(at), title: `${axis.title}: ${digits(at)}`, lines } : undefined;
}

/** The nearest of some values; nothing where there is none. @param {Values} values @param {number} at @returns {number | null} */
function nearest(values, at) {
  /** @type {number | null} */
  let best = null;
  for (const value of values) {
    if (value !== null && (best === null || Math.abs(value - at) < Math.abs(best - at))) best = value;
  }
  return best;
}

/** The value of a curve at a place, between two of its points; nothing beyond its ends. @param {Values} xs @param {Values} ys @param {number} at @returns {number | null} */
export function valueAt(xs, ys, at) {
  for (const [place, value] of ys.entries()) {
    const x = xs[place];
    if (x === null || value === null) continue;
    if (x === at) return value;
    const [nextX, next] = [xs[place + 1] ?? null, ys[place + 1] ?? null];
    if (nextX === null || next === null || (x - at) * (nextX - at) > 0) continue;
    return value + ((at - x) / (nextX - x)) * (next - value);
  }
  return null;
}

/** A reading as what is shown beside the pointer. @param {Reading} reading @param {(colour: string) => string} shade */
export function readingElement({ title, lines }, shade) {
  const items = lines.map(({ words, colour }) => {
    const key = element("span", { class: "key area", "aria-hidden": "true" });
    key.style.color = shade(colour);
    return element("li", {}, key, words);
  });
  return [title ? element("p", {}, title) : "", element("ul", {}, ...items)];
}
