// A part of the page: its heading, its chart, and what is said of it.

import { draw } from "../../web/page/chart_place.js";
import { element } from "../../web/page/dom.js";
import { outside, pointAt } from "../../web/page/figure_parts.js";
import { valueAt } from "../../web/page/figure_words.js";

/** @typedef {import("./case.js").Case} Case */
/** @typedef {import("../../web/page/figure.js").Figure} Figure */
/** @typedef {import("../../web/page/figure.js").Values} Values */
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
 *   floodedTorque: () => number | undefined,
 *   give: (name: string, shown: number | string | undefined) => void,
 *   banded: () => import("./banding.js").Banded,
 *   save: (name: string, content: Blob) => void,
 * }} Scene
 */

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

/** Numbers in the unit they are shown in; nothing where there is none. @param {ArrayLike<number>} numbers @param {{ factor: number, offset: number }} quantity @returns {Values} */
export function inShownUnit(numbers, { factor, offset }) {
  return Array.from(numbers, (value) => (Number.isFinite(value) ? (value - offset) / factor : null));
}

/** @param {ArrayLike<number>} numbers @param {{ factor: number, offset: number }} quantity */
export function inSiUnit(numbers, { factor, offset }) {
  return Float64Array.from(numbers, (value) => value * factor + offset);
}

/** Where the model holds. @param {ArrayLike<number>} valid */
export function holding(valid) {
  return Array.from(valid, (value) => value === 1);
}

/** Numbers at equal distances. @param {number} from @param {number} to @param {number} count */
export function evenly(from, to, count) {
  return Array.from({ length: count }, (_, place) => from + ((to - from) * place) / (count - 1));
}

export class View {
  isDirty = true;
  isSeen = false;

  /**
   * @param {Scene} scene
   * @param {string} id
   * @param {{ heading: string, hint?: string, hasChart?: boolean }} options
   */
  constructor(scene, id, { heading, hint = "", hasChart = true }) {
    this.scene = scene;
    this.id = id;
    this.heading = heading;
    this.hint = element("p", { class: "hint" }, hint);
    this.note = element("p", { class: "shaded" });
    this.chart = element("div", { class: "chart", id: `${id}-chart`, hidden: !hasChart });
    this.section = element(
      "section",
      { id, class: "card", "aria-labelledby": `${id}-heading` },
      element("h2", { id: `${id}-heading` }, heading),
      this.hint,
      this.chart,
      this.note,
    );
  }

  /** Make what depends on the structure alone. */
  prepare() {}

  /** Compute and draw. */
  draw() {
    this.isDirty = false;
    this.paint();
  }

  /** Compute and draw; each part in its own way. */
  paint() {}

  /**
   * Draw a figure, with the operating point as a handle of the numbers along its axes.
   *
   * @param {Figure} figure
   * @param {{ across?: string, up?: string, said?: string }} handle what is dragged; what is said to those who see no chart
   */
  show(figure, { across, up, said = "" } = {}) {
    const curve = figure.marks.find((mark) => mark.kind === "curve" && mark.width);
    const heightAt = (/** @type {number} */ x) =>
      curve?.kind === "curve" ? (valueAt(curve.x, curve.y, x) ?? Number.NaN) : Number.NaN;
    const move = (/** @type {[number, number]} */ at) => {
      if (across) this.take(across, at[0]);
      if (up) this.take(up, at[1]);
      return true;
    };
    const drag = across && {
      place: (/** @type {number} */ x, /** @type {number} */ y) =>
        /** @type {[number, number]} */ ([x, up ? y : heightAt(x)]),
      moved: move,
      dropped: move,
      left: () => {},
    };
    draw(`${this.id}-chart`, {
      name: this.id.replaceAll("-", "_"),
      caption: `Numbers: ${this.heading}`,
      description: [this.heading, said].filter(Boolean).join(". "),
      figure,
      drag: drag || undefined,
      save: this.scene.save,
    });
  }

  /** The operating point, and where the model does not hold. @param {Values} x @param {Columns} found @param {number} at @param {number | null} up */
  marksOf(x, found, at, up) {
    return [outside(x, holding(found.valid)), pointAt(at, up, "accent")];
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
}
