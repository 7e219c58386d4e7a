// Names written into a figure, so that nobody has to look for them in its legend: where there is room.

import { DOTS, pathOf } from "./figure_marks.js";
import { isDark, shade } from "./palette.js";
import { ROOM, SMALL, widthOf } from "./pen.js";

/** @import { Band, Curve, Figure, Frame, Mark, Point } from "./figure.js" */
/** @import { Palette } from "./palette.js" */
/** @import { Box, Pen } from "./pen.js" */

/** Names at curves at most. */
const FEW = 7;
/** Places along a curve where its name may stand. */
const PLACES = [0.94, 0.82, 0.68, 0.54, 0.4, 0.26];

/** Write the name of an area into it, where it is widest and there is room. @param {Pen} pen @param {Mark[]} areas @param {Frame} frame @param {Palette} palette */
export function nameAreas(pen, areas, { x, y, box }, palette) {
  for (const area of /** @type {Band[]} */ (areas)) {
    const half = widthOf(area.name, SMALL) / 2 + 4;
    const across = area.x.map((value) => x.pixel(value));
    const [bottoms, tops] = [area.low, area.high].map((values) => values.map((value) => y.pixel(value)));
    let best = { at: 0, middle: 0, room: ROOM };
    for (const [place, at] of across.entries()) {
      const isInside = at - half > box.left && at + half < box.right;
      if (!isInside || !(bottoms[place] - tops[place] > best.room)) continue;
      let [bottom, top] = [bottoms[place], tops[place]];
      for (const step of [-1, 1]) {
        for (let next = place + step; Math.abs(across[next] - at) <= half; next += step) {
          bottom = Math.min(bottom, bottoms[next]);
          top = Math.max(top, tops[next]);
        }
      }
      if (bottom - top > best.room) best = { at, middle: (bottom + top) / 2, room: bottom - top };
    }
    const colour = shade(area.colour, palette);
    if (best.at)
      pen.text(area.name, best.at, best.middle, {
        colour: isDark(colour) ? "#ffffff" : "#000000",
        size: SMALL,
        anchor: "middle",
      });
  }
}

/** Write names at curves where there is room, so that nobody has to look for them. @param {Pen} pen @param {Figure} figure @param {Frame} frame @param {Palette} palette */
export function nameCurves(pen, { marks }, frame, palette) {
  const { x, box } = frame;
  const curves = /** @type {Curve[]} */ (marks.filter((mark) => mark.kind === "curve" && !DOTS.includes(mark.style)));
  const named = curves.filter(({ name, isQuiet }) => name && !isQuiet);
  if (named.length < 2 || named.length > FEW) return;
  const heights = new Map(curves.map((curve) => [curve, heightOf(curve, frame)]));
  const points = /** @type {Point[]} */ (marks.filter((mark) => mark.kind === "point"));
  /** @type {Box[]} */
  const taken = points.map((point) => around(x.pixel(point.x), frame.y.pixel(point.y), 12));
  for (const curve of named) {
    const width = widthOf(curve.name, SMALL) + 6;
    const candidates = PLACES.flatMap((share) => {
      const right = box.left + share * (box.right - box.left);
      const up = heights.get(curve)?.(right - width / 2) ?? Number.NaN;
      return [-16, 3].map((above) => ({ left: right - width, right, top: up + above, bottom: up + above + 13 }));
    });
    const free = candidates.find(
      (area) =>
        area.left > box.left &&
        area.top > box.top &&
        area.bottom < box.bottom &&
        !taken.some((other) => overlap(area, other)) &&
        ![...heights.values()].some((height) => crosses(height, area)),
    );
    if (!free) continue;
    taken.push(free);
    const colour = shade(curve.colour, palette);
    pen.text(curve.name, free.left + 3, free.top + 6.5, { colour, size: SMALL, halo: palette.panel });
  }
}

/** The height of a curve at a pixel of the horizontal axis, along which it goes one way. @param {Curve} curve @param {Frame} frame @returns {(at: number) => number} */
function heightOf(curve, { x, y, second }) {
  const points = pathOf(curve.x, curve.y, x, (curve.second && second) || y).filter((point) => point !== null);
  if (points.length > 1 && points[0][0] > points[points.length - 1][0]) points.reverse();
  const goesOneWay = points.every(([at], place) => !place || at >= points[place - 1][0]);
  return (at) => {
    if (!goesOneWay || !points.length || at < points[0][0] || at > points[points.length - 1][0]) return Number.NaN;
    let [low, high] = [0, points.length - 1];
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (points[middle][0] < at) low = middle;
      else high = middle;
    }
    const [one, other] = [points[low], points[high]];
    return one[1] + ((at - one[0]) / (other[0] - one[0] || 1)) * (other[1] - one[1]);
  };
}

/** Test whether a curve goes through an area. @param {(at: number) => number} height @param {Box} area */
function crosses(height, { left, right, top, bottom }) {
  const places = Array.from({ length: 9 }, (_, place) => left + (place / 8) * (right - left));
  return places.some((at) => {
    const up = height(at);
    return up > top - 1 && up < bottom + 1;
  });
}

/** @param {Box} one @param {Box} other */
function overlap(one, other) {
  return one.left < other.right && other.left < one.right && one.top < other.bottom && other.top < one.bottom;
}

/** @param {number} x @param {number} y @param {number} half @returns {Box} */
function around(x, y, half) {
  return { left: x - half, right: x + half, top: y - half, bottom: y + half };
}
