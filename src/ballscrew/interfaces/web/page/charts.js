// What the charts show: each its traces, its legend and its numbers.

import { element } from "./dom.js";
import { draw, layout } from "./plot.js";
import { data } from "./results.js";
import * as units from "./units.js";

function column(name, values) { return values.map((value) => units.inShownUnit(name, value)); }

function titled(name, words) { return `${words} (${units.spoken(units.shownUnit(name))})`; }

const HERE = "operating point";

/** The operating point: a diamond in front of the curves. */
function point({ ink, panel }, x, y) {
  return { x: [x], y: [y], name: HERE, mode: "markers", marker: { symbol: "diamond", size: 11, color: panel, line: { color: ink, width: 2.5 } }, hovertemplate: "%{y:.4g}" };
}

function diamond({ ink }) { return { kind: "point", name: HERE, colour: ink }; }

const VEIL = "#80808055", OUTSIDE = "outside the model's validity";

/** A veil over the stretches where the model does not hold, each up to halfway to the point where it does. */
function veils(x, valid) {
  const edge = (place) => (place <= 0 ? x[0] : place >= x.length ? x.at(-1) : (x[place - 1] + x[place]) / 2);
  const starts = valid.flatMap((holds, place) => (!holds && (place === 0 || valid[place - 1]) ? [place] : []));
  return starts.map((start) => {
    const end = valid.indexOf(true, start);
    return { type: "rect", yref: "paper", y0: 0, y1: 1, x0: edge(start), x1: edge(end < 0 ? x.length : end), fillcolor: VEIL, line: { width: 0 }, layer: "above" };
  });
}

function veiled(valid) { return valid.flat().every(Boolean) ? [] : [{ kind: "area", name: OUTSIDE, colour: VEIL }]; }

function holds(valid) { return valid.map((one) => (one ? "yes" : "no")); }

/** Torque against speed, its parts stacked, and the operating point. */
export function torque(swept, answer, mechanisms) {
  const speeds = column("screw_speed", swept.axes.screw_speed.values);
  const parts = Object.keys(answer.results.contributions).filter((name) => swept.outputs[`contribution_${name}`]?.values.some((value) => value !== 0));
  const values = Object.fromEntries(parts.map((name) => [name, column("screw_torque", swept.outputs[`contribution_${name}`].values)]));
  const total = column("screw_torque", swept.outputs.screw_torque.values);
  const load = units.shown("axial_load", answer.inputs.operation.axial_load);
  const speed = units.inShownUnit("screw_speed", answer.inputs.operation.screw_speed);
  const { screw_torque: sum, contributions } = answer.results;
  const { values: valid } = swept.outputs.valid;
  const words = (name) => mechanisms[name]?.words ?? name;
  const x = titled("screw_speed", "speed of the screw"), y = titled("screw_torque", "friction torque");
  const share = (name) => element("span", { class: "value" }, data("screw_torque", contributions[name]),
    sum > 0 ? ` · ${units.digits((100 * contributions[name]) / sum, 2)} %` : "");
  return draw("torque-chart", {
    name: "torque_over_speed", caption: `friction torque and its parts at ${load}`,
    description: `Friction torque against speed at ${load}, stacked by mechanism. At the operating point ${units.shown("screw_torque", sum)}.`,
    figure: (colours) => ({
      traces: [...parts.map((name) => ({
        x: speeds, y: values[name], name: words(name), stackgroup: "parts", mode: "lines",
        line: { width: 0.5, color: mechanisms[name]?.colour }, fillcolor: mechanisms[name]?.colour, hovertemplate: "%{y:.4g}",
      })), { x: speeds, y: total, name: "sum", mode: "lines", line: { color: colours.ink, width: 2 }, hovertemplate: "%{y:.4g}" },
      point(colours, speed, units.inShownUnit("screw_torque", sum))],
      layout: layout(colours, x, y, { shapes: veils(speeds, valid) }),
    }),
    legend: (colours) => [{ kind: "line", name: "sum", colour: colours.ink, value: element("span", { class: "value" }, data("screw_torque", sum)) },
      ...parts.toReversed().map((name) => ({ kind: "area", name: words(name), colour: mechanisms[name]?.colour, value: share(name) })), diamond(colours), ...veiled(valid)],
    numbers: () => [[x, y, ...parts.map((name) => titled("screw_torque", words(name))), "valid"],
      speeds.map((at, place) => [at, total[place], ...parts.map((name) => values[name][place]), holds(valid)[place]])],
  });
}

