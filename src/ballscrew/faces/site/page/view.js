// A chart with its heading, its numbers as a table, and what is said of it.

import { Plot } from "./plot.js";
import { digitsOf, element } from "./words.js";

/** @typedef {import("./case.js").Case} Case */
/** @typedef {Record<string, Float64Array>} Columns */
/**
 * What a chart is of: the case, its numbers at the operating point in SI, and the model.
 *
 * @typedef {{
 *   case: Case, inputs: Record<string, number>, outputs: Record<string, number>,
 *   evaluate: (changes: Record<string, number | ArrayLike<number>>, count: number) => Columns,
 *   oil: (kelvin: ArrayLike<number>) => Columns,
 *   count: (whole: number, least: number) => number,
 *   range: (name: string) => { min: number, max: number },
 *   change: (name: string, shown: number) => void,
 *   judged: (ReturnType<typeof import("./judgements.js").recordsOf> & { derived: Record<string, any> }) | undefined,
 *   give: (name: string, shown: number | string | undefined) => void,
 *   banded: () => import("./banding.js").Banded,
 * }} Scene
 */
/** @typedef {{ caption: string, head: string[], rows: number[][] }} Numbers */

/** The rows of a table at most. */
const ROWS = 21;

/**
 * The reasons for which the model does not hold at any of the points.
 *
 * @param {Case} one
 * @param {Record<string, ArrayLike<number>>} found
 * @returns {string[]}
 */
export function reasonsIn(one, found) {
  return Object.entries(one.contents.reasons)
    .filter(([name]) => {
      const holds = found[`validity_${name}`];
      return holds !== undefined && Array.prototype.some.call(holds, (value) => value !== 1);
    })
    .map(([, words]) => words);
}

/** Numbers in the unit they are shown in. @param {ArrayLike<number>} numbers @param {{ factor: number, offset: number }} quantity */
export function inShownUnit(numbers, { factor, offset }) {
  return Float64Array.from(numbers, (value) => (value - offset) / factor);
}

/** @param {ArrayLike<number>} numbers @param {{ factor: number, offset: number }} quantity */
export function inSiUnit(numbers, { factor, offset }) {
  return Float64Array.from(numbers, (value) => value * factor + offset);
}

export class View {
  /** @type {Plot | undefined} */
  plot;
  isDirty = true;
  isSeen = false;

  /**
   * @param {Scene} scene
   * @param {string} id
   * @param {{ heading: string, hint?: string, hasCanvas?: boolean }} options
   */
  constructor(scene, id, { heading, hint = "", hasCanvas = true }) {
    this.scene = scene;
    this.words = { heading, hint };
    this.heading = element("h2", { id: `${id}-heading` });
    this.hint = element("p", { class: "hint" });
    this.note = element("p", { class: "shaded" });
    this.legend = element("ul", { class: "legend" });
    this.table = element("table");
    this.section = element(
      "section",
      { id, class: "card", "aria-labelledby": `${id}-heading` },
      this.heading,
      this.hint,
    );
    if (!hasCanvas) return;
    const canvas = element("canvas", { role: "img" });
    this.plot = new Plot(canvas);
    this.summary = element("summary");
    this.scroll = element("div", { class: "scroll", tabindex: "0", role: "region" }, this.table);
    this.details = element("details", { class: "numbers" }, this.summary, this.scroll);
    this.details.addEventListener("toggle", () => this.settle());
    this.section.append(element("div", { class: "picture" }, canvas), this.legend, this.note, this.details);
  }

  /** Make all words, and what depends on what is chosen. */
  build() {
    this.heading.textContent = this.words.heading;
    this.hint.textContent = this.words.hint;
    if (this.summary) this.summary.textContent = "Numbers";
    this.plot?.canvas.setAttribute("aria-label", this.words.heading); // more when it is drawn
    this.scroll?.setAttribute("aria-label", `Numbers: ${this.words.heading}`);
    this.prepare();
  }

  /** Make what depends on the structure alone, such as a legend. */
  prepare() {}

  /** Compute and draw. */
  draw() {
    this.isDirty = false;
    if (this.plot && !this.plot.measure()) return;
    this.paint();
  }

  /** Compute and draw; each chart in its own way. */
  paint() {}

  /** Write what needs no frame: the table, and the words for those who do not see the chart. */
  settle() {
    const numbers = this.numbers();
    if (!numbers || !this.plot) return;
    this.plot.canvas.setAttribute("aria-label", this.description());
    if (this.details?.open) fillTable(this.table, numbers);
  }

  /** @returns {Numbers | undefined} */
  numbers() {
    return undefined;
  }

  description() {
    return this.words.heading;
  }

  /** @param {Record<string, ArrayLike<number>>} found */
  sayShaded(found) {
    this.sayReasons(reasonsIn(this.scene.case, found));
  }

  /** @param {string[]} reasons */
  sayReasons(reasons) {
    const text = reasons.length ? `Shaded, the model does not hold: ${reasons.join("; ")}.` : "";
    if (this.note.textContent !== text) this.note.textContent = text;
  }

  /**
   * Take a number that the pointer gave.
   *
   * @param {string} name
   * @param {number} shown
   */
  take(name, shown) {
    this.scene.change(name, shown);
  }

  /**
   * Let the pointer set numbers by dragging in the chart.
   *
   * @param {string | undefined} across the field that the axis across is
   * @param {string | undefined} up
   */
  follow(across, up = undefined) {
    const { plot } = this;
    if (!plot) return;
    const { canvas } = plot;
    canvas.classList.add("draggable");
    const moved = (/** @type {PointerEvent} */ event) => {
      const box = canvas.getBoundingClientRect();
      if (across) this.take(across, plot.valueAcross(event.clientX - box.left));
      if (up) this.take(up, plot.valueUp(event.clientY - box.top));
    };
    canvas.addEventListener("pointerdown", (event) => {
      if (event.button !== 0) return;
      canvas.setPointerCapture(event.pointerId);
      moved(event);
    });
    canvas.addEventListener("pointermove", (event) => {
      if (canvas.hasPointerCapture(event.pointerId)) moved(event);
    });
  }
}

/**
 * @param {HTMLTableElement} table
 * @param {Numbers} numbers
 */
function fillTable(table, { caption, head, rows }) {
  const stride = Math.max(1, Math.floor((rows.length - 1) / (ROWS - 1)));
  const some = rows.filter((_, place) => place % stride === 0);
  const top = element("tr", {}, ...head.map((text) => element("th", { scope: "col" }, text)));
  const lines = some.map((row) => element("tr", {}, ...row.map((value) => element("td", {}, digitsOf(value)))));
  table.replaceChildren(element("caption", {}, caption), element("thead", {}, top), element("tbody", {}, ...lines));
}
