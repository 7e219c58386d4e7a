// Figures: what a chart shows, in the units of the page, and how it is drawn by a pen. They compute no result.

import { drawShades } from "./figure_map.js";
import { crisp, DOTS, draw, horizontal, vertical } from "./figure_marks.js";
import { nameAreas, nameCurves } from "./figure_names.js";
import { widthOf } from "./pen.js";
import { extent, Scale, stepOf, tickWords } from "./scale.js";

/** @import { Palette } from "./palette.js" */
/** @import { Box, Pen } from "./pen.js" */
/** @typedef {(number | null)[]} Values */
/**
 * An axis with its title: from where to where it goes if not as far as what is drawn, whether zero is on it, and names in
 * place of numbers.
 *
 * @typedef {{ title: string, log?: boolean, from?: number, to?: number, zero?: boolean, step?: number, names?: { words: string, isBold: boolean }[] }} Axis
 */
/** Colours from the least value to the greatest. @typedef {{ from: number, to: number, title: string, colours: string[] }} Shades */
/**
 * Points that are joined, or dots: of one colour, or each by its value; what is read of each is a text.
 *
 * @typedef {{ kind: "curve", name: string, x: Values, y: Values, colour: string, style: string, second?: boolean, width?: number, size?: number, labels?: string[], words?: string[], values?: number[], shades?: Shades, note?: Node, isQuiet?: boolean, heading?: string }} Curve
 */
/** The area between two curves: light, or solid as a part of what is stacked. @typedef {{ kind: "band", name: string, x: Values, low: Values, high: Values, colour: string, solid: boolean, ends?: string[], note?: Node }} Band */
/** A value of an axis that holds along the other one. @typedef {{ kind: "level", name: string, x?: number, y?: number, colour: string, note?: Node }} Level */
/** A range of an axis, with its name where it begins. @typedef {{ kind: "zone", name: string, along: "x" | "y", from: number, to: number, colour: string, words: string, note?: Node }} Zone */
/** Where along the horizontal axis the model holds. @typedef {{ kind: "outside", name: string, x: Values, valid: boolean[], note?: Node }} Outside */
/** The operating point. @typedef {{ kind: "point", name: string, x: number | null | undefined, y: number | null | undefined, colour: string, note?: Node }} Point */
/** A part of a bar in its row. @typedef {{ kind: "bar", name: string, row: number, base: number, width: number | null, colour: string, isHatched: boolean, words: string, note?: Node }} Bar */
/** The ends of the band of a bar. @typedef {{ kind: "whisker", name: "", row: number, low: number, high: number, colour: string, note?: Node }} Whisker */
/** Values over both axes, in rows along the horizontal one, and where the model holds. @typedef {{ kind: "grid", name: string, x: number[], y: number[], values: Values[], shades: Shades, valid?: boolean[][], colour: string, note?: Node }} Grid */
/** @typedef {Curve | Band | Level | Zone | Outside | Point | Bar | Whisker | Grid} Mark */
/** @typedef {{ x: Axis, y: Axis, second?: Axis, marks: Mark[] }} Figure */
/** Where a figure was drawn, with the scales of its axes. @typedef {{ box: Box, x: Scale, y: Scale, second: Scale | undefined }} Frame */
/** Ends of axes in place of those of what is drawn. @typedef {{ x?: [number, number], y?: [number, number] }} Ranges */

/** Pixels around the axes, between two ticks, and of a letter of a tick. */
const [LEFT, RIGHT, TOP, BOTTOM] = [56, 20, 10, 44];
const [TICK_X, TICK_Y] = [64, 42];
const OF_SHADES = 76;
/** Lines of a name beside its bar, and the height of one. */
const LINE = 13;
/** How far axes go beyond dots, and ranges of a single value around it. */
const [BEYOND, AROUND] = [0.04, 0.1];
/**
 * Draw a figure; returns where, for a pointer.
 *
 * @param {Pen} pen
 * @param {Figure} figure
 * @param {{ width: number, height: number }} size
 * @param {Palette} palette
 * @param {Ranges} [ranges]
 * @returns {Frame}
 */
