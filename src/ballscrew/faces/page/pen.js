// Two pens with which charts are drawn: one on a canvas of the screen, one that writes SVG.

/** Points of a path in pixels; nothing lifts the pen. @typedef {([number, number] | null)[]} Path */
/** @typedef {{ stroke?: string, width?: number, dash?: number[], fill?: string, opacity?: number }} Style */
/** @typedef {{ colour: string, anchor?: "start" | "middle" | "end", angle?: number, size?: number, bold?: boolean, halo?: string }} TextStyle */
/** @typedef {{ left: number, top: number, right: number, bottom: number }} Box */
/**
 * What draws: closed paths are filled, texts stand in the middle of their height, ``inside`` draws within a box alone.
 *
 * @typedef {object} Pen
 * @property {(path: Path, style: Style, isClosed?: boolean) => void} path
 * @property {(x: number, y: number, radius: number, style: Style) => void} circle
 * @property {(words: string, x: number, y: number, style: TextStyle) => void} text
 * @property {(box: Box, draw: () => void) => void} inside
 */

const FAMILY = 'system-ui, "Segoe UI", "DejaVu Sans", sans-serif';
const SIZE = 12;
/** Size of small letters, and the height of an area that has room for them. */
export const [SMALL, ROOM] = [11, 17];
/** Width of the light edge around a text. */
const EDGE = 3;
/** Width of a letter by its height, where nothing can measure it. */
const LETTER = 0.56;

/** The width of a text, about. @param {string} words @param {number} [size] */
export function widthOf(words, size = SIZE) {
  return LETTER * size * words.length;
}

/** The corners of a box. @param {Box} box @returns {Path} */
export function corners({ left, top, right, bottom }) {
  return [
    [left, top],
    [right, top],
    [right, bottom],
    [left, bottom],
  ];
}

/** A pen on a canvas that has ``scale`` dots a pixel. @implements {Pen} */
export class CanvasPen {
  /** @param {HTMLCanvasElement} canvas @param {number} width @param {number} height @param {number} scale */
  constructor(canvas, width, height, scale) {
    const [across, down] = [Math.round(width * scale), Math.round(height * scale)];
    if (canvas.width !== across || canvas.height !== down) Object.assign(canvas, { width: across, height: down });
    this.context = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d"));
    this.context.setTransform(scale, 0, 0, scale, 0, 0);
    this.context.clearRect(0, 0, width, height);
    this.context.lineJoin = "round";
    this.context.textBaseline = "middle";
  }

  /** @type {Pen["path"]} */
  path(path, style, isClosed = false) {
    const { context } = this;
    context.beginPath();
    let isDown = false;
    for (const point of path) {
      if (!point) isDown = false;
      else if (isDown) context.lineTo(point[0], point[1]);
      else {
        context.moveTo(point[0], point[1]);
        isDown = true;
      }
    }
    if (isClosed) context.closePath();
    this.#ink(style);
  }

  /** @type {Pen["circle"]} */
  circle(x, y, radius, style) {
    this.context.beginPath();
    this.context.arc(x, y, radius, 0, 2 * Math.PI);
    this.#ink(style);
  }

  /** @param {Style} style */
  #ink({ stroke, width = 1, dash = [], fill, opacity = 1 }) {
    const { context } = this;
    context.globalAlpha = opacity;
    if (fill) {
      context.fillStyle = fill;
      context.fill();
    }
    if (stroke) {
      context.strokeStyle = stroke;
      context.lineWidth = width;
      context.setLineDash(dash);
      context.stroke();
    }
    context.globalAlpha = 1;
  }

  /** @type {Pen["text"]} */
  text(words, x, y, { colour, anchor = "start", angle = 0, size = SIZE, bold = false, halo }) {
    const { context } = this;
    context.save();
    context.translate(x, y);
    context.rotate(angle);
    context.font = `${bold ? "bold " : ""}${size}px ${FAMILY}`;
    context.textAlign = anchor === "middle" ? "center" : anchor;
    if (halo) {
      context.setLineDash([]);
      context.lineWidth = EDGE;
      context.strokeStyle = halo;
      context.strokeText(words, 0, 0);
    }
    context.fillStyle = colour;
    context.fillText(words, 0, 0);
    context.restore();
  }

  /** @type {Pen["inside"]} */
  inside({ left, top, right, bottom }, draw) {
    this.context.save();
    this.context.beginPath();
    this.context.rect(left, top, right - left, bottom - top);
    this.context.clip();
    draw();
    this.context.restore();
  }
}

