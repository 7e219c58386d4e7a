// Faults and names of fields in words.

import { within } from "./dom.js";
import { labelIn, words } from "./fields.js";
import { OF_CARDS, SECTIONS } from "./schema.js";

/** What to do, by the problem that the server has found, with its field where that matters. @type {Record<string, string>} */
const FAULTS = {
  "installation.ends: missing": "Choose how the ends of the shaft are held.",
  "installation.unsupported_length: missing": "Give the unsupported length.",
  "installation: missing section": "Give the unsupported length of the shaft, and choose how its ends are held.",
  "is a share of a dynamic load rating that is not known":
    "A share needs the dynamic load rating of the screw: give that, or the preload as a force.",
  "lubricant.kinematic_viscosity_100: missing": "Give both kinematic viscosities, at 40 °C and at 100 °C.",
  "lubricant.kinematic_viscosity_40: missing": "Give both kinematic viscosities, at 40 °C and at 100 °C.",
  "lubricant.temperature: needs a grade or a data sheet": "A temperature needs an oil that follows it: choose a grade.",
  "lubricant.viscosity: missing": "Give a viscosity; or choose a grade, or give two kinematic viscosities.",
  missing: "Give a value: nothing stands for it.",
  "nut.preload: missing": "Give the preload of this kind of nut: a force, or a share of the load rating such as 7 %.",
  "nut.type: missing": "Choose the kind of nut.",
  "unknown key": "There is no such field.",
  "unknown section": "There is no such field.",
};

/**
 * The name of a field as the form labels it.
 *
 * @param {string} path
 */
export function labelOf(path) {
  const parts = path.split(".");
  const name = labelIn(path);
  return parts.length > 1
    ? `${name} (${SECTIONS[parts[0]] ?? OF_CARDS[parts[0]] ?? words(parts[0]).replaceAll("-", " ")})`
    : name;
}

/**
 * A fault in words: what the page says of this field, or what is wrong, the value, and what to do.
 *
 * @param {FaultLine} fault
 */
export function inWords({ where, problem, given, remedy }) {
  const own = FAULTS[`${where}: ${problem}`] ?? FAULTS[problem];
  return own || `${problem}${given ? ` (${given})` : ""}${remedy ? `: ${remedy}` : ""}`;
}

/**
 * Mark the fields of a place that faults name, each with its first fault in words, and no others.
 *
 * @param {Element} holder
 * @param {FaultLine[]} faults
 * @param {(fault: FaultLine) => Element | null | undefined} fieldOf
 * @returns {FaultLine[]} those of no field there
 */
export function markFaults(holder, faults, fieldOf) {
  for (const field of holder.querySelectorAll(".wrong")) {
    field.classList.remove("wrong");
    within(field, ".fault").textContent = "";
    field.querySelector("[aria-invalid]")?.removeAttribute("aria-invalid");
  }
  return faults.filter((fault) => {
    const field = fieldOf(fault);
    if (!field || field.classList.contains("wrong")) return !field;
    field.classList.add("wrong");
    within(field, ".fault").textContent = inWords(fault);
    field.querySelector("input, select")?.setAttribute("aria-invalid", "true");
    return false;
  });
}

/** Places of faults that are keys, such as ``own-nut.preload``, and those that are files. */
const KEY = /^[a-z][\w-]*(?:\.[a-z_]+)+$/;
const FILE = /\.(?:csv|json|toml|txt|xlsx)$/;

/**
 * A fault that names no field of the form: its place, in words or as a file or an option has it, and the fault in words.
 *
 * @param {FaultLine} fault
 */
export function withPlace(fault) {
  const place = fault.where.startsWith("--") ? fault.where.slice(2) : fault.where;
  return `${KEY.test(place) && !FILE.test(place) ? labelOf(place) : place}: ${inWords(fault)}`;
}
