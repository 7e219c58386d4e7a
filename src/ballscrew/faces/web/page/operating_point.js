// The operating point moved by hand: sliders beside the fields, and that of a chart, which can be dragged.

import { byId, element } from "./dom.js";
import { entries } from "./history.js";
import * as units from "./units.js";

/** Fields with a slider, and the least and the greatest value where they are known in SI. @type {Record<string, [number, number] | null>} */
const SLIDERS = {
  "operation.axial_load": null,
  "operation.screw_speed": null,
  "lubricant.temperature": [253.15, 393.15],
};
const STEPS = 200;
/** Shares of the greatest value from which the ends are set anew. */
const CLOSE = 0.95;
const FAR = 0.05;
const DIGITS = 3;

/**
 * A slider for a field, to stand below it; none where the field has none.
 *
 * @param {string} path
 * @param {HTMLElement} field
 * @param {string} name
 * @param {string | undefined} si
 */
export function slidersOf(path, field, name, si) {
  const [input, unit] = [field.querySelector("input"), field.querySelector("select")];
  if (!Object.hasOwn(SLIDERS, path) || !input || !unit) return [];
  const slider = element("input", {
    type: "range",
    name: path,
    step: "any",
    class: "slider",
    id: `s-${path.replaceAll(".", "-")}`,
    "aria-label": `${name}, slider`,
  });
  const say = () => slider.setAttribute("aria-valuetext", `${input.value} ${units.symbol(unit.value)}`);
  let isMoving = false; // its ends stay as they are then
  const follow = () => {
    const number = Number(units.withPoint(units.inASCII(input.value)));
    slider.disabled = !input.value.trim() || !Number.isFinite(number);
    if (slider.disabled) return;
    const ends = SLIDERS[path];
    if (ends) setEnds(slider, units.fromSI(ends[0], unit.value, si), units.fromSI(ends[1], unit.value, si));
    else {
      const size = Math.abs(number) / Number(slider.dataset.end);
      const isFar = !(size <= CLOSE && size >= FAR); // or there is no end yet
      const end = isFar ? roundUp(2 * Math.abs(number)) : Number(slider.dataset.end);
      setEnds(slider, number < 0 ? -end : 0, end);
    }
    slider.value = String(number);
    say();
  };
  slider.addEventListener("input", () => {
    const size = (Number(slider.max) - Number(slider.min)) / STEPS;
    isMoving = true;
    type(input, Math.round(Number(slider.value) / size) * size);
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
    slider.value = String(Number(slider.value) + (turn * (Number(slider.max) - Number(slider.min))) / STEPS);
    slider.dispatchEvent(new Event("input"));
  });
  slider.addEventListener("change", follow);
  input.addEventListener("change", follow); // its unit may have moved to the list of units
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
  slider.dataset.end = String(greatest);
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
 */
function type(input, number) {
  input.value = String(Number(number.toPrecision(DIGITS)));
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
