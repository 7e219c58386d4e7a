// The flow of power at the operating point: what comes in at the shaft or by the load, what goes out, and each loss.

import { operationOf } from "./chart_parts.js";
import { wordsOf } from "./charts.js";
import { opened } from "./controls.js";
import { element, NARROW, scrolling, table } from "./dom.js";
import { shape } from "./shapes.js";
import * as units from "./units.js";

/** One flow of power, W: a loss has the name of its part of the torque. @typedef {{ name: string, power: number, isLoss: boolean }} Flow */
/** What comes in and what goes out; both sums are equal. @typedef {{ sources: Flow[], sinks: Flow[], sum: number }} Balance */

/** Sizes in the picture, in its own units: where bands begin and end, and how wide all of the power is. */
const [WIDTH, LEFT, TRUNK, SPREAD, RIGHT] = [760, 200, 310, 340, 470];
const WHOLE = 150;
/** Room of a label of two lines, of one of them, above and below the picture, and of the bars at the ends of the bands. */
const [ROW, LINE, MARGIN, BAR] = [36, 15, 8, 8];
/** How far the heat of the contacts may be from the sum of the losses before that is said. */
const APART = 1e-3;

/**
 * The power of an answer, as torque times speed: that of the shaft is the power of the load and all losses, so that both
 * sums are equal. The load takes power where it is moved against its direction, and gives it where it drives. None where
 * a number of it is none, or at rest.
 *
 * @param {Run} answer
 * @returns {Balance | undefined}
 */
function balanceOf(answer) {
  const { ideal_torque: ideal, contributions } = answer.results;
  const { screw_speed: speed } = operationOf(answer);
  const torques = Object.entries(contributions);
  if (!speed || typeof ideal !== "number" || torques.some(([, torque]) => torque === null)) return undefined;
  /** @type {Flow[]} */
  const losses = torques.map(([name, torque]) => ({ name, power: Number(torque) * Math.abs(speed), isLoss: true }));
  const load = ideal * speed;
  const shaft = load + losses.reduce((sum, { power }) => sum + power, 0);
  /** @param {string} name @param {number} power @returns {Flow} */
  const end = (name, power) => ({ name, power, isLoss: false });
  // a part below zero pushes on, and gives power
  const sources = [end("shaft", shaft), end("load", -load), ...losses.map((one) => ({ ...one, power: -one.power }))];
  const sinks = [end("useful", load), end("brake", -shaft), ...losses];
  const [given, taken] = [sources, sinks].map((flows) => flows.filter(({ power }) => power > 0));
  return { sources: given, sinks: taken, sum: given.reduce((sum, { power }) => sum + power, 0) };
}

/**
 * The flow of power of an answer as a picture and a table, or why there is none.
 *
 * @param {Run} answer
 * @param {Mechanisms} mechanisms
 * @returns {HTMLElement}
 */
export function powerFlow(answer, mechanisms) {
  const found = balanceOf(answer);
  const { screw_speed: speed } = operationOf(answer);
  if (!found?.sum)
    return element("p", {}, speed ? "Power has no number at this operating point." : "At rest no power flows.");
  const { sources, sinks, sum } = found;
  /** @param {Flow} flow */
  const words = ({ name, isLoss }) => (isLoss ? wordsOf(name, mechanisms) : textOf(name));
  /** @param {Flow} flow */
  const colour = ({ name, isLoss }) => (isLoss ? mechanisms[name]?.colour : undefined);
  const isDriven = sources.some(({ name }) => name === "load");
  const isDrivenAlone = isDriven && !sources.some(({ name }) => name === "shaft");
  const direction = isDrivenAlone
    ? "The load drives the screw; what is left of its power is taken up at the shaft."
    : isDriven
      ? "Shaft and load together drive the screw: the load alone does not overcome friction."
      : "The shaft drives the nut against its load.";
  const total = units.formatted("friction_power", sum);
  const lost = sinks.reduce((all, { power, isLoss }) => all + (isLoss ? power : 0), 0);
  const label = `${direction} In all ${total}, of which ${units.formatted("friction_power", lost)} are losses.`;
  /** @param {string} side @param {Flow[]} flows */
  const rows = (side, flows) =>
    flows.map((flow) => [
      key(words(flow), colour(flow)),
      side === "in" ? "in" : "out",
      number(side, flow),
      shareOf(flow.power, sum),
    ]);
  const headings = ["part", "direction", "power", "share of what comes in"];
  const numbers = table("power in and out at the operating point", headings, [
    ...rows("in", sources),
    ...rows("out", sinks),
  ]);
  const below = opened("Numbers", scrolling("power in and out at the operating point", numbers));
  if (NARROW.matches) below.setAttribute("open", ""); // the picture has no room for the names there
  const heat = answer.results.friction_power;
  const given = sources.reduce((all, { power, isLoss }) => all + (isLoss ? power : 0), 0);
  const isApart = typeof heat === "number" && Math.abs(heat - (lost - given)) > APART * Math.abs(heat);
  return element(
    "div",
    { class: "power-flow" },
    element("p", { class: "small" }, direction),
    picture(found, words, colour, label),
    below,
    isApart
      ? element(
          "p",
          { class: "small" },
          `Power here is torque times speed. From local forces and speeds in the contacts the heat is ${units.formatted("friction_power", heat)}.`,
        )
      : null,
  );
}

