// The operating point moved by hand: sliders beside the fields, and that of a chart, which can be dragged.

import { byId, element } from "./dom.js";
import { entries } from "./history.js";
import * as units from "./units.js";

/** Sections whose numbers move what is live: each has a slider. */
const LIVE = ["operation", "screw", "nut", "lubricant", "losses", "model"];
/** Inputs that have either sign, or none, whose slider goes from nothing to twice their value. */
const FROM_NOTHING = ["operation.axial_load", "operation.screw_speed"];
/** Ends that are known, in SI. @type {Record<string, [number, number]>} */
const ENDS = { "lubricant.temperature": [253.15, 393.15] };
const SHARE = /\s*%$/;
const STEPS = 200;
/** Shares of its way from which the ends are set anew. */
const CLOSE = 0.95;
const FAR = 0.05;
const DIGITS = 3;
/** How far a slider goes below and above a value, as its shares, and how near to a bound that is no value itself. */
const [BELOW, ABOVE, NEAR] = [0.5, 2, 0.02];

/** @typedef {import("./schema.js").SchemaNode & Partial<Record<"minimum" | "maximum" | "exclusiveMinimum" | "exclusiveMaximum", number>>} Bounded */

/**
 * The ends of a slider around a number, in its unit, within the bounds of its field.
 *
 * @param {string} path
 * @param {number} number
 * @param {Bounded} node
 * @param {string | undefined} unit
 * @returns {[number, number]}
 */
function endsAround(path, number, node, unit) {
  const shown = (/** @type {number} */ value) => (unit ? units.fromSI(value, unit, node["x-si-unit"]) : value);
  if (ENDS[path]) return [shown(ENDS[path][0]), shown(ENDS[path][1])];
  if (FROM_NOTHING.includes(path)) {
    const end = roundUp(2 * Math.abs(number));
    return [number < 0 ? -end : 0, end];
  }
  const bounds = /** @type {Bounded} */ (node.anyOf?.find(({ type }) => type === "number") ?? node);
  const bound = (/** @type {number | undefined} */ value) => (value === undefined ? undefined : shown(value));
  const [above, below] = [bound(bounds.exclusiveMinimum), bound(bounds.exclusiveMaximum)];
  let [low, high] = number === 0 ? [0, 1] : [BELOW * number, ABOVE * number].sort((a, b) => a - b);
  if (above !== undefined && low <= above) low = above + NEAR * (number - above);
  if (below !== undefined && high >= below) high = below - NEAR * (below - number);
  return [Math.max(low, bound(bounds.minimum) ?? low), Math.min(high, bound(bounds.maximum) ?? high)];
}

/**
 * A slider for a field, to stand below it; none where the field has none.
 *
 * @param {string} path
 * @param {HTMLElement} field
 * @param {string} name
 * @param {Bounded} node
 */
export function slidersOf(path, field, name, node) {
  const input = field.querySelector("input");
  const unit = field.querySelector("select");
  if (!input || !LIVE.includes(path.split(".")[0])) return [];
  const slider = element("input", {
    type: "range",
    name: path,
    step: "any",
    class: "slider",
    id: `s-${path.replaceAll(".", "-")}`,
    "aria-label": `${name}, slider`,
  });
  const say = () => {
    const share = (Number(slider.value) - Number(slider.min)) / (Number(slider.max) - Number(slider.min));
    slider.style.setProperty("--share", `${100 * share}%`);
    slider.setAttribute("aria-valuetext", `${input.value} ${units.symbol(unit?.value ?? "")}`.trim());
  };
  const isWhole = node.type === "integer" || node.anyOf?.some(({ type }) => type === "integer");
  let isMoving = false; // its ends stay as they are then
  let isShare = false;
  const follow = () => {
    const written = units.withPoint(units.inASCII(input.value.trim() || input.placeholder));
    isShare = SHARE.test(written);
    const number = Number(written.replace(SHARE, ""));
    slider.hidden = !written || !Number.isFinite(number) || (unit?.value === "" && !isShare);
    if (slider.hidden) return;
    const share = (number - Number(slider.min)) / (Number(slider.max) - Number(slider.min));
    const isEnd = !(share <= CLOSE && share >= FAR); // or there is no end yet
    if (isEnd || !slider.max)
      setEnds(slider, ...endsAround(path, number, isShare ? {} : node, isShare ? "" : unit?.value));
    slider.value = String(number);
    say();
  };
  slider.addEventListener("input", () => {
    const size = (Number(slider.max) - Number(slider.min)) / STEPS;
    const value = Number(slider.min) + Math.round((Number(slider.value) - Number(slider.min)) / size) * size;
    isMoving = true;
    type(input, isWhole ? Math.round(value) : value, isShare ? " %" : "");
    isMoving = false;
    say();
  });
  input.addEventListener("input", () => {
    if (!isMoving) follow();
  });
  slider.addEventListener("keydown", (event) => {
    const turns = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1 };
    const turn = turns[/** @type {keyof typeof turns} */ (event.key)];
    if (!turn) return;
    event.preventDefault(); // a step of its own, since a slider of any value has none
    const step = (Number(slider.max) - Number(slider.min)) / STEPS;
    slider.value = String(Number(slider.value) + turn * (isWhole ? Math.max(1, step) : step));
    slider.dispatchEvent(new Event("input"));
  });
  slider.addEventListener("change", follow);
  input.addEventListener("change", follow); // its unit may have moved to the list of units
  input.addEventListener("effective", follow);
  follow();
  return [slider];
}

