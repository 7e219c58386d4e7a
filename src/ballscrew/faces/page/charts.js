// Charts of an operating point over its speed and its load: the torque and its parts, efficiency, film, pressure, Stribeck.

import * as parts from "./chart_parts.js";
import { draw, hide } from "./chart_place.js";
import { element } from "./dom.js";
import { linesByValidity, OUTSIDE, outside, pointAt } from "./figure_parts.js";
import { yesOrNo } from "./figure_words.js";
import { data, greatestPressure, leastFilm } from "./results.js";
import { extent } from "./scale.js";
import { FLOODED, fullBath } from "./starvation.js";
import * as units from "./units.js";

/** @import { Mark, Zone } from "./figure.js" */

// light enough everywhere for dark lines, also for people who do not see red or green
const SHADES = ["#8296b5", "#c3b98c", "#ffe945"];
/** @type {Record<string, string>} */
const FILMS = {
  screw_film_parameter: "ball and screw",
  nut_film_parameter: "ball and nut",
  minimum_film_parameter: "least of all contacts",
};
/** @type {Record<string, string>} */
const PRESSURES = {
  screw_maximum_pressure: "ball and screw",
  nut_maximum_pressure: "ball and nut",
  maximum_pressure: "greatest of all balls",
};
/** Regimes of lubrication, and where the next one begins. @type {[string, number, number, string][]} */
const REGIMES = [
  ["boundary", 0, 1, "red"],
  ["mixed", 1, 3, "orange"],
  ["full film", 3, Number.POSITIVE_INFINITY, "green"],
];
/** How far the axis of the Stribeck curve goes beyond it, as a factor. */
const BEYOND = 1.15;

/**
 * A mechanism in words.
 *
 * @param {string} name
 * @param {Mechanisms} mechanisms
 */
export function wordsOf(name, mechanisms) {
  return mechanisms[name]?.words ?? name;
}

// -- the torque -------------------------------------------------------------------------------------

/**
 * The band of the torque over the speed as intervals in each other, from the widest on, or why there is none.
 *
 * @param {Sweep | string | undefined} banded
 * @returns {Mark[]}
 */
function bandsOf(banded) {
  if (!banded) return [];
  if (typeof banded === "string") {
    return [{ kind: "level", name: `no band: ${banded}`, colour: "soft" }];
  }
  const x = parts.converted("screw_speed", banded.axes.screw_speed);
  const { low, high, inner } = banded.outputs.screw_torque;
  const intervals = [{ level: banded.band?.level, low, high, isWidest: true }, ...(inner ?? []).toReversed()];
  return intervals.map(({ level, ...ends }) => {
    const share = units.digits(100 * (level ?? 0));
    const names =
      "isWidest" in ends
        ? ["lower end of the band", "upper end of the band"]
        : [`lower end, ${share} % of the samples`, `upper end, ${share} % of the samples`];
    const [lows, highs] = [ends.low, ends.high].map((values) =>
      parts.converted("screw_torque", { values: values ?? [] }),
    );
    return {
      kind: "band",
      name: `band: ${share} % of the samples of inputs and laws`,
      x,
      low: lows,
      high: highs,
      colour: "ink",
      solid: false,
      ends: names,
    };
  });
}

/**
 * Torque against speed, its parts stacked, its band, and the operating point.
 *
 * @param {Sweep} swept
 * @param {Run} answer
 * @param {Mechanisms} mechanisms
 * @param {Sweep | string} [banded] the band at some of the speeds, or why there is none
 */
export function torque(swept, answer, mechanisms, banded) {
  const speeds = parts.converted("screw_speed", swept.axes.screw_speed);
  const { screw_torque: sum, contributions } = answer.results;
  const total = parts.converted("screw_torque", swept.outputs.screw_torque);
  const operation = parts.operationOf(answer);
  const load = units.formatted("axial_load", operation.axial_load);
  const names = Object.keys(contributions).filter((name) =>
    swept.outputs[`contribution_${name}`]?.values.some((value) => value !== 0),
  );
  let low = speeds.map(() => 0);
  /** @type {Mark[]} */
  const stacked = names.map((name) => {
    const part = parts.converted("screw_torque", swept.outputs[`contribution_${name}`]);
    const [below, high] = [low, low.map((value, place) => value + (part[place] ?? 0))];
    low = high;
    const colour = mechanisms[name]?.colour ?? "grey";
    return {
      kind: "band",
      name: wordsOf(name, mechanisms),
      x: speeds,
      low: below,
      high,
      colour,
      solid: true,
      note: share(name),
    };
  });
  /** @param {string} name */
  function share(name) {
    const part = contributions[name];
    const percent = sum && sum > 0 && part !== null ? ` · ${units.digits((100 * part) / sum, 2)} %` : "";
    return element("span", { class: "value" }, data("screw_torque", part), percent);
  }
  /** The sum at the nearest speed of the curve. @param {number} at */
  const nearest = (at) => {
    const [[place]] = speeds.map((one, i) => [i, Math.abs(one - at)]).sort(([, a], [, b]) => a - b);
    return total[place];
  };
  const note = element("span", { class: "value" }, data("screw_torque", sum));
  const title = units.heading("screw_torque", "friction torque");
  draw("torque-chart", {
    name: "torque_over_speed",
    drag: { x: "screw_speed", place: (at) => [at, nearest(at)] },
    caption: `friction torque and its parts at ${load}`,
    description: `Friction torque against speed at ${load}, stacked by mechanism. At the operating point ${units.formatted("screw_torque", sum)}.`,
    figure: {
      x: { title: units.heading("screw_speed", "speed of the screw") },
      y: { title, zero: true },
      marks: [
        ...stacked,
        ...bandsOf(banded),
        {
          kind: "curve",
          name: "sum",
          x: speeds,
          y: total,
          colour: "ink",
          style: "line",
          note,
          heading: title,
        },
        ...(FLOODED in swept.outputs
          ? [fullBath(speeds, parts.converted("screw_torque", swept.outputs[FLOODED]))]
          : []),
        outside(speeds, parts.validAlong(swept)),
        pointAt(units.inDisplayUnit("screw_speed", operation.screw_speed), units.inDisplayUnit("screw_torque", sum)),
      ],
    },
  });
}

