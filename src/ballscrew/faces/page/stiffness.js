// The nut: how far it gives way, what is left of its preload, and the load of each ball.

import { draw, hide } from "./chart_place.js";
import { byId, element, table, update } from "./dom.js";
import * as units from "./units.js";
import { vocabulary } from "./vocabulary.js";

/** Loads of the flanks in words. @type {Record<string, string>} */
const FLANKS = {
  loaded: "load of a ball, loaded flank",
  relieved: "load of a ball, relieved flank",
};

/** Rows of the table: the place in the answer, words, SI unit, display unit. @type {[string, string, string, string][]} */
const ROWS = [
  ["rigidity", "rigidity of the nut, by its contacts", "N/m", "N/um"],
  ["deflection", "deflection of the nut under the load", "m", "um"],
  ["remaining_preload", "preload left under this load", "N", "N"],
  ["lift_off_load", "load at which the preload is lost", "N", "N"],
  ["axial_rigidity.nut", "rigidity of the nut by ISO 3408-4", "N/m", "N/um"],
  ["axial_rigidity.shaft", "rigidity of the shaft, where it is softest", "N/m", "N/um"],
  ["axial_rigidity.drive", "rigidity of nut, shaft and bearings, where the shaft is softest", "N/m", "N/um"],
  ["axial_rigidity.deflection", "deflection of all of it", "m", "um"],
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
    update(
      place,
      element(
        "p",
        {},
        `Each ball carries ${load}: no nut is given, and all balls carry alike. Choose a kind of nut to see its rigidity, its preload and the load of each ball.`,
      ),
    );
    return;
  }
  const rows = ROWS.flatMap(([path, words, si, unit]) => {
    const value = at(loads, path);
    if (typeof value !== "number") return [];
    const name = path.replace(".", "-");
    return [[words, element("data", { value: String(value), "data-name": name }, shown(value, si, unit))]];
  });
  for (const flank of /** @type {const} */ (["loaded", "relieved"])) {
    const found = loads[`${flank}_flank`]?.load;
    if (!found) continue;
    const [least, mean, greatest] = ["least", "mean", "greatest"].map((one) => units.formattedIn(found[one], "N", "N"));
    rows.push([FLANKS[flank], `${least} to ${greatest}, mean ${mean}`]);
  }
  const notes = answer.words.rigidity.join("; ");
  update(
    place,
    table("stiffness and preload at this load", ["", ""], rows),
    element("p", { class: "small" }, notes ? `Assumed: ${notes}.` : ""),
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
    { name: "flank that carries the load", values: converted(forward) },
    { name: "other flank", values: converted(backward) },
  ].filter(({ values }) => values.some((value) => value > 0));
  const y = units.heading("contact_load", "load of a ball");
  // a bar for all balls of a half
  const alike = places.length <= halves && Array.isArray(count);
  const x = alike ? (halves > 1 ? "half" : "all balls alike") : "ball, along the nut";
  draw("balls-chart", {
    name: "load_of_each_ball",
    caption: "load of each ball, in the order of the nut",
    description: `Load of each of ${places.length} balls on both flanks.`,
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
      ["ball", ...flanks.map(({ name }) => units.heading("contact_load", name))],
      places.map((one, place) => [one, ...flanks.map(({ values }) => values[place])]),
    ],
  });
}