export function drawFigure(pen, figure, size, palette, ranges = {}) {
  const frame = frameOf(figure, size, ranges);
  const of = (/** @type {string} */ kind) => figure.marks.filter((mark) => mark.kind === kind);
  const isMap = of("grid").length > 0;
  const paint = (/** @type {Mark[]} */ marks) =>
    pen.inside(frame.box, () => {
      for (const mark of marks) draw(pen, mark, frame, palette);
    });
  const isArea = (/** @type {Mark} */ mark) => mark.kind === "band" && mark.solid;
  paint([...of("zone"), ...of("grid"), ...of("band").filter(isArea)]);
  drawAxes(pen, figure, frame, palette, !isMap);
  paint([...of("bar"), ...of("whisker"), ...of("band").filter((mark) => !isArea(mark)), ...of("level")]);
  paint([...of("curve"), ...of("outside")]);
  nameAreas(pen, of("band").filter(isArea), frame, palette);
  if (!isMap) nameCurves(pen, figure, frame, palette);
  for (const mark of of("point")) draw(pen, mark, frame, palette);
  for (const mark of figure.marks) if ("shades" in mark && mark.shades) drawShades(pen, mark.shades, frame, palette);
  return frame;
}

// -- axes -------------------------------------------------------------------------------------------

/** @param {Figure} figure @param {{ width: number, height: number }} size @param {Ranges} ranges @returns {Frame} */
function frameOf(figure, { width, height }, ranges) {
  const { x, y, second, marks } = figure;
  const across = ranges.x ?? rangeOf(x, valuesAlong(marks, "x"), marks, false);
  const whole = rangeOf(y, valuesAlong(marks, "y"), marks, true);
  const up = ranges.y ?? whole;
  const other = second && partOf(rangeOf(second, valuesAlong(marks, "second"), marks, true), whole, up);
  const names = y.names?.flatMap(({ words }) => linesOf(words)) ?? [];
  const ticks = new Scale(up[0], up[1], 1, 0, y.log).ticks(height / TICK_Y).map(tickWords);
  const widest = (/** @type {string[]} */ words) => Math.max(0, ...words.map((one) => widthOf(one)));
  const hasShades = marks.some((mark) => "shades" in mark && mark.shades);
  const box = {
    left: y.names ? 14 + widest(names) : Math.max(LEFT, 32 + widest(ticks)),
    top: TOP,
    right: width - (hasShades ? OF_SHADES : second ? LEFT + 6 : RIGHT),
    bottom: height - BOTTOM,
  };
  return {
    box,
    x: new Scale(across[0], across[1], box.left, box.right, x.log),
    y: new Scale(up[0], up[1], box.bottom, box.top, y.log),
    second: other && second && new Scale(other[0], other[1], box.bottom, box.top, second.log),
  };
}

/** The same part of the second axis as is shown of the first. @param {[number, number]} range @param {[number, number]} whole @param {[number, number]} part @returns {[number, number]} */
function partOf([from, to], [low, high], part) {
  const [start, end] = part.map((value) => from + ((value - low) / (high - low)) * (to - from));
  return [start, end];
}

/** All values of marks along an axis. @param {Mark[]} marks @param {"x" | "y" | "second"} along @returns {Values} */
function valuesAlong(marks, along) {
  return marks.flatMap((mark) => valuesOf(mark, along));
}

/** @param {Mark} mark @param {"x" | "y" | "second"} along @returns {Values} */
function valuesOf(mark, along) {
  switch (mark.kind) {
    case "curve":
      if (along === "x") return mark.x;
      return Boolean(mark.second) === (along === "second") ? mark.y : [];
    case "band":
      return along === "x" ? mark.x : along === "y" ? [...mark.low, ...mark.high] : [];
    case "bar":
      return along === "x" ? [mark.base, mark.base + (mark.width ?? 0)] : [];
    case "whisker":
      return along === "x" ? [mark.low, mark.high] : [];
    case "outside":
      return along === "x" ? mark.x : [];
    case "level":
    case "point":
    case "grid":
      return along === "second" ? [] : [mark[along] ?? null].flat();
    default:
      return [];
  }
}

/**
 * From where to where an axis goes.
 *
 * @param {Axis} axis
 * @param {Values} values
 * @param {Mark[]} marks
 * @param {boolean} isUp
 * @returns {[number, number]}
 */
