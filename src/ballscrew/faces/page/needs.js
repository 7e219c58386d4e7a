// Needs: the fields of the card of choosing, and a need that was opened as their texts.

import { valueAt } from "./state.js";

/** @typedef {import("./state.js").Need} Need */

/** Fields of a need, by their short names: where a case has them, or nothing where only needs have them. */
/** @type {Record<string, string>} */
export const FIELDS = {
  axial_load: "operation.axial_load",
  mass: "axis.mass",
  inclination: "axis.inclination",
  acceleration: "motion.acceleration",
  feed: "",
  stroke: "",
  unsupported_length: "installation.unsupported_length",
  ends: "installation.ends",
  running_time: "limits.running_time",
  nut: "nut.type",
  preload: "nut.preload",
  grade: "lubricant.grade",
  temperature: "lubricant.temperature",
  back_driving: "",
  accuracy: "",
  least_rigidity: "",
  largest_drive_torque: "",
  largest_preload_torque: "",
  largest_inertia: "",
};
/** Fields that take several values. */
export const LISTS = ["preload"];
/** Fields that make a motion, in place of a force; a design has them in its duty. */
export const OF_MASS = ["mass", "inclination", "acceleration"];

/**
 * A need that was opened: what fields show becomes their texts, the rest stays as it is.
 *
 * @param {Record<string, any>} opened
 * @returns {Need}
 */
export function readNeed(opened) {
  const rest = structuredClone(opened);
  /** @type {Record<string, string>} */
  const texts = {};
  for (const [name, path] of Object.entries(FIELDS)) {
    // a motion that is written out stays as it is
    const places = OF_MASS.includes(name) ? [] : [path];
    for (const place of [...places, `need.${name}`, name].filter(Boolean)) {
      const [section, field] = place.split(".");
      const value = valueAt(rest, place);
      const isShort =
        field === undefined
          ? !["string", "number"].includes(typeof value)
          : typeof value === "object" && !Array.isArray(value);
      if (value === undefined || isShort || (Array.isArray(value) && !LISTS.includes(name))) continue;
      texts[name] = Array.isArray(value) ? value.join("; ") : String(value);
      if (field === undefined) delete rest[section];
      else delete rest[section][field];
      if (field !== undefined && !Object.keys(rest[section]).length) delete rest[section];
    }
  }
  // an operation may state the feed
  if (typeof rest.operation?.feed === "string") {
    texts.feed = rest.operation.feed;
    delete rest.operation.feed;
    if (!Object.keys(rest.operation).length) delete rest.operation;
  }
  return { texts, units: {}, rest, duty: false };
}