/** An end of the flow in words. @param {string} name */
function textOf(name) {
  if (name === "shaft") return "shaft of the screw";
  if (name === "load") return "load";
  return name === "useful" ? "useful, at the nut" : "taken up at the shaft";
}

/** @param {number} power @param {number} sum */
function shareOf(power, sum) {
  return `${units.digits((100 * power) / sum, 3)}\u00a0%`;
}

/** A power for people, and for programs exactly. @param {string} side @param {Flow} flow */
function number(side, { name, power }) {
  const shown = units.formatted("friction_power", power);
  return element("data", { value: String(power), "data-name": `power-${side}-${name}` }, shown);
}

/** A name with the colour of its band. @param {string} words @param {string | undefined} colour */
function key(words, colour) {
  const swatch = element("span", { "aria-hidden": "true" });
  swatch.classList.add("key", "area");
  swatch.style.color = colour ?? "var(--accent)";
  return element("span", {}, swatch, ` ${words}`);
}

/**
 * Bands from the left to the trunk in the middle, and from there to the right; all widths have one scale.
 *
 * @param {Balance} balance
 * @param {(flow: Flow) => string} words
 * @param {(flow: Flow) => string | undefined} colour
 * @param {string} label
 */
function picture({ sources, sinks, sum }, words, colour, label) {
  /** @param {Flow} flow */
  const size = ({ power }) => (WHOLE * power) / sum;
  /** @param {Flow[]} flows */
  const heightOf = (flows) => flows.reduce((all, flow) => all + Math.max(ROW, size(flow)), 0);
  const height = Math.max(WHOLE, heightOf(sources), heightOf(sinks));
  const top = MARGIN + (height - WHOLE) / 2;
  /** @param {string} side @param {Flow[]} flows */
  const side = (side, flows) => {
    const isIn = side === "in";
    let [row, inner] = [MARGIN + (height - heightOf(flows)) / 2, top];
    return flows.flatMap((flow) => {
      const own = size(flow);
      const room = Math.max(ROW, own);
      const outer = row + (room - own) / 2;
      const centre = row + room / 2;
      const [from, to] = isIn ? [LEFT, TRUNK] : [SPREAD, RIGHT];
      const [start, end] = isIn ? [outer, inner] : [inner, outer];
      const fill = colour(flow);
      const common = { class: fill ? "loss" : "end", ...(fill && { fill }) };
      const amount = units.formatted("friction_power", flow.power, 3);
      const at = { x: isIn ? LEFT - 2 * BAR : RIGHT + 2 * BAR, "text-anchor": isIn ? "end" : "start" };
      /** @param {string} name @param {number} y @param {string} said */
      const line = (name, y, said) => shape("text", { class: name, ...at, y }, said);
      row += room;
      inner += own;
      return [
        shape("path", { ...common, d: band(from, start, to, end, own) }),
        shape("rect", {
          ...common,
          "data-flow": `${side}-${flow.name}`,
          x: isIn ? LEFT - BAR : RIGHT,
          y: outer,
          width: BAR,
          height: String(own), // as it is: a loss may be a hundredth of a pixel
        }),
        line("name", centre - LINE / 4, words(flow)),
        line("amount", centre + (3 * LINE) / 4, `${amount} · ${shareOf(flow.power, sum)}`),
      ];
    });
  };
  return shape(
    "svg",
    { viewBox: `0 0 ${WIDTH} ${height + 2 * MARGIN}`, role: "img", "aria-label": label },
    shape("rect", { class: "trunk", x: TRUNK, y: top, width: SPREAD - TRUNK, height: WHOLE }),
    ...side("in", sources),
    ...side("out", sinks),
  );
}

/**
 * The outline of a band that is as wide at both ends.
 *
 * @param {number} from
 * @param {number} start its upper edge there
 * @param {number} to
 * @param {number} end its upper edge there
 * @param {number} width
 */
function band(from, start, to, end, width) {
  const middle = (from + to) / 2;
  const above = `M${from} ${start}C${middle} ${start} ${middle} ${end} ${to} ${end}`;
  return `${above}V${end + width}C${middle} ${end + width} ${middle} ${start + width} ${from} ${start + width}Z`;
}
