// Charts of the torque and its parts, of the efficiency, and of several designs.

import * as parts from "./chart_parts.js";
import { element } from "./dom.js";
import { draw, layout } from "./plot.js";
import { data } from "./results.js";
import { text } from "./texts.js";
import * as units from "./units.js";

// light enough everywhere for black numbers, also for people who do not see red or green
const SCALE = [
  [0, "#8296b5"],
  [0.5, "#c3b98c"],
  [1, "#ffe945"],
];

/**
 * A mechanism in words.
 *
 * @param {string} name
 * @param {Mechanisms} mechanisms
 */
export function wordsOf(name, mechanisms) {
  return mechanisms[name]?.words ?? name;
}

/** How dark the area of a band is, as two digits of a colour. */
const SHADE = "24";
/** The same of intervals in each other, from the widest on: so dark are as many areas over each other. */
const DEPTHS = [SHADE, "43", "5d"];

/**
 * The band of the torque over the speed, as intervals in each other: its traces, its entry in the legend, and its ends at a place of the curve.
 *
 * @param {Sweep | string | undefined} banded or why there is none
 */
function bandOf(banded) {
  const none = { count: 0, traces: () => [], entries: () => [], headings: [], cells: () => [] };
  if (!banded) return none;
  if (typeof banded === "string") {
    const name = text("chart.no_band", { reason: banded });
    return { ...none, entries: () => [{ kind: "none", name, colour: undefined }] };
  }
  const speeds = parts.valuesOf(banded.axes.screw_speed);
  const shown = parts.converted("screw_speed", banded.axes.screw_speed);
  const { low, high, inner = [] } = banded.outputs.screw_torque;
  /** @param {number | undefined} level */
  const share = (level) => units.digits(100 * (level ?? 0));
  /** From the widest on: each is drawn over those around it, and so is darker. */
  const intervals = [
    { level: banded.band?.level, low, high, names: [text("chart.low"), text("chart.high")] },
    ...(inner ?? []).toReversed().map((one) => ({
      ...one,
      names: [text("chart.low_of", { share: share(one.level) }), text("chart.high_of", { share: share(one.level) })],
    })),
  ].map(({ level, names, ...ends }) => ({
    names,
    words: text("chart.band", { share: share(level) }),
    ends: [ends.low, ends.high].map((values) => parts.converted("screw_torque", { values: values ?? [] })),
  }));
  return {
    count: 2 * intervals.length,
    /** @param {import("./plot.js").Colours} colours */
    traces: ({ ink }) =>
      intervals.flatMap(({ names, ends }, place) =>
        ends.map((y, end) => ({
          x: shown,
          y,
          name: names[end],
          mode: "lines",
          line: place ? { color: `${ink}${SHADE}`, width: 0.6 } : { color: ink, width: 1.2, dash: "dot" },
          hovertemplate: "%{y:.4g}",
          ...(end && { fill: "tonexty", fillcolor: `${ink}${SHADE}` }),
        })),
      ),
    /** @param {import("./plot.js").Colours} colours */
    entries: ({ ink }) =>
      intervals.map(({ words }, place) => ({
        kind: intervals.length > 1 ? "area" : "dot",
        name: words,
        colour: intervals.length > 1 ? `${ink}${DEPTHS[place] ?? SHADE}` : ink,
      })),
    headings: intervals.flatMap(({ names }) => names.map((one) => parts.titled("screw_torque", one))),
    /** @param {number} speed in SI */
    cells: (speed) => {
      const place = speeds.indexOf(speed);
      return intervals.flatMap(({ ends }) => ends.map((values) => (place < 0 ? "" : values[place])));
    },
  };
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
  const band = bandOf(banded);
  const speeds = parts.converted("screw_speed", swept.axes.screw_speed);
  const { screw_torque: sum, contributions } = answer.results;
  const names = Object.keys(contributions).filter((name) =>
    swept.outputs[`contribution_${name}`]?.values.some((value) => value !== 0),
  );
  const byName = Object.fromEntries(
    names.map((name) => [name, parts.converted("screw_torque", swept.outputs[`contribution_${name}`])]),
  );
  const total = parts.converted("screw_torque", swept.outputs.screw_torque);
  const operation = parts.operationOf(answer);
  const load = units.formatted("axial_load", operation.axial_load);
  const speed = units.inDisplayUnit("screw_speed", operation.screw_speed);
  const valid = parts.validAlong(swept);
  /** @param {string} name */
  const words = (name) => wordsOf(name, mechanisms);
  const x = parts.titled("screw_speed", text("chart.speed"));
  const y = parts.titled("screw_torque", text("chart.torque"));
  /** @param {string} name */
  const share = (name) => {
    const part = contributions[name];
    const percent = sum && sum > 0 && part !== null ? ` · ${units.digits((100 * part) / sum, 2)} %` : "";
    return element("span", { class: "value" }, data("screw_torque", part), percent);
  };
  const totalText = units.formatted("screw_torque", sum);
  /** The sum of the nearest speed of the curve. @param {number} at */
  const nearest = (at) => {
    const [[place]] = speeds.map((one, i) => [i, Math.abs(one - at)]).sort(([, a], [, b]) => a - b);
    return total[place];
  };
  const others = names.length + band.count;
  return draw("torque-chart", {
    name: "torque_over_speed",
    drag: { x: "screw_speed", trace: others + 1, place: (at) => [at, nearest(at)] },
    caption: text("speed.caption", { load }),
    description: text("speed.description", { load, total: totalText }),
    figure: (colours) => ({
      traces: [
        ...names.map((name) => ({
          x: speeds,
          y: byName[name],
          name: words(name),
          stackgroup: "parts",
          mode: "lines",
          line: { width: 0.5, color: mechanisms[name]?.colour },
          fillcolor: mechanisms[name]?.colour,
          hovertemplate: "%{y:.4g}",
        })),
        ...band.traces(colours),
        {
          x: speeds,
          y: total,
          name: text("chart.sum"),
          mode: "lines",
          line: { color: colours.ink, width: 2 },
          hovertemplate: "%{y:.4g}",
        },
        parts.pointAt(colours, speed, units.inDisplayUnit("screw_torque", sum)),
      ],
      layout: layout(colours, x, y, { shapes: parts.invalidRanges(speeds, valid) }),
    }),
    legend: (colours) => [
      {
        kind: "line",
        name: text("chart.sum"),
        colour: colours.ink,
        value: element("span", { class: "value" }, data("screw_torque", sum)),
      },
      ...names.toReversed().map((name) => ({
        kind: "area",
        name: words(name),
        colour: mechanisms[name]?.colour,
        value: share(name),
      })),
      ...band.entries(colours),
      parts.pointEntry(colours),
      ...parts.invalidEntries(valid),
    ],
    numbers: () => [
      [x, y, ...band.headings, ...names.map((name) => parts.titled("screw_torque", words(name))), text("chart.valid")],
      speeds.map((at, place) => [
        at,
        total[place],
        ...band.cells(parts.valuesOf(swept.axes.screw_speed)[place]),
        ...names.map((name) => byName[name][place]),
        parts.yesOrNo(valid[place]),
      ]),
    ],
  });
}

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
  const byLoad = (values) => (loadIsFirst ? values : loads.map((_, i) => speeds.map((_, j) => values[j][i])));
  const [driving, driven] = ["efficiency", "back_driving_efficiency"].map((name) =>
    byLoad(/** @type {(number | null)[][]} */ (swept.outputs[name].values)),
  );
  // where load and speed have not the same sign, the load drives the screw
  const isDriven = loads.some((load) => speeds.some((speed) => load * speed < 0));
  const grid = driving.map((row, i) => row.map((value, j) => (loads[i] * speeds[j] < 0 ? driven[i][j] : value)));
  const valid = byLoad(/** @type {boolean[][]} */ (swept.outputs.valid.values));
  const x = parts.titled("screw_speed", text("chart.speed"));
  const y = parts.titled("axial_load", text("chart.load"));
  const operation = parts.operationOf(answer);
  const point = parts.pointAt(
    { ink: "#000", panel: "#fff" },
    units.inDisplayUnit("screw_speed", operation.screw_speed),
    units.inDisplayUnit("axial_load", operation.axial_load),
  );
  const efficiency = units.digits(answer.results.efficiency ?? answer.results.back_driving_efficiency);
  return draw("map-chart", {
    name: "efficiency_map",
    drag: { x: "screw_speed", y: "axial_load", trace: 2, place: (at, load) => [at, load] },
    caption: text("map.caption"),
    description: text("map.description", { efficiency }),
    figure: (colours) => ({
      traces: [
        {
          x: speeds,
          y: loads,
          z: grid,
          type: "contour",
          colorscale: SCALE,
          ncontours: 12,
          name: text("chart.efficiency"),
          contours: { coloring: "heatmap", showlabels: true, labelfont: { size: 11, color: "#000" } },
          line: { width: 0.6, color: "#333" },
          colorbar: { thickness: 12, outlinewidth: 0, tickformat: ".3~g", xpad: 6 },
          hovertemplate: `%{x:.4g}, %{y:.4g}: ${text("chart.efficiency")} %{z:.4f}<extra></extra>`,
          showlegend: false,
        },
        {
          x: speeds,
          y: loads,
          z: valid.map((row) => row.map((holds) => (holds ? 0 : 1))),
          type: "contour",
          name: parts.OUTSIDE,
          showlegend: false,
          // plotly fills what the constraint excludes
          contours: { type: "constraint", operation: "<", value: 0.5 },
          fillcolor: parts.INVALID,
          line: { width: 0 },
          hoverinfo: "skip",
        },
        { ...point, hoverinfo: "skip", hovertemplate: undefined },
      ],
      layout: layout(colours, x, y, { hovermode: "closest", margin: { l: 72, r: 60, t: 8, b: 42 } }),
    }),
    legend: (colours) => [
      parts.pointEntry(colours),
      ...parts.invalidEntries(valid.flat()),
      ...(isDriven ? [{ kind: "none", name: text("map.driven"), colour: undefined }] : []),
    ],
    numbers: () => [
      [`${y} \\ ${x}`, ...speeds.map((one) => String(Number(one.toPrecision(6))))],
      loads.map((one, i) => [one, ...grid[i]]),
    ],
  });
}

