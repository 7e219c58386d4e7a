// The charts of sheets: curves, bars and maps, as the plot draws them.

import * as plot from "./plot.js";
import { text } from "./texts.js";
import { converted, digits, titled } from "./units.js";

/** @typedef {import("./units.js").Quantity} Quantity */
/** @typedef {import("./sheet.js").Block} Block */
/** @typedef {import("./plot.js").Colours} Colours */
/** @typedef {import("./plot.js").LegendEntry} LegendEntry */
/** @typedef {(number | null)[]} Values */
/** An axis of a chart. @typedef {{ name: string, quantity: Quantity, log: boolean, least: number | null }} Axis */
/** A curve. @typedef {{ name: string, x: Values, y: Values, colour: string, style: string, second: boolean, labels: string[] }} Curve */
/** The area between two curves. @typedef {{ name: string, x: Values, low: Values, high: Values, colour: string, solid: boolean }} Band */
/** A value of an axis that holds along the other one. @typedef {{ name: string, x?: number, y?: number, colour: string }} Mark */
/** A bar and its parts. @typedef {{ name: string, parts: [string, number | null, string][], band: Values | null, text: string, hatched: boolean, start: number | null }} Bar */

/** Shades of the colours of a sheet, but for ink; told apart with any colour vision. @type {Record<string, string>} */
const SHADES = {
  grey: "#888888",
  blue: "#0072B2",
  orange: "#E69F00",
  green: "#009E73",
  purple: "#CC79A7",
  sky: "#56B4E9",
  red: "#D55E00",
  yellow: "#C9B800",
};
const TRANSPARENT = "33";
/** Lines of the styles of curves, and those that are marks. @type {Record<string, object>} */
const STYLES = {
  line: { mode: "lines" },
  area: { mode: "lines", fill: "tozeroy" },
  dashed: { mode: "lines", line: { dash: "dash" } },
  dotted: { mode: "lines", line: { dash: "dot" } },
  dots: { mode: "markers", marker: { size: 5 } },
  circles: { mode: "markers", marker: { size: 8, symbol: "circle-open" } },
};
/** Keys of the legend, by the styles of curves. @type {Record<string, string>} */
const KEYS = { line: "line", area: "area", dashed: "dash", dotted: "dot", dots: "point", circles: "point" };
/** Pixels: a row of bars, what stands above and below them, letters of their names in a line, and the width of one. */
const [ROW, FRAME, LINE, LETTER] = [26, 70, 30, 6.4];
const HEIGHT = 260;

/**
 * Draw a block in its place.
 *
 * @param {string} id
 * @param {Block} block
 */
export function draw(id, block) {
  const bars = block.kind === "bars" ? block.bars.length : 0;
  document.getElementById(id)?.style.setProperty("--plot-height", `${Math.max(HEIGHT, FRAME + ROW * bars)}px`);
  const common = { name: slug(block.title).replaceAll("-", "_"), caption: block.title };
  if (block.kind === "bars") plot.draw(id, { ...common, ...barsOf(block) });
  else if (block.kind === "map") plot.draw(id, { ...common, ...mapOf(block) });
  else plot.draw(id, { ...common, ...chartOf(block) });
}

/** The name of a chart in addresses: letters, digits and hyphens. @param {string} words */
export function slug(words) {
  return words.toLowerCase().replaceAll(/[^a-z0-9]+/g, "-");
}

/** A text for plotly, which reads markup in what it draws. @param {string} words */
function asText(words) {
  return words.replaceAll("&", "&amp;").replaceAll("<", "&lt;");
}

/** @param {string} colour @param {Colours} colours */
function shade(colour, { ink }) {
  return SHADES[colour] ?? ink;
}

/** @param {Values} values @param {Axis} axis @returns {Values} */
function all(values, { quantity }) {
  return values.map((value) => converted(value, quantity));
}

/** @param {Axis} axis */
function heading({ name, quantity }) {
  return titled(name, quantity);
}

/** An axis as the plot has it. @param {Axis} axis */
function scale({ log, least, quantity }) {
  const type = log ? { type: "log" } : {};
  if (least === null || (log && least <= 0)) return { ...type, rangemode: "normal" };
  const low = Number(converted(least, quantity));
  return { ...type, rangemode: "normal", range: [log ? Math.log10(low) : low, null] };
}

// -- curves -----------------------------------------------------------------------------------------

