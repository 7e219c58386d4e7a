// The nut: how far it gives way, what is left of its preload, and the load of each ball.

import * as parts from "./chart_parts.js";
import { byId, element, table } from "./dom.js";
import { draw, hide, layout } from "./plot.js";
import * as units from "./units.js";

const DIGITS = 3;
/** Rows of the table: the place in the answer, words, SI unit, display unit. @type {[string, string, string, string][]} */
const ROWS = [
  ["rigidity", "rigidity of the nut, by its contacts", "N/m", "N/um"],
  ["deflection", "deflection of the nut under the load", "m", "um"],
  ["remaining_preload", "preload left under this load", "N", "N"],
  ["lift_off_load", "load at which the preload is lost", "N", "N"],
  ["axial_rigidity.nut", "rigidity of the nut by ISO 3408-4", "N/m", "N/um"],
  ["axial_rigidity.shaft", "rigidity of the shaft", "N/m", "N/um"],
  ["axial_rigidity.drive", "rigidity of nut, shaft and bearings", "N/m", "N/um"],
  ["axial_rigidity.deflection", "deflection of all of it", "m", "um"],
];

/**
 * @param {Record<string, any>} table
 * @param {string} path
 */
function at(table, path) {
  return path.split(".").reduce((found, name) => found?.[name], /** @type {any} */ (table));
}

/**
 * The table of stiffness, and the load of each ball.
 *
 * @param {Run} answer
 */
export function show(answer) {
  /** @type {Record<string, any> | undefined} */
  const loads = answer.loads;
  const place = byId("stiffness");
  if (!loads) {
    const load = units.formatted("contact_load", answer.results.contact_load, DIGITS);
    const words = `Each ball carries ${load}: no nut is given, and all balls carry alike. Choose a kind of nut to see its rigidity, its preload and the load of each ball.`;
    place.replaceChildren(element("p", {}, words));
    hide("balls-chart");
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
    const [least, mean, greatest] = ["least", "mean", "greatest"].map((one) =>
      units.formattedIn(found[one], "N", "N", DIGITS),
    );
    rows.push([`load of a ball, ${flank} flank`, `${least} to ${greatest}, mean ${mean}`]);
  }
  const notes = /** @type {string[]} */ (loads.axial_rigidity?.assumed ?? []);
  place.replaceChildren(
    table("stiffness and preload at this load", ["", ""], rows),
    element("p", { class: "small" }, notes.length ? `Assumed: ${notes.join("; ")}.` : ""),
  );
  drawBalls(loads.balls ?? {});
}

/**
 * @param {number} value
 * @param {string} si
 * @param {string} unit
 */
function shown(value, si, unit) {
  return units.formattedIn(value, unit, si, DIGITS);
}

/**
 * The load of each ball along the nut, on both flanks.
 *
 * @param {Record<string, unknown>} balls
 */
function drawBalls({ forward_load: forward, backward_load: backward, count }) {
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
  const y = parts.titled("contact_load", "load of a ball");
  const alike = places.length === 1 && Array.isArray(count);
  const x = alike ? "all balls alike" : "ball, along the nut";
  draw("balls-chart", {
    name: "load_of_each_ball",
    caption: "load of each ball, in the order of the nut",
    description: `Load of each of ${places.length} balls on both flanks.`,
    legend: (colours) =>
      flanks.map(({ name }, place) => ({ kind: "area", name, colour: place ? colours.second : colours.accent })),
    figure: (colours) => ({
      traces: flanks.map(({ name, values }, place) => ({
        x: places,
        y: values,
        name,
        type: alike ? "bar" : "scatter",
        mode: "lines",
        line: { shape: "hvh", width: 1.5, color: place ? colours.second : colours.accent },
        marker: { color: place ? colours.second : colours.accent },
        hovertemplate: "%{y:.3g}",
      })),
      layout: layout(colours, x, y, { xaxis: { tickformat: "d" } }),
    }),
    numbers: () => [
      ["ball", ...flanks.map(({ name }) => parts.titled("contact_load", name))],
      places.map((at, place) => [at, ...flanks.map(({ values }) => values[place])]),
    ],
  });
}
