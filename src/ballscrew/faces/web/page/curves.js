// Charts of a few curves: the film parameter over speed, the pressure over load.

import * as parts from "./chart_parts.js";
import { draw, layout } from "./plot.js";
import { greatestPressure, leastFilm } from "./results.js";
import { text } from "./texts.js";
import * as units from "./units.js";

/** @typedef {import("./plot.js").Colours} Colours */

/** @type {Record<string, string>} */
const FILMS = {
  screw_film_parameter: text("contact.screw"),
  nut_film_parameter: text("contact.nut"),
  minimum_film_parameter: text("film.least"),
};
/** @type {Record<string, string>} */
const PRESSURES = {
  screw_maximum_pressure: text("contact.screw"),
  nut_maximum_pressure: text("contact.nut"),
  maximum_pressure: text("pressure.greatest"),
};
/** Regimes of lubrication, and where the next one begins. @type {[string, number, number, string][]} */
export const REGIMES = [
  [text("film.boundary"), 0, 1, "#D55E00"],
  [text("film.mixed"), 1, 3, "#E69F00"],
  [text("contact.full"), 3, Number.POSITIVE_INFINITY, "#009E73"],
];

/**
 * Curves with a line each, and the operating point.
 *
 * @param {number[]} x
 * @param {Record<string, number[]>} curves values by name
 * @param {Record<string, string>} labels
 * @param {boolean[]} valid
 */
function lines(x, curves, labels, valid) {
  const names = Object.keys(curves);
  /**
   * @param {Colours} colours
   * @param {number} place
   */
  const style = (colours, place) => ({
    colour: place ? colours.second : colours.accent,
    kind: place ? "dash" : "line",
  });
  return {
    /** @param {Colours} colours */
    traces: (colours) =>
      names.map((name, place) => ({
        x,
        y: curves[name],
        name: labels[name],
        mode: "lines",
        hovertemplate: "%{y:.4g}",
        line: { width: 2, color: style(colours, place).colour, dash: place ? "dash" : "solid" },
      })),
    /** @param {Colours} colours */
    legend: (colours) => [
      ...names.map((name, place) => ({ ...style(colours, place), name: labels[name] })),
      parts.pointEntry(colours),
      ...parts.invalidEntries(valid),
    ],
    rows: () => x.map((at, place) => [at, ...names.map((name) => curves[name][place]), parts.yesOrNo(valid[place])]),
    invalid: parts.invalidRanges(x, valid),
  };
}

/**
 * The film parameter over speed, with the regimes behind it.
 *
 * @param {Sweep} swept
 * @param {Run} answer
 */
export function film(swept, answer) {
  const speeds = parts.converted("screw_speed", swept.axes.screw_speed);
  const names = Object.keys(FILMS).filter((name) => swept.outputs[name]);
  const curves = Object.fromEntries(names.map((name) => [name, parts.valuesOf(swept.outputs[name])]));
  const now = answer.results.minimum_film_parameter ?? leastFilm(answer);
  const highest = 1.08 * Math.max(1.2, ...[now, ...Object.values(curves).flat()].filter(Number.isFinite));
  const zones = REGIMES.filter(([, from]) => from < 0.97 * highest);
  const shapes = zones.map(([, from, to, colour]) => ({
    type: "rect",
    xref: "paper",
    x0: 0,
    x1: 1,
    y0: from,
    y1: Math.min(to, highest),
    fillcolor: colour,
    opacity: 0.13,
    line: { width: 0 },
    layer: "below",
  }));
  const annotations = zones.map(([name, , to]) => ({
    xref: "paper",
    x: 0.01,
    xanchor: "left",
    y: Math.min(to, highest),
    yanchor: "top",
    text: name,
    showarrow: false,
    font: { size: 11 },
  }));
  const x = parts.titled("screw_speed", text("chart.speed"));
  const shown = lines(speeds, curves, FILMS, parts.validAlong(swept));
  const speed = units.inDisplayUnit("screw_speed", parts.operationOf(answer).screw_speed);
  return draw("film-chart", {
    name: "film_over_speed",
    caption: text("film.caption"),
    description: text("film.description", { film: units.digits(now) }),
    legend: shown.legend,
    figure: (colours) => ({
      traces: [...shown.traces(colours), parts.pointAt(colours, speed, now)],
      layout: layout(colours, x, text("results.of_contact.film_parameter"), {
        shapes: [...shapes, ...shown.invalid],
        annotations,
        yaxis: { range: [0, highest] },
      }),
    }),
    numbers: () => [[x, ...names.map((name) => `λ, ${FILMS[name]}`), text("chart.valid")], shown.rows()],
  });
}

/**
 * The greatest contact pressure over load.
 *
 * @param {Sweep} swept
 * @param {Run} answer
 */
export function pressure(swept, answer) {
  const loads = parts.converted("axial_load", swept.axes.axial_load);
  const names = Object.keys(PRESSURES).filter((name) => swept.outputs[name]);
  const curves = Object.fromEntries(
    names.map((name) => [name, parts.converted("maximum_pressure", swept.outputs[name])]),
  );
  const x = parts.titled("axial_load", text("chart.load"));
  const y = parts.titled("maximum_pressure", text("results.of_contact.maximum_pressure"));
  const now = greatestPressure(answer);
  const nowText = units.formatted("maximum_pressure", now);
  const shown = lines(loads, curves, PRESSURES, parts.validAlong(swept));
  const load = units.inDisplayUnit("axial_load", parts.operationOf(answer).axial_load);
  return draw("pressure-chart", {
    name: "pressure_over_load",
    caption: text("pressure.caption"),
    description: text("pressure.description", { pressure: nowText }),
    legend: shown.legend,
    figure: (colours) => ({
      traces: [...shown.traces(colours), parts.pointAt(colours, load, units.inDisplayUnit("maximum_pressure", now))],
      layout: layout(colours, x, y, { shapes: shown.invalid }),
    }),
    numbers: () => [
      [x, ...names.map((name) => parts.titled("maximum_pressure", PRESSURES[name])), text("chart.valid")],
      shown.rows(),
    ],
  });
}
