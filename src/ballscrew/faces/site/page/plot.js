// A chart on a canvas: axes, lines, areas and the operating point. It draws numbers and computes none.

import { plainDigits } from "./words.js";

/** @typedef {{ from: number, to: number, title: string, log?: boolean }} Axis */

const LEFT = 70;
const RIGHT = 14;
const TOP = 12;
const BOTTOM = 42;
/** Pixels between two ticks. */
const TICK_X = 80;
const TICK_Y = 44;
/** Stripes on a map, whose colours are those of no scheme. */
const MAP_STRIPES = "#1b2127";
const FONT = '12px system-ui, "Segoe UI", "DejaVu Sans", sans-serif';

/** Colours of the page, which differ by its scheme. @type {Record<string, string>} */
const colours = {};

/** Read the colours of the page again. */
export function readColours() {
  const style = getComputedStyle(document.documentElement);
  for (const name of ["ink", "soft", "line", "panel", "accent", "careful", "second"]) {
    colours[name] = style.getPropertyValue(`--${name}`).trim();
  }
}

/** @param {string} name */
export function colourOf(name) {
  return colours[name];
}

/**
 * Numbers at equal distances.
 *
 * @param {number} from
 * @param {number} to
 * @param {number} count
 */
export function evenly(from, to, count) {
  return Float64Array.from({ length: count }, (_, place) => from + ((to - from) * place) / (count - 1));
}

/** Numbers at equal ratios. @param {number} from @param {number} to @param {number} count */
export function evenlyLog(from, to, count) {
  return evenly(Math.log10(from), Math.log10(to), count).map((exponent) => 10 ** exponent);
}

/** The least and the greatest of finite numbers, and zero. @param {ArrayLike<number>[]} rows */
export function spanOf(...rows) {
  let from = 0;
  let to = 0;
  for (const row of rows) {
    for (let place = 0; place < row.length; place += 1) {
      if (!Number.isFinite(row[place])) continue;
      from = Math.min(from, row[place]);
      to = Math.max(to, row[place]);
    }
  }
  return from === to ? { from: 0, to: 1 } : { from, to };
}

/** A step of one, two or five. @param {number} span @param {number} count */
export function stepOf(span, count) {
  const raw = span / Math.max(1, count);
  const decade = 10 ** Math.floor(Math.log10(raw));
  return decade * ([1, 2, 5].find((step) => step * decade >= raw) ?? 10);
}

/**
 * Bounds moved outwards to ticks.
 *
 * @param {{ from: number, to: number }} span
 */
export function rounded({ from, to }) {
  const step = stepOf(to - from, 6);
  return { from: step * Math.floor(from / step), to: -step * Math.floor(-to / step) };
}

/** @param {Axis} axis @param {number} count */
function ticksOf({ from, to, log }, count) {
  if (log) {
    const first = -Math.floor(-Math.log10(from) + 1e-9);
    const last = Math.floor(Math.log10(to) + 1e-9);
    return Array.from({ length: last - first + 1 }, (_, place) => 10 ** (first + place));
  }
  const low = Math.min(from, to);
  const high = Math.max(from, to);
  const step = stepOf(high - low, count);
  const first = -Math.floor(-low / step);
  const last = Math.floor(high / step + 1e-9);
  return Array.from({ length: last - first + 1 }, (_, place) => Number(((first + place) * step).toPrecision(12)));
}

export class Plot {
  /** @param {HTMLCanvasElement} canvas */
  constructor(canvas) {
    this.canvas = canvas;
    this.pen = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d"));
    this.width = 0;
    this.height = 0;
    /** @type {Axis} */
    this.across = { from: 0, to: 1, title: "" };
    /** @type {Axis} */
    this.up = { from: 0, to: 1, title: "" };
  }

  /** Take the size of the canvas on the screen; true where it has one. */
  measure() {
    this.width = this.canvas.clientWidth;
    this.height = this.canvas.clientHeight;
    const scale = globalThis.devicePixelRatio || 1;
    const width = Math.round(this.width * scale);
    const height = Math.round(this.height * scale);
    if (this.canvas.width !== width || this.canvas.height !== height) {
      this.canvas.width = width;
      this.canvas.height = height;
    }
    this.pen.setTransform(scale, 0, 0, scale, 0, 0);
    return this.width > 0 && this.height > 0;
  }

  get right() {
    return this.width - RIGHT;
  }

  get bottom() {
    return this.height - BOTTOM;
  }

  /** @param {number} value */
  x(value) {
    return LEFT + part(value, this.across) * (this.right - LEFT);
  }

  /** @param {number} value */
  y(value) {
    return this.bottom - part(value, this.up) * (this.bottom - TOP);
  }

  /** The value of an axis at a place of the canvas, in its pixels. @param {number} pixel */
  valueAcross(pixel) {
    return valueAt((pixel - LEFT) / (this.right - LEFT), this.across);
  }

