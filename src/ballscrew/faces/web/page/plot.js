// A chart in its place: the plot, its legend, its numbers as a table, and both as files.

import { byId, csv, element, table, update, within } from "./dom.js";
import { letDrag } from "./operating_point.js";
import { save } from "./saving.js";
import { sketch } from "./sketch.js";
import { text, textOr } from "./texts.js";

/** @typedef {{ ink: string, line: string, panel: string, accent: string, second: string }} Colours */
/** @typedef {Record<string, any>} Layout */
/** @typedef {{ traces: object[], layout: Layout }} Figure */
/** @typedef {{ kind: string, name: string, colour: string | undefined, value?: Node }} LegendEntry */
/**
 * A chart: a name for its files, a description, a caption of its numbers, and, made when they are needed, its figure,
 * its legend and its numbers.
 *
 * @typedef {object} Chart
 * @property {string} name
 * @property {string} description
 * @property {string} caption
 * @property {(colours: Colours) => Figure} figure
 * @property {(colours: Colours) => LegendEntry[]} legend
 * @property {() => [string[], import("./dom.js").Cell[][]]} numbers
 * @property {import("./operating_point.js").Handle} [drag] its diamond, where that can be dragged
 * @property {number} [height] of its plot, where it is not that of the page
 * @property {false} [canSketch] where only plotly can draw it
 */

const CONFIG = { responsive: true, displaylogo: false, displayModeBar: false };
const FONT = 'system-ui, "DejaVu Sans", sans-serif';
const ON_PAPER = { width: 660, height: 210 };
/** Colours of what is printed or saved: light, whatever the screen is. @type {Colours} */
const PAPER = { ink: "#1c2127", line: "#d5dade", panel: "#ffffff", accent: "#0062a0", second: "#a34a00" };

/** Colours of the screen, which has two sets of them. @returns {Colours} */
function coloursOfScreen() {
  const style = getComputedStyle(document.documentElement);
  /** @param {string} name */
  const colour = (name) => style.getPropertyValue(`--${name}`).trim();
  return {
    ink: colour("ink"),
    line: colour("line"),
    panel: colour("panel"),
    accent: colour("accent"),
    second: colour("second"),
  };
}

/**
 * End the plot in a place before it is taken away: plotly.js listens to the window for it, and so keeps it and its
 * numbers in memory.
 *
 * @param {Element} place
 */
function purge(place) {
  const plot = place.querySelector(".plot");
  if (plot) globalThis.Plotly?.purge(plot);
}

/**
 * The layout that all charts share. Margins are fixed and the legend is ours: measuring them takes plotly half of its
 * time.
 *
 * @param {Colours} colours
 * @param {string} x
 * @param {string} y
 * @param {Layout} more
 * @returns {Layout}
 */
export function layout({ ink, line, panel }, x, y, more = {}) {
  /**
   * @param {string} title
   * @param {Layout} others
   */
  const axis = (title, others) => ({
    title: { text: title, standoff: 6 },
    gridcolor: line,
    linecolor: line,
    zerolinecolor: line,
    tickformat: ".6~g",
    hoverformat: ".4~g",
    ticklabeloverflow: "allow",
    nticks: 7,
    ...others,
  });
  return {
    paper_bgcolor: "rgba(0,0,0,0)",
    plot_bgcolor: "rgba(0,0,0,0)",
    font: { color: ink, family: FONT, size: 12.5 },
    margin: { l: 72, r: 26, t: 8, b: 42 },
    separators: ".,",
    showlegend: false,
    hovermode: "x unified",
    hoverlabel: { bgcolor: panel, bordercolor: line, font: { color: ink } },
    ...more,
    xaxis: axis(x, more.xaxis),
    yaxis: axis(y, { rangemode: "tozero", ...more.yaxis }),
  };
}

/** @param {Chart} chart */
function saveCsv(chart) {
  save(`-${chart.name}.csv`, new Blob([csv(...chart.numbers())], { type: "text/csv" }));
}