// -- efficiency -------------------------------------------------------------------------------------

/**
 * Efficiency over load and speed.
 *
 * @param {Sweep} swept
 * @param {Run} answer
 */
export function map(swept, answer) {
  const speeds = parts.converted("screw_speed", swept.axes.screw_speed);
  const loads = parts.converted("axial_load", swept.axes.axial_load);
  const loadIsFirst = Object.keys(swept.axes)[0] === "axial_load";
  /**
   * Rows of one load each.
   *
   * @template Value
   * @param {Value[][]} values
   */
  const byLoad = (values) => (loadIsFirst ? values : loads.map((_, i) => speeds.map((_speed, j) => values[j][i])));
  const [driving, driven] = ["efficiency", "back_driving_efficiency"].map((name) =>
    byLoad(/** @type {(number | null)[][]} */ (swept.outputs[name].values)),
  );
  // where load and speed have not the same sign, the load drives the screw
  const isDriven = loads.some((load) => speeds.some((speed) => load * speed < 0));
  const values = driving.map((row, i) => row.map((value, j) => (loads[i] * speeds[j] < 0 ? driven[i][j] : value)));
  const [from, to] = extent(values.flat()) ?? [0, 1];
  const operation = parts.operationOf(answer);
  const efficiency = units.digits(answer.results.efficiency ?? answer.results.back_driving_efficiency);
  const words = "efficiency";
  const valid = byLoad(/** @type {boolean[][]} */ (swept.outputs.valid.values));
  draw("map-chart", {
    name: "efficiency_map",
    drag: { x: "screw_speed", y: "axial_load", place: (at, load) => [at, load] },
    caption: "efficiency over axial load (down) and speed (across)",
    description: `Efficiency over axial load and speed; at the operating point ${efficiency}.`,
    figure: {
      x: {
        title: units.heading("screw_speed", "speed of the screw"),
        from: Math.min(...speeds),
        to: Math.max(...speeds),
      },
      y: { title: units.heading("axial_load", "axial load"), from: Math.min(...loads), to: Math.max(...loads) },
      marks: [
        {
          kind: "grid",
          name: words,
          x: speeds,
          y: loads,
          values,
          valid,
          colour: "",
          shades: { from, to, title: words, colours: SHADES },
        },
        ...(isDriven
          ? [
              /** @type {Mark} */ ({
                kind: "level",
                name: "load and speed of opposite signs: the load drives the screw",
                colour: "soft",
              }),
            ]
          : []),
        { kind: "outside", name: OUTSIDE, x: [], valid: valid.flat() },
        pointAt(
          units.inDisplayUnit("screw_speed", operation.screw_speed),
          units.inDisplayUnit("axial_load", operation.axial_load),
        ),
      ],
    },
  });
}

// -- film and pressure ------------------------------------------------------------------------------

/**
 * The curves of a sweep, one for each side of the contact.
 *
 * @param {number[]} x
 * @param {Sweep} swept
 * @param {Record<string, string>} labels
 * @returns {Mark[]}
 */
function sides(x, swept, labels) {
  const names = Object.keys(labels).filter((name) => swept.outputs[name]);
  return names.map((name, place) => ({
    kind: "curve",
    name: labels[name],
    x,
    y: parts.converted(name.includes("pressure") ? "maximum_pressure" : name, swept.outputs[name]),
    colour: place ? "second" : "accent",
    style: place ? "dashed" : "line",
  }));
}

/**
 * The film parameter over speed, with the regimes behind it.
 *
 * @param {Sweep} swept
 * @param {Run} answer
 */
