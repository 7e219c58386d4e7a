// What the shaft needs in the four quadrants of load and speed: with this load and this speed, each with both signs.

import { operationOf } from "./chart_parts.js";
import { byId, element, scrolling, table, update } from "./dom.js";
import { data } from "./results.js";
import * as units from "./units.js";

const SIGNS = [1, -1];

/** Show them of an answer. @param {Run} answer */
export function show({ results, inputs, ...answer }) {
  const all = Object.values(results.quadrants);
  const { axial_load: load, screw_speed: speed } = operationOf({ results, inputs, ...answer });
  const cell = (/** @type {number} */ ofLoad, /** @type {number} */ ofSpeed) => {
    const one = all.find(({ load_sign, speed_sign }) => load_sign === ofLoad && speed_sign === ofSpeed);
    if (!one) return "–";
    const isDriven = ofLoad !== ofSpeed;
    const torque = data("drive_torque", one.shaft_torque);
    // the load turns the screw where the shaft has to be held against it
    const backDrives = Number(one.shaft_torque) * ofLoad > 0;
    const words = !isDriven ? "the screw drives" : backDrives ? "back-drives" : "self-locking";
    const efficiency = one.efficiency === null ? "" : ` · η ${units.digits(100 * one.efficiency, 3)} %`;
    const isHere = ofLoad === (load < 0 ? -1 : 1) && ofSpeed === (speed < 0 ? -1 : 1);
    return element("div", { class: isHere ? "here" : "" }, element("strong", {}, torque), ` ${words}${efficiency}`);
  };
  const rows = SIGNS.map((ofLoad) => [
    ofLoad > 0 ? "load +" : "load −",
    ...SIGNS.toReversed().map((ofSpeed) => cell(ofLoad, ofSpeed)),
  ]);
  const content = table("torque of the shaft", ["", "speed −", "speed +"], rows);
  update(byId("quadrants"), scrolling("torque of the shaft in four quadrants", content));
}
