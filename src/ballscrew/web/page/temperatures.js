// Cold and hot: the friction torque, and whether the load drives the screw, over the temperature of the oil.

import { OUTSIDE, operationOf, valuesOf } from "./chart_parts.js";
import { byId, element, scrolling, table } from "./dom.js";
import { data } from "./results.js";
import { text } from "./texts.js";
import * as units from "./units.js";

/** A cold start and a hot machine, K. */
const COLD = 273.15;
const HOT = 353.15;
/** What tells an oil that follows the temperature. */
const FOLLOWS = ["grade", "oil", "kinematic_viscosity_40"];

/**
 * The axes and outputs to ask for; none where the oil does not follow the temperature.
 *
 * @param {Run} answer
 */
export function question(answer) {
  const oil = /** @type {Record<string, any>} */ (answer.inputs.lubricant ?? {});
  const { axial_load: load, screw_speed: speed } = operationOf(answer);
  if (!FOLLOWS.some((name) => oil[name] !== undefined) || !load || !speed) return undefined;
  const now = typeof oil.temperature === "number" ? [oil.temperature] : [];
  const temperatures = [...new Set([COLD, ...now, HOT])].sort((one, other) => one - other);
  return {
    vary: { temperature: `${temperatures.join(", ")} K`, screw_speed: `0, ${speed} rad/s` },
    outputs: ["screw_torque", "holding_torque"],
  };
}

/** Say why there is nothing to show. @param {Run} answer */
export function leaveOut(answer) {
  const { axial_load: load, screw_speed: speed } = operationOf(answer);
  const words = text(load && speed ? "temperatures.one" : "temperatures.nothing");
  byId("temperatures").replaceChildren(element("p", {}, words));
}

/**
 * @param {number | null} held
 * @param {number} load
 */
function driven(held, load) {
  if (held === null) return "–";
  const torque = units.formatted("holding_torque", Math.abs(held), units.DIGITS);
  return text(held * load > 0 ? "temperatures.back_drives" : "temperatures.locks", { torque });
}

/**
 * @param {Sweep} swept
 * @param {Run} answer
 */
export function show(swept, answer) {
  const { axial_load: load } = operationOf(answer);
  const { temperature } = swept.axes;
  const torques = /** @type {(number | null)[][]} */ (swept.outputs.screw_torque.values);
  const held = /** @type {(number | null)[][]} */ (swept.outputs.holding_torque.values);
  const valid = /** @type {boolean[][]} */ (swept.outputs.valid.values);
  const rows = valuesOf(temperature).map((at, place) => [
    units.formattedIn(at, "degC", "K", units.DIGITS),
    data("screw_torque", torques[place][1]),
    driven(held[place][1], load),
    driven(held[place][0], load),
    valid[place].every(Boolean) ? "" : OUTSIDE,
  ]);
  const headings = [
    text("temperatures.oil"),
    text("chart.torque"),
    text("temperatures.moving"),
    text("temperatures.at_rest"),
    "",
  ];
  const content = table(text("temperatures.caption"), headings, rows);
  byId("temperatures").replaceChildren(scrolling(text("temperatures.table"), content));
}