/**
 * @param {HTMLInputElement} slider
 * @param {number} least
 * @param {number} greatest
 */
function setEnds(slider, least, greatest) {
  slider.min = String(least);
  slider.max = String(greatest);
}

/**
 * The next number with one digit of 1, 2 or 5; 100 for nothing.
 *
 * @param {number} value
 */
function roundUp(value) {
  if (!(value > 0)) return 100;
  const power = 10 ** Math.floor(Math.log10(value));
  return ([1, 2, 5, 10].find((digit) => digit * power >= value * (1 - 1e-9)) ?? 10) * power;
}

/**
 * Put a number into a field as if it had been typed.
 *
 * @param {HTMLInputElement} input
 * @param {number} number
 * @param {string} [sign] what follows it
 */
function type(input, number, sign = "") {
  input.value = `${Number(number.toPrecision(DIGITS))}${sign}`;
  input.dispatchEvent(new Event("input", { bubbles: true }));
}

/**
 * Put a value in SI into a field, in the unit that it has.
 *
 * @param {string} path
 * @param {number} value
 * @param {string} si
 */
function put(path, value, si) {
  const id = path.replaceAll(".", "-");
  const input = /** @type {HTMLInputElement} */ (byId(`f-${id}`));
  const unit = /** @type {HTMLSelectElement} */ (byId(`u-${id}`));
  if (!unit.value) unit.value = unit.options[1].value; // what was as typed is a number now
  type(input, units.fromSI(value, unit.value, si));
}

/** Inputs along the axes of a chart, by their result's name. @type {Record<string, [string, string]>} */
const FIELDS = {
  screw_speed: ["operation.screw_speed", "rad/s"],
  axial_load: ["operation.axial_load", "N"],
};

/**
 * What can be dragged in a chart: the inputs along its axes, and where the operating point is drawn for a place of the pointer.
 *
 * @typedef {{ x: string, y?: string, place: (x: number, y: number) => [number, number] }} Handle
 */

/**
 * Tells by ``move`` of an operating point that is dragged: ``detail`` has its values in SI, or null where it is let go and
 * stays where it was. Whoever follows it prevents the default, which is that it alone is drawn.
 */
export const dragged = new EventTarget();

/** Tell where the operating point is dragged to; true where somebody follows it. @param {Handle} handle @param {[number, number]} at */
export function isFollowed(handle, [x, y]) {
  const detail = { [handle.x]: inSI(handle.x, x), ...(handle.y && { [handle.y]: inSI(handle.y, y) }) };
  return !dragged.dispatchEvent(new CustomEvent("move", { detail, cancelable: true }));
}

/** The operating point is let go, and stays where it was. */
export function letGo() {
  dragged.dispatchEvent(new CustomEvent("move", { detail: null, cancelable: true }));
}

/**
 * Take the values of the operating point as it was dropped. The fields have them only then: until then the axes of the chart
 * stay as they are under the pointer.
 *
 * @param {Handle} handle
 * @param {[number, number]} at
 */
export function take(handle, [x, y]) {
  entries.asOne(() => {
    commit(handle.x, x);
    if (handle.y) commit(handle.y, y);
  });
}

/**
 * @param {string} name
 * @param {number} shown the value in the unit that the chart shows
 */
function commit(name, shown) {
  const [path, si] = FIELDS[name];
  put(path, inSI(name, shown), si);
}

/**
 * @param {string} name
 * @param {number} shown the value in the unit that the chart shows
 */
function inSI(name, shown) {
  return units.toSI(shown, units.unitOf(name), FIELDS[name][1]);
}
