// The side view of a screw and its nut, to scale, with the load of each ball in front as its colour.

import { COLOURS, nutOf, rangeOf } from "./ball_places.js";
import { byId, element, NARROW, update } from "./dom.js";
import { colourAt } from "./palette.js";
import { arrow, line, polygon, shape } from "./shapes.js";
import * as units from "./units.js";

/** @import { Ball, Nut } from "./ball_places.js" */

/** Width of the drawing, and its greatest height: of a screen, and of a phone. */
const SIZES = { wide: { width: 860, height: 330 }, narrow: { width: 340, height: 260 } };
/** Room above the nut for the arrow, and below it for the scale. */
const ABOVE = 44;
const BELOW = 34;
/** Points of the edge of a thread over half a turn. */
const STEPS = 12;
/** Shades of the scale of loads. */
const SHADES = 40;
/** The longest scale bar against the width of the drawing. */
const LONGEST_BAR = 0.22;
/** Loads that differ by less are alike: what is left is rounding. */
const ROUNDING = 1e-9;

/** Show the nut of an answer in its place, or why it is not drawn. @param {Run} answer */
export function show(answer) {
  update(byId("nut-picture"), picture(answer, NARROW.matches));
}

/**
 * The picture of a nut with its scale of loads and what is assumed.
 *
 * @param {Run} answer
 * @param {boolean} isNarrow
 * @returns {HTMLElement}
 */
export function picture(answer, isNarrow) {
  const nut = nutOf(answer);
  if (!nut)
    return element(
      "p",
      { class: "small" },
      "The nut is not drawn: it has more balls than can be told apart, or a size or the loads of its halves are missing.",
    );
  const range = rangeOf(nut.balls);
  const load = Number(/** @type {Record<string, any>} */ (answer.inputs).operation?.axial_load ?? 0);
  const size = isNarrow ? SIZES.narrow : SIZES.wide;
  const notes = nut.notes.join("; ");
  return element(
    "figure",
    { class: "nut-picture" },
    element(
      "figcaption",
      {},
      "screw and nut from the side, to scale, the nut cut open; balls behind the shaft are hidden",
    ),
    drawing(nut, range, load, size),
    scale(range, size.width),
    element(
      "p",
      { class: "small" },
      nut.isAlike ? "All balls of a half carry the same: bodies are rigid and balls are alike. " : null,
      `Drawn with: ${notes}.`,
    ),
  );
}

/** A load of a ball with its unit. @param {number} value */
function loadText(value) {
  return units.formatted("contact_load", value);
}

/**
 * Where a load lies between the least and the greatest, 0 to 1.
 *
 * @param {number} load
 * @param {[number, number]} range
 */
function share(load, [least, greatest]) {
  return greatest - least > ROUNDING * greatest ? (load - least) / (greatest - least) : 0;
}

/**
 * @param {Nut} nut
 * @param {[number, number]} range
 * @param {number} load
 * @param {{ width: number, height: number }} size
 */
function drawing(nut, range, load, { width, height: tallest }) {
  const length = Math.max(...nut.balls.map((one) => one.along));
  const [from, to] = [-2 * nut.ball - nut.lead / 2, length + 2 * nut.ball + nut.lead / 2];
  const factor = Math.min(width / (to - from), tallest / nut.width); // of the drawing over m
  const left = (width - factor * (to - from)) / 2 - factor * from;
  const middle = ABOVE + (factor * nut.width) / 2;
  const height = 2 * middle - ABOVE + BELOW;
  /** @param {number} along @param {number} up @returns {[number, number]} */
  const at = (along, up) => [left + factor * along, middle - factor * up];
  const carrying = nut.balls.filter((one) => !one.isSpacer);
  const [least, greatest] = range.map(loadText);
  const label = `Side view of screw and nut, to scale: ${carrying.length} balls carry, ${units.digits(nut.turns, 3)} turns in each of ${nut.halves} bodies or halves; loads of a ball from ${least} to ${greatest}, axial load ${units.formatted("axial_load", load)}.`;
  const behind = nut.balls.filter((one) => Math.sin(one.angle) < 0);
  const before = nut.balls.filter((one) => Math.sin(one.angle) >= 0);
  /** @param {Ball} one */
  const ball = (one) => drawnBall(one, nut, range, at, factor);
  return shape(
    "svg",
    { viewBox: `0 0 ${width} ${Math.round(height)}`, role: "img", "aria-label": label, "data-scale": String(factor) },
    ...walls(nut, at),
    ...behind.map(ball),
    ...shaft(nut, from, to, at),
    ...before.map(ball),
    line(at(from, 0), at(to, 0), { class: "centre" }),
    ...loadArrow(load, at(-nut.ball, 0)[0], at(length + nut.ball, 0)[0], ABOVE - 14, width),
    ...scaleBar(factor, width, height - 10),
  );
}

/**
 * A ball, which says its number and its load where it is pointed at.
 *
 * @param {Ball} one
 * @param {Nut} nut
 * @param {[number, number]} range
 * @param {(along: number, up: number) => [number, number]} at
 * @param {number} factor
 */
function drawnBall(one, nut, range, at, factor) {
  const [cx, cy] = at(one.along, (nut.pitch / 2) * Math.cos(one.angle));
  const r = (factor * nut.ball) / 2;
  const place = nut.balls.indexOf(one) + 1;
  if (one.isSpacer) {
    const words = shape("title", {}, `spacer ball ${place}`);
    return shape("circle", { cx, cy, r, class: "spacer-ball", "data-place": place }, words);
  }
  const words = shape("title", {}, `ball ${place}: ${loadText(one.load)}`);
  const marks = { class: "ball", fill: colourAt(share(one.load, range), COLOURS), "data-place": place };
  const found = shape("circle", { cx, cy, r, ...marks }, words);
  found.dataset.load = String(one.load);
  return found;
}

