// The Stribeck curve: the friction torque at constant load over the film parameter, with the regimes of lubrication.

import * as parts from "./chart_parts.js";
import { REGIMES } from "./curves.js";
import { draw, hide, layout } from "./plot.js";
import { leastFilm } from "./results.js";
import { text } from "./texts.js";
import * as units from "./units.js";

const ID = "stribeck-chart";
/** How far the axis goes beyond the curve, as a factor. */
const BEYOND = 1.15;
/** Outputs of a sweep of which the least is the film parameter: of a whole nut, and of both contacts of a ball. */
const FILMS = ["minimum_film_parameter", "screw_film_parameter", "nut_film_parameter"];

/** A point of the curve, torque in its display unit. @typedef {{ film: number, speed: number, torque: number, valid: boolean }} Point */

/**
 * The points of a sweep over the speed that turn as the operating point does, by their film parameter.
 *
 * @param {Sweep} swept
 * @param {number} speed of the operating point
 * @returns {Point[]}
 */
function pointsOf(swept, speed) {
  const speeds = parts.valuesOf(swept.axes.screw_speed);
  const torques = parts.converted("screw_torque", swept.outputs.screw_torque);
  const shown = parts.converted("screw_speed", swept.axes.screw_speed);
  const films = FILMS.flatMap((name) => (swept.outputs[name] ? [parts.valuesOf(swept.outputs[name])] : []));
  const valid = parts.validAlong(swept);
  return speeds
    .map((one, i) => ({
      film: Math.min(...films.map((values) => values[i] ?? Number.NaN)),
      speed: shown[i],
      torque: torques[i],
      valid: valid[i],
      isSame: one * (speed || 1) > 0,
    }))
    .filter(({ film, torque, isSame }) => isSame && film > 0 && Number.isFinite(torque))
    .sort((one, other) => one.film - other.film);
}

/** Which text names a regime by its ends. @param {number} from @param {number} to */
function keyOf(from, to) {
  if (!from) return "stribeck.below";
  return Number.isFinite(to) ? "stribeck.between" : "stribeck.above";
}

/** Places of the marks of a logarithmic axis: 1, 2 and 5 times a power of ten. @param {number} low @param {number} high */
function marksOf(low, high) {
  const [first, last] = [low, high].map((end) => Math.floor(Math.log10(end)));
  const powers = Array.from({ length: last - first + 1 }, (_, i) => 10 ** (first + i));
  return powers.flatMap((power) => [1, 2, 5].map((digit) => digit * power)).filter((at) => at >= low && at <= high);
}

/**
 * The friction torque over the least film parameter, at the speeds of a sweep.
 *
 * @param {Sweep} swept
 * @param {Run} answer
 */
export function show(swept, answer) {
  const { screw_speed: speed, axial_load: load } = parts.operationOf(answer);
  const points = pointsOf(swept, speed);
  const least = answer.results.minimum_film_parameter ?? leastFilm(answer);
  if (points.length < 2) {
    hide(ID);
    return undefined;
  }
  const now = least > 0 ? least : null;
  const films = points.map(({ film }) => film);
  const [low, high] = [
    Math.min(...films, now ?? Number.POSITIVE_INFINITY) / BEYOND,
    Math.max(...films, now ?? 0) * BEYOND,
  ];
  const zones = REGIMES.map(([name, from, to, colour]) => ({
    name,
    colour,
    from: Math.max(from, low),
    to: Math.min(to, high),
  })).filter(({ from, to }) => from < to);
  const torque = answer.results.screw_torque;
  const x = text("stribeck.film");
  const y = parts.titled("screw_torque", text("chart.torque"));
  const regime = (now && REGIMES.find(([, , to]) => now < to)?.[0]) || "";
  const description = { film: units.digits(now), torque: units.formatted("screw_torque", torque), regime };
  return draw(ID, {
    name: "stribeck_curve",
    caption: text("stribeck.caption", { load: units.formatted("axial_load", load) }),
    description: text("stribeck.description", description),
    figure: (colours) => ({
      traces: [
        ...parts.linesByValidity(
          films,
          points.map((one) => one.torque),
          points.map(({ valid }) => valid),
          text("chart.torque"),
          colours.accent,
        ),
        parts.pointAt(colours, now, units.inDisplayUnit("screw_torque", torque)),
      ],
      layout: layout(colours, x, y, {
        hovermode: "closest",
        xaxis: { type: "log", range: [low, high].map(Math.log10), tickmode: "array", tickvals: marksOf(low, high) },
        shapes: zones.map(({ from, to, colour }) => ({
          type: "rect",
          yref: "paper",
          y0: 0,
          y1: 1,
          x0: from,
          x1: to,
          fillcolor: colour,
          opacity: 0.13,
          line: { width: 0 },
          layer: "below",
        })),
        // the places of words on a logarithmic axis are logarithms, those of areas are not
        annotations: zones.map(({ name, from }) => ({
          yref: "paper",
          x: Math.log10(from),
          xanchor: "left",
          y: 1,
          yanchor: "top",
          text: name,
          showarrow: false,
          font: { size: 11 },
        })),
      }),
    }),
    legend: (colours) => [
      { kind: "line", name: text("chart.torque"), colour: colours.accent },
      parts.pointEntry(colours),
      ...parts.dottedEntries(
        points.map(({ valid }) => valid),
        colours.accent,
      ),
      ...REGIMES.filter(([name]) => zones.some((zone) => zone.name === name)).map(([name, from, to, colour]) => ({
        kind: "area",
        name: text(keyOf(from, to), { name, from, to }),
        colour: `${colour}66`,
      })),
    ],
    numbers: () => [
      [x, y, parts.titled("screw_speed", text("chart.speed")), text("chart.valid")],
      points.map((one) => [one.film, one.torque, one.speed, parts.yesOrNo(one.valid)]),
    ],
  });
}
