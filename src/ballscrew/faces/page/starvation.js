// A screw that is starved of oil, and the same one in a full bath: what tells of it, and how it is drawn.

/** @import { Curve, Values } from "./figure.js" */

/** The torque in a full bath among the outputs, and the input of a module with which it has that bath. */
export const FLOODED = "flooded_torque";
export const REPLENISHMENT = "inlet.replenishment_constant";
export const FULL_BATH = { [REPLENISHMENT]: 0 };
const STARVED = "lubricant.starved";

/**
 * The friction torque in a full bath, in SI, by the records of a result that is starved of oil; none of others.
 *
 * @param {{ id: string, value?: number | null }[]} records
 */
export function floodedTorqueIn(records) {
  return records.find(({ id }) => id === STARVED)?.value ?? undefined;
}

/** The torque in a full bath beside that of a screw that is starved. @param {Values} x @param {Values} y @returns {Curve} */
export function fullBath(x, y) {
  return { kind: "curve", name: "in a full bath of oil", x, y, colour: "ink", style: "dashed" };
}