/** @param {Block} block */
function chartOf(block) {
  /** @type {{ x: Axis, y: Axis, second: Axis | null, marks: any[] }} */
  const { x, y, second, marks } = /** @type {any} */ (block);
  /** @type {Curve[]} */
  const curves = marks.filter((mark) => "style" in mark);
  /** @type {Band[]} */
  const bands = marks.filter((mark) => "low" in mark);
  /** @type {Mark[]} */
  const levels = marks.filter((mark) => !("style" in mark) && !("low" in mark));
  const axisOf = (/** @type {Curve} */ curve) => (curve.second && second ? second : y);
  const one = { title: block.title, x: heading(x), y: heading(y) };
  return {
    description: text("sheet.chart", one),
    figure: (/** @type {Colours} */ colours) => ({
      traces: [
        ...bands.flatMap((band) => areaOf(band, x, y, colours)),
        ...curves.flatMap((curve) => curveOf(curve, x, axisOf(curve), colours)),
      ],
      layout: plot.layout(colours, one.x, one.y, {
        margin: { l: 72, r: second ? 72 : 26, t: 8, b: 42 },
        hovermode: curves.some(({ style }) => style === "dots") ? "closest" : "x unified",
        shapes: levels.map((mark) => lineOf(mark, x, y, colours)),
        xaxis: scale(x),
        yaxis: scale(y),
        ...(second ? { yaxis2: secondAxis(second, colours) } : {}),
      }),
    }),
    legend: (/** @type {Colours} */ colours) => legendOf([...bands, ...curves, ...levels], colours),
    numbers: () => numbersOf(curves, bands, x, axisOf),
  };
}

/** @param {Axis} axis @param {Colours} colours */
function secondAxis(axis, { line }) {
  return {
    ...scale(axis),
    title: { text: heading(axis), standoff: 6 },
    overlaying: "y",
    tickmode: "auto",
    side: "right",
    showgrid: false,
    zeroline: false,
    linecolor: line,
    tickformat: ".6~g",
    nticks: 7,
  };
}

/** @param {Curve} curve @param {Axis} x @param {Axis} y @param {Colours} colours */
function curveOf(curve, x, y, colours) {
  const colour = shade(curve.colour, colours);
  const style = /** @type {Record<string, any>} */ (STYLES[curve.style]);
  const points = { x: all(curve.x, x), y: all(curve.y, y), name: asText(curve.name), yaxis: curve.second ? "y2" : "y" };
  const trace = {
    ...points,
    ...style,
    line: { color: colour, width: 1.8, ...style.line },
    marker: { color: colour, ...style.marker },
    fillcolor: `${colour}${TRANSPARENT}`,
    hovertemplate: "%{y:.4g}",
    ...(curve.name ? {} : { hoverinfo: "skip", hovertemplate: undefined }),
  };
  if (!curve.labels.length) return [trace];
  const few = curve.labels.length;
  const labels = { x: points.x.slice(0, few), y: points.y.slice(0, few), text: curve.labels.map(asText) };
  return [trace, { ...labels, mode: "text", textposition: "top right", hoverinfo: "skip" }];
}

/** @param {Band} band @param {Axis} x @param {Axis} y @param {Colours} colours */
function areaOf(band, x, y, colours) {
  const colour = shade(band.colour, colours);
  const end = { x: all(band.x, x), mode: "lines", line: { color: colour, width: 0 }, hoverinfo: "skip" };
  return [
    { ...end, y: all(band.low, y) },
    { ...end, y: all(band.high, y), fill: "tonexty", fillcolor: band.solid ? colour : `${colour}${TRANSPARENT}` },
  ];
}

/** A level or a vertical line. @param {Mark} mark @param {Axis} x @param {Axis} y @param {Colours} colours */
function lineOf(mark, x, y, colours) {
  const line = { color: shade(mark.colour, colours), width: 1.3, dash: "dot" };
  if (mark.y !== undefined) {
    const at = converted(mark.y, y.quantity);
    return { type: "line", xref: "paper", x0: 0, x1: 1, y0: at, y1: at, line };
  }
  const at = converted(Number(mark.x), x.quantity);
  return { type: "line", yref: "paper", y0: 0, y1: 1, x0: at, x1: at, line };
}

/**
 * The marks that have names, each name once.
 *
 * @param {(Curve | Band | Mark)[]} marks
 * @param {Colours} colours
 * @returns {LegendEntry[]}
 */
function legendOf(marks, colours) {
  const named = new Map(marks.filter(({ name }) => name).map((mark) => [mark.name, mark]));
  return [...named.values()].map((mark) => ({
    kind: "style" in mark ? KEYS[mark.style] : "low" in mark ? "area" : "dot",
    name: mark.name,
    colour: shade(mark.colour, colours),
  }));
}