  /** @param {number} pixel */
  valueUp(pixel) {
    return valueAt((this.bottom - pixel) / (this.bottom - TOP), this.up);
  }

  /**
   * A new picture with these axes.
   *
   * @param {Axis} across
   * @param {Axis} up
   */
  begin(across, up) {
    this.across = across;
    this.up = up;
    this.pen.clearRect(0, 0, this.width, this.height);
    this.pen.lineJoin = "round";
    this.pen.font = FONT;
  }

  /** The lines of the ticks and what is written on them; after areas, so that they are seen. */
  axes() {
    const { pen, across, up } = this;
    pen.strokeStyle = colours.line;
    pen.fillStyle = colours.soft;
    pen.lineWidth = 1;
    pen.textAlign = "right";
    pen.textBaseline = "middle";
    for (const tick of ticksOf(up, (this.bottom - TOP) / TICK_Y)) {
      const y = Math.round(this.y(tick)) + 0.5;
      this.#stroke(LEFT, y, this.right, y, tick === 0 ? colours.soft : colours.line);
      pen.fillText(plainDigits(tick), LEFT - 8, y);
    }
    pen.textAlign = "center";
    pen.textBaseline = "top";
    for (const tick of ticksOf(across, (this.right - LEFT) / TICK_X)) {
      const x = Math.round(this.x(tick)) + 0.5;
      this.#stroke(x, this.bottom, x, this.bottom + 5, colours.soft);
      pen.fillText(plainDigits(tick), Math.min(x, this.width - 18), this.bottom + 8);
    }
    this.#stroke(LEFT, this.bottom + 0.5, this.right, this.bottom + 0.5, colours.soft);
    pen.textAlign = "right";
    pen.fillText(across.title, this.right, this.bottom + 25);
    pen.save();
    pen.translate(12, TOP);
    pen.rotate(-Math.PI / 2);
    pen.textAlign = "right";
    pen.textBaseline = "middle";
    pen.fillText(up.title, 0, 0);
    pen.restore();
  }

