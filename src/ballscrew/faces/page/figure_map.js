// Maps: values over both axes in colours, with lines at round ones, and the colours of values beside a figure.

import { colourAt } from "./palette.js";
import { corners, SMALL } from "./pen.js";
import { Scale, tickWords } from "./scale.js";

/** @import { Frame, Grid, Shades, Values } from "./figure.js" */
/** @import { Palette } from "./palette.js" */
/** @import { Path, Pen } from "./pen.js" */

/** Steps of colour, pieces between two values of an axis, lines at most, pixels between numbers. */
const [STEPS, FINE, LINES, TICK] = [48, 6, 11, 42];
/** Opacity over where the model does not hold. */
const VEIL = 0.35;

/**
 * Values in fine steps of colour, with lines at round ones; where the model does not hold, under stripes.
 *
 * @param {Pen} pen
 * @param {Grid} grid
 * @param {Frame} frame
 * @param {Palette} palette
 */
export function drawGrid(pen, grid, { x, y }, palette) {
  const { shades, values, valid } = grid;
  const span = shades.to - shades.from || 1;
  const stepAt = (/** @type {number} */ value) =>
    Number.isFinite(value) ? Math.min(STEPS - 1, Math.max(0, Math.floor((STEPS * (value - shades.from)) / span))) : -1;
  const [columns, rows] = [grid.x, grid.y].map((places) => fineOf(places));
  if (!columns.length) return; // one value of an axis has no area
  for (const row of rows) {
    const [top, bottom] = [y.pixel(row.to), y.pixel(row.from)].sort((one, other) => one - other);
    let start = columns[0].from;
    let step = -2;
    for (const [place, column] of [...columns, undefined].entries()) {
      const next = column ? stepAt(between(values, row, column)) : -2;
      if (next === step) continue;
      if (step >= 0) {
        const [left, right] = [x.pixel(start), x.pixel(column?.from ?? columns[place - 1].to)].sort(
          (one, other) => one - other,
        );
        const fill = colourAt((step + 0.5) / STEPS, shades.colours);
        pen.path(corners({ left, right: right + 0.6, top, bottom: bottom + 0.6 }), { fill }, true);
      }
      [start, step] = [column?.from ?? 0, next];
    }
  }
  for (const level of new Scale(shades.from, shades.to, 0, 1).ticks(LINES)) {
    pen.path(contour(grid, level, x, y), { stroke: "#222222", width: 0.6, opacity: 0.75 });
  }
  if (!valid) return;
  for (const row of rows) {
    for (const column of columns) {
      if (valid[row.nearest]?.[column.nearest] !== false) continue;
      const [left, right] = [x.pixel(column.from), x.pixel(column.to)].sort((one, other) => one - other);
      const [top, bottom] = [y.pixel(row.to), y.pixel(row.from)].sort((one, other) => one - other);
      pen.path(corners({ left, right, top, bottom }), { fill: palette.careful, opacity: VEIL }, true);
    }
  }
}

/** A piece of an axis between two of its values. @typedef {{ from: number, to: number, place: number, share: number, nearest: number }} Piece */

/** The pieces of an axis, some between two of its values. @param {number[]} places @returns {Piece[]} */
function fineOf(places) {
  return places.slice(1).flatMap((next, place) =>
    Array.from({ length: FINE }, (_, step) => {
      const width = (next - places[place]) / FINE;
      const share = (step + 0.5) / FINE;
      const from = places[place] + step * width;
      return { from, to: from + width, place, share, nearest: place + Math.round(share) };
    }),
  );
}

/** The value in the middle of a piece of both axes. @param {Values[]} values @param {Piece} row @param {Piece} column */
function between(values, { place: row, share: up }, { place: column, share: along }) {
  const at = (/** @type {number} */ one, /** @type {number} */ other) => values[one]?.[other] ?? Number.NaN;
  const [below, above] = [row, row + 1].map((one) => (1 - along) * at(one, column) + along * at(one, column + 1));
  return (1 - up) * below + up * above;
}

/** The lines along which values are a level, by the two triangles of each cell. @param {Grid} grid @param {number} level @param {Scale} x @param {Scale} y @returns {Path} */
function contour({ x: xs, y: ys, values }, level, x, y) {
  /** @type {Path} */
  const path = [];
  /** @param {[number, number, number][]} triangle points with their values */
  const cross = (triangle) => {
    const ends = triangle.flatMap((one, place) => {
      const other = triangle[(place + 1) % 3];
      if (one[2] >= level === other[2] >= level) return [];
      const share = (level - one[2]) / (other[2] - one[2]);
      return [
        /** @type {[number, number]} */ ([one[0] + share * (other[0] - one[0]), one[1] + share * (other[1] - one[1])]),
      ];
    });
    if (ends.length === 2) path.push(ends[0], ends[1], null);
  };
  for (let row = 0; row + 1 < ys.length; row += 1) {
    for (let column = 0; column + 1 < xs.length; column += 1) {
      const at = (/** @type {number} */ down, /** @type {number} */ right) =>
        /** @type {[number, number, number]} */ ([
          x.pixel(xs[column + right]),
          y.pixel(ys[row + down]),
          values[row + down][column + right] ?? Number.NaN,
        ]);
      const [one, other] = [at(0, 0), at(1, 1)];
      if (![one, other, at(0, 1), at(1, 0)].every((corner) => Number.isFinite(corner[2]))) continue;
      cross([one, at(0, 1), other]);
      cross([one, at(1, 0), other]);
    }
  }
  return path;
}

/** The colours of values beside a figure. @param {Pen} pen @param {Shades} shades @param {Frame} frame @param {Palette} palette */
export function drawShades(pen, { from, to, title, colours }, { box }, palette) {
  const [left, right] = [box.right + 10, box.right + 22];
  const scale = new Scale(from, to, box.bottom, box.top);
  for (let step = 0; step < STEPS; step += 1) {
    const [bottom, top] = [step, step + 1].map((end) => box.bottom + (end / STEPS) * (box.top - box.bottom));
    pen.path(corners({ left, right, top: top - 0.3, bottom }), { fill: colourAt((step + 0.5) / STEPS, colours) }, true);
  }
  for (const tick of scale.ticks((box.bottom - box.top) / TICK)) {
    pen.text(tickWords(tick), right + 4, scale.pixel(tick), { colour: palette.soft, size: SMALL });
  }
  pen.text(title, right + 44, (box.top + box.bottom) / 2, {
    colour: palette.ink,
    size: SMALL,
    anchor: "middle",
    angle: -Math.PI / 2,
  });
}