/**
 * Curves and bands as columns beside one horizontal axis, or one below the other where each has its own.
 *
 * @param {Curve[]} curves
 * @param {Band[]} bands
 * @param {Axis} x
 * @param {(curve: Curve) => Axis} axisOf
 * @returns {[string[], import("./dom.js").Cell[][]]}
 */
function numbersOf(curves, bands, x, axisOf) {
  const columns = [
    ...curves.map((curve) => ({
      name: curve.name,
      x: curve.x,
      values: all(curve.y, axisOf(curve)),
      axis: axisOf(curve),
    })),
    ...bands.flatMap((band) =>
      ["low", "high"].map((end) => ({
        name: text(end === "low" ? "sheet.low" : "sheet.high", { name: band.name }),
        x: band.x,
        values: all(end === "low" ? band.low : band.high, axisOf(curves[0])),
        axis: axisOf(curves[0]),
      })),
    ),
  ];
  const first = JSON.stringify(columns[0]?.x);
  const titles = columns.map(({ name, axis }) => titled(name || axis.name, axis.quantity));
  if (columns.every((column) => JSON.stringify(column.x) === first)) {
    const places = all(columns[0]?.x ?? [], x);
    return [[heading(x), ...titles], places.map((at, row) => [at, ...columns.map(({ values }) => values[row])])];
  }
  const rows = columns.flatMap(({ values, x: own }, column) =>
    all(own, x).map((at, row) => [titles[column], at, values[row]]),
  );
  return [["", heading(x), text("sheet.value")], rows];
}

// -- bars -------------------------------------------------------------------------------------------

/** @param {Block} block */
function barsOf(block) {
  /** @type {{ title: string, quantity: Quantity, bars: Bar[], marks: Mark[], origin: number }} */
  const { title, quantity, bars, marks, origin } = /** @type {any} */ (block);
  const zero = Number(converted(0, quantity));
  const width = (/** @type {number | null} */ value) => Number(converted(Number(value), quantity)) - zero;
  const placed = bars.map((bar) => stacked(bar, width, Number(converted(bar.start ?? origin, quantity))));
  const axis = { name: "", quantity, log: false, least: null };
  const x = titled("", quantity);
  const count = Math.max(0, ...bars.map(({ parts }) => parts.length));
  const names = bars.map(({ name }) => inLines(asText(name)));
  const letters = Math.max(0, ...names.flatMap((name) => name.split("<br>").map(({ length }) => length)));
  return {
    description: text("sheet.bars", { title, count: bars.length }),
    figure: (/** @type {Colours} */ colours) => ({
      traces: [
        ...Array.from({ length: count }, (_, part) => ({
          type: "bar",
          orientation: "h",
          y: bars.map((__, row) => row),
          x: placed.map(({ parts }) => parts[part]?.width ?? null),
          base: placed.map(({ parts }) => parts[part]?.base ?? null),
          width: 0.7,
          marker: {
            color: bars.map(({ parts }) => (parts[part] ? shade(parts[part][2], colours) : null)),
            pattern: { shape: bars.map(({ hatched }) => (hatched ? "/" : "")) },
          },
          customdata: bars.map((bar) => wordsOf(bar, part, quantity)),
          hovertemplate: "%{customdata}<extra></extra>",
        })),
        ...bars.flatMap(({ band }, row) => (band ? [errorOf(band, placed[row].end, row, quantity, colours)] : [])),
      ],
      layout: plot.layout(colours, x, "", {
        barmode: "overlay",
        hovermode: "closest",
        margin: { l: 16 + LETTER * letters, r: 26, t: 8, b: 42 },
        shapes: [{ name: "", x: origin, colour: "grey" }, ...marks].map((mark) => lineOf(mark, axis, axis, colours)),
        xaxis: { rangemode: "normal" },
        yaxis: {
          range: [bars.length - 0.4, -0.6],
          tickvals: bars.map((_, row) => row),
          ticktext: names.map((name, row) => (bars[row].parts.length ? name : `<b>${name}</b>`)),
          tickmode: "array",
          zeroline: false,
        },
      }),
    }),
    legend: (/** @type {Colours} */ colours) => [
      ...[
        ...new Map(
          bars.flatMap(({ parts }) => parts.filter(([name, value]) => name && value)).map((part) => [part[0], part]),
        ).values(),
      ].map(([name, , colour]) => ({ kind: "area", name, colour: shade(colour, colours) })),
      ...legendOf(marks, colours),
    ],
    numbers: () => numbersOfBars(bars, quantity),
  };
}

