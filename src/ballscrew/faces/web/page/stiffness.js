// The nut: how far it gives way, what is left of its preload, and the load of each ball.

import * as parts from "./chart_parts.js";
import { hide } from "./chart_place.js";
import { byId, element, table, update } from "./dom.js";
import { draw } from "./plot.js";
import { text } from "./texts.js";
import * as units from "./units.js";
import { vocabulary } from "./vocabulary.js";

/** Rows of the table: the place in the answer, words, SI unit, display unit. @type {[string, import("./texts.js").Key, string, string][]} */
const ROWS = [
  ["rigidity", "stiffness.rigidity", "N/m", "N/um"],
  ["deflection", "stiffness.deflection", "m", "um"],
  ["remaining_preload", "stiffness.remaining_preload", "N", "N"],
  ["lift_off_load", "stiffness.lift_off_load", "N", "N"],
  ["axial_rigidity.nut", "stiffness.nut", "N/m", "N/um"],
  ["axial_rigidity.shaft", "stiffness.shaft", "N/m", "N/um"],
  ["axial_rigidity.drive", "stiffness.drive", "N/m", "N/um"],
  ["axial_rigidity.deflection", "stiffness.all", "m", "um"],
];

/**
 * @param {Record<string, any>} table
 * @param {string} path
 */
function at(table, path) {
  return path.split(".").reduce((found, name) => found?.[name], /** @type {any} */ (table));
}

/** @param {Run} answer @returns {Record<string, any> | undefined} */
function loadsOf({ loads }) {
  return loads;
}

/**
 * The table of stiffness.
 *
 * @param {Run} answer
 */
export function show(answer) {
  const loads = loadsOf(answer);
  const place = byId("stiffness");
  if (!loads) {
    const load = units.formatted("contact_load", answer.results.contact_load);
    update(place, element("p", {}, text("stiffness.no_nut", { load })));
    return;
  }
  const rows = ROWS.flatMap(([path, key, si, unit]) => {
    const value = at(loads, path);
    if (typeof value !== "number") return [];
    const name = path.replace(".", "-");
    return [[text(key), element("data", { value: String(value), "data-name": name }, shown(value, si, unit))]];
  });
  for (const flank of /** @type {const} */ (["loaded", "relieved"])) {
    const found = loads[`${flank}_flank`]?.load;
    if (!found) continue;
    const [least, mean, greatest] = ["least", "mean", "greatest"].map((one) => units.formattedIn(found[one], "N", "N"));
    rows.push([text(`stiffness.${flank}`), text("stiffness.loads", { least, greatest, mean })]);
  }
  const notes = answer.words.rigidity.join("; ");
  update(
    place,
    table(text("stiffness.caption"), ["", ""], rows),
    element("p", { class: "small" }, notes ? text("stiffness.assumed", { notes }) : ""),
  );
}

/** The load of each ball, where it is known. @param {Run} answer */
export function showBalls(answer) {
  const loads = loadsOf(answer);
  if (loads) drawBalls(loads.balls ?? {}, halvesOf(answer));
  else hide("balls-chart");
}

/**
 * @param {number} value
 * @param {string} si
 * @param {string} unit
 */
function shown(value, si, unit) {
  return units.formattedIn(value, unit, si);
}

/** The halves of the nut of an answer, which follow each other with a distance between them. @param {Run} answer */
function halvesOf({ inputs }) {
  const { type } = /** @type {{ type?: string }} */ (inputs.nut ?? {});
  return vocabulary.nuts[type ?? ""]?.halves ?? 1;
}

/**
 * Values along the nut with a gap where one half ends and the next begins, so that no line is drawn across it.
 *
 * @template Value
 * @param {Value[]} values
 * @param {number} halves
 * @returns {(Value | null)[]}
 */
function parted(values, halves) {
  const size = values.length / halves;
  return values.flatMap((value, place) => (place && place % size === 0 ? [null, value] : [value]));
}

/**
 * The load of each ball along the nut, on both flanks.
 *
 * @param {Record<string, unknown>} balls
 * @param {number} halves
 */
function drawBalls({ forward_load: forward, backward_load: backward, count }, halves) {
  if (!Array.isArray(forward) || !Array.isArray(backward)) {
    hide("balls-chart");
    return;
  }
  const places = forward.map((_, place) => place + 1);
  /** @param {number[]} values */
  const converted = (values) => values.map((value) => units.inDisplayUnit("contact_load", value));
  const flanks = [
    { name: text("stiffness.carrying"), values: converted(forward) },
    { name: text("stiffness.other"), values: converted(backward) },
  ].filter(({ values }) => values.some((value) => value > 0));
  const y = parts.titled("contact_load", text("stiffness.load"));
  // a bar for all balls of a half
  const alike = places.length <= halves && Array.isArray(count);
  const x = text(alike ? (halves > 1 ? "nut_unrolled.half" : "stiffness.alike") : "stiffness.along");
  draw("balls-chart", {
    name: "load_of_each_ball",
    caption: text("stiffness.balls"),
    description: text("stiffness.description", { count: places.length }),
    figure: {
      x: { title: x, ...(alike && { step: 1 }) },
      y: { title: y, zero: true },
      marks: flanks.map(({ name, values }, place) => ({
        kind: "curve",
        name,
        x: alike ? places : parted(places, halves),
        y: alike ? values : parted(values, halves),
        style: alike ? "dots" : "steps",
        size: 9,
        width: 1.5,
        colour: place ? "second" : "accent",
      })),
    },
    numbers: () => [
      [text("chart.ball"), ...flanks.map(({ name }) => parts.titled("contact_load", name))],
      places.map((one, place) => [one, ...flanks.map(({ values }) => values[place])]),
    ],
  });
}
