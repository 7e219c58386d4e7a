// A figure drawn at once on a canvas, while something moves: what plotly draws better, and much later.

import { digits } from "./units.js";

/** @typedef {import("./plot.js").Figure} Figure */
/** @typedef {import("./plot.js").Colours} Colours */
/** @typedef {[number, number]} Range */
/** In pixels of the page. @typedef {{ width: number, height: number }} Size */

/** The most marks on an axis, and how long one is, in pixels. */
const MOST_MARKS = 7;
const MARK = 4;
/** Room above the greatest value, as a share. */
const ROOM = 0.05;
/** Dots of a map, and steps between its colours. */
const DOTS = { x: 96, y: 64 };
const SHADES = 100;
const FONT = '12.5px system-ui, "DejaVu Sans", sans-serif';
const DASHES = { dash: [9, 9], dot: [3, 3] };

/** Draws a figure into a canvas of a size in pixels of the page. */
class Sketch {
  /**
   * @param {HTMLCanvasElement} canvas
   * @param {Size} size
   * @param {Figure} figure
   * @param {Colours} colours
   * @param {{ x: Range, y: Range } | undefined} ranges those of the axes, where they stay
   */
  constructor(canvas, { width, height }, { traces, layout }, colours, ranges) {
    const scale = devicePixelRatio || 1;
    canvas.width = Math.round(width * scale);
    canvas.height = Math.round(height * scale);
    this.context = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d"));
    this.context.scale(scale, scale);
    this.context.font = FONT;
    this.traces = /** @type {any[]} */ (traces);
    this.layout = layout;
    this.colours = colours;
    const { l, r, t, b } = layout.margin;
    this.area = { left: l, top: t, width: width - l - r, height: height - t - b };
    this.stacked = stacked(this.traces);
    this.ranges = ranges ?? { x: extent(this.traces.flatMap(({ x }) => x)), y: this.#rangeOfY() };
  }

  /** @returns {Range} */
  #rangeOfY() {
    if (this.layout.yaxis.range) return this.layout.yaxis.range;
    const [low, high] = extent(this.traces.flatMap((trace) => this.stacked.get(trace) ?? trace.y));
    if (this.traces.some(({ type }) => type === "contour")) return [low, high];
    const room = ROOM * (Math.max(high, 0) - Math.min(low, 0)) || 1;
    return [low < 0 ? low - room : 0, high > 0 ? high + room : 0];
  }

  draw() {
    const { context, area } = this;
    this.#grid();
    context.save();
    context.beginPath();
    context.rect(area.left, area.top, area.width, area.height);
    context.clip();
    for (const shape of this.layout.shapes ?? []) if (shape.layer === "below") this.#shape(shape);
    this.#below = undefined;
    for (const trace of this.traces) {
      if (trace.type === "contour") this.#map(trace);
      else if (trace.mode === "lines") this.#line(trace);
    }
    for (const shape of this.layout.shapes ?? []) if (shape.layer !== "below") this.#shape(shape);
    context.restore();
    for (const note of this.layout.annotations ?? []) this.#note(note);
    for (const trace of this.traces) if (trace.mode === "markers" && trace.x.length === 1) this.#diamond(trace);
  }

