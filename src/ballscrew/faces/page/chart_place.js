// A chart in its place: drawn on a canvas, read below the pointer, with its legend, its numbers as a table, and both as files.

import { button } from "./controls.js";
import { byId, csv, element, table, update, within } from "./dom.js";
import { drawFigure } from "./figure.js";
import { vertical } from "./figure_marks.js";
import { follow } from "./figure_pointer.js";
import { legendOf, numbersOf, readingElement } from "./figure_words.js";
import * as point from "./operating_point.js";
import { forget, ofScreen, PAPER, shade } from "./palette.js";
import { CanvasPen, corners, SvgPen, widthOf } from "./pen.js";
import { save } from "./saving.js";

/** @import { Figure, Frame } from "./figure.js" */
/** @import { Palette } from "./palette.js" */
/** @typedef {{ width: number, height: number }} Size */
/**
 * A chart: a name for its files, a description, a caption of its numbers, and its figure.
 *
 * @typedef {object} Chart
 * @property {string} name
 * @property {string} description
 * @property {string} caption
 * @property {Figure} figure
 * @property {() => import("./figure_words.js").Numbers} [numbers] where they are not those of the figure
 * @property {point.Handle} [drag] what moves its operating point, where that can be dragged
 */

/** Size of a chart on paper, in a file, and dots of a pixel on paper. */
const ON_PAPER = { width: 660, height: 210 };
const IN_FILE = { width: 900, height: 480 };
const FINE = 3;
/** Height of a line of the legend of a file. */
const LINE = 20;
/** Pixels between the pointer and what is read there. */
const GAP = 14;

/** How charts are drawn while something moves: with the axes as they are, where one of them is under the hand. */
const moving = { isHeld: false };
/** The places of charts. @type {WeakMap<Element, Place>} */
const places = new WeakMap();
const seen = new IntersectionObserver(
  (entries) => {
    for (const { target, isIntersecting } of entries) placeOf(target).look(isIntersecting);
  },
  { rootMargin: "250px" },
);
const sized = new ResizeObserver((entries) => {
  for (const { target } of entries) places.get(/** @type {Element} */ (target.parentElement))?.resize();
});

/** The place of a chart. */
class Place {
  /** @type {Chart | undefined} */
  #chart;
  /** @type {Frame | undefined} */
  #frame;
  /** @type {import("./figure.js").Ranges} */
  #ranges = {};
  /** @type {Size | undefined} */
  #size;
  /** A part that is being selected, from corner to corner. @type {[number, number, number, number] | undefined} */
  #selected;
  /** Where the operating point is dragged to. @type {[number, number] | undefined} */
  #dragged;
  /** The pixel of the horizontal axis that is read. @type {number | undefined} */
  #read;
  #isPending = false;
  isSeen = false;

  /** @param {HTMLElement} holder */
  constructor(holder) {
    this.holder = holder;
    seen.observe(holder);
  }

