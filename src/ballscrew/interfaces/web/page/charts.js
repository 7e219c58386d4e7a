// Charts by plotly, each with its numbers as a table and as a file.

import { byId, csv, element, save, table } from "./dom.js";
import * as units from "./units.js";

/** plotly.js is large: the numbers do not wait for it. */
const loaded = new Promise((go) => {
  if (globalThis.Plotly) go();
  else byId("plotly").addEventListener("load", go);
});
const CONFIG = { responsive: true, displaylogo: false, displayModeBar: false };

function colour(name) { return getComputedStyle(document.documentElement).getPropertyValue(name).trim(); }

/** A colour that can be looked through, for areas. */
function layout(titles, more = {}) {
  const ink = colour("--ink"), line = colour("--line");
  const axis = (title, others) => ({ title: { text: title, standoff: 8 }, gridcolor: line, linecolor: line, zerolinecolor: line, automargin: true, ...others });
  return {
    paper_bgcolor: "rgba(0,0,0,0)", plot_bgcolor: "rgba(0,0,0,0)", font: { color: ink, family: "system-ui, sans-serif", size: 12.5 },
    margin: { l: 55, r: 15, t: 12, b: 45 }, hovermode: "x unified", hoverlabel: { bgcolor: colour("--panel"), font: { color: ink } },
    legend: { orientation: "h", y: -0.28, x: 0, yanchor: "top" }, ...more,
    xaxis: axis(titles.x, { ...more.xaxis }), yaxis: axis(titles.y, { rangemode: "tozero", ...more.yaxis }),
  };
}

/** Draw a chart into its place, and put its table and files below it. */
async function draw(id, name, description, traces, shape, caption, headings, rows) {
  await loaded;
  const holder = byId(id);
  holder.hidden = false;
  if (!holder.querySelector(".plot")) {
    const plot = element("div", { class: "plot", role: "img" });
    holder.replaceChildren(plot, element("div", { class: "beside" }));
  }
  const plot = holder.querySelector(".plot");
  plot.setAttribute("aria-label", description);
  const below = holder.querySelector(".beside");
  const open = below.querySelector("details")?.open ?? false;
  const numbers = element("details", { open }, element("summary", {}, "Numbers"));
  const fill = () => { if (numbers.open && !numbers.querySelector("table")) {
    numbers.append(element("div", { class: "scroll", tabindex: "0", role: "region", "aria-label": caption }, table(caption, headings, rows)));
  } };
  numbers.addEventListener("toggle", fill);
  below.replaceChildren(numbers,
    element("button", { type: "button", onclick: () => save(`${name}.csv`, new Blob([csv(headings, rows)], { type: "text/csv" })) }, "CSV"),
    element("button", { type: "button", onclick: () => picture(plot, name) }, "SVG"));
  fill();
  return globalThis.Plotly.react(plot, traces, shape, CONFIG);
}

async function picture(plot, name) {
  const found = await globalThis.Plotly.toImage(plot, { format: "svg", width: 900, height: 500 });
  save(`${name}.svg`, new Blob([decodeURIComponent(found.slice(found.indexOf(",") + 1))], { type: "image/svg+xml" }));
}

function column(name, values) { return values.map((value) => units.inShownUnit(name, value)); }

function pretty(value) { return units.digits(value, 5); }

