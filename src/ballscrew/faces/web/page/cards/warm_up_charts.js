// Charts of warming up: temperatures, the axis as a picture, growth, preload and torque over hours.

import { draw, hide, layout } from "../plot.js";
import { text, textOr } from "../texts.js";
import { FORCE, GROWTH, HOURS, POSITION, TEMPERATURE, TORQUE } from "./quantities.js";

/** @typedef {WarmUpAnswer["results"]} Results */
/** @typedef {WarmUpAnswer["band"]} Bands */
/** @typedef {typeof TEMPERATURE} Quantity */
/** @typedef {{ name: string, values: readonly (number | null)[], colour: string, dash?: string, end?: number | null, band?: Ends }} Line */
/** @typedef {{ time: number[], low: (number | null)[], high: (number | null)[] }} Ends */

/** The places of the charts, and the panes in which they are. @type {Record<string, string>} */
export const PLACES = {
  "warm-temperature-chart": "heat.temperatures",
  "warm-picture-chart": "heat.temperatures",
  "warm-axis-chart": "heat.temperatures",
  "warm-growth-chart": "heat.growth",
  "warm-preload-chart": "heat.growth",
  "warm-torque-chart": "heat.growth",
};
/** Colours of Okabe and Ito, as the command draws with. */
const [BLUE, ORANGE, GREEN, RED, PURPLE, GREY] = ["#0072B2", "#E69F00", "#009E73", "#D55E00", "#CC79A7", "#8a8a8a"];
/** Elements of the axis by their series, and their colours. @type {[string, string, string?][]} */
const ELEMENTS = [
  ["nut_temperature", RED],
  ["oil_temperature", ORANGE, "dot"],
  ["shaft_temperature", BLUE],
  ["first_bearing_temperature", GREY],
  ["last_bearing_temperature", GREY, "dash"],
];
const SHADE = 0.2;

/** The meaning of a series. @param {string} name @param {Vocabulary} vocabulary */
export function meaning(name, { of_warm_up: known }) {
  return known[name]?.meaning ?? name;
}

/**
 * @param {Results} results
 * @param {Bands | undefined} band
 * @param {Vocabulary} vocabulary
 * @param {number} place of the instant that the picture of the axis shows
 */
export function show(results, band, vocabulary, place) {
  temperatures(results, band, vocabulary);
  picture(results);
  axis(results, place);
  growth(results, band, vocabulary);
  const held = results.preload.some((value) => value !== null && value !== 0);
  if (held) over("warm-preload-chart", "preload", FORCE, PURPLE, results, band, vocabulary);
  else hide("warm-preload-chart");
  over("warm-torque-chart", "screw_torque", TORQUE, RED, results, band, vocabulary);
}

/**
 * The ends of a band; none where there is no band of this series.
 *
 * @param {Bands | undefined} band
 * @param {string} name
 * @returns {Ends | undefined}
 */
function endsOf(band, name) {
  const found = /** @type {Record<string, any> | undefined} */ (band)?.[name];
  return band && found ? { time: band.time, low: found.low, high: found.high } : undefined;
}

/**
 * Lines over the hours, each with its band and its steady state.
 *
 * @param {string} id
 * @param {string} name
 * @param {string} caption
 * @param {Results} results
 * @param {Quantity} quantity
 * @param {Line[]} lines
 * @param {string} title of the axis
 */
function drawLines(id, name, caption, results, quantity, lines, title = caption) {
  const hours = HOURS.all(results.time);
  const x = HOURS.titled(text("warm_up.time"));
  const y = quantity.titled(title);
  const [first, last] = [hours[0], hours.at(-1) ?? null];
  const banded = lines.some((one) => one.band);
  const steady = lines.some((one) => typeof one.end === "number");
  draw(id, {
    name,
    caption,
    description: text("warm_up.description", { name: caption, hours: HOURS.text(results.time.at(-1)) }),
    figure: (colours) => ({
      traces: lines.flatMap(({ name: words, values, colour, dash, end, band }) => [
        ...(band ? shaded(band, quantity, colour) : []),
        ...(typeof end === "number"
          ? [
              {
                x: [first, last],
                y: [end, end].map(quantity.convert),
                name: text("warm_up.steady"),
                mode: "lines",
                showlegend: false,
                line: { color: colour, width: 1, dash: "dash" },
                hoverinfo: "skip",
              },
            ]
          : []),
        {
          x: hours,
          y: quantity.all(values),
          name: words,
          mode: "lines",
          line: { color: colour, width: 2, dash },
          hovertemplate: "%{y:.4g}",
        },
      ]),
      layout: layout(colours, x, y, { yaxis: { rangemode: "normal" } }),
    }),
    legend: (colours) => [
      ...lines.map(({ name: words, colour, dash }) => ({ kind: dash ? "dash" : "line", name: words, colour })),
      ...(steady ? [{ kind: "dash", name: text("warm_up.steady"), colour: colours.ink }] : []),
      ...(banded
        ? [{ kind: "area", name: text("warm_up.band"), colour: `${lines.find((one) => one.band)?.colour ?? ""}33` }]
        : []),
    ],
    numbers: () => [
      [x, ...lines.map(({ name: words }) => quantity.titled(words))],
      hours.map((at, place) => [at, ...lines.map(({ values }) => quantity.convert(values[place]))]),
    ],
  });
}