export function film(swept, answer) {
  const speeds = parts.converted("screw_speed", swept.axes.screw_speed);
  const curves = sides(speeds, swept, FILMS);
  const now = answer.results.minimum_film_parameter ?? leastFilm(answer);
  const known = curves
    .flatMap((curve) => (curve.kind === "curve" ? curve.y : []))
    .map(Number)
    .filter(Number.isFinite);
  const highest = 1.08 * Math.max(1.2, Number.isFinite(now) ? now : 0, ...known);
  /** @type {Mark[]} */
  const zones = REGIMES.filter(([, from]) => from < 0.97 * highest).map(([words, from, to, colour]) => ({
    kind: "zone",
    name: "",
    words,
    along: "y",
    from,
    to: Math.min(to, highest),
    colour,
  }));
  draw("film-chart", {
    name: "film_over_speed",
    caption: "film parameter over speed",
    description: `Film parameter against speed; ${units.digits(now)} at the operating point.`,
    figure: {
      x: { title: units.heading("screw_speed", "speed of the screw") },
      y: { title: "film parameter λ", from: 0, to: highest },
      marks: [
        ...zones,
        ...curves,
        outside(speeds, parts.validAlong(swept)),
        pointAt(units.inDisplayUnit("screw_speed", parts.operationOf(answer).screw_speed), now),
      ],
    },
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
  const now = greatestPressure(answer);
  draw("pressure-chart", {
    name: "pressure_over_load",
    caption: "greatest contact pressure over axial load",
    description: `Greatest contact pressure against axial load; ${units.formatted("maximum_pressure", now)} at the operating point.`,
    figure: {
      x: { title: units.heading("axial_load", "axial load") },
      y: { title: units.heading("maximum_pressure", "greatest pressure"), zero: true },
      marks: [
        ...sides(loads, swept, PRESSURES),
        outside(loads, parts.validAlong(swept)),
        pointAt(
          units.inDisplayUnit("axial_load", parts.operationOf(answer).axial_load),
          units.inDisplayUnit("maximum_pressure", now),
        ),
      ],
    },
  });
}

// -- Stribeck ---------------------------------------------------------------------------------------

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
  // of a whole nut, and of both contacts of a ball
  const films = Object.keys(FILMS).flatMap((name) =>
    swept.outputs[name] ? [parts.valuesOf(swept.outputs[name])] : [],
  );
  const valid = parts.validAlong(swept);
  return speeds
    .map((one, i) => ({
      film: Math.min(...films.map((values) => values[i] ?? Number.NaN)),
      speed: shown[i],
      torque: torques[i],
      valid: valid[i],
      isSame: one * (speed || 1) > 0,
    }))
    .filter(({ film: thickness, torque: value, isSame }) => isSame && thickness > 0 && Number.isFinite(value))
    .sort((one, other) => one.film - other.film);
}

/** The film parameters of a regime. @param {number} from @param {number} to */
function rangeOf(from, to) {
  if (!from) return `λ below ${to}`;
  return Number.isFinite(to) ? `λ from ${from} to ${to}` : `λ above ${from}`;
}

/**
 * The friction torque over the least film parameter, at the speeds of a sweep, with the regimes of lubrication.
 *
 * @param {Sweep} swept
 * @param {Run} answer
 */
export function stribeck(swept, answer) {
  const { screw_speed: speed, axial_load: load } = parts.operationOf(answer);
  const points = pointsOf(swept, speed);
  const least = answer.results.minimum_film_parameter ?? leastFilm(answer);
  if (points.length < 2) {
    hide("stribeck-chart");
    return;
  }
  const now = least > 0 ? least : null;
  const films = points.map(({ film: thickness }) => thickness);
  const low = Math.min(...films, now ?? Number.POSITIVE_INFINITY) / BEYOND;
  const high = Math.max(...films, now ?? 0) * BEYOND;
  /** @type {Zone[]} */
  const zones = REGIMES.filter(([, from, to]) => Math.max(from, low) < Math.min(to, high)).map(
    ([words, from, to, colour]) => ({
      kind: "zone",
      name: `${words}: ${rangeOf(from, to)}`,
      words,
      along: "x",
      from: Math.max(from, low),
      to: Math.min(to, high),
      colour,
    }),
  );
  const torqueNow = answer.results.screw_torque;
  const title = units.heading("screw_torque", "friction torque");
  const regime = (now && REGIMES.find(([, , to]) => now < to)?.[0]) || "";
  const lines = linesByValidity(
    films,
    points.map((one) => one.torque),
    points.map(({ valid }) => valid),
    "friction torque",
    "accent",
  );
  const x = "least film parameter λ";
  draw("stribeck-chart", {
    name: "stribeck_curve",
    caption: `friction torque over the film parameter at ${units.formatted("axial_load", load)}`,
    description: `Friction torque against the least film parameter as the speed varies. At the operating point λ is ${units.digits(now)}, the torque ${units.formatted("screw_torque", torqueNow)}: ${regime}.`,
    figure: {
      x: { title: x, log: true, from: low, to: high },
      y: { title, zero: true },
      marks: [...zones, ...lines, pointAt(now, units.inDisplayUnit("screw_torque", torqueNow))],
    },
    numbers: () => [
      [x, title, units.heading("screw_speed", "speed of the screw"), "valid"],
      points.map((one) => [one.film, one.torque, one.speed, yesOrNo(one.valid)]),
    ],
  });
}