/**
 * The parts of a bar from its origin, negative ones to the left.
 *
 * @param {Bar} bar
 * @param {(value: number | null) => number} width
 * @param {number} origin
 */
function stacked({ parts }, width, origin) {
  const ends = { left: origin, right: origin };
  const found = parts.map(([, value]) => {
    const size = width(value);
    const side = size < 0 ? "left" : "right";
    const base = ends[side];
    ends[side] += size;
    return { base, width: size };
  });
  return { parts: found, end: ends.left + ends.right - origin };
}

/** The ends of a band of a bar. @param {Values} band @param {number} end @param {number} row @param {Quantity} quantity @param {Colours} colours */
function errorOf(band, end, row, quantity, { ink }) {
  const [low, high] = band.map((one) => Number(converted(Number(one), quantity)));
  const whiskers = { type: "data", symmetric: false, array: [high - end], arrayminus: [end - low], color: ink };
  return { x: [end], y: [row], mode: "markers", marker: { size: 1, color: ink }, error_x: whiskers, hoverinfo: "skip" };
}

/** What is read of a part of a bar. @param {Bar} bar @param {number} part @param {Quantity} quantity */
function wordsOf({ name, parts, text: beside }, part, quantity) {
  const [words, value] = parts[part] ?? ["", null];
  const [number, unit] = [digits(Number(converted(value, quantity))), titled("", quantity)];
  const read = [[name, words].filter(Boolean).join(", "), `${number} ${unit}`.trim(), beside];
  return asText(read.filter(Boolean).join(": "));
}

/** A name in lines, for an axis. @param {string} name */
function inLines(name) {
  /** @type {string[]} */
  const lines = [];
  for (const word of name.split(" ")) {
    const last = lines.at(-1);
    if (last !== undefined && last.length + word.length < LINE) lines[lines.length - 1] = `${last} ${word}`;
    else lines.push(word);
  }
  return lines.join("<br>");
}

/** @param {Bar[]} bars @param {Quantity} quantity @returns {[string[], import("./dom.js").Cell[][]]} */
function numbersOfBars(bars, quantity) {
  const rows = bars.flatMap(({ name, parts, band }) =>
    parts.map(([words, value]) => [
      [name, words].filter(Boolean).join(", "),
      converted(value, quantity),
      ...(band ?? [null, null]).map((end) => converted(end, quantity)),
    ]),
  );
  const value = titled(text("sheet.value"), quantity);
  return [["", value, text("sheet.low", { name: "" }).trim(), text("sheet.high", { name: "" }).trim()], rows];
}

// -- maps -------------------------------------------------------------------------------------------

/** @param {Block} block */
function mapOf(block) {
  /** @type {{ x: Axis, y: Axis, value: Axis, places: [Values, Values], values: Values[], marks: any[] }} */
  const { x, y, value, places, values, marks } = /** @type {any} */ (block);
  /** @type {Curve[]} */
  const curves = marks.filter((mark) => "style" in mark);
  const grid = values.map((row) => all(row, value));
  const one = { title: block.title, x: heading(x), y: heading(y) };
  return {
    description: text("sheet.chart", one),
    figure: (/** @type {Colours} */ colours) => ({
      traces: [
        {
          x: all(places[0], x),
          y: all(places[1], y),
          z: grid,
          type: "contour",
          colorscale: "Inferno",
          ncontours: 12,
          name: value.name,
          contours: { coloring: "heatmap" },
          line: { width: 0.4, color: "#333" },
          colorbar: { thickness: 12, outlinewidth: 0, tickformat: ".3~g", xpad: 6, title: { text: heading(value) } },
          hovertemplate: "%{x:.4g}, %{y:.4g}: %{z:.4g}<extra></extra>",
          showlegend: false,
        },
        ...curves.flatMap((curve) => curveOf(curve, x, y, colours)),
      ],
      layout: plot.layout(colours, one.x, one.y, {
        hovermode: "closest",
        margin: { l: 72, r: 90, t: 8, b: 42 },
        shapes: marks.filter((mark) => !("style" in mark)).map((mark) => lineOf(mark, x, y, colours)),
        xaxis: scale(x),
        yaxis: scale(y),
      }),
    }),
    legend: (/** @type {Colours} */ colours) => legendOf(curves, colours),
    numbers: /** @returns {[string[], import("./dom.js").Cell[][]]} */ () => [
      [`${one.y} \\ ${one.x}`, ...all(places[0], x).map((at) => String(Number(Number(at).toPrecision(6))))],
      all(places[1], y).map((at, row) => [at, ...grid[row]]),
    ],
  };
}