/** A pen that writes SVG. @implements {Pen} */
export class SvgPen {
  /** @type {string[]} */
  #parts = [];
  #clips = 0;

  /** @param {number} width @param {number} height */
  constructor(width, height) {
    this.width = width;
    this.height = height;
  }

  /** @type {Pen["path"]} */
  path(path, style, isClosed = false) {
    let isDown = false;
    const steps = path.map((point) => {
      const letter = isDown ? "L" : "M";
      isDown = Boolean(point);
      return point ? `${letter}${rounded(point[0])} ${rounded(point[1])}` : "";
    });
    if (steps.length) this.#parts.push(`<path d="${steps.join("")}${isClosed ? "Z" : ""}"${ink(style)}/>`);
  }

  /** @type {Pen["circle"]} */
  circle(x, y, radius, style) {
    this.#parts.push(`<circle cx="${rounded(x)}" cy="${rounded(y)}" r="${rounded(radius)}"${ink(style)}/>`);
  }

  /** @type {Pen["text"]} */
  text(words, x, y, { colour, anchor = "start", angle = 0, size = SIZE, bold = false, halo }) {
    const turn = angle ? ` rotate(${rounded((angle * 180) / Math.PI)})` : "";
    const edge = halo ? ` stroke="${halo}" stroke-width="${EDGE}" paint-order="stroke"` : "";
    const font = `font-size="${size}"${bold ? ' font-weight="bold"' : ""} text-anchor="${anchor}"`;
    const place = `transform="translate(${rounded(x)} ${rounded(y)})${turn}" dominant-baseline="central"`;
    this.#parts.push(`<text ${place} ${font} fill="${colour}"${edge}>${escaped(words)}</text>`);
  }

  /** @type {Pen["inside"]} */
  inside({ left, top, right, bottom }, draw) {
    this.#clips += 1;
    const [id, width, height] = [`inside-${this.#clips}`, rounded(right - left), rounded(bottom - top)];
    const box = `<rect x="${rounded(left)}" y="${rounded(top)}" width="${width}" height="${height}"/>`;
    this.#parts.push(`<clipPath id="${id}">${box}</clipPath><g clip-path="url(#${id})">`);
    draw();
    this.#parts.push("</g>");
  }

  /** The whole picture. @param {string} title @param {string} background */
  document(title, background) {
    const size = `width="${this.width}" height="${this.height}" viewBox="0 0 ${this.width} ${this.height}"`;
    const paper = `<rect width="100%" height="100%" fill="${background}"/>`;
    const family = escaped(FAMILY);
    return `<svg xmlns="http://www.w3.org/2000/svg" ${size} font-family="${family}"><title>${escaped(title)}</title>${paper}${this.#parts.join("")}</svg>\n`;
  }
}

/** @param {Style} style */
function ink({ stroke, width = 1, dash = [], fill, opacity = 1 }) {
  const line = stroke ? ` stroke="${stroke}" stroke-width="${width}"` : "";
  const dashes = stroke && dash.length ? ` stroke-dasharray="${dash.join(" ")}"` : "";
  return ` fill="${fill ?? "none"}"${line}${dashes}${opacity < 1 ? ` opacity="${opacity}"` : ""}`;
}

/** @param {number} value */
function rounded(value) {
  return String(Math.round(100 * value) / 100);
}

/** A text as markup. @param {string} words */
function escaped(words) {
  return words.replaceAll("&", "&amp;").replaceAll("<", "&lt;").replaceAll('"', "&quot;");
}
