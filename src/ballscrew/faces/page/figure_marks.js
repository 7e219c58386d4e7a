// The marks of figures, each as a pen draws it.

import { drawGrid } from "./figure_map.js";
import { colourAt, shade } from "./palette.js";
import { corners, ROOM, SMALL, widthOf } from "./pen.js";

/** @import { Band, Bar, Curve, Frame, Level, Mark, Outside, Point, Values, Whisker, Zone } from "./figure.js" */
/** @import { Palette } from "./palette.js" */
/** @import { Box, Path, Pen } from "./pen.js" */
/** @import { Scale } from "./scale.js" */

/** @type {Record<string, number[]>} */
const DASHES = { dashed: [7, 4], dotted: [2, 3], dashdot: [8, 3, 2, 3] };
/** Styles of curves whose points are not joined. */
export const DOTS = ["dots", "circles", "crosses"];
/** Opacity of a band, and of a zone. */
const [LIGHT, ZONE] = [0.2, 0.13];

// -- marks ------------------------------------------------------------------------------------------

/** Draw a mark. @param {Pen} pen @param {Mark} mark @param {Frame} frame @param {Palette} palette */
export function draw(pen, mark, frame, palette) {
  switch (mark.kind) {
    case "curve":
      return drawCurve(pen, mark, frame, palette);
    case "band":
      return drawBand(pen, mark, frame, palette);
    case "level":
      return drawLevel(pen, mark, frame, palette);
    case "zone":
      return drawZone(pen, mark, frame, palette);
    case "outside":
      return drawOutside(pen, mark, frame, palette);
    case "point":
      return drawPoint(pen, mark, frame, palette);
    case "bar":
      return drawBar(pen, mark, frame, palette);
    case "whisker":
      return drawWhisker(pen, mark, frame, palette);
    default:
      return drawGrid(pen, mark, frame, palette);
  }
}

/** Pixels of points; nothing where one is not known. @param {Values} xs @param {Values} ys @param {Scale} x @param {Scale} y @returns {Path} */
export function pathOf(xs, ys, x, y) {
  return xs.map((at, place) => {
    const [across, up] = [x.pixel(at), y.pixel(ys[place])];
    return Number.isFinite(across) && Number.isFinite(up) ? [across, up] : null;
  });
}

/** @param {Pen} pen @param {Curve} curve @param {Frame} frame @param {Palette} palette */
function drawCurve(pen, curve, { x, y: first, second, box }, palette) {
  const y = (curve.second && second) || first;
  const colour = shade(curve.colour, palette);
  const path = pathOf(curve.x, curve.y, x, y);
  const { style, width = 1.8, size = 5, values, shades, labels = [] } = curve;
  if (DOTS.includes(style)) {
    for (const [place, point] of path.entries()) {
      if (!point) continue;
      if (style === "crosses") drawCross(pen, point, size / 2, colour);
      else if (style === "circles")
        pen.circle(point[0], point[1], size / 2 + 1, { stroke: colour, width: 1.5, fill: palette.panel });
      else if (values && shades) {
        const fill = colourAt((values[place] - shades.from) / (shades.to - shades.from), shades.colours);
        pen.circle(point[0], point[1], size / 2, { fill, stroke: palette.ink, width: 0.8 });
      } else pen.circle(point[0], point[1], size / 2, { fill: colour });
    }
  } else {
    const line = style === "steps" ? stepped(path) : path;
    if (style === "area") {
      const floor = Math.min(box.bottom, Math.max(box.top, y.pixel(y.isLog ? y.from : 0)));
      for (const piece of pieces(line)) {
        const [start, end] = [piece[0], piece[piece.length - 1]];
        pen.path([[start[0], floor], ...piece, [end[0], floor]], { fill: colour, opacity: LIGHT }, true);
      }
    }
    pen.path(line, { stroke: colour, width, dash: DASHES[style] });
  }
  for (const [place, words] of labels.entries()) {
    const point = path[place];
    if (point) pen.text(words, point[0] + 5, point[1] - 8, { colour: palette.ink, size: SMALL, halo: palette.panel });
  }
}

/** @param {Pen} pen @param {[number, number]} point @param {number} half @param {string} colour */
function drawCross(pen, [x, y], half, colour) {
  /** @type {Path} */
  const path = [[x - half, y - half], [x + half, y + half], null, [x - half, y + half], [x + half, y - half]];
  pen.path(path, { stroke: colour, width: 1.5 });
}

/** A path that keeps its height around each point, to half the way to the next. @param {Path} path @returns {Path} */
function stepped(path) {
  return path.flatMap((point, place) => {
    if (!point) return [null];
    const [before, next] = [path[place - 1], path[place + 1]];
    const from = before ? (before[0] + point[0]) / 2 : point[0] - (next ? (next[0] - point[0]) / 2 : 0);
    const to = next ? (point[0] + next[0]) / 2 : point[0] + (point[0] - from);
    return /** @type {Path} */ ([
      [from, point[1]],
      [to, point[1]],
    ]);
  });
}

/** The joined pieces of a path. @param {Path} path */
function pieces(path) {
  /** @type {[number, number][][]} */
  const found = [[]];
  for (const point of path) {
    if (point) found[found.length - 1].push(point);
    else if (found[found.length - 1].length) found.push([]);
  }
  return found.filter((piece) => piece.length > 1);
}