/** Torque against speed, its parts stacked, and the operating point. */
export function torque(swept, answer, mechanisms) {
  const speeds = column("screw_speed", swept.axes.screw_speed.values);
  const parts = Object.keys(answer.results.contributions).filter((name) => swept.outputs[`contribution_${name}`]?.values.some((value) => value !== 0));
  const values = Object.fromEntries(parts.map((name) => [name, column("screw_torque", swept.outputs[`contribution_${name}`].values)]));
  const total = column("screw_torque", swept.outputs.screw_torque.values);
  const load = units.shown("axial_load", answer.inputs.operation.axial_load);
  const traces = parts.map((name) => ({
    x: speeds, y: values[name], name: mechanisms[name]?.words ?? name, stackgroup: "parts", mode: "lines",
    line: { width: 0.5, color: mechanisms[name]?.colour }, fillcolor: mechanisms[name]?.colour, hovertemplate: "%{y:.4g}",
  }));
  traces.push({ x: speeds, y: total, name: "sum", mode: "lines", line: { color: colour("--ink"), width: 2 }, hovertemplate: "%{y:.4g}" });
  traces.push(point([units.inShownUnit("screw_speed", answer.inputs.operation.screw_speed)], [units.inShownUnit("screw_torque", answer.results.screw_torque)]));
  const x = units.heading("screw_speed", "speed of the screw"), y = units.heading("screw_torque", "friction torque");
  return draw("torque-chart", "torque_over_speed",
    `Friction torque against speed at ${load}, stacked by mechanism. At the operating point ${units.shown("screw_torque", answer.results.screw_torque)}.`,
    traces, layout({ x, y }), `friction torque and its parts at ${load}`,
    [x, y, ...parts.map((name) => `${mechanisms[name]?.words ?? name} (${units.spoken(units.shownUnit("screw_torque"))})`)],
    speeds.map((speed, place) => [pretty(speed), pretty(total[place]), ...parts.map((name) => pretty(values[name][place]))]));
}

function point(x, y) {
  return { x, y, name: "operating point", mode: "markers", marker: { symbol: "diamond", size: 11, color: colour("--panel"), line: { color: colour("--ink"), width: 2.5 } }, hovertemplate: "%{y:.4g}" };
}

/** Efficiency over load and speed. */
export function map(swept, answer) {
  const speeds = column("screw_speed", swept.axes.screw_speed.values), loads = column("axial_load", swept.axes.axial_load.values);
  const names = Object.keys(swept.axes);
  const grid = names[0] === "axial_load" ? swept.outputs.efficiency.values
    : loads.map((_, i) => speeds.map((_, j) => swept.outputs.efficiency.values[j][i]));
  const x = units.heading("screw_speed", "speed of the screw"), y = units.heading("axial_load", "axial load");
  const here = answer.inputs.operation;
  const traces = [{
    x: speeds, y: loads, z: grid, type: "contour", colorscale: "Cividis", ncontours: 14, contours: { coloring: "heatmap", showlabels: true, labelfont: { size: 11, color: "#fff" } },
    line: { width: 0.6, color: "#fff" }, colorbar: { title: { text: "efficiency", side: "right" }, thickness: 12 },
    hovertemplate: `%{x:.4g}, %{y:.4g}: efficiency %{z:.4f}<extra></extra>`, name: "efficiency",
  }, { ...point([units.inShownUnit("screw_speed", here.screw_speed)], [units.inShownUnit("axial_load", here.axial_load)]), showlegend: false }];
  return draw("map-chart", "efficiency_map", `Efficiency over axial load and speed; at the operating point ${units.digits(answer.results.efficiency)}.`,
    traces, layout({ x, y }, { hovermode: "closest" }), "efficiency over axial load (down) and speed (across)",
    [`${y} \\ ${x}`, ...speeds.map(pretty)], loads.map((load, i) => [pretty(load), ...grid[i].map(pretty)]));
}

const FILMS = { screw_film_parameter: "ball and screw", nut_film_parameter: "ball and nut", minimum_film_parameter: "least of all contacts" };