  /** @param {number} value */
  #x(value) {
    const [low, high] = this.ranges.x;
    return this.area.left + ((value - low) / (high - low)) * this.area.width;
  }

  /** @param {number} value */
  #y(value) {
    const [low, high] = this.ranges.y;
    return this.area.top + this.area.height - ((value - low) / (high - low)) * this.area.height;
  }

  #grid() {
    const { context, area, colours } = this;
    context.strokeStyle = colours.line;
    context.fillStyle = colours.ink;
    context.lineWidth = 1;
    context.textAlign = "center";
    context.textBaseline = "top";
    for (const at of marks(this.ranges.x)) {
      const x = this.#x(at);
      this.#stroke([x, area.top], [x, area.top + area.height]);
      context.fillText(digits(at), x, area.top + area.height + MARK);
    }
    context.textAlign = "right";
    context.textBaseline = "middle";
    for (const at of marks(this.ranges.y)) {
      const y = this.#y(at);
      this.#stroke([area.left, y], [area.left + area.width, y]);
      context.fillText(digits(at), area.left - MARK, y);
    }
    this.#title(this.layout.xaxis.title.text, area.left + area.width / 2, area.top + area.height + 30, 0);
    this.#title(this.layout.yaxis.title.text, 16, area.top + area.height / 2, -Math.PI / 2);
  }

  /**
   * @param {string} words
   * @param {number} x
   * @param {number} y
   * @param {number} angle
   */
  #title(words, x, y, angle) {
    const { context } = this;
    context.save();
    context.translate(x, y);
    context.rotate(angle);
    context.textAlign = "center";
    context.textBaseline = "middle";
    context.fillText(words, 0, 0);
    context.restore();
  }

  /** @param {[number, number]} from @param {[number, number]} to */
  #stroke(from, to) {
    this.context.beginPath();
    this.context.moveTo(...from);
    this.context.lineTo(...to);
    this.context.stroke();
  }

  /** The curve that the next area stands on. @type {{ x: number[], y: number[] } | undefined} */
  #below;

  /** @param {any} trace */
  #line(trace) {
    const { context } = this;
    const { x, line = {}, fillcolor, stackgroup, fill } = trace;
    const y = this.stacked.get(trace) ?? trace.y;
    if (fillcolor && (stackgroup || fill)) {
      const floor = this.#below ?? { x, y: x.map(() => 0) };
      context.beginPath();
      this.#path(x, y, true);
      for (let i = floor.x.length - 1; i >= 0; i--) context.lineTo(this.#x(floor.x[i]), this.#y(floor.y[i]));
      context.closePath();
      context.fillStyle = fillcolor;
      context.fill();
    }
    this.#below = { x, y };
    if (!stackgroup) {
      context.beginPath();
      this.#path(x, y, false);
      context.strokeStyle = line.color;
      context.lineWidth = line.width;
      context.setLineDash(DASHES[/** @type {keyof typeof DASHES} */ (line.dash)] ?? []);
      context.stroke();
      context.setLineDash([]);
    }
  }

  /**
   * @param {number[]} x
   * @param {(number | null)[]} y
   * @param {boolean} isWhole whether what is missing is none, as in an area
   */
  #path(x, y, isWhole) {
    let isOpen = false;
    x.forEach((at, i) => {
      const value = y[i] ?? (isWhole ? 0 : Number.NaN);
      if (!Number.isFinite(value)) {
        isOpen = false;
        return;
      }
      if (isOpen) this.context.lineTo(this.#x(at), this.#y(value));
      else this.context.moveTo(this.#x(at), this.#y(value));
      isOpen = true;
    });
  }

  /** @param {any} shape */
  #shape({ x0, x1, y0, y1, xref, yref, fillcolor, opacity = 1 }) {
    const { context, area } = this;
    const [left, right] = xref === "paper" ? [area.left, area.left + area.width] : [this.#x(x0), this.#x(x1)];
    const [top, bottom] = yref === "paper" ? [area.top, area.top + area.height] : [this.#y(y1), this.#y(y0)];
    context.globalAlpha = opacity;
    context.fillStyle = fillcolor;
    context.fillRect(left, top, right - left, bottom - top);
    context.globalAlpha = 1;
  }

  /** @param {any} note */
  #note({ y, text }) {
    const { context, area, colours } = this;
    context.fillStyle = colours.ink;
    context.textAlign = "left";
    context.textBaseline = "top";
    context.fillText(text, area.left + 0.01 * area.width + 2, this.#y(y) + 3);
  }

  /** @param {any} trace */
  #diamond({ x: [x], y: [y], marker }) {
    const { context } = this;
    if (!(Number.isFinite(x) && Number.isFinite(y))) return;
    const [left, top, half] = [this.#x(x), this.#y(y), marker.size / Math.SQRT2];
    context.beginPath();
    context.moveTo(left - half, top);
    context.lineTo(left, top - half);
    context.lineTo(left + half, top);
    context.lineTo(left, top + half);
    context.closePath();
    context.fillStyle = marker.color;
    context.fill();
    context.strokeStyle = marker.line.color;
    context.lineWidth = marker.line.width;
    context.stroke();
  }

  /**
   * A map as an image of few dots, each of the colour of its value, or of what is beyond a limit; the browser smooths it.
   *
   * @param {any} trace
   */
  #map({ x, y, z, colorscale, contours, fillcolor }) {
    const { context, area } = this;
    const isLimit = contours.type === "constraint";
    const [low, high] = extent(z.flat());
    if (isLimit && high < contours.value) return;
    const shades = isLimit ? [channelsOf(fillcolor)] : shadesOf(colorscale);
    const image = new ImageData(DOTS.x, DOTS.y);
    const columns = places(x, DOTS.x, this.ranges.x);
    let dot = 4 * DOTS.x * DOTS.y;
    for (const [row, up] of places(y, DOTS.y, this.ranges.y)) {
      const [below, above] = [z[row], z[Math.min(row + 1, z.length - 1)]];
      dot -= 4 * DOTS.x; // from the lowest row of the image on
      let at = dot;
      for (const [column, along] of columns) {
        const value = (1 - up) * between(below, column, along) + up * between(above, column, along);
        if (isLimit ? value >= contours.value : Number.isFinite(value)) {
          image.data.set(isLimit ? shades[0] : shades[Math.round((SHADES * (value - low)) / (high - low))], at);
        }
        at += 4;
      }
    }
    spare.width = DOTS.x;
    spare.height = DOTS.y;
    spare.getContext("2d")?.putImageData(image, 0, 0);
    context.drawImage(spare, area.left, area.top, area.width, area.height);
  }
}