/**
 * The table of numbers, where it is open.
 *
 * @param {Chart} chart
 * @param {HTMLElement} holder
 */
function showNumbers(chart, holder) {
  const details = holder.querySelector("details");
  if (!details?.open) return;
  const [headings, rows] = chart.numbers();
  const rounded = rows.map((cells) =>
    cells.map((cell) => (typeof cell === "number" ? String(Number(cell.toPrecision(5))) : String(cell ?? ""))),
  );
  const scroll = details.querySelector(".scroll") ?? element("div", { class: "scroll", tabindex: "0", role: "region" });
  scroll.setAttribute("aria-label", chart.caption);
  scroll.replaceChildren(table(chart.caption, headings, rounded));
  details.append(scroll);
}

/**
 * The legend below a chart; plotly's own, of the same class, comes before it once something has been pointed at.
 *
 * @param {string} id
 * @param {LegendEntry[]} entries
 */
function showLegend(id, entries) {
  update(within(byId(id), "ul.legend"), ...entries.map(legendItem));
}

/**
 * An entry of a legend: a key, a name and, where there is one, a value.
 *
 * @param {LegendEntry} entry
 */
function legendItem({ kind, name, colour, value }) {
  const swatch = element("span", { class: `key ${kind}`, "aria-hidden": "true" });
  swatch.style.color = colour ?? "";
  return element("li", {}, swatch, element("span", {}, name), value);
}

/** @param {Chart} chart */
async function saveSvg({ name, figure, height = 0 }) {
  const { traces, layout: own } = figure(PAPER);
  const legend = { orientation: "h", y: -0.18, yanchor: "top" };
  const more = { showlegend: true, legend, paper_bgcolor: PAPER.panel, margin: { ...own.margin, b: 110 } };
  const found = await globalThis.Plotly.toImage(
    { data: traces, layout: { ...own, ...more } },
    { format: "svg", width: 900, height: Math.max(520, height + 160) },
  );
  save(`-${name}.svg`, new Blob([decodeURIComponent(found.slice(found.indexOf(",") + 1))], { type: "image/svg+xml" }));
}

/** The charts of the page. Those outside the viewport are drawn when they come into it: that halves the time of a key press. */
class Charts {
  /** By their places. @type {Map<string, Chart>} */
  #charts = new Map();
  /** Places in or near the viewport. @type {Set<string>} */
  #visible = new Set();
  /** Places of charts that are drawn when they come into the viewport. @type {Set<string>} */
  #pending = new Set();
  /** Places that were made after the page was loaded, by their names. @type {Map<string, Element>} */
  #made = new Map();
  /** Places whose diamond can be dragged. @type {Set<string>} */
  #dragged = new Set();
  /** @type {Colours | undefined} */
  #colours;
  /** @type {Promise<void> | undefined} */
  #loading;
  /** Sizes of sketches. @type {WeakMap<HTMLCanvasElement, { width: number, height: number }>} */
  #sizes = new WeakMap();
  /** How charts are drawn while something moves. @type {{ isHeld: boolean } | undefined} */
  #moving;
  #observer = new IntersectionObserver((entries) => this.#look(entries), { rootMargin: "250px" });

  constructor() {
    for (const place of document.querySelectorAll(".chart")) this.#observer.observe(place);
    addEventListener("beforeprint", () => this.#redraw(PAPER, ON_PAPER));
    addEventListener("afterprint", () => this.#redraw(this.#screen, { autosize: true }));
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
      this.#colours = undefined;
      this.#redraw(this.#screen);
    });
  }

