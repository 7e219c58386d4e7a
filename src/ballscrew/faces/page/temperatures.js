// Cold and hot: the friction torque, and whether the load drives the screw, over the temperature of the oil.

import { operationOf, valuesOf } from "./chart_parts.js";
import { byId, element, scrolling, table } from "./dom.js";
import { OUTSIDE } from "./figure_parts.js";
import { data } from "./results.js";
import * as units from "./units.js";

/** How slowly oil flows back into the track; none where it is always full. @param {Run} answer */
function replenishmentOf(answer) {
  const inlet = /** @type {Record<string, any>} */ (answer.inputs.model).inlet;
  return /** @type {number | undefined} */ (inlet?.replenishment_constant);
}

/** Say why there is nothing to show. @param {Run} answer */
export function leaveOut(answer) {
  const { axial_load: load, screw_speed: speed } = operationOf(answer);
  const words =
    load && speed
      ? "The oil is given by one viscosity, at one temperature. Choose a grade to see it cold and hot."
      : "Without axial load, or at rest, there is nothing to compare.";
  byId("temperatures").replaceChildren(element("p", {}, words));
}

/**
 * @param {number | null} held
 * @param {number | null} atRest
 * @param {number} load
 */
function driven(held, atRest, load) {
  if (held === null) return "–";
  const torque = units.formatted("holding_torque", Math.abs(held));
  if (held * load > 0) return `back-drives, ${torque} hold it`;
  return (atRest ?? 0) * load > 0
    ? `friction holds the load only while the screw turns, ${torque} lower it`
    : `self-locking, ${torque} lower it`;
}

/**
 * @param {Sweep} swept
 * @param {Run} answer
 */
export function show(swept, answer) {
  const { axial_load: load } = operationOf(answer);
  const { temperature } = swept.axes;
  const isSlow = Boolean(replenishmentOf(answer));
  // by temperature, at rest and at speed, and where the track may be short of oil in a full bath and as it is
  const [torques, held, valid] = [swept.outputs.screw_torque, swept.outputs.holding_torque, swept.outputs.valid].map(
    ({ values }) => {
      const found = /** @type {any[][]} */ (values);
      return isSlow ? found : found.map((row) => row.map((one) => [one]));
    },
  );
  const own = isSlow ? 1 : 0;
  const rows = valuesOf(temperature).map((at, place) => {
    const [atRest, atSpeed] = held[place].map((one) => one[own]);
    return [
      units.formattedIn(at, "degC", "K"),
      data("screw_torque", torques[place][1][own]),
      ...(isSlow ? [data("screw_torque", torques[place][1][0])] : []),
      driven(atSpeed, atRest, load),
      driven(atRest, atRest, load),
      valid[place].every((one) => one[own]) ? "" : OUTSIDE,
    ];
  });
  const headings = [
    "oil",
    "friction torque",
    ...(isSlow ? ["friction torque in a full bath of oil"] : []),
    "at this speed",
    "at rest",
    "",
  ];
  const content = table("friction and back-driving, cold and hot", headings, rows);
  byId("temperatures").replaceChildren(scrolling("friction and back-driving", content));
}