/**
 * Parts of the torque of several designs as bars.
 *
 * @param {Record<string, Run>} answers
 * @param {Mechanisms} mechanisms
 */
export function designs(answers, mechanisms) {
  const letters = Object.keys(answers);
  /**
   * @param {string} letter
   * @param {string} name
   */
  const part = (letter, name) => answers[letter].results.contributions[name] ?? 0;
  const names = [...new Set(letters.flatMap((letter) => Object.keys(answers[letter].results.contributions)))].filter(
    (name) => letters.some((letter) => part(letter, name)),
  );
  /**
   * @param {string} letter
   * @param {string} name
   */
  const shown = (letter, name) => units.inDisplayUnit("screw_torque", part(letter, name));
  /** @param {string} name */
  const words = (name) => wordsOf(name, mechanisms);
  const x = parts.titled("screw_torque", text("chart.torque"));
  return draw("compare-chart", {
    name: "designs",
    caption: text("compare.chart"),
    description: text("compare.description"),
    figure: (colours) => ({
      traces: names.map((name) => ({
        type: "bar",
        orientation: "h",
        y: letters,
        x: letters.map((letter) => shown(letter, name)),
        name: words(name),
        marker: { color: mechanisms[name]?.colour },
        hovertemplate: "%{x:.4g}",
      })),
      layout: layout(colours, x, text("chart.design"), {
        barmode: "stack",
        hovermode: "closest",
        margin: { l: 48, r: 26, t: 8, b: 42 },
        xaxis: { rangemode: "tozero" },
        yaxis: { autorange: "reversed", type: "category", tickformat: undefined, nticks: undefined, dtick: 1 },
      }),
    }),
    legend: () => names.map((name) => ({ kind: "area", name: words(name), colour: mechanisms[name]?.colour })),
    numbers: () => [
      [text("chart.design"), ...names.map((name) => parts.titled("screw_torque", words(name)))],
      letters.map((letter) => [letter, ...names.map((name) => shown(letter, name))]),
    ],
  });
}
