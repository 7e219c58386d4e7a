// The button beside a result that is starved of oil: computes it with a full bath, and takes that back.

import * as designs from "./designs.js";
import { byId } from "./dom.js";
import { floodedTorqueIn, REPLENISHMENT } from "./starvation.js";
import * as units from "./units.js";

const PATH = `model.${REPLENISHMENT}`;
const FULL = "0";

/** True where a result is starved of oil. @param {Run} answer */
export function isStarved(answer) {
  return floodedTorqueIn(answer.verdicts) !== undefined;
}

/** The torque of the full bath in words, for the headline of a result that is starved. @param {Run} answer */
export function inHeadline(answer) {
  if (!isStarved(answer)) return "";
  return ` Starved of oil: in a full bath the friction torque is ${units.formatted("screw_torque", floodedTorqueIn(answer.verdicts))}.`;
}

/** True where the button has filled the bath of the current design. */
function isFull() {
  return designs.current().changes[PATH] === FULL;
}

/** @param {Run} answer */
export function show(answer) {
  const button = byId("bath");
  button.hidden = !isFull() && !isStarved(answer);
  button.textContent = isFull() ? "Compute without the full bath of oil" : "Compute with a full bath of oil";
}

/** Fill the bath of the current design, or leave that out again. */
export function turn() {
  if (isFull()) designs.takeBack(PATH);
  else designs.change({ [PATH]: FULL }, { rebuild: true, isStep: true });
}