// light enough everywhere for black numbers, also for those who see no red or no green
const SCALE = [[0, "#8296b5"], [0.5, "#c3b98c"], [1, "#ffe945"]];

/** Efficiency over load and speed. */
export function map(swept, answer) {
  const speeds = column("screw_speed", swept.axes.screw_speed.values), loads = column("axial_load", swept.axes.axial_load.values);
  const byLoad = ({ values }) => (Object.keys(swept.axes)[0] === "axial_load" ? values : loads.map((_, i) => speeds.map((_, j) => values[j][i])));
  const grid = byLoad(swept.outputs.efficiency), valid = byLoad(swept.outputs.valid);
  const x = titled("screw_speed", "speed of the screw"), y = titled("axial_load", "axial load");
  const { screw_speed: speed, axial_load: load } = answer.inputs.operation;
  return draw("map-chart", {
    name: "efficiency_map", caption: "efficiency over axial load (down) and speed (across)",
    description: `Efficiency over axial load and speed; at the operating point ${units.digits(answer.results.efficiency)}.`,
    figure: (colours) => ({
      traces: [{
        x: speeds, y: loads, z: grid, type: "contour", colorscale: SCALE, ncontours: 12, name: "efficiency",
        contours: { coloring: "heatmap", showlabels: true, labelfont: { size: 11, color: "#000" } }, line: { width: 0.6, color: "#333" },
        colorbar: { thickness: 12, outlinewidth: 0, tickformat: ".3~g", xpad: 6 },
        hovertemplate: "%{x:.4g}, %{y:.4g}: efficiency %{z:.4f}<extra></extra>", showlegend: false,
      // plotly fills what the constraint shuts out
      }, { x: speeds, y: loads, z: valid.map((row) => row.map((one) => (one ? 0 : 1))), type: "contour", name: OUTSIDE, showlegend: false,
        contours: { type: "constraint", operation: "<", value: 0.5 }, fillcolor: VEIL, line: { width: 0 }, hoverinfo: "skip",
      }, { ...point({ ink: "#000", panel: "#fff" }, units.inShownUnit("screw_speed", speed), units.inShownUnit("axial_load", load)), hoverinfo: "skip", hovertemplate: undefined }],
      layout: layout(colours, x, y, { hovermode: "closest", margin: { l: 72, r: 60, t: 8, b: 42 } }),
    }),
    legend: (colours) => [diamond(colours), ...veiled(valid)],
    numbers: () => [[`${y} \\ ${x}`, ...speeds.map((one) => String(Number(one.toPrecision(6))))], loads.map((one, i) => [one, ...grid[i]])],
  });
}

/** Curves with a line each, and the operating point. */
function curves(x, names, called, of, valid) {
  const style = (colours, place) => ({ colour: place ? colours.second : colours.accent, kind: place ? "dash" : "line" });
  return {
    traces: (colours) => names.map((name, place) => ({
      x, y: of(name), name: called[name], mode: "lines", hovertemplate: "%{y:.4g}",
      line: { width: 2, color: style(colours, place).colour, dash: place ? "dash" : "solid" },
    })),
    legend: (colours) => [...names.map((name, place) => ({ ...style(colours, place), name: called[name] })), diamond(colours), ...veiled(valid)],
    rows: () => x.map((at, place) => [at, ...names.map((name) => of(name)[place]), holds(valid)[place]]),
    veils: veils(x, valid),
  };
}

const FILMS = { screw_film_parameter: "ball and screw", nut_film_parameter: "ball and nut", minimum_film_parameter: "least of all contacts" };
const REGIMES = [["boundary", 0, 1, "#D55E00"], ["mixed", 1, 3, "#E69F00"], ["full film", 3, Infinity, "#009E73"]];