/**
 * The area of a band.
 *
 * @param {Ends} band
 * @param {Quantity} quantity
 * @param {string} colour
 */
function shaded({ time, low, high }, quantity, colour) {
  const x = HOURS.all(time);
  const line = { width: 0, color: colour };
  const alpha = Math.round(255 * SHADE).toString(16);
  const common = { x, mode: "lines", line, hoverinfo: "skip", showlegend: false };
  return [
    { ...common, y: quantity.all(low) },
    { ...common, y: quantity.all(high), fill: "tonexty", fillcolor: `${colour}${alpha}` },
  ];
}

/**
 * @param {Results} results
 * @param {Bands | undefined} band
 * @param {Vocabulary} vocabulary
 */
function temperatures(results, band, vocabulary) {
  const found = /** @type {Record<string, any>} */ (results);
  const end = /** @type {Record<string, any>} */ (results.equilibrium);
  const lines = ELEMENTS.map(([name, colour, dash]) => ({
    name: meaning(name, vocabulary),
    values: found[name],
    colour,
    dash,
    end: dash ? undefined : end[name],
    band: endsOf(band, name),
  }));
  drawLines("warm-temperature-chart", "temperatures", text("warm_up.temperatures"), results, TEMPERATURE, lines);
}

/** The temperature of the shaft over place and time. @param {Results} results */
function picture(results) {
  const shaft = /** @type {{ place: number[], temperature: (number | null)[][] }} */ (results.shaft);
  const { place: stroke } = /** @type {{ place: number[] }} */ (results.drift);
  const hours = HOURS.all(results.time);
  const places = POSITION.all(shaft.place);
  const rows = shaft.temperature.map(TEMPERATURE.all);
  const grid = places.map((_, place) => rows.map((row) => row[place]));
  const x = HOURS.titled(text("warm_up.time"));
  const y = POSITION.titled(text("warm_up.place"));
  const z = TEMPERATURE.titled(text("warm_up.shaft"));
  const ends = [hours[0], hours.at(-1) ?? null];
  draw("warm-picture-chart", {
    name: "temperature_of_the_shaft",
    caption: text("warm_up.picture"),
    description: text("warm_up.picture_description"),
    figure: (colours) => ({
      traces: [
        {
          x: hours,
          y: places,
          z: grid,
          type: "heatmap",
          zsmooth: "best",
          colorscale: "Cividis",
          name: z,
          showlegend: false,
          colorbar: { thickness: 12, outlinewidth: 0, tickformat: ".3~g", xpad: 6, title: { text: z, side: "right" } },
          hovertemplate: "%{x:.3g}, %{y:.4g}: %{z:.4g}<extra></extra>",
        },
        ...[stroke[0], stroke.at(-1)].map((one) => ({
          x: ends,
          y: [one, one].map(POSITION.convert),
          mode: "lines",
          line: { color: "#ffffff", width: 1.5, dash: "dot" },
          name: text("warm_up.stroke"),
          showlegend: false,
          hoverinfo: "skip",
        })),
      ],
      layout: layout(colours, x, y, { hovermode: "closest", margin: { l: 72, r: 92, t: 8, b: 42 } }),
    }),
    legend: (colours) => [{ kind: "dash", name: text("warm_up.stroke_ends"), colour: colours.ink }],
    numbers: () => [
      [y, ...hours.map((at) => `${HOURS.text(results.time[hours.indexOf(at)])}`)],
      places.map((at, place) => [at, ...grid[place]]),
    ],
  });
}

/**
 * The axis at one instant: the shaft over its length, the nut over its stroke, the bearings at the ends.
 *
 * @param {Results} results
 * @param {number} instant
 */