/**
 * The walls of the halves above and below the balls, cut open.
 *
 * @param {Nut} nut
 * @param {(along: number, up: number) => [number, number]} at
 */
function walls(nut, at) {
  const beyond = Math.min(nut.ball, nut.between / 2);
  const bore = nut.pitch - nut.outer / 2; // as far outside the centres as the thread ends inside of them
  return Array.from({ length: nut.halves }, (_, half) => {
    const along = nut.balls.filter((one) => one.half === half).map((one) => one.along);
    const [first, last] = [Math.min(...along) - beyond, Math.max(...along) + beyond];
    return [1, -1].map((side) =>
      polygon(
        [
          at(first, (side * nut.width) / 2),
          at(last, (side * nut.width) / 2),
          at(last, side * bore),
          at(first, side * bore),
        ],
        { class: "nut-wall" },
      ),
    );
  }).flat();
}

/**
 * The core of the shaft, and the lands of its thread between the grooves, as far as they are in front.
 *
 * @param {Nut} nut
 * @param {number} from
 * @param {number} to
 * @param {(along: number, up: number) => [number, number]} at
 */
function shaft(nut, from, to, at) {
  const { lead, starts, pitch, outer, root, ball } = nut;
  const core = polygon([at(from, root / 2), at(to, root / 2), at(to, -root / 2), at(from, -root / 2)], {
    class: "core",
  });
  const slope = Math.atan(lead / (Math.PI * pitch));
  const depth = (pitch - outer) / 2;
  // half of the groove along the axis, where the thread ends
  const half = Math.sqrt(Math.max(0, (ball / 2) ** 2 - depth ** 2)) / Math.cos(slope);
  const distance = lead / starts;
  const lands = [];
  for (let turn = Math.floor((from - lead) / distance); turn * distance < to; turn += 1) {
    const [begin, end] = [turn * distance + half, (turn + 1) * distance - half];
    if (end <= begin) continue;
    /** @param {number} start @returns {[number, number][]} */
    const edge = (start) =>
      Array.from({ length: STEPS + 1 }, (_, step) => {
        const angle = (Math.PI * step) / STEPS;
        const along = Math.min(to, Math.max(from, start + (lead * angle) / (2 * Math.PI)));
        return at(along, (outer / 2) * Math.cos(angle));
      });
    lands.push(polygon([...edge(begin), ...edge(end).reverse()], { class: "land" }));
  }
  return [core, ...lands];
}

/**
 * The axial load as an arrow on the nut: a positive one from its first ball on.
 *
 * @param {number} load
 * @param {number} first
 * @param {number} last
 * @param {number} y
 * @param {number} width
 */
function loadArrow(load, first, last, y, width) {
  if (!load) return [];
  const long = Math.min(90, last - first, width / 3);
  const middle = (first + last) / 2;
  // as on the sketch of the axis: a positive speed moves the nut to the right, against a positive load
  const [from, to] = load < 0 ? [middle - long / 2, middle + long / 2] : [middle + long / 2, middle - long / 2];
  const words = `axial load on the nut ${units.formatted("axial_load", Math.abs(load))}`;
  return [arrow(from, to, y + 6, "load"), shape("text", { x: middle, y: y - 6, "text-anchor": "middle" }, words)];
}

/**
 * A bar of a round length in the unit of the page.
 *
 * @param {number} factor
 * @param {number} width
 * @param {number} y
 */
function scaleBar(factor, width, y) {
  const unit = units.inSystem("mm");
  const most = units.fromSI((LONGEST_BAR * width) / factor, unit, "m");
  const power = 10 ** Math.floor(Math.log10(most));
  const long = ([5, 2, 1].find((one) => one * power <= most) ?? 1) * power;
  const end = 8 + factor * units.toSI(long, unit, "m");
  return [
    shape("path", { d: `M8 ${y - 5}V${y}H${end.toFixed(2)}V${y - 5}`, class: "bar-of-scale" }),
    shape("text", { x: end + 8, y: y + 1 }, units.formattedIn(units.toSI(long, unit, "m"), "mm", "m")),
  ];
}

/**
 * The scale of loads with its least and its greatest value; one colour where all balls carry the same.
 *
 * @param {[number, number]} range
 * @param {number} width
 */
function scale([least, greatest], width) {
  const long = Math.min(300, width - 40);
  const isOne = greatest - least <= ROUNDING * greatest;
  const values = isOne ? [least] : [least, (least + greatest) / 2, greatest];
  const unit = units.symbol(units.unitOf("contact_load"));
  const title = `normal load of a ball, the greater of its flanks (${unit})`;
  const [height, top] = [54, 20];
  const steps = isOne ? 1 : SHADES;
  const shades = Array.from({ length: steps }, (_, place) =>
    shape("rect", {
      x: 20 + (long * place) / steps,
      y: top,
      width: long / steps + 0.5,
      height: 12,
      fill: colourAt(isOne ? 0 : place / (steps - 1), COLOURS),
    }),
  );
  const marks = values.map((value, place) => {
    const x = 20 + (values.length > 1 ? (long * place) / (values.length - 1) : long / 2);
    const words = units.digits(units.inDisplayUnit("contact_load", value), 3);
    return shape("text", { x, y: top + 28, "text-anchor": "middle" }, words);
  });
  const ends = `Scale of colours: loads of a ball from ${loadText(least)}, light, to ${loadText(greatest)}, dark.`;
  return shape(
    "svg",
    { viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": ends, class: "scale-of-loads" },
    shape("text", { x: 20, y: top - 7 }, title),
    ...shades,
    shape("rect", { x: 20, y: top, width: long, height: 12, class: "frame" }),
    ...marks,
  );
}
