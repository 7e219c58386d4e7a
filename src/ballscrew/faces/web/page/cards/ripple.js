// The card of a ripple: the friction torque of the balls over the angle of the screw, its orders, and what faults change.
// It takes some seconds, so that it is asked for by its button.

import { element, scrollingTable } from "../dom.js";
import { documented } from "../help.js";
import { draw, layout } from "../plot.js";
import { text } from "../texts.js";
import * as units from "../units.js";
import { askedByButton } from "./asked_by_button.js";
import { data, quantity, TORQUE } from "./quantities.js";

/** @typedef {RippleAnswer["results"]} Results */

const CHART = "ripple-chart";
const ORDERS = "ripple-orders-chart";
/** Orders that are drawn, and the share of the greatest amplitude that is the least drawn. */
const MOST_ORDER = 24;
const FLOOR = 1e-4;
const BLUE = "#0072B2";
const SMALL_TORQUE = quantity("N m", "N mm");

/**
 * @param {HTMLElement} holder
 * @returns {import("../cards.js").Card}
 */
export function setUp(holder) {
  const charts = [CHART, ORDERS].map((id) => element("div", { id, class: "chart low", hidden: true }));
  const page = documented("howto/ripple", `${text("ripple.how_to")}.`);
  const about = [`${text("ripple.hypothesis")} `, page];
  return askedByButton(holder, "ripple", about, "ripple.start", charts, ({ results, assumed }) => {
    draw(CHART, overAngle(results));
    draw(ORDERS, overOrder(results));
    const list = element("ul", {}, ...assumed.map((one) => element("li", {}, one)));
    const details = element("details", { open: "" }, element("summary", {}, text("ripple.assumed")), list);
    return [sizes(results), causes(results), orders(results), details];
  });
}

/**
 * The torque over all turns: its greatest and its least value may come once in many of them.
 *
 * @param {Results} results
 * @returns {import("../plot.js").Chart}
 */
function overAngle({ torque, mean, peak_to_peak: range }) {
  const { x } = torque;
  const y = TORQUE.all(torque.y);
  const titles = /** @type {const} */ ([text("ripple.turns"), TORQUE.titled(text("ripple.torque"))]);
  return {
    name: "ripple_torque",
    caption: text("ripple.torque_caption"),
    description: text("ripple.torque_description", {
      turns: units.digits(x.at(-1), 2),
      mean: TORQUE.text(mean, 3),
      range: TORQUE.text(range, 3),
    }),
    figure: (colours) => ({
      traces: [
        {
          x,
          y,
          name: text("ripple.torque"),
          mode: "lines",
          line: { color: BLUE, width: 1.2 },
          hovertemplate: "%{y:.4g}",
        },
      ],
      layout: layout(colours, ...titles),
    }),
    legend: () => [{ kind: "line", name: text("ripple.torque"), colour: BLUE }],
    numbers: () => [[...titles], x.map((at, place) => [at, y[place]])],
  };
}

/**
 * The amplitude over the order, with the orders that have a cause.
 *
 * @param {Results} results
 * @returns {import("../plot.js").Chart}
 */
function overOrder({ spectrum, orders: named }) {
  const shown = spectrum.x.flatMap((order, place) => (Number(order) > 0 && Number(order) <= MOST_ORDER ? [place] : []));
  const x = shown.map((place) => spectrum.x[place]);
  const y = SMALL_TORQUE.all(shown.map((place) => spectrum.y[place]));
  const here = named.filter(({ order }) => Number(order) <= MOST_ORDER);
  const most = Math.max(...y.map(Number), Number.MIN_VALUE);
  const titles = /** @type {const} */ ([text("ripple.order"), SMALL_TORQUE.titled(text("ripple.amplitude"))]);
  return {
    name: "ripple_orders",
    caption: text("ripple.orders"),
    description: text("ripple.orders_description", { order: MOST_ORDER }),
    figure: (colours) => ({
      traces: [
        {
          x,
          y,
          name: text("ripple.amplitude"),
          mode: "lines",
          line: { color: BLUE, width: 1.2 },
          hovertemplate: "%{y:.3g}",
        },
      ],
      layout: layout(colours, ...titles, {
        yaxis: { type: "log", dtick: 1, rangemode: "normal", range: [FLOOR * most, 2 * most].map(Math.log10) },
        shapes: here.map(({ order }) => ({
          type: "line",
          yref: "paper",
          y0: 0,
          y1: 1,
          x0: order,
          x1: order,
          line: { color: colours.ink, width: 0.7, dash: "dot" },
        })),
      }),
    }),
    legend: (colours) => [
      { kind: "line", name: text("ripple.amplitude"), colour: BLUE },
      { kind: "dash", name: text("ripple.orders_caption"), colour: colours.ink },
    ],
    numbers: () => [[...titles], x.map((at, place) => [at, y[place]])],
  };
}

/** Mean and range of the torque, as the nut is and with each fault. @param {Results} results */
function sizes(results) {
  /** @param {string} name @param {string} label @param {Results | Results["faults"][number]} one */
  const row = (name, label, one) => [
    label,
    data(`${name}-mean`, one.mean, TORQUE.text(one.mean, 3)),
    data(`${name}-range`, one.peak_to_peak, SMALL_TORQUE.text(one.peak_to_peak, 3)),
    `${units.digits(100 * Number(one.relative), 2)}\u00a0%`,
    SMALL_TORQUE.text(one.deviation, 3),
  ];
  const rows = [
    row("nut", text("ripple.as_it_is"), results),
    ...results.faults.map((one) => row(one.fault, one.fault, one)),
  ];
  const caption = text("ripple.sizes");
  const headings = [
    text("ripple.nut"),
    text("ripple.mean"),
    text("ripple.peak_to_peak"),
    text("ripple.over_mean"),
    text("ripple.deviation"),
  ];
  return scrollingTable(caption, headings, rows);
}

/** The mean torque by cause, and the range of several nuts where it is asked for. @param {Results} results */
function causes({ parts, range }) {
  const { balls, rubbing, return: returning } = parts;
  const [mean, rubbed, pushed] = [balls, rubbing, returning].map((one) => SMALL_TORQUE.text(one, 3));
  const sentence = text("ripple.of_causes", { balls: mean, rubbing: rubbed, returning: pushed });
  if (!range) return element("p", { class: "small" }, sentence);
  const [low, median, high] = [range.low, range.median, range.high].map((one) => SMALL_TORQUE.text(one, 3));
  const several = text("ripple.several", { nuts: range.nuts, low, median, high });
  return element("p", { class: "small" }, `${sentence}. ${several}`);
}

/** The orders that have a cause, as the nut is and with each fault. @param {Results} results */
function orders({ orders: named, faults }) {
  const rows = named.map(({ name, order, amplitude }, place) => [
    name,
    units.digits(order, 4),
    data(`order-${place}`, amplitude, SMALL_TORQUE.text(amplitude, 2)),
    ...faults.map((one) => SMALL_TORQUE.text(one.orders[place]?.amplitude, 2)),
  ]);
  const caption = text("ripple.orders_caption");
  const headings = [text("ripple.cause"), text("ripple.order"), text("ripple.amplitude")];
  return scrollingTable(caption, [...headings, ...faults.map((one) => one.fault)], rows);
}