  /**
   * @param {number} x
   * @param {number} y
   * @param {number} toX
   * @param {number} toY
   * @param {string} colour
   */
  #stroke(x, y, toX, toY, colour) {
    this.pen.strokeStyle = colour;
    this.pen.beginPath();
    this.pen.moveTo(x, y);
    this.pen.lineTo(toX, toY);
    this.pen.stroke();
  }

  /** Draw only within the axes. @param {() => void} draw */
  inside(draw) {
    this.pen.save();
    this.pen.beginPath();
    this.pen.rect(LEFT, TOP, this.right - LEFT, this.bottom - TOP);
    this.pen.clip();
    draw();
    this.pen.restore();
  }

  /**
   * A line; it has gaps where there are no numbers.
   *
   * @param {ArrayLike<number>} xs
   * @param {ArrayLike<number>} ys
   * @param {string} colour
   * @param {{ width?: number, dash?: number[] }} [style]
   */
  line(xs, ys, colour, { width = 2, dash = [] } = {}) {
    const { pen } = this;
    pen.strokeStyle = colour;
    pen.lineWidth = width;
    pen.setLineDash(dash);
    pen.beginPath();
    let isDown = false;
    for (let place = 0; place < xs.length; place += 1) {
      const y = this.y(ys[place]);
      if (!Number.isFinite(y)) isDown = false;
      else if (isDown) pen.lineTo(this.x(xs[place]), y);
      else {
        pen.moveTo(this.x(xs[place]), y);
        isDown = true;
      }
    }
    pen.stroke();
    pen.setLineDash([]);
  }

  /**
   * @param {ArrayLike<number>} xs
   * @param {ArrayLike<number>} lows
   * @param {ArrayLike<number>} highs
   * @param {string} colour
   */
  area(xs, lows, highs, colour) {
    const { pen } = this;
    pen.fillStyle = colour;
    pen.beginPath();
    let first = 0;
    while (first < xs.length) {
      let end = first;
      while (end < xs.length && Number.isFinite(lows[end]) && Number.isFinite(highs[end])) end += 1;
      for (let place = first; place < end; place += 1) {
        if (place === first) pen.moveTo(this.x(xs[place]), this.y(highs[place]));
        else pen.lineTo(this.x(xs[place]), this.y(highs[place]));
      }
      for (let place = end - 1; place >= first; place -= 1) pen.lineTo(this.x(xs[place]), this.y(lows[place]));
      if (end > first) pen.closePath();
      first = end + 1;
    }
    pen.fill();
  }

  /**
   * An area that is seen through, with lines at its ends.
   *
   * @param {ArrayLike<number>} xs
   * @param {ArrayLike<number>} lows
   * @param {ArrayLike<number>} highs
   * @param {string} colour
   */
  band(xs, lows, highs, colour) {
    this.pen.globalAlpha = 0.2;
    this.area(xs, lows, highs, colour);
    this.pen.globalAlpha = 1;
    for (const row of [lows, highs]) this.line(xs, row, colour, { width: 1 });
  }

  /**
   * Shade where the model does not hold: stripes, so that it is told from an area.
   *
   * @param {ArrayLike<number>} xs
   * @param {ArrayLike<number>} valid
   */
  shade(xs, valid) {
    let first = 0;
    while (first < xs.length) {
      let end = first;
      while (end < xs.length && valid[end] !== 1) end += 1;
      if (end > first) {
        const from = first === 0 ? this.x(xs[0]) : (this.x(xs[first - 1]) + this.x(xs[first])) / 2;
        const to = end === xs.length ? this.x(xs[end - 1]) : (this.x(xs[end - 1]) + this.x(xs[end])) / 2;
        this.stripes(Math.min(from, to), TOP, Math.abs(to - from), this.bottom - TOP);
      }
      first = end + 1;
    }
  }

  /**
   * @param {number} x
   * @param {number} y
   * @param {number} width
   * @param {number} height
   * @param {string} [colour]
   */
  stripes(x, y, width, height, colour = colours.careful) {
    const { pen } = this;
    pen.save();
    pen.beginPath();
    pen.rect(x, y, width, height);
    pen.clip();
    pen.globalAlpha = 0.1;
    pen.fillStyle = colour;
    pen.fillRect(x, y, width, height);
    pen.globalAlpha = 0.45;
    pen.strokeStyle = colour;
    pen.lineWidth = 1;
    pen.beginPath();
    for (let place = x - height - ((x - height) % 9); place < x + width; place += 9) {
      pen.moveTo(place, y + height);
      pen.lineTo(place + height, y);
    }
    pen.stroke();
    pen.restore();
  }

  /**
   * Shade along a line where the model does not hold.
   *
   * @param {ArrayLike<number>} xs
   * @param {ArrayLike<number>} ys
   */
  halo(xs, ys) {
    this.pen.globalAlpha = 0.25;
    this.line(xs, ys, colours.careful, { width: 11 });
    this.pen.globalAlpha = 1;
  }

  /** A line across the chart at a height. @param {number} value */
  level(value) {
    const y = Math.round(this.y(value)) + 0.5;
    this.pen.setLineDash([4, 4]);
    this.#stroke(LEFT, y, this.right, y, colours.soft);
    this.pen.setLineDash([]);
  }

  /**
   * The operating point.
   *
   * @param {number} x
   * @param {number} y
   */
  point(x, y) {
    const { pen } = this;
    const [at, high] = [this.x(x), this.y(y)];
    if (!(at >= LEFT - 1 && at <= this.right + 1)) return;
    pen.setLineDash([3, 3]);
    this.#stroke(at, TOP, at, this.bottom, colours.ink);
    pen.setLineDash([]);
    if (!Number.isFinite(high)) return;
    pen.beginPath();
    pen.arc(at, high, 6, 0, 2 * Math.PI);
    pen.fillStyle = colours.panel;
    pen.fill();
    pen.lineWidth = 3;
    pen.strokeStyle = colours.accent;
    pen.stroke();
    pen.lineWidth = 1;
  }

  /**
   * A map of numbers by rows and columns, in the middle of whose cells the values of the axes lie.
   *
   * @param {ArrayLike<number>} xs
   * @param {ArrayLike<number>} ys
   * @param {(row: number, column: number) => { colour: string, isValid: boolean }} cell
   */
  cells(xs, ys, cell) {
    const { pen } = this;
    const width = Math.abs(this.x(xs[1]) - this.x(xs[0]));
    const height = Math.abs(this.y(ys[1]) - this.y(ys[0]));
    const outside = new Path2D();
    for (let row = 0; row < ys.length; row += 1) {
      for (let column = 0; column < xs.length; column += 1) {
        const { colour, isValid } = cell(row, column);
        const x = this.x(xs[column]) - width / 2;
        const y = this.y(ys[row]) - height / 2;
        pen.fillStyle = colour;
        pen.fillRect(x, y, width + 0.6, height + 0.6);
        if (!isValid) outside.rect(x, y, width, height);
      }
    }
    pen.save();
    pen.clip(outside);
    this.stripes(LEFT, TOP, this.right - LEFT, this.bottom - TOP, MAP_STRIPES);
    pen.restore();
  }
}

/** @param {number} value @param {Axis} axis */
function part(value, { from, to, log }) {
  if (log) return (Math.log10(value) - Math.log10(from)) / (Math.log10(to) - Math.log10(from));
  return (value - from) / (to - from);
}

/** @param {number} share @param {Axis} axis */
function valueAt(share, { from, to, log }) {
  const within = Math.max(0, Math.min(1, share));
  if (log) return 10 ** (Math.log10(from) + within * (Math.log10(to) - Math.log10(from)));
  return from + within * (to - from);
}