/** @param {Pen} pen @param {Band} band @param {Frame} frame @param {Palette} palette */
function drawBand(pen, { x: at, low, high, colour: name, solid }, { x, y }, palette) {
  const ends = [low, high].map((values) => pathOf(at, values, x, y));
  // where one of both is not known there is no area
  const [lows, highs] = ends.map((path) =>
    path.map((point, place) => (ends[0][place] && ends[1][place] ? point : null)),
  );
  const colour = shade(name, palette);
  const uppers = pieces(highs);
  for (const [place, lower] of pieces(lows).entries()) {
    pen.path([...(uppers[place] ?? []), ...lower.toReversed()], { fill: colour, opacity: solid ? 1 : LIGHT }, true);
  }
  if (!solid) for (const path of [lows, highs]) pen.path(path, { stroke: colour, width: 0.7, opacity: 0.6 });
}

/** @param {Pen} pen @param {Level} level @param {Frame} frame @param {Palette} palette */
function drawLevel(pen, level, { x, y, box }, palette) {
  const at = level.y === undefined ? x.pixel(level.x) : y.pixel(level.y);
  if (!Number.isFinite(at)) return; // a note of the legend alone
  const path = level.y === undefined ? vertical(crisp(at), box) : horizontal(crisp(at), box);
  pen.path(path, { stroke: shade(level.colour, palette), width: 1.3, dash: DASHES.dotted });
}

/** @param {Pen} pen @param {Zone} zone @param {Frame} frame @param {Palette} palette */
function drawZone(pen, { along, from, to, colour, words }, { box, ...scales }, palette) {
  const scale = scales[along];
  const [start, end] = [from, to].map((value) =>
    scale.pixel(Math.min(Math.max(value, Math.min(scale.from, scale.to)), Math.max(scale.from, scale.to))),
  );
  const area = along === "x" ? { ...box, left: start, right: end } : { ...box, top: end, bottom: start };
  pen.path(corners(area), { fill: shade(colour, palette), opacity: ZONE }, true);
  if (area.bottom - area.top > ROOM && area.right - area.left > widthOf(words, SMALL)) {
    pen.text(words, area.left + 6, area.top + 10, { colour: palette.ink, size: SMALL });
  }
}

/** @param {Pen} pen @param {Outside} outside @param {Frame} frame @param {Palette} palette */
function drawOutside(pen, { x: at, valid }, { x, box }, palette) {
  const edge = (/** @type {number} */ place) => {
    const [before, next] = [at[place - 1] ?? at[0], at[place] ?? at[at.length - 1]].map((value) => x.pixel(value));
    return (before + next) / 2;
  };
  for (let first = 0; first < at.length; first += 1) {
    if (valid[first]) continue;
    let end = first;
    while (end < at.length && !valid[end]) end += 1;
    const [from, to] = [edge(first), edge(end)].sort((one, other) => one - other);
    const [left, right] = [Math.max(box.left, from), Math.min(box.right, to)];
    if (right > left) hatch(pen, { ...box, left, right }, palette.careful, 0.5);
    first = end;
  }
}

/** Stripes over a box, under a veil of their colour. @param {Pen} pen @param {Box} box @param {string} colour @param {number} opacity */
function hatch(pen, box, colour, opacity) {
  const height = box.bottom - box.top;
  pen.inside(box, () => {
    pen.path(corners(box), { fill: colour, opacity: 0.1 }, true);
    /** @type {Path} */
    const lines = [];
    for (let at = box.left - height; at < box.right; at += 9)
      lines.push([at, box.bottom], [at + height, box.top], null);
    pen.path(lines, { stroke: colour, opacity });
  });
}

/** @param {Pen} pen @param {Point} point @param {Frame} frame @param {Palette} palette */
function drawPoint(pen, { x: at, y: high, colour }, { x, y, box }, palette) {
  const [across, up] = [x.pixel(at), y.pixel(high)];
  const isSeen = across >= box.left - 1 && across <= box.right + 1 && up >= box.top - 1 && up <= box.bottom + 1;
  if (!isSeen) return;
  const half = 7.5;
  const diamond = [
    [across - half, up],
    [across, up - half],
    [across + half, up],
    [across, up + half],
  ];
  pen.path(/** @type {Path} */ (diamond), { fill: palette.panel, stroke: shade(colour, palette), width: 2.5 }, true);
}

/** @param {Pen} pen @param {Bar} bar @param {Frame} frame @param {Palette} palette */
function drawBar(pen, { row, base, width, colour, isHatched }, { x, y }, palette) {
  if (width === null) return;
  const [left, right] = [x.pixel(base), x.pixel(base + width)].sort((one, other) => one - other);
  const area = { left, right, top: y.pixel(row - 0.35), bottom: y.pixel(row + 0.35) };
  pen.path(corners(area), { fill: shade(colour, palette) }, true);
  if (isHatched) hatch(pen, area, palette.panel, 0.9);
}

/** @param {Pen} pen @param {Whisker} whisker @param {Frame} frame @param {Palette} palette */
function drawWhisker(pen, { row, low, high, colour }, { x, y }, palette) {
  const [left, right, at] = [x.pixel(low), x.pixel(high), y.pixel(row)];
  /** @type {Path} */
  const path = [[left, at - 4], [left, at + 4], null, [left, at], [right, at], null, [right, at - 4], [right, at + 4]];
  pen.path(path, { stroke: shade(colour, palette), width: 1.3 });
}

// -- lines along the axes ---------------------------------------------------------------------------

/** The middle of a dot: a line of one pixel is sharp there. @param {number} pixel */
export function crisp(pixel) {
  return Math.round(pixel) + 0.5;
}

/** @param {number} x @param {Box} box @returns {Path} */
export function vertical(x, { top, bottom }) {
  return [
    [x, top],
    [x, bottom],
  ];
}

/** @param {number} y @param {Box} box @returns {Path} */
export function horizontal(y, { left, right }) {
  return [
    [left, y],
    [right, y],
  ];
}