function rangeOf({ log = false, from, to, zero = false, names }, values, marks, isUp) {
  if (names) return [names.length - 0.4, -0.6];
  const known = log ? values.filter((value) => Number(value) > 0) : zero ? [...values, 0] : values;
  let [low, high] = extent([from ?? null, to ?? null, ...known]) ?? (log ? [1, 10] : [0, 1]);
  if (low === high)
    [low, high] = log
      ? [low / 2, high * 2]
      : [low - AROUND * (Math.abs(low) || 10), high + AROUND * (Math.abs(high) || 10)];
  if (from === to) [from, to] = [undefined, undefined]; // of one value there is no range
  const hasDots = marks.some((mark) => mark.kind === "bar" || (mark.kind === "curve" && DOTS.includes(mark.style)));
  if (log) {
    const beyond = isUp || hasDots ? (high / low) ** BEYOND : 1;
    return [from ?? low / beyond, to ?? high * beyond];
  }
  if (isUp) {
    const step = stepOf((high - low) / 6);
    return [from ?? step * Math.floor(low / step), to ?? step * Math.ceil(high / step)];
  }
  const beyond = hasDots ? BEYOND * (high - low) : 0;
  return [from ?? (low === 0 && !marks.some(({ kind }) => kind === "curve") ? low : low - beyond), to ?? high + beyond];
}

/**
 * @param {Pen} pen
 * @param {Figure} figure
 * @param {Frame} frame
 * @param {Palette} palette
 * @param {boolean} hasLines
 */
function drawAxes(pen, { x, y, second }, frame, palette, hasLines) {
  const { box } = frame;
  const soft = palette.soft;
  const line = { stroke: palette.line };
  const titleY = box.bottom + 33;
  const middle = (box.top + box.bottom) / 2;
  for (const tick of ticksOf(x, frame.x, (box.right - box.left) / TICK_X)) {
    const at = crisp(frame.x.pixel(tick));
    if (hasLines) pen.path(vertical(at, box), line);
    pen.text(tickWords(tick), at, box.bottom + 13, { colour: soft, anchor: "middle" });
  }
  if (y.names) drawNames(pen, y.names, frame, palette);
  else {
    for (const tick of ticksOf(y, frame.y, (box.bottom - box.top) / TICK_Y)) {
      const at = crisp(frame.y.pixel(tick));
      if (hasLines) pen.path(horizontal(at, box), tick === 0 ? { stroke: soft } : line);
      pen.text(tickWords(tick), box.left - 7, at, { colour: soft, anchor: "end" });
    }
    pen.text(y.title, 10, middle, { colour: palette.ink, anchor: "middle", angle: -Math.PI / 2 });
  }
  if (second && frame.second) {
    for (const tick of ticksOf(second, frame.second, (box.bottom - box.top) / TICK_Y)) {
      pen.text(tickWords(tick), box.right + 7, frame.second.pixel(tick), { colour: soft });
    }
    pen.text(second.title, box.right + LEFT, middle, { colour: palette.ink, anchor: "middle", angle: -Math.PI / 2 });
  }
  pen.path(horizontal(crisp(box.bottom), box), { stroke: soft });
  pen.text(x.title, (box.left + box.right) / 2, titleY, { colour: palette.ink, anchor: "middle" });
}

/** @param {Axis} axis @param {Scale} scale @param {number} most */
function ticksOf({ step }, scale, most) {
  if (!step || Math.abs(scale.to - scale.from) < 2 * step) return scale.ticks(most);
  const first = Math.ceil(Math.min(scale.from, scale.to) / step);
  const count = Math.floor(Math.max(scale.from, scale.to) / step) - first + 1;
  return Array.from({ length: count }, (_, place) => (first + place) * step);
}

/** @param {Pen} pen @param {{ words: string, isBold: boolean }[]} names @param {Frame} frame @param {Palette} palette */
function drawNames(pen, names, { box, y }, { ink }) {
  for (const [row, { words, isBold }] of names.entries()) {
    const lines = linesOf(words);
    const first = y.pixel(row) - ((lines.length - 1) * LINE) / 2;
    for (const [place, line] of lines.entries()) {
      pen.text(line, box.left - 8, first + place * LINE, { colour: ink, anchor: "end", bold: isBold });
    }
  }
}

/** A name in lines, for an axis. @param {string} name */
function linesOf(name) {
  const most = 30;
  /** @type {string[]} */
  const lines = [];
  for (const word of name.split(" ")) {
    const last = lines.at(-1);
    if (last !== undefined && last.length + word.length < most) lines[lines.length - 1] = `${last} ${word}`;
    else lines.push(word);
  }
  return lines;
}
