// The nut unrolled: each ball at its angle about the screw and its place along it, with its load as its colour.

import { COLOURS, nutOf, rangeOf } from "./ball_places.js";
import { draw, hide } from "./chart_place.js";
import { byId, element, scrolling, table, update } from "./dom.js";
import * as units from "./units.js";

/** What is said of the loads. @type {Record<string, string>} */
const NUMBERS = {
  count: "balls that carry",
  greatest: "greatest",
  least: "least",
  mean: "mean",
  ratio: "greatest / least",
};

/** @import { Ball, Nut } from "./ball_places.js" */
/** @import { Curve } from "./figure.js" */

const CHART = "nut-unrolled";
const PLACE = { unit: "m", shown_in: "mm" };
const TURN = 2 * Math.PI;
/** Room beside the first and the last ball, in leads; the least and the greatest size of a dot, in pixels. */
const ROOM = 0.5;
const DOT = { least: 5, greatest: 14, height: 290 };

/** Show the nut of an answer, and the extremes of its loads. @param {Run} answer */
export function show(answer) {
  const nut = nutOf(answer);
  const place = byId("nut-extremes");
  if (!nut) {
    hide(CHART);
    place.replaceChildren();
    return;
  }
  update(place, extremes(nut));
  draw(CHART, chart(nut));
}

/** The angle of a ball within a turn, in degrees. @param {Ball} ball */
function angleOf({ angle }) {
  return (((angle % TURN) + TURN) % TURN) * (360 / TURN);
}

/**
 * @param {Nut} nut
 * @returns {import("./chart_place.js").Chart}
 */
function chart(nut) {
  const x = "angle about the screw (°)";
  const y = units.titled("place along the screw", PLACE);
  const z = units.heading("contact_load", "load of a ball");
  const balls = nut.balls.filter((one) => !one.isSpacer);
  const spacers = nut.balls.filter((one) => one.isSpacer);
  const [least, greatest] = rangeOf(nut.balls);
  const length = Math.max(...nut.balls.map((one) => one.along)) + 2 * ROOM * nut.lead;
  const size = Math.min(DOT.greatest, Math.max(DOT.least, (DOT.height * nut.ball) / length));
  const ends = [-ROOM * nut.lead, length - ROOM * nut.lead].map((along) => Number(units.converted(along, PLACE)));
  /** @param {number} load */
  const shown = (load) => units.inDisplayUnit("contact_load", load);
  /** @param {Ball[]} some @param {Pick<Curve, "name" | "style"> & Partial<Curve>} others @returns {Curve} */
  const dots = (some, others) => ({
    kind: "curve",
    x: some.map(angleOf),
    y: some.map((one) => units.converted(one.along, PLACE)),
    colour: "ink",
    size,
    ...others,
  });
  const words = "ball";
  return {
    name: "nut_unrolled",
    caption: "the nut unrolled: place and load of each ball",
    description: `Places of ${balls.length} balls over the angle about the screw, with loads from ${units.formatted("contact_load", least)} to ${units.formatted("contact_load", greatest)} as colours.`,
    figure: {
      x: { title: x, from: -8, to: 368, step: 90 },
      y: { title: y, from: ends[0], to: ends[1] },
      marks: [
        {
          kind: "curve",
          ...helix(nut),
          name: "line of the groove",
          colour: "ink",
          style: "line",
          width: 0.6,
          isQuiet: true,
        },
        ...(spacers.length ? [dots(spacers, { name: "spacer ball", style: "circles", isQuiet: true })] : []),
        dots(balls, {
          name: "",
          style: "dots",
          words: balls.map(
            (one) => `${words} ${nut.balls.indexOf(one) + 1}: ${units.formatted("contact_load", one.load)}`,
          ),
          values: balls.map((one) => shown(one.load)),
          shades: {
            from: shown(least),
            to: shown(greatest > least ? greatest : least + 1),
            title: z,
            colours: COLOURS,
          },
        }),
      ],
    },
    numbers: () => [
      [
        "ball",
        "half",
        x,
        y,
        units.heading("contact_load", "flank that carries the load"),
        units.heading("contact_load", "other flank"),
        "kind of ball",
      ],
      nut.balls.map((one, place) => [
        place + 1,
        one.half + 1,
        angleOf(one),
        units.converted(one.along, PLACE),
        one.isSpacer ? null : shown(one.forward),
        one.isSpacer ? null : shown(one.backward),
        one.isSpacer ? "spacer ball" : words,
      ]),
    ],
  };
}

/**
 * The lines of the grooves of each half and each start, parted where a turn ends.
 *
 * @param {Nut} nut
 */
function helix({ balls, halves, lead, starts }) {
  /** @type {(number | null)[]} */
  const x = [];
  /** @type {(number | null)[]} */
  const y = [];
  for (let half = 0; half < halves; half += 1) {
    const own = balls.filter((one) => one.half === half);
    const [first] = own;
    const [low, high] = [Math.min(...own.map((one) => one.along)), Math.max(...own.map((one) => one.along))];
    const [from, to] = [low - (ROOM * lead) / 2, high + (ROOM * lead) / 2];
    for (let start = 0; start < starts; start += 1) {
      // along the axis where this start is at angle zero
      const zero = first.along - (lead * (first.angle + (start * TURN) / starts)) / TURN;
      for (let turn = Math.floor((from - zero) / lead); zero + turn * lead < to; turn += 1) {
        const begin = zero + turn * lead;
        const ends = [Math.max(from, begin), Math.min(to, begin + lead)];
        if (ends[1] <= ends[0]) continue;
        x.push(...ends.map((along) => ((along - begin) / lead) * 360), null);
        y.push(...ends, null);
      }
    }
  }
  return { x, y: y.map((along) => units.converted(along, PLACE)) };
}

/** Least, greatest and mean load of the balls of each half, and how many times the least the greatest is. @param {Nut} nut */
function extremes({ balls, halves }) {
  const rows = Array.from({ length: halves }, (_, half) => {
    const loads = balls.filter((one) => one.half === half && !one.isSpacer).map((one) => one.load);
    const [least, greatest] = [Math.min(...loads), Math.max(...loads)];
    const mean = loads.reduce((sum, one) => sum + one, 0) / loads.length;
    /** @param {string} name @param {number} value */
    const cell = (name, value) =>
      element(
        "data",
        { value: String(value), "data-name": `${name}-${half + 1}` },
        units.formatted("contact_load", value),
      );
    const ratio = least > 0 ? units.digits(greatest / least, 4) : "–";
    return [
      halves > 1 ? `half ${half + 1}` : "nut",
      String(loads.length),
      cell("least", least),
      cell("greatest", greatest),
      cell("mean", mean),
      ratio,
    ];
  });
  const caption = "loads of the balls: the greater of both flanks";
  const headings = ["", "count", "least", "greatest", "mean", "ratio"].map((name) => (name ? heading(name) : ""));
  return scrolling(caption, table(caption, headings, rows));
}

/** @param {string} name */
function heading(name) {
  return NUMBERS[name];
}
