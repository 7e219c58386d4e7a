// The checks: how much of each limit is used, what fails, and what was not judged for want of an input.

import { jump } from "./cards.js";
import { byId, element, table, update } from "./dom.js";
import { nameOfCheck } from "./names.js";
import * as units from "./units.js";

/** Display units, by SI unit. @type {Record<string, string>} */
const SHOWN_IN = { N: "kN", Pa: "MPa", s: "h", "rad/s": "rpm", "m rad/s": "mm rpm" };
/** The field to fill in, by the input that a check lacks. @type {Record<string, [string, string]>} */
const FIELDS = {
  installation: ["installation.unsupported_length", "give unsupported length and ends"],
  "limits.running_time": ["limits.running_time", "give required running time"],
  dynamic_load_rating: ["screw.dynamic_load_rating", "give dynamic load rating"],
  static_load_rating: ["screw.static_load_rating", "give static load rating"],
};
/** Shares of a limit from which a bar is coloured as close to it. */
const CLOSE = 0.8;
/** The share from which it is written as a multiple. */
const MULTIPLE = 10;
const DIGITS_OF_SHARE = 3;

/** @typedef {VerdictRecord & { name: string, utilisation: number | null, missing: string, source_text?: string | null }} OneCheck */

/**
 * Checks of an operating point, or over a cycle.
 *
 * @typedef {{ checks: OneCheck[], judged: number, holds: boolean, isOfCycle?: boolean }} Judged
 */

/** The checks over a cycle, and how many of them were judged. @param {DutyAnswer} answer @returns {Judged} */
export function ofCycle({ checks: all }) {
  const judged = all.filter((one) => one.holds !== null).length;
  return { checks: all, judged, holds: all.every((one) => one.holds === true), isOfCycle: true };
}

/**
 * All checks in one sentence, with the number of those judged where not all were; nothing passes that was not judged.
 * Of a cycle it says so.
 *
 * @param {Judged} found
 */
export function verdict(found) {
  return found.isOfCycle ? `Over the cycle: ${inWords(found)}` : inWords(found);
}

/** @param {Judged} found */
function inWords({ checks, judged, holds }) {
  const all = checks.length;
  const failed = checks.filter((one) => one.holds === false).map(nameOfCheck);
  const rest = judged < all ? ` ${judged} of ${all} checks judged.` : "";
  if (failed.length) return `Fails: ${failed.join(", ")}.${rest}`;
  if (holds) return `All ${all} checks hold.`;
  return `${judged} checks hold.${rest}`;
}

/**
 * The name of the tone of a verdict or a bar.
 *
 * @param {OneCheck} check
 */
function toneOf({ holds, utilisation }) {
  if (holds === null) return "open";
  if (!holds) return "fails";
  return (utilisation ?? 0) > CLOSE ? "close" : "holds";
}

/**
 * A value in its unit; a life of many turns as 9.56 · 10⁶.
 *
 * @param {OneCheck} check
 * @param {number | null} value
 */
function shown({ unit }, value) {
  return units.withPowers(units.formattedIn(value, SHOWN_IN[unit] ?? unit, unit));
}

/** @param {OneCheck} check */
function numberOf(check) {
  return element("data", { value: String(check.value ?? ""), "data-name": check.name }, shown(check, check.value));
}

/**
 * The limit of a check; a motor above its largest speed has no torque, which is said with both speeds.
 *
 * @param {OneCheck} check
 * @param {OneCheck[]} all
 */
function limitOf(check, all) {
  const speed = all.find(({ name }) => name === "motor_speed");
  const words =
    check.name === "motor_peak_torque" && check.limit === 0 && speed
      ? `the motor has no torque above ${shown(speed, speed.limit)}, where its curve ends; ${shown(speed, speed.value)} are needed`
      : `limit ${shown(check, check.limit)}`;
  return element("span", { class: "limit" }, check.limit === null ? "" : words);
}

/**
 * A share of a limit in percent; far beyond it as a multiple.
 *
 * @param {number} share
 */
function percentage(share) {
  if (!Number.isFinite(share)) return "over";
  if (share >= MULTIPLE) return `${units.digits(share, 2)} times`;
  return `${units.digits(100 * share, share < 0.1 ? 2 : DIGITS_OF_SHARE)}\u00a0%`;
}

/**
 * The source of the formulas of a check, where it was not read.
 *
 * @param {OneCheck} check
 */
function sourceOf({ value, source_text: words }) {
  return words && value !== null ? [element("span", { class: "source" }, words)] : [];
}

/**
 * The share of the limit as a bar, a number and a word; or the field to fill in.
 *
 * @param {OneCheck} check
 */
function used(check) {
  const { utilisation, holds } = check;
  if (holds === null) {
    const [path, wanted] = FIELDS[check.missing] ?? [];
    if (!path) return element("span", {}, "not judged ", ...sourceOf(check));
    const button = element("button", { type: "button", onclick: () => jump(path) }, wanted);
    button.setAttribute("aria-label", `${nameOfCheck(check)}: ${wanted}`);
    return element("span", {}, "not judged ", button, " ", ...sourceOf(check));
  }
  const tone = toneOf(check);
  const fill = element("span");
  const share = utilisation ?? Number.POSITIVE_INFINITY;
  fill.style.width = `${100 * Math.min(1, share)}%`;
  return element(
    "span",
    { class: "used" },
    element("span", { class: `bar ${tone}`, "aria-hidden": "true" }, fill),
    element("data", { value: String(utilisation ?? "") }, percentage(share)),
    element("strong", { class: tone }, holds ? "holds" : "fails"),
    ...sourceOf(check),
  );
}

/**
 * The panel of checks.
 *
 * @param {Judged | undefined} found
 */
export function show(found) {
  if (!found) {
    byId("checks").textContent = "The checks could not be computed.";
    return;
  }
  update(
    byId("checks"),
    ...panel(found, found.isOfCycle ? "checks of the whole cycle" : "life, strength and speed against their limits"),
    element(
      "p",
      { class: "small" },
      `${found.isOfCycle ? "Above 100 % a check fails. The life is the basic rating life L10, which 90 % of screws reach, with one cycle after the other: the operating point above is not judged as if it lasted for ever." : "Above 100 % a check fails. The life is the basic rating life L10, which 90 % of screws reach; the load is taken as constant."} `,
      ...notes(found),
    ),
  );
}

/**
 * All checks in one sentence, and a table of them.
 *
 * @param {Judged} found
 * @param {string} caption
 */
export function panel(found, caption) {
  const tone = found.checks.some((one) => one.holds === false) ? "careful" : found.holds ? "good" : "";
  const headings = ["", "value and limit", "used"];
  const rows = found.checks.map((check) => [
    element("span", { title: check.text }, nameOfCheck(check)),
    element("span", {}, numberOf(check), limitOf(check, found.checks)),
    used(check),
  ]);
  const content = table(caption, headings, rows);
  content.className = "checks";
  for (const [place, row] of [...content.tBodies[0].rows].entries()) row.dataset.check = found.checks[place].name;
  return [element("p", { class: `verdict ${tone}` }, verdict(found)), content];
}

/** What a limit rests on, where a check says it. @param {Judged} found */
function notes({ checks }) {
  const source = checks.find((one) => one.name === "diameter_speed_product");
  return source ? [`d·n: ${source.text}.`] : [];
}
