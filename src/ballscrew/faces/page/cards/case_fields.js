// Fields of a card: sections of the case that the form does not show, with their faults beside them.

import { framed } from "../controls.js";
import { element, fieldIn } from "../dom.js";
import { markFaults } from "../messages.js";
import { fieldFor, showEffective } from "../fields.js";
import * as schema from "../schema.js";
import { valueAt } from "../state.js";

/** @import { Change } from "../fields.js" */
/** @import { FrozenState as State, Tables } from "../state.js" */

/**
 * The fields of a section by their names, in a fieldset.
 *
 * @param {string} section
 * @param {string} title
 * @param {string[]} names
 * @param {{ state: State, tables: Tables, onChange: (change: Change) => void }} source
 */
export function fieldset(section, title, names, { state, tables, onChange }) {
  /** @param {string} path */
  const given = (path) => valueAt(tables, path);
  const paths = names.map((name) => `${section}.${name}`);
  const fields = paths.map((path) => fieldFor(path, schema.fieldOf(path) ?? {}, { state, given, onChange }));
  return framed(title, element("div", { class: "grid" }, ...fields));
}

/**
 * Show in grey what counts where nothing is typed.
 *
 * @param {HTMLElement} holder
 * @param {Tables} inputs of an answer, in SI
 */
export function showValues(holder, inputs) {
  /** @type {NodeListOf<HTMLElement>} */
  const fields = holder.querySelectorAll(".field[data-path]");
  for (const field of fields) {
    const path = field.dataset.path ?? "";
    const select = field.querySelector("select.unit");
    if (field.querySelector("input") && (select || !schema.fieldOf(path)?.["x-si-unit"])) {
      showEffective(field, schema.fieldOf(path), valueAt(inputs, path));
    }
  }
}

/**
 * Put faults beside their fields.
 *
 * @param {HTMLElement} holder
 * @param {FaultLine[]} faults
 * @returns {FaultLine[]} those of no field here
 */
export function placeFaults(holder, faults) {
  return markFaults(holder, faults, ({ path }) => fieldIn(holder, path));
}