  /** @param {boolean} isSeen */
  look(isSeen) {
    this.isSeen = isSeen;
    if (isSeen && this.#isPending) this.paint();
  }

  resize() {
    this.#size = undefined;
    if (this.isSeen) this.paint();
    else this.#isPending = true;
  }

  /** @param {Chart} chart */
  show(chart) {
    const before = this.#chart?.figure;
    this.#chart = chart;
    this.holder.hidden = false;
    this.holder.classList.remove("behind");
    if (!this.holder.querySelector(".plot")) this.#build(chart);
    if (before && isAnother(before, chart.figure)) this.#enlarge({});
    within(this.holder, ".plot").setAttribute("aria-label", chart.description);
    this.#showLegend(ofScreen());
    this.#showNumbers();
    if (this.isSeen) this.paint();
    else this.#isPending = true;
  }

  /** There is nothing to show any more. */
  clear() {
    this.#chart = this.#frame = undefined;
    this.#ranges = {};
    this.#isPending = false;
  }

  /** @param {Palette} [palette] @param {Size} [size] of paper */
  paint(palette = ofScreen(), size) {
    this.#isPending = false;
    const plot = this.holder.querySelector(".plot");
    const [canvas, above] = plot?.querySelectorAll("canvas") ?? [];
    if (!this.#chart || !plot || !canvas || !above) return;
    this.#size ??= { width: plot.clientWidth, height: plot.clientHeight };
    const { width, height } = size ?? this.#size;
    if (!width || !height) {
      this.#size = undefined;
      this.#isPending = true;
      return;
    }
    const pen = new CanvasPen(canvas, width, height, size ? FINE : globalThis.devicePixelRatio || 1);
    const figure = this.#figure(this.#chart);
    const held = this.#frame && moving.isHeld ? rangesOf(this.#frame) : this.#ranges;
    this.#frame = drawFigure(pen, figure, { width, height }, palette, held);
    if (!size) this.#paintPointer();
    else above.width = 0; // nothing is pointed at on paper
    // as it is drawn, for those who look from outside
    Object.assign(plot, { drawn: { figure, frame: this.#frame } });
    /** @type {HTMLElement} */ (plot).dataset.drawn = "";
  }

  /** What is drawn: the operating point where it is dragged to. @param {Chart} chart @returns {Figure} */
  #figure({ figure }) {
    const at = this.#dragged;
    if (!at) return figure;
    return {
      ...figure,
      marks: figure.marks.map((mark) => (mark.kind === "point" ? { ...mark, x: at[0], y: at[1] } : mark)),
    };
  }

  /** Draw what the pointer does over the chart: where it reads, and the part that it draws out. */
  #paintPointer() {
    const above = this.holder.querySelectorAll("canvas")[1];
    if (!above || !this.#size || !this.#frame) return;
    const { box } = this.#frame;
    const { soft, accent } = ofScreen();
    const pen = new CanvasPen(above, this.#size.width, this.#size.height, globalThis.devicePixelRatio || 1);
    if (this.#selected) {
      const [left, top, right, bottom] = this.#selected;
      pen.inside(box, () => {
        pen.path(corners({ left, top, right, bottom }), { fill: accent, stroke: accent, opacity: 0.25 }, true);
      });
    } else if (this.#read !== undefined) {
      pen.path(vertical(this.#read, box), { stroke: soft, dash: [3, 3] });
    }
  }

  /** @param {import("./figure.js").Ranges} ranges */
  #enlarge(ranges) {
    this.#ranges = Object.keys(ranges).length ? { ...this.#ranges, ...ranges } : {};
    within(this.holder, "button.whole").hidden = !Object.keys(ranges).length;
    if (this.#frame) this.paint();
  }

  /** @param {Palette} palette */
  #showLegend(palette) {
    if (!this.#chart) return;
    const items = legendOf(this.#chart.figure).map(({ kind, name, colour, value }) => {
      const key = element("span", { class: `key ${kind}`, "aria-hidden": "true" });
      key.style.color = shade(colour, palette);
      return element("li", {}, key, element("span", {}, name), value?.cloneNode(true));
    });
    update(within(this.holder, "ul.legend"), ...items);
  }

  #numbers() {
    const chart = /** @type {Chart} */ (this.#chart);
    return chart.numbers ? chart.numbers() : numbersOf(chart.figure);
  }

  /** Show the table of numbers, where it is open. */
  #showNumbers() {
    const details = this.holder.querySelector("details");
    if (!this.#chart || !details?.open) return;
    const [headings, rows] = this.#numbers();
    const rounded = rows.map((cells) =>
      cells.map((cell) => (typeof cell === "number" ? String(Number(cell.toPrecision(5))) : String(cell ?? ""))),
    );
    const scroll =
      details.querySelector(".scroll") ?? element("div", { class: "scroll", tabindex: "0", role: "region" });
    scroll.setAttribute("aria-label", this.#chart.caption);
    scroll.replaceChildren(table(this.#chart.caption, headings, rounded));
    details.append(scroll);
  }

  /** Draw it again, for paper or for the screen. @param {Palette} palette @param {Size} [size] */
  redraw(palette, size) {
    this.#showLegend(palette);
    const tall = this.holder.style.getPropertyValue("--plot-height");
    this.paint(palette, size && { ...size, height: Math.max(size.height, Number.parseFloat(tall) || 0) });
  }

  #saveSvg() {
    const { name, description, figure } = /** @type {Chart} */ (this.#chart);
    const height = Math.max(
      IN_FILE.height,
      Number.parseFloat(this.holder.style.getPropertyValue("--plot-height")) || 0,
    );
    const lines = linesOf(legendOf(figure), IN_FILE.width);
    const pen = new SvgPen(IN_FILE.width, height + LINE * lines.length + LINE / 2);
    drawFigure(pen, figure, { ...IN_FILE, height }, PAPER, this.#ranges);
    for (const [row, entries] of lines.entries()) {
      let x = 2 * LINE;
      for (const { name: words, colour } of entries) {
        const top = height + LINE * row + 2;
        pen.path(corners({ left: x, right: x + 14, top, bottom: top + 10 }), { fill: shade(colour, PAPER) }, true);
        pen.text(words, x + 20, top + 5, { colour: PAPER.ink });
        x += widthOf(words) + 2 * LINE;
      }
    }
    save(`-${name}.svg`, new Blob([pen.document(description, PAPER.panel)], { type: "image/svg+xml" }));
  }

  /** @param {Chart} chart */
  #build({ name }) {
    const words = name.replaceAll("_", " "); // many charts have the same buttons
    const summary = element("summary", {}, "Numbers", element("span", { class: "hidden" }, `: ${words}`));
    const details = element("details", {}, summary);
    details.addEventListener("toggle", () => this.#showNumbers());
    /** @param {string} label @param {() => void} action @param {import("./dom.js").Attributes} [more] */
    const act = (label, action, more) => button(label, action, { "aria-label": `${label}: ${words}`, ...more });
    const saveCsv = () =>
      this.#chart && save(`-${this.#chart.name}.csv`, new Blob([csv(...this.#numbers())], { type: "text/csv" }));
    const showWhole = () => {
      this.#enlarge({});
      summary.focus(); // the button is gone
    };
    const reading = element("div", { class: "reading", hidden: true });
    const plot = element("div", { class: "plot", role: "img" }, element("canvas"), element("canvas"), reading);
    this.holder.replaceChildren(
      plot,
      element("ul", { class: "legend" }),
      element(
        "div",
        { class: "beside" },
        details,
        act("Whole chart", showWhole, { class: "whole", hidden: true }),
        act("CSV", saveCsv),
        act("SVG", () => this.#saveSvg()),
      ),
    );
    sized.observe(plot);
    this.#followPointer(plot, reading);
  }

  /** @param {HTMLElement} plot @param {HTMLElement} reading */
  #followPointer(plot, reading) {
    const frame = () => this.#frame;
    follow({
      plot,
      drawn: () => {
        const there = frame();
        return (
          there &&
          this.#chart && { figure: this.#figure(this.#chart), frame: there, canDrag: Boolean(this.#chart.drag) }
        );
      },
      read: (found, x, y) => {
        if (!found && reading.hidden) return;
        reading.hidden = !found;
        this.#read = found?.across;
        if (found) {
          reading.replaceChildren(...readingElement(found, (colour) => shade(colour, ofScreen())));
          const { width = 0, height = 0 } = this.#size ?? {};
          const left = x > width / 2 ? x - GAP - reading.offsetWidth : x + GAP;
          reading.style.setProperty("left", `${Math.max(0, left)}px`);
          reading.style.setProperty("top", `${Math.max(0, Math.min(y, height - reading.offsetHeight))}px`);
        }
        this.#paintPointer();
      },
      select: (ends) => {
        this.#selected = ends;
        this.#paintPointer();
      },
      enlarge: (ranges) => this.#enlarge(ranges),
      drag: (at) => {
        const handle = this.#chart?.drag;
        if (!handle) return;
        this.#dragged = handle.place(...at);
        if (!point.isFollowed(handle, this.#dragged)) this.paint(); // nobody else draws it there
      },
      drop: (isDropped) => {
        const [handle, at] = [this.#chart?.drag, this.#dragged];
        this.#dragged = undefined;
        if (isDropped && handle && at) point.take(handle, at);
        else {
          if (handle) point.letGo();
          this.paint();
        }
      },
    });
  }
}

/** Test whether a figure is of something else than the one before: other axes, or from elsewhere on. @param {Figure} before @param {Figure} figure */
function isAnother(before, figure) {
  const key = (/** @type {Figure} */ { x, y, marks }) => {
    const along = marks.flatMap((mark) => ("x" in mark && Array.isArray(mark.x) ? [[mark.x[0], mark.x.at(-1)]] : []));
    return JSON.stringify([x.title, y.title, along[0]]);
  };
  return key(before) !== key(figure);
}

/** The ends of the axes of what is drawn. @param {Frame} frame @returns {import("./figure.js").Ranges} */
function rangesOf({ x, y }) {
  return { x: [x.from, x.to], y: [y.from, y.to] };
}

/**
 * The entries of a legend in lines of a width.
 *
 * @param {ReturnType<typeof legendOf>} entries
 * @param {number} width
 */
function linesOf(entries, width) {
  /** @type {ReturnType<typeof legendOf>[]} */
  const lines = [];
  let left = 0;
  for (const entry of entries) {
    const own = widthOf(entry.name) + 2 * LINE;
    if (own > left) {
      lines.push([]);
      left = width - 2 * LINE;
    }
    lines[lines.length - 1].push(entry);
    left -= own;
  }
  return lines;
}

/** The place of a chart, which is made when it is first asked for. @param {Element} holder */
function placeOf(holder) {
  const found = places.get(holder) ?? new Place(/** @type {HTMLElement} */ (holder));
  places.set(holder, found);
  return found;
}

/** Draw all charts of the page again. @param {() => Palette} palette @param {Size} [size] */
function redrawAll(palette, size) {
  for (const holder of document.querySelectorAll(".chart")) places.get(holder)?.redraw(palette(), size);
}

/** Draw all charts on paper, those that nobody has seen as well. */
function drawOnPaper() {
  redrawAll(() => PAPER, ON_PAPER);
}

/** Draw all charts on the screen, whose colours may be others now. */
export function drawOnScreen() {
  forget();
  redrawAll(ofScreen);
}

for (const holder of document.querySelectorAll(".chart")) placeOf(holder);
addEventListener("beforeprint", drawOnPaper);
addEventListener("afterprint", drawOnScreen);
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", drawOnScreen);

/** Draw a chart in its place: at once where that is seen, else when it is. @param {string} id @param {Chart} chart */
export function draw(id, chart) {
  const holder = document.getElementById(id);
  if (holder) placeOf(holder).show(chart);
}

/**
 * Draw charts of what moves. Those that are not are dimmed.
 *
 * @param {string[]} ids of charts that are moved
 * @param {boolean} isHeld whether axes stay as they are, since one of them is under the hand
 * @param {() => void} work
 */
export function move(ids, isHeld, work) {
  moving.isHeld = isHeld;
  for (const id of ids) byId(id).classList.add("behind");
  try {
    work();
  } finally {
    moving.isHeld = false;
  }
}

/** Test whether a place is in or near the viewport. @param {string} id */
export function isVisible(id) {
  return placeOf(byId(id)).isSeen;
}

/** Take a chart away, of which there is nothing to show. @param {string} id */
export function hide(id) {
  placeOf(byId(id)).clear();
  byId(id).hidden = true;
}

/** Words in place of a chart. @param {string} id @param {string} words */
export function showWords(id, words) {
  placeOf(byId(id)).clear();
  byId(id).replaceChildren(element("p", { class: "warning" }, words));
}

/** The reason in place of a chart that could not be computed. @param {string} id @param {string} reason */
export function showFailure(id, reason) {
  showWords(id, `This chart could not be computed: ${reason}`);
}