/** Where a map is made before it has its size. */
const spare = document.createElement("canvas");

/**
 * @param {(number | null)[]} values
 * @param {number} place
 * @param {number} share
 */
function between(values, place, share) {
  const next = values[Math.min(place + 1, values.length - 1)];
  return (1 - share) * (values[place] ?? Number.NaN) + share * (next ?? Number.NaN);
}

/**
 * Where each cell lies among the values of an axis.
 *
 * @param {number[]} values
 * @param {number} count
 * @param {Range} range
 * @returns {[number, number][]}
 */
function places(values, count, [low, high]) {
  let place = 0;
  return Array.from({ length: count }, (_, i) => {
    const at = low + ((i + 0.5) / count) * (high - low);
    while (place < values.length - 2 && values[place + 1] < at) place += 1;
    const share = (at - values[place]) / (values[place + 1] - values[place]);
    return [place, Math.min(1, Math.max(0, share))];
  });
}

/** Red, green, blue and opacity of a colour #rrggbb or #rrggbbaa. @param {string} colour */
function channelsOf(colour) {
  const written = colour.length < 9 ? `${colour}ff` : colour;
  return [1, 3, 5, 7].map((start) => Number.parseInt(written.slice(start, start + 2), 16));
}

/** The colours of a scale in small steps. @param {[number, string][]} scale */
function shadesOf(scale) {
  return Array.from({ length: SHADES + 1 }, (_, i) => {
    const share = i / SHADES;
    const next = Math.max(
      1,
      scale.findIndex(([at]) => at >= share),
    );
    const [[from, first], [to, last]] = [scale[next - 1], scale[next]];
    const [one, other] = [channelsOf(first), channelsOf(last)];
    return one.map((channel, k) => channel + ((share - from) / (to - from)) * (other[k] - channel));
  });
}

/** The least and the greatest number. @param {(number | null | undefined)[]} values @returns {Range} */
function extent(values) {
  let [low, high] = [Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY];
  for (const value of values) {
    if (value === null || value === undefined || !Number.isFinite(value)) continue;
    if (value < low) low = value;
    if (value > high) high = value;
  }
  if (low > high) return [0, 1];
  return low === high ? [low - 1, high + 1] : [low, high];
}

/** Values of traces that stand on each other. @param {any[]} traces @returns {Map<any, number[]>} */
function stacked(traces) {
  const found = new Map();
  /** @type {number[] | undefined} */
  let below;
  for (const trace of traces) {
    if (!trace.stackgroup) continue;
    const sum = trace.y.map(
      (/** @type {number | null} */ value, /** @type {number} */ i) => (below?.[i] ?? 0) + (value ?? 0),
    );
    found.set(trace, sum);
    below = sum;
  }
  return found;
}

/** Round numbers within a range. @param {Range} range */
function marks([low, high]) {
  const least = (high - low) / MOST_MARKS;
  const power = 10 ** Math.floor(Math.log10(least));
  const step = power * ([1, 2, 5].find((digit) => digit * power >= least) ?? 10);
  const first = Math.ceil(low / step - 1e-9);
  const count = Math.floor(high / step + 1e-9) - first + 1;
  return Array.from({ length: count }, (_, i) => (first + i) * step);
}

/**
 * Draw a figure into a canvas.
 *
 * @param {HTMLCanvasElement} canvas
 * @param {Size} size
 * @param {Figure} figure
 * @param {Colours} colours
 * @param {{ x: Range, y: Range }} [ranges] those of the axes, where they stay
 */
export function sketch(canvas, size, figure, colours, ranges) {
  new Sketch(canvas, size, figure, colours, ranges).draw();
}