export function axis(results, instant) {
  const shaft = /** @type {{ place: number[], temperature: (number | null)[][] }} */ (results.shaft);
  const { place: stroke } = /** @type {{ place: number[] }} */ (results.drift);
  const found = /** @type {Record<string, any>} */ (results);
  const length = Number(results.network.shaft_length);
  const at = Math.min(instant, results.time.length - 1);
  const places = POSITION.all(shaft.place);
  const values = TEMPERATURE.all(shaft.temperature[at]);
  const nut = TEMPERATURE.convert(found.nut_temperature[at]);
  const bearings = TEMPERATURE.all([found.first_bearing_temperature[at], found.last_bearing_temperature[at]]);
  const all = [
    ...shaft.temperature.flat(),
    ...found.nut_temperature,
    ...found.first_bearing_temperature,
    ...found.last_bearing_temperature,
  ].filter((one) => typeof one === "number");
  const range = TEMPERATURE.all([Math.min(...all) - 1, Math.max(...all) + 1]);
  const names = { shaft: text("warm_up.shaft"), nut: text("warm_up.nut"), bearings: text("warm_up.bearings") };
  const x = POSITION.titled(text("warm_up.place"));
  const y = TEMPERATURE.titled(text("warm_up.temperature"));
  const time = HOURS.text(results.time[at]);
  draw("warm-axis-chart", {
    name: "temperature_of_the_axis",
    caption: text("warm_up.axis", { time }),
    description: text("warm_up.axis_description", { time, nut: TEMPERATURE.text(found.nut_temperature[at]) }),
    figure: (colours) => ({
      traces: [
        {
          x: places,
          y: values,
          name: names.shaft,
          mode: "lines",
          line: { color: BLUE, width: 3 },
          hovertemplate: "%{y:.4g}",
        },
        {
          x: POSITION.all([stroke[0], stroke.at(-1) ?? null]),
          y: [nut, nut],
          name: names.nut,
          mode: "lines",
          line: { color: RED, width: 7 },
          hovertemplate: "%{y:.4g}",
        },
        {
          x: POSITION.all([0, length]),
          y: bearings,
          name: names.bearings,
          mode: "markers",
          marker: { symbol: "square", size: 13, color: colours.ink },
          hovertemplate: "%{y:.4g}",
        },
      ],
      layout: layout(colours, x, y, { hovermode: "closest", yaxis: { range, rangemode: "normal" } }),
    }),
    legend: (colours) => [
      { kind: "line", name: names.shaft, colour: BLUE },
      { kind: "area", name: names.nut, colour: RED },
      { kind: "area", name: names.bearings, colour: colours.ink },
    ],
    numbers: () => [[x, y], places.map((one, place) => [one, values[place]])],
  });
}

/**
 * Growth at the ends and the middle of the stroke: what a machine without a scale is wrong by.
 *
 * @param {Results} results
 * @param {Bands | undefined} band
 * @param {Vocabulary} vocabulary
 */
function growth(results, band, vocabulary) {
  const { place, growth: rows } = /** @type {{ place: number[], growth: (number | null)[][] }} */ (results.drift);
  const colours = [GREEN, ORANGE, PURPLE];
  const lines = place.map((at, column) => ({
    name: text("warm_up.growth_at", { place: POSITION.text(at) }),
    values: rows.map((row) => row[column]),
    colour: colours[column],
  }));
  const whole = {
    name: meaning("shaft_growth", vocabulary),
    values: results.shaft_growth,
    colour: GREY,
    dash: "dot",
    end: results.equilibrium.growth,
    band: endsOf(band, "shaft_growth"),
  };
  drawLines("warm-growth-chart", "growth", text("warm_up.growth"), results, GROWTH, [...lines, whole]);
}

/**
 * One series with its band and its steady state.
 *
 * @param {string} id
 * @param {"preload" | "screw_torque"} name
 * @param {Quantity} quantity
 * @param {string} colour
 * @param {Results} results
 * @param {Bands | undefined} band
 * @param {Vocabulary} vocabulary
 */
function over(id, name, quantity, colour, results, band, vocabulary) {
  const words = meaning(name, vocabulary);
  const line = { name: words, values: results[name], colour, end: results.equilibrium[name], band: endsOf(band, name) };
  const full = results.full_bath;
  const inBath =
    full && full.time.length === results.time.length
      ? [{ name: text("bath.line"), values: full[name], colour: BLUE, end: full.equilibrium[name] }]
      : [];
  drawLines(id, name, words, results, quantity, [line, ...inBath], textOr(`warm_up.axis_of.${name}`, words));
}
