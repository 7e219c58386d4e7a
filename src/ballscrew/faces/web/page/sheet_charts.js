// The charts of sheets: curves with bands and lines, bars of parts, and maps, as the plot draws them.

import * as plot from "./plot.js";
import { text } from "./texts.js";
import { converted, digits, symbolOf, titled } from "./units.js";

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
/** Lines on a map, and its colours from the least value to the greatest. */
const ON_MAP = "#ffffff";
const SCALE = [
  [0, "#000004"],
  [0.25, "#57106e"],
  [0.5, "#bc3754"],
  [0.75, "#f98e09"],
  [1, "#fcffa4"],
];

/**
 * Draw a block in its place.
 *
 * @param {string} id
 * @param {Block} block
 */
export function draw(id, block) {
  const chart = block.kind === "bars" ? barsOf(block) : block.kind === "map" ? mapOf(block) : chartOf(block);
  const height = Math.max(HEIGHT, "height" in chart ? chart.height : 0);
  document.getElementById(id)?.style.setProperty("--plot-height", `${height}px`);
  const name = slug(block.title).replaceAll("-", "_");
  plot.draw(id, { name, caption: text("sheet.numbers", { title: block.title }), canSketch: false, ...chart, height });
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

/** @param {number | null} one @param {number | null} other */
function difference(one, other) {
  return one === null || other === null ? null : one - other;
}

/** @param {Values} values @param {Axis} axis @returns {Values} */
function all(values, { quantity }) {
  return values.map((value) => converted(value, quantity));
}

/** @param {Axis} axis */
function heading({ name, quantity }) {
  return asText(titled(name, quantity));
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
  const levels = marks.filter((mark) => isPlaced(mark));
  const axisOf = (/** @type {Curve} */ curve) => (curve.second && second ? second : y);
  const one = { title: block.title, x: heading(x), y: heading(y) };
  return {
    description: text("sheet.chart", one),
    figure: (/** @type {Colours} */ colours) => ({
      traces: [
        ...bands.flatMap((band) => areaOf(band, x, y, colours)),
        ...curves.flatMap((curve) => curveOf(curve, x, axisOf(curve), colours)),
        ...keysOf(levels, colours),
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
    legend: (/** @type {Colours} */ colours) => legendOf([...bands, ...curves, ...levels], colours, x, y),
    numbers: () => numbersOf(curves, bands, x, y, axisOf),
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
    ...(curve.name ? {} : { showlegend: false, hoverinfo: "skip", hovertemplate: undefined }),
  };
  if (!curve.labels.length) return [trace];
  const few = curve.labels.length;
  const labels = { x: points.x.slice(0, few), y: points.y.slice(0, few), text: curve.labels.map(asText) };
  const yaxis = points.yaxis;
  return [trace, { ...labels, yaxis, mode: "text", textposition: "top right", hoverinfo: "skip", showlegend: false }];
}

/** @param {Band} band @param {Axis} x @param {Axis} y @param {Colours} colours */
function areaOf(band, x, y, colours) {
  const colour = shade(band.colour, colours);
  const end = { x: all(band.x, x), mode: "lines", line: { color: colour, width: 0 }, hoverinfo: "skip" };
  return [
    { ...end, y: all(band.low, y), showlegend: false },
    {
      ...end,
      y: all(band.high, y),
      name: asText(band.name),
      showlegend: Boolean(band.name),
      fill: "tonexty",
      fillcolor: band.solid ? colour : `${colour}${TRANSPARENT}`,
    },
  ];
}

/** Test whether a mark is a level or a vertical line that has a place. @param {any} mark */
function isPlaced(mark) {
  return !("style" in mark) && !("low" in mark) && typeof (mark.y ?? mark.x) === "number";
}

/** The names of lines, which are shapes, for a legend of the plot: that of a saved picture. @param {Mark[]} marks @param {Colours} colours */
function keysOf(marks, colours) {
  return marks
    .filter(({ name }) => name)
    .map(({ name, colour }) => ({
      x: [null],
      y: [null],
      name: asText(name),
      mode: "lines",
      line: { color: shade(colour, colours), width: 1.3, dash: "dot" },
      hoverinfo: "skip",
    }));
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
 * The marks that have names, each name once; a line that has its name alone has its value beside it.
 *
 * @param {(Curve | Band | Mark)[]} marks
 * @param {Colours} colours
 * @param {Axis} x
 * @param {Axis} y
 * @returns {LegendEntry[]}
 */
function legendOf(marks, colours, x, y) {
  const named = new Map(marks.filter(({ name }) => name).map((mark) => [mark.name, mark]));
  return [...named.values()].map((mark) => {
    const colour = shade(mark.colour, colours);
    if ("style" in mark) return { kind: KEYS[mark.style], name: mark.name, colour };
    if ("low" in mark) return { kind: "area", name: mark.name, colour };
    if (marks.filter(({ name }) => name === mark.name).length > 1) return { kind: "dot", name: mark.name, colour };
    const [value, { quantity }] = mark.y === undefined ? [mark.x, x] : [mark.y, y];
    const shown = `${digits(Number(converted(Number(value), quantity)))} ${symbolOf(quantity)}`.trim();
    return { kind: "dot", name: `${mark.name} ${shown}`, colour };
  });
}

/**
 * Curves and bands as columns beside one horizontal axis, or one below the other where each has its own.
 *
 * @param {Curve[]} curves
 * @param {Band[]} bands
 * @param {Axis} x
 * @param {Axis} y
 * @param {(curve: Curve) => Axis} axisOf
 * @returns {[string[], import("./dom.js").Cell[][]]}
 */
function numbersOf(curves, bands, x, y, axisOf) {
  const columns = [
    ...curves.map((curve) => ({
      name: curve.name,
      x: curve.x,
      values: all(curve.y, axisOf(curve)),
      axis: axisOf(curve),
    })),
    ...bands.flatMap((band) => {
      const [low, high] = [all(band.low, y), all(band.high, y)];
      const column = (/** @type {string} */ name, /** @type {Values} */ values) => ({
        name,
        x: band.x,
        values,
        axis: y,
      });
      // what is stacked is a part of a whole
      if (band.solid)
        return [
          column(
            band.name,
            high.map((value, row) => difference(value, low[row])),
          ),
        ];
      return [
        column(text("sheet.low", { name: band.name }), low),
        column(text("sheet.high", { name: band.name }), high),
      ];
    }),
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
  const placed = bars.map((bar) => stacked(bar, quantity, Number(converted(bar.start ?? origin, quantity))));
  const axis = { name: "", quantity, log: false, least: null };
  const x = titled("", quantity);
  const count = Math.max(0, ...bars.map(({ parts }) => parts.length));
  const names = bars.map(({ name }) => inLines(asText(name)));
  const letters = Math.max(0, ...names.flatMap((name) => name.split("<br>").map(({ length }) => length)));
  const lines = marks.filter((mark) => isPlaced(mark));
  const named = new Map(
    bars.flatMap(({ parts }) => parts.filter(([name, value]) => name && value)).map((part) => [part[0], part[2]]),
  );
  return {
    description: text("sheet.bars", { title, count: bars.length }),
    height: FRAME + ROW * bars.length,
    figure: (/** @type {Colours} */ colours) => ({
      traces: [
        ...Array.from({ length: count }, (_, part) => ({
          type: "bar",
          orientation: "h",
          y: bars.map((__, row) => row),
          x: placed.map(({ parts }) => parts[part]?.width ?? null),
          base: placed.map(({ parts }) => parts[part]?.base ?? null),
          width: 0.7,
          showlegend: false,
          marker: {
            color: bars.map(({ parts }) => (parts[part] ? shade(parts[part][2], colours) : null)),
            pattern: { shape: bars.map(({ hatched }) => (hatched ? "/" : "")) },
          },
          customdata: bars.map((_bar, row) => wordsOf(bars, row, part, quantity)),
          hovertemplate: "%{customdata}<extra></extra>",
        })),
        ...bars.flatMap(({ band }, row) => errorOf(band, placed[row].end, row, quantity, colours)),
        ...[...named].map(([name, colour]) => ({
          type: "bar",
          x: [null],
          y: [null],
          name: asText(name),
          marker: { color: shade(colour, colours) },
        })),
        ...keysOf(lines, colours),
      ],
      layout: plot.layout(colours, x, "", {
        barmode: "overlay",
        hovermode: "closest",
        margin: { l: 16 + LETTER * letters, r: 26, t: 8, b: 42 },
        shapes: [{ name: "", x: origin, colour: "grey" }, ...lines].map((mark) => lineOf(mark, axis, axis, colours)),
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
      ...[...named].map(([name, colour]) => ({ kind: "area", name, colour: shade(colour, colours) })),
      ...legendOf(lines, colours, axis, axis),
    ],
    numbers: () => numbersOfBars(bars, quantity),
  };
}

/** The size of a part in the unit of the page: a difference, which no offset changes. @param {number | null} value @param {Quantity} quantity */
function sizeOf(value, quantity) {
  return value === null ? null : Number(converted(value, quantity)) - Number(converted(0, quantity));
}

/**
 * The parts of a bar from its origin, negative ones to the left.
 *
 * @param {Bar} bar
 * @param {Quantity} quantity
 * @param {number} origin
 */
function stacked({ parts }, quantity, origin) {
  const ends = { left: origin, right: origin };
  const found = parts.map(([, value]) => {
    const width = sizeOf(value, quantity);
    const side = Number(width) < 0 ? "left" : "right";
    const base = ends[side];
    ends[side] += Number(width);
    return { base, width };
  });
  return { parts: found, end: ends.left + ends.right - origin };
}

/** The ends of the band of a bar, where both are known. @param {Values | null} band @param {number} end @param {number} row @param {Quantity} quantity @param {Colours} colours */
function errorOf(band, end, row, quantity, { ink }) {
  if (!band || band.includes(null)) return [];
  const [low, high] = band.map((one) => Number(converted(one, quantity)));
  const sizes = { array: [Math.max(high - end, 0)], arrayminus: [Math.max(end - low, 0)] };
  const whiskers = { type: "data", symmetric: false, ...sizes, color: ink };
  const trace = { x: [end], y: [row], mode: "markers", marker: { size: 1, color: ink }, error_x: whiskers };
  return [{ ...trace, hoverinfo: "skip", showlegend: false }];
}

/** The name of a bar: one without is a second bar of the one above. @param {Bar[]} bars @param {number} row */
function nameOf(bars, row) {
  return bars.slice(0, row + 1).findLast(({ name }) => name)?.name ?? "";
}

/** What is read of a part of a bar. @param {Bar[]} bars @param {number} row @param {number} part @param {Quantity} quantity */
function wordsOf(bars, row, part, quantity) {
  const { parts, text: beside } = bars[row];
  const [words, value] = parts[part] ?? ["", null];
  const [number, unit] = [digits(sizeOf(value, quantity)), symbolOf(quantity)];
  const read = [[nameOf(bars, row), words].filter(Boolean).join(", "), `${number} ${unit}`.trim(), beside];
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

/**
 * A row for each part; the ends of a band, which is of the sum of all parts, stand beside the last.
 *
 * @param {Bar[]} bars
 * @param {Quantity} quantity
 * @returns {[string[], import("./dom.js").Cell[][]]}
 */
function numbersOfBars(bars, quantity) {
  const rows = bars.flatMap(({ parts, band, text: beside }, row) =>
    parts.map(([words, value], part) => [
      [nameOf(bars, row), words].filter(Boolean).join(", "),
      sizeOf(value, quantity),
      ...((part === parts.length - 1 && band) || [null, null]).map((end) => converted(end, quantity)),
      part ? "" : beside,
    ]),
  );
  const ends = [text("sheet.low", { name: "" }), text("sheet.high", { name: "" })].map((one) => one.trim());
  return [["", titled(text("sheet.value"), quantity), ...ends, ""], rows];
}

// -- maps -------------------------------------------------------------------------------------------

/** @param {Block} block */
function mapOf(block) {
  /** @type {{ x: Axis, y: Axis, value: Axis, places: [Values, Values], values: Values[], marks: any[] }} */
  const { x, y, value, places, values, marks } = /** @type {any} */ (block);
  /** @type {Curve[]} */
  const curves = marks.filter((mark) => "style" in mark);
  /** @type {Mark[]} */
  const lines = marks.filter((mark) => isPlaced(mark)).map((mark) => ({ ...mark, colour: "ink" }));
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
          colorscale: SCALE,
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
        shapes: lines.map((mark) => lineOf(mark, x, y, { ...colours, ink: ON_MAP })),
        xaxis: scale(x),
        yaxis: scale(y),
      }),
    }),
    legend: (/** @type {Colours} */ colours) => legendOf([...curves, ...lines], colours, x, y),
    numbers: /** @returns {[string[], import("./dom.js").Cell[][]]} */ () => [
      [`${one.y} \\ ${one.x}`, ...all(places[0], x).map((at) => String(Number(Number(at).toPrecision(6))))],
      all(places[1], y).map((at, row) => [at, ...grid[row]]),
    ],
  };
}