  get #screen() {
    this.#colours ??= coloursOfScreen();
    return this.#colours;
  }

  /** plotly.js is large: it is loaded for the first chart, which comes after the numbers and is sketched until then. */
  #loaded() {
    this.#loading ??= new Promise((resolve) => {
      const { content } = /** @type {HTMLMetaElement} */ (byId("plotly"));
      const script = element("script", { src: content });
      script.addEventListener("load", () => {
        for (const words of document.querySelectorAll(".chart > .loading")) words.remove();
        resolve();
      });
      document.head.append(script);
    });
    return this.#loading;
  }

  /**
   * Watch a place for a chart that was made after the page was loaded; one of the same name is done with.
   *
   * @param {Element} place
   */
  watch(place) {
    const before = this.#made.get(place.id);
    if (before && before !== place) {
      this.#observer.unobserve(before);
      purge(before);
    }
    this.#made.set(place.id, place);
    this.#observer.observe(place);
  }

  /**
   * Draw a chart in its place.
   *
   * @param {string} id
   * @param {Chart} chart
   */
  async draw(id, chart) {
    if (chart.canSketch !== false && (this.#moving || !globalThis.Plotly)) this.#sketch(id, chart);
    if (this.#moving) return;
    await this.#loaded();
    if (!document.getElementById(id)) return; // it was taken away meanwhile
    this.#place(id, chart);
    if (this.#visible.has(id)) await this.#show(id, this.#screen);
    else this.#postpone(id);
  }

  /** Draw a chart when it comes into the viewport. @param {string} id */
  #postpone(id) {
    this.#pending.add(id);
    byId(id).querySelector("canvas")?.remove();
  }

  /**
   * Put a chart into its place, without its plot.
   *
   * @param {string} id
   * @param {Chart} chart
   */
  #place(id, chart) {
    this.#charts.set(id, chart);
    const holder = byId(id);
    holder.hidden = false;
    holder.classList.remove("behind");
    if (!holder.querySelector(".plot")) this.#frame(id, chart, holder);
    if (chart.drag && !this.#dragged.has(id)) {
      this.#dragged.add(id);
      letDrag(id, () => this.#charts.get(id)?.drag);
    }
    within(holder, ".plot").setAttribute("aria-label", chart.description);
    showLegend(id, chart.legend(this.#screen));
    showNumbers(chart, holder);
  }

  /**
   * Draw charts at once, as sketches over their plots, until they are drawn again. Those that are not are dimmed.
   *
   * @param {string[]} ids of charts that are moved
   * @param {boolean} isHeld whether axes stay as they are, since one of them is under the hand
   * @param {() => void} work
   */
  move(ids, isHeld, work) {
    this.#moving = { isHeld };
    for (const id of ids) byId(id).classList.add("behind");
    try {
      work();
    } finally {
      this.#moving = undefined;
    }
  }

  /** @param {string} id */
  isVisible(id) {
    return this.#visible.has(id);
  }

  /**
   * @param {string} id
   * @param {Chart} chart
   */
  #sketch(id, chart) {
    this.#place(id, chart);
    if (!this.#visible.has(id)) {
      this.#postpone(id);
      return;
    }
    const holder = byId(id);
    const plot = /** @type {any} */ (within(holder, ".plot"));
    let canvas = holder.querySelector("canvas");
    let size = canvas && this.#sizes.get(canvas);
    if (!canvas || !size) {
      // its place is measured once: asking for it makes the browser lay out the page
      const { offsetLeft: left, offsetTop: top, offsetWidth: width, offsetHeight: height } = plot;
      size = { width, height };
      canvas = element("canvas", { "aria-hidden": true });
      for (const [name, value] of Object.entries({ left, top, width, height })) {
        canvas.style.setProperty(name, `${value}px`);
      }
      this.#sizes.set(canvas, size);
      holder.append(canvas);
    }
    const { xaxis, yaxis } = plot._fullLayout ?? {};
    const ranges = this.#moving?.isHeld && xaxis ? { x: xaxis.range, y: yaxis.range } : undefined;
    sketch(canvas, size, chart.figure(this.#screen), this.#screen, ranges);
  }

  /**
   * Take a chart away, of which there is nothing to show.
   *
   * @param {string} id
   */
  hide(id) {
    this.#charts.delete(id);
    this.#pending.delete(id);
    byId(id).hidden = true;
  }

  /**
   * Forget a place that was made after the page was loaded, with its chart.
   *
   * @param {string} id
   */
  remove(id) {
    this.#charts.delete(id);
    this.#pending.delete(id);
    this.#visible.delete(id);
    const place = this.#made.get(id);
    if (!place) return;
    purge(place);
    this.#observer.unobserve(place);
    this.#made.delete(id);
  }

  /**
   * Words in place of a chart.
   *
   * @param {string} id
   * @param {string} words
   */
  showWords(id, words) {
    this.#charts.delete(id);
    this.#pending.delete(id);
    purge(byId(id));
    byId(id).replaceChildren(element("p", { class: "warning" }, words));
  }

  /** @param {IntersectionObserverEntry[]} entries */
  #look(entries) {
    for (const { target, isIntersecting } of entries) {
      if (isIntersecting) this.#visible.add(target.id);
      else this.#visible.delete(target.id);
      if (isIntersecting && this.#pending.delete(target.id)) this.#show(target.id, this.#screen);
    }
  }

  /**
   * @param {string} id
   * @param {Colours} palette
   * @param {Layout} more
   */
  async #show(id, palette, more = {}) {
    const chart = this.#charts.get(id);
    if (!chart) return;
    await this.#loaded();
    const { traces, layout: own } = chart.figure(palette);
    const plot = within(byId(id), ".plot");
    await globalThis.Plotly.react(plot, traces, { ...own, ...more }, CONFIG);
    byId(id).querySelector("canvas")?.remove();
  }

  /**
   * Draw all charts again, for paper or for the screen.
   *
   * @param {Colours} palette
   * @param {Layout} [more]
   */
  #redraw(palette, more) {
    for (const [id, chart] of this.#charts) {
      this.#pending.delete(id);
      showLegend(id, chart.legend(palette));
      const height = more?.height && Math.max(more.height, chart.height ?? 0);
      this.#show(id, palette, height ? { ...more, height } : more);
    }
  }

  /**
   * @param {string} id
   * @param {Chart} chart
   * @param {HTMLElement} holder
   */
  #frame(id, { name }, holder) {
    /** @param {(chart: Chart) => void} action */
    const withChart = (action) => () => {
      const chart = this.#charts.get(id);
      if (chart) action(chart);
    };
    const words = textOr(`chart.name.${name}`, name.replaceAll("_", " ")); // five charts have the same buttons
    const summary = element("summary", {}, text("chart.numbers"), element("span", { class: "hidden" }, `: ${words}`));
    const details = element("details", {}, summary);
    details.addEventListener(
      "toggle",
      withChart((chart) => showNumbers(chart, holder)),
    );
    /**
     * @param {string} kind
     * @param {(chart: Chart) => void} action
     */
    const button = (kind, action) =>
      element("button", { type: "button", onclick: withChart(action), "aria-label": `${kind}: ${words}` }, kind);
    holder.replaceChildren(
      element("div", { class: "plot", role: "img" }),
      element("ul", { class: "legend" }),
      element("div", { class: "beside" }, details, button("CSV", saveCsv), button("SVG", saveSvg)),
    );
  }
}

const charts = new Charts();

/** @type {Charts["watch"]} */
export const watch = (place) => charts.watch(place);
/** @type {Charts["draw"]} */
export const draw = (id, chart) => charts.draw(id, chart);
/** @type {Charts["move"]} */
export const move = (ids, isHeld, work) => charts.move(ids, isHeld, work);
/** @type {Charts["isVisible"]} */
export const isVisible = (id) => charts.isVisible(id);
/** @type {Charts["hide"]} */
export const hide = (id) => charts.hide(id);
/** @type {Charts["remove"]} */
export const remove = (id) => charts.remove(id);
/** @type {Charts["showWords"]} */
export const showWords = (id, words) => charts.showWords(id, words);
/** The reason in place of a chart that could not be computed. @param {string} id @param {string} reason */
export const showFailure = (id, reason) => charts.showWords(id, text("chart.none", { reason }));
