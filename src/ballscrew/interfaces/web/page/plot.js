// A chart in its place: the plot, its legend, its numbers as a table, and both as files.

import { byId, csv, element, save, table } from "./dom.js";

/** plotly.js is large: the numbers do not wait for it. */
const loaded = new Promise((go) => {
  if (globalThis.Plotly) go();
  else byId("plotly").addEventListener("load", go);
});
const CONFIG = { responsive: true, displaylogo: false, displayModeBar: false };
const FONT = "system-ui, \"DejaVu Sans\", sans-serif";
const WIDTH_OF_PAPER = 660;
/** What is printed or saved is light, whatever the screen is. */
const PAPER = { ink: "#1c2127", line: "#d5dade", panel: "#ffffff", accent: "#0062a0", second: "#a34a00" };

const drawn = new Map(); // the charts on the page, by their place
const seen = new Set(), waiting = new Set(); // places on the screen or near it; charts that wait to come there
let onScreen; // the colours of the page

// what nobody sees is drawn when it comes into sight: a key pressed costs half as much
const sight = new IntersectionObserver((entries) => {
  for (const { target: { id }, isIntersecting } of entries) {
    seen[isIntersecting ? "add" : "delete"](id);
    if (isIntersecting && waiting.delete(id)) show(id, colours());
  }
}, { rootMargin: "250px" });
for (const place of document.querySelectorAll(".chart")) sight.observe(place);

function colours() {
  if (!onScreen) {
    const style = getComputedStyle(document.documentElement);
    onScreen = Object.fromEntries(Object.keys(PAPER).map((name) => [name, style.getPropertyValue(`--${name}`).trim()]));
  }
  return onScreen;
}

/** What all charts share. Margins are fixed and the legend is ours: measuring them takes plotly half of its time. */
export function layout({ ink, line, panel }, x, y, more = {}) {
  const axis = (title, others) => ({ title: { text: title, standoff: 6 }, gridcolor: line, linecolor: line, zerolinecolor: line,
    tickformat: ".6~g", hoverformat: ".4~g", ticklabeloverflow: "allow", nticks: 7, ...others });
  return {
    paper_bgcolor: "rgba(0,0,0,0)", plot_bgcolor: "rgba(0,0,0,0)", font: { color: ink, family: FONT, size: 12.5 },
    margin: { l: 72, r: 26, t: 8, b: 42 }, showlegend: false, hovermode: "x unified",
    hoverlabel: { bgcolor: panel, bordercolor: line, font: { color: ink } }, ...more,
    xaxis: axis(x, more.xaxis), yaxis: axis(y, { rangemode: "tozero", ...more.yaxis }),
  };
}

/**
 * Draw a chart. It has a ``name`` for its files, a ``description``, a ``caption`` of its numbers, and, made when they
 * are needed: ``figure(colours)``, its traces and layout; ``legend(colours)``; ``numbers()``, headings and rows.
 */
export async function draw(id, chart) {
  await loaded;
  drawn.set(id, chart);
  const holder = byId(id);
  holder.hidden = false;
  if (!holder.querySelector(".plot")) frame(id, holder);
  holder.querySelector(".plot").setAttribute("aria-label", chart.description);
  holder.querySelector(".legend").replaceChildren(...chart.legend(colours()).map(key));
  numbers(id, holder);
  if (seen.has(id)) return show(id, colours());
  waiting.add(id);
  return null;
}

function show(id, palette, more = {}) {
  const { traces, layout: shape } = drawn.get(id).figure(palette);
  return globalThis.Plotly.react(byId(id).querySelector(".plot"), traces, { ...shape, ...more }, CONFIG);
}

/** A chart that cannot be drawn, and why. */
export function refuse(id, words) {
  drawn.delete(id);
  waiting.delete(id);
  byId(id).replaceChildren(element("p", { class: "warning" }, `This chart could not be computed: ${words}`));
}

function frame(id, holder) {
  const called = drawn.get(id).name.replaceAll("_", " "); // five charts have the same buttons
  const details = element("details", {}, element("summary", {}, "Numbers", element("span", { class: "hidden" }, `: ${called}`)));
  details.addEventListener("toggle", () => numbers(id, holder));
  const button = (kind, take) => element("button", { type: "button", onclick: take, "aria-label": `${kind}: ${called}` }, kind);
  holder.replaceChildren(element("div", { class: "plot", role: "img" }), element("ul", { class: "legend" }),
    element("div", { class: "beside" }, details,
      button("CSV", () => save(`${drawn.get(id).name}.csv`, new Blob([csv(...drawn.get(id).numbers())], { type: "text/csv" }))),
      button("SVG", () => picture(drawn.get(id)))));
}

/** The table, where somebody looks at it. */
function numbers(id, holder) {
  const details = holder.querySelector("details");
  if (!details.open) return;
  const { caption, numbers: made } = drawn.get(id);
  const [headings, rows] = made();
  const short = rows.map((cells) => cells.map((cell) => (typeof cell === "number" ? String(Number(cell.toPrecision(5))) : cell)));
  const scroll = details.querySelector(".scroll") ?? element("div", { class: "scroll", tabindex: "0", role: "region" });
  scroll.setAttribute("aria-label", caption);
  scroll.replaceChildren(table(caption, headings, short));
  details.append(scroll);
}

/** An entry of a legend: a key, a name and, where there is one, a value. */
function key({ kind, name, colour, value }) {
  const swatch = element("span", { class: `key ${kind}`, "aria-hidden": "true" });
  swatch.style.color = colour;
  return element("li", {}, swatch, element("span", {}, name), value ?? null);
}

async function picture({ name, figure }) {
  const { traces, layout: shape } = figure(PAPER);
  const legend = { orientation: "h", y: -0.18, yanchor: "top" };
  const found = await globalThis.Plotly.toImage(
    { data: traces, layout: { ...shape, showlegend: true, legend, paper_bgcolor: PAPER.panel, margin: { ...shape.margin, b: 110 } } },
    { format: "svg", width: 900, height: 520 });
  save(`${name}.svg`, new Blob([decodeURIComponent(found.slice(found.indexOf(",") + 1))], { type: "image/svg+xml" }));
}

/** Draw all charts once more, as for paper or for the screen. */
function again(palette, more) {
  for (const [id, chart] of drawn) {
    waiting.delete(id);
    byId(id).querySelector(".legend").replaceChildren(...chart.legend(palette).map(key));
    show(id, palette, more);
  }
}

addEventListener("beforeprint", () => again(PAPER, { width: WIDTH_OF_PAPER }));
addEventListener("afterprint", () => again(colours(), { autosize: true }));
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => { onScreen = undefined; again(colours()); });