/** The film parameter against speed, with the regimes behind it. */
export function film(swept, answer) {
  const speeds = column("screw_speed", swept.axes.screw_speed.values);
  const names = Object.keys(FILMS).filter((name) => swept.outputs[name]);
  const { results } = answer;
  const now = results.minimum_film_parameter ?? Math.min(results.screw.film_parameter, results.nut.film_parameter);
  const highest = Math.max(1.2, now, ...names.flatMap((name) => swept.outputs[name].values).filter(Number.isFinite)) * 1.08;
  const zones = REGIMES.filter(([, from]) => from < 0.97 * highest).map(([words, from, to, shade]) => ({ words, from, to: Math.min(to, highest), shade }));
  const shapes = zones.map(({ from, to, shade }) => ({ type: "rect", xref: "paper", x0: 0, x1: 1, y0: from, y1: to, fillcolor: shade, opacity: 0.13, line: { width: 0 }, layer: "below" }));
  const annotations = zones.map(({ words, to }) => ({ xref: "paper", x: 0.01, xanchor: "left", y: to, yanchor: "top", text: words, showarrow: false, font: { size: 11 } }));
  const x = titled("screw_speed", "speed of the screw");
  const lines = curves(speeds, names, FILMS, (name) => swept.outputs[name].values, swept.outputs.valid.values);
  return draw("film-chart", {
    name: "film_over_speed", caption: "film parameter over speed", legend: lines.legend,
    description: `Film parameter against speed; ${units.digits(now, 3)} at the operating point.`,
    figure: (colours) => ({
      traces: [...lines.traces(colours), point(colours, units.inShownUnit("screw_speed", answer.inputs.operation.screw_speed), now)],
      layout: layout(colours, x, "film parameter λ", { shapes: [...shapes, ...lines.veils], annotations, yaxis: { range: [0, highest] } }),
    }),
    numbers: () => [[x, ...names.map((name) => `λ, ${FILMS[name]}`), "valid"], lines.rows()],
  });
}

const PRESSURES = { screw_maximum_pressure: "ball and screw", nut_maximum_pressure: "ball and nut", maximum_pressure: "greatest of all balls" };

/** The greatest contact pressure against the load. */
export function pressure(swept, answer) {
  const loads = column("axial_load", swept.axes.axial_load.values);
  const names = Object.keys(PRESSURES).filter((name) => swept.outputs[name]);
  const x = titled("axial_load", "axial load"), y = titled("maximum_pressure", "greatest pressure");
  const { results } = answer;
  const now = results.maximum_pressure ?? Math.max(results.screw.maximum_pressure, results.nut.maximum_pressure);
  const lines = curves(loads, names, PRESSURES, (name) => column("maximum_pressure", swept.outputs[name].values), swept.outputs.valid.values);
  return draw("pressure-chart", {
    name: "pressure_over_load", caption: "greatest contact pressure over axial load", legend: lines.legend,
    description: `Greatest contact pressure against axial load; ${units.shown("maximum_pressure", now)} at the operating point.`,
    figure: (colours) => ({
      traces: [...lines.traces(colours), point(colours, units.inShownUnit("axial_load", answer.inputs.operation.axial_load), units.inShownUnit("maximum_pressure", now))],
      layout: layout(colours, x, y, { shapes: lines.veils }),
    }),
    numbers: () => [[x, ...names.map((name) => titled("maximum_pressure", PRESSURES[name])), "valid"], lines.rows()],
  });
}

/** The parts of the torque of several designs as bars. */
export function designs(answers, mechanisms) {
  const letters = Object.keys(answers);
  const parts = [...new Set(letters.flatMap((letter) => Object.keys(answers[letter].results.contributions)))]
    .filter((name) => letters.some((letter) => answers[letter].results.contributions[name]));
  const of = (letter, name) => units.inShownUnit("screw_torque", answers[letter].results.contributions[name] ?? 0);
  const words = (name) => mechanisms[name]?.words ?? name;
  const x = titled("screw_torque", "friction torque");
  return draw("compare-chart", {
    name: "designs", caption: "friction torque of the designs by mechanism", description: "Friction torque of each design, by mechanism.",
    figure: (colours) => ({
      traces: parts.map((name) => ({ type: "bar", orientation: "h", y: letters, x: letters.map((letter) => of(letter, name)), name: words(name), marker: { color: mechanisms[name]?.colour }, hovertemplate: "%{x:.4g}" })),
      layout: layout(colours, x, "design", { barmode: "stack", hovermode: "closest", margin: { l: 48, r: 26, t: 8, b: 42 },
        xaxis: { rangemode: "tozero" }, yaxis: { autorange: "reversed", type: "category", tickformat: undefined } }),
    }),
    legend: () => parts.map((name) => ({ kind: "area", name: words(name), colour: mechanisms[name]?.colour })),
    numbers: () => [["design", ...parts.map((name) => titled("screw_torque", words(name)))], letters.map((letter) => [letter, ...parts.map((name) => of(letter, name))])],
  });
}
