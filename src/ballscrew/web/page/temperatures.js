// Cold and hot: the friction torque, and whether the load drives the screw, over the temperature of the oil.

import { operationOf, valuesOf } from "./chart_parts.js";
import { byId, element, scrolling, table } from "./dom.js";
import { data } from "./results.js";
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
  const words =
    load && speed
      ? "The oil is given by one viscosity, at one temperature. Choose a grade to see it cold and hot."
      : "Without load, or at rest, there is nothing to compare.";
  byId("temperatures").replaceChildren(element("p", {}, words));
}

/**
 * @param {number | null} held
 * @param {number} load
 */
function driven(held, load) {
  if (held === null) return "–";
  const torque = units.formatted("holding_torque", Math.abs(held), units.DIGITS);
  return held * load > 0 ? `back-drives, ${torque} hold it` : `self-locking, ${torque} lower it`;
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
    valid[place].every(Boolean) ? "" : "outside the model's validity",
  ]);
  const headings = ["oil", "friction torque", "at this speed", "at rest", ""];
  const content = table("friction and back-driving, cold and hot", headings, rows);
  byId("temperatures").replaceChildren(scrolling("friction and back-driving", content));
}