/** The film parameter against speed, with the regimes behind it. */
export function film(swept, answer) {
  const speeds = column("screw_speed", swept.axes.screw_speed.values);
  const names = Object.keys(FILMS).filter((name) => swept.outputs[name]);
  const finite = names.flatMap((name) => swept.outputs[name].values).filter(Number.isFinite);
  const highest = Math.max(1.2, ...finite) * 1.08;
  const zones = [["boundary", 0, 1, "#D55E00"], ["mixed", 1, 3, "#E69F00"], ["full film", 3, 1e9, "#009E73"]].filter(([, from]) => from < highest);
  const shapes = zones.map(([, from, to, shade]) => ({ type: "rect", xref: "paper", x0: 0, x1: 1, y0: from, y1: Math.min(to, highest), fillcolor: shade, opacity: 0.13, line: { width: 0 }, layer: "below" }));
  const annotations = zones.map(([words, from, to]) => ({ xref: "paper", x: 0.99, xanchor: "right", y: (from + Math.min(to, highest)) / 2, text: words, showarrow: false, font: { size: 11 } }));
  const x = units.heading("screw_speed", "speed of the screw");
  const traces = names.map((name, place) => ({ x: speeds, y: swept.outputs[name].values, name: FILMS[name], mode: "lines", line: { width: 2, color: colour(place ? "--second" : "--accent"), dash: place ? "dash" : "solid" }, hovertemplate: "%{y:.3g}" }));
  const now = answer.results.minimum_film_parameter ?? Math.min(answer.results.screw.film_parameter, answer.results.nut.film_parameter);
  traces.push(point([units.inShownUnit("screw_speed", answer.inputs.operation.screw_speed)], [now]));
  return draw("film-chart", "film_over_speed", `Film parameter against speed; ${units.digits(now, 3)} at the operating point.`, traces,
    layout({ x, y: "film parameter λ" }, { shapes, annotations, yaxis: { range: [0, highest] } }), "film parameter over speed",
    [x, ...names.map((name) => `λ, ${FILMS[name]}`)], speeds.map((speed, place) => [pretty(speed), ...names.map((name) => pretty(swept.outputs[name].values[place]))]));
}

const PRESSURES = { screw_maximum_pressure: "ball and screw", nut_maximum_pressure: "ball and nut", maximum_pressure: "greatest of all balls" };

/** The greatest contact pressure against the load. */
export function pressure(swept, answer) {
  const loads = column("axial_load", swept.axes.axial_load.values);
  const names = Object.keys(PRESSURES).filter((name) => swept.outputs[name]);
  const x = units.heading("axial_load", "axial load"), y = units.heading("maximum_pressure", "greatest pressure");
  const traces = names.map((name, place) => ({ x: loads, y: column("maximum_pressure", swept.outputs[name].values), name: PRESSURES[name], mode: "lines", line: { width: 2, color: colour(place ? "--second" : "--accent"), dash: place ? "dash" : "solid" }, hovertemplate: "%{y:.4g}" }));
  const now = answer.results.maximum_pressure ?? Math.max(answer.results.screw.maximum_pressure, answer.results.nut.maximum_pressure);
  traces.push(point([units.inShownUnit("axial_load", answer.inputs.operation.axial_load)], [units.inShownUnit("maximum_pressure", now)]));
  return draw("pressure-chart", "pressure_over_load", `Greatest contact pressure against axial load; ${units.shown("maximum_pressure", now)} at the operating point.`, traces,
    layout({ x, y }), "greatest contact pressure over axial load", [x, ...names.map((name) => `${PRESSURES[name]} (${units.spoken(units.shownUnit("maximum_pressure"))})`)],
    loads.map((load, place) => [pretty(load), ...traces.slice(0, names.length).map((trace) => pretty(trace.y[place]))]));
}

/** The parts of the torque of several designs as bars. */
export function designs(answers, mechanisms) {
  const letters = Object.keys(answers);
  const parts = [...new Set(letters.flatMap((letter) => Object.keys(answers[letter].results.contributions)))]
    .filter((name) => letters.some((letter) => answers[letter].results.contributions[name]));
  const of = (letter, name) => units.inShownUnit("screw_torque", answers[letter].results.contributions[name] ?? 0);
  const traces = parts.map((name) => ({ type: "bar", orientation: "h", y: letters, x: letters.map((letter) => of(letter, name)), name: mechanisms[name]?.words ?? name, marker: { color: mechanisms[name]?.colour }, hovertemplate: "%{x:.4g}" }));
  const x = units.heading("screw_torque", "friction torque");
  return draw("compare-chart", "designs", "Friction torque of each design, by mechanism.", traces,
    layout({ x, y: "design" }, { barmode: "stack", hovermode: "closest", yaxis: { autorange: "reversed", type: "category" } }), "friction torque of the designs by mechanism",
    ["design", ...parts.map((name) => `${mechanisms[name]?.words ?? name} (${units.spoken(units.shownUnit("screw_torque"))})`)],
    letters.map((letter) => [letter, ...parts.map((name) => pretty(of(letter, name)))]));
}
