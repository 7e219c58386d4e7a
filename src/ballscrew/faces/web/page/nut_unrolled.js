// The nut unrolled: each ball at its angle about the screw and its place along it, with its load as its colour.

import { nutOf, rangeOf, SCALE } from "./ball_places.js";
import { POSITION } from "./cards/quantities.js";
import * as parts from "./chart_parts.js";
import { byId, element, scrolling, table, update } from "./dom.js";
import { draw, hide, layout } from "./plot.js";
import { text } from "./texts.js";
import * as units from "./units.js";

/** @typedef {import("./ball_places.js").Nut} Nut */
/** @typedef {import("./ball_places.js").Ball} Ball */

const CHART = "nut-unrolled";
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
 * @returns {import("./plot.js").Chart}
 */
function chart(nut) {
  const x = text("nut_unrolled.angle");
  const y = POSITION.titled(text("nut_unrolled.along"));
  const z = parts.titled("contact_load", text("stiffness.load"));
  const balls = nut.balls.filter((one) => !one.isSpacer);
  const spacers = nut.balls.filter((one) => one.isSpacer);
  const [least, greatest] = rangeOf(nut.balls);
  const length = Math.max(...nut.balls.map((one) => one.along)) + 2 * ROOM * nut.lead;
  const size = Math.min(DOT.greatest, Math.max(DOT.least, (DOT.height * nut.ball) / length));
  /** @param {number} load */
  const shown = (load) => units.inDisplayUnit("contact_load", load);
  /** @param {Ball[]} some */
  const placed = (some) => ({ x: some.map(angleOf), y: POSITION.all(some.map((one) => one.along)), mode: "markers" });
  const words = text("nut_unrolled.ball");
  return {
    name: "nut_unrolled",
    caption: text("nut_unrolled.caption"),
    description: text("nut_unrolled.description", {
      balls: balls.length,
      least: units.formatted("contact_load", least),
      greatest: units.formatted("contact_load", greatest),
    }),
    figure: (colours) => ({
      traces: [
        {
          ...helix(nut),
          name: text("nut_unrolled.helix"),
          mode: "lines",
          hoverinfo: "skip",
          line: { color: colours.ink, width: 0.6 },
        },
        ...(spacers.length
          ? [
              {
                ...placed(spacers),
                name: text("nut_unrolled.spacer"),
                hoverinfo: "skip",
                marker: { size, color: colours.panel, line: { color: colours.ink, width: 1.2 } },
              },
            ]
          : []),
        {
          ...placed(balls),
          name: words,
          customdata: balls.map((one) => nut.balls.indexOf(one) + 1),
          marker: {
            size,
            color: balls.map((one) => shown(one.load)),
            colorscale: SCALE,
            cmin: shown(least),
            cmax: shown(greatest > least ? greatest : least + 1),
            showscale: true,
            colorbar: {
              thickness: 12,
              outlinewidth: 0,
              tickformat: ".4~g",
              title: { text: z, side: "right" },
              xpad: 6,
            },
            line: { color: colours.ink, width: 0.8 },
          },
          hovertemplate: `${words} %{customdata}: %{marker.color:.4g} ${units.symbol(units.unitOf("contact_load"))}<extra></extra>`,
        },
      ],
      layout: layout(colours, x, y, {
        hovermode: "closest",
        margin: { l: 72, r: 92, t: 8, b: 42 },
        xaxis: { range: [-8, 368], tickvals: [0, 90, 180, 270, 360], nticks: undefined },
        yaxis: { rangemode: "normal" },
      }),
    }),
    legend: (colours) => [
      ...(spacers.length ? [{ kind: "point", name: text("nut_unrolled.spacer"), colour: colours.ink }] : []),
      { kind: "line", name: text("nut_unrolled.helix"), colour: colours.ink },
    ],
    numbers: () => [
      [
        text("chart.ball"),
        text("nut_unrolled.half"),
        x,
        y,
        parts.titled("contact_load", text("stiffness.carrying")),
        parts.titled("contact_load", text("stiffness.other")),
        text("nut_unrolled.kind"),
      ],
      nut.balls.map((one, place) => [
        place + 1,
        one.half + 1,
        angleOf(one),
        POSITION.convert(one.along),
        one.isSpacer ? null : shown(one.forward),
        one.isSpacer ? null : shown(one.backward),
        one.isSpacer ? text("nut_unrolled.spacer") : words,
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
  return { x, y: POSITION.all(y) };
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
      halves > 1 ? text("nut_unrolled.of_half", { half: half + 1 }) : text("nut_unrolled.all"),
      String(loads.length),
      cell("least", least),
      cell("greatest", greatest),
      cell("mean", mean),
      ratio,
    ];
  });
  const caption = text("nut_unrolled.extremes");
  const headings = ["", "count", "least", "greatest", "mean", "ratio"].map((name) => (name ? heading(name) : ""));
  return scrolling(caption, table(caption, headings, rows));
}

/** @param {string} name */
function heading(name) {
  return text(/** @type {import("./texts.js").Key} */ (`nut_unrolled.${name}`));
}
