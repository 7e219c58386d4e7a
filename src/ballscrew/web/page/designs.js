// Designs of the page: the case of each, and the changes that the form and the cards make to them.

import * as schema from "./schema.js";
import { get } from "./server.js";
import * as states from "./state.js";

/** Sections that belong to the use of a screw, not to the screw. */
const OF_USE = ["operation", "lubricant", "model", "losses", "installation", "limits"];
/** Fields of an oil that the others follow from. */
const OF_OIL = [
  "viscosity",
  "grade",
  "oil",
  "temperature",
  "kinematic_viscosity_40",
  "kinematic_viscosity_100",
  "density_15",
  "pour_point",
  "lowest_temperature",
  "highest_temperature",
];
/** Letters of a name that stand in the name of a file. */
const NOT_IN_FILES = /[^\p{L}\p{N}._-]+/gu;

/** @type {Vocabulary} */
let vocabulary;
/** @type {states.State} */
let state;
/** Writes the state into the address and shows it. @type {(options: Follow) => Promise<void>} */
let follow;
/** Tables of the cases to start from, by name. @type {Map<string, states.Tables>} */
const starts = new Map();

/** @typedef {{ rebuild?: boolean, keep?: boolean, formOnly?: boolean, path?: string, ofCards?: boolean }} Follow */

/**
 * @param {Vocabulary} words
 * @param {(options: Follow) => Promise<void>} listener follows changes that cards make
 */
export function setUp(words, listener) {
  vocabulary = words;
  follow = listener;
}

/**
 * The state of the page, which is another object after Back.
 *
 * @param {states.State} found
 */
export function use(found) {
  state = found;
}

/** The design on the page. */
export function current() {
  return state.designs[state.show];
}

/** All designs and which of them is shown, to be read. @returns {Readonly<states.State>} */
export function all() {
  return state;
}

/**
 * Test whether the page can start from this name.
 *
 * @param {string} name
 */
export function isKnown(name) {
  return Object.hasOwn(vocabulary.starts, name) || vocabulary.rows.some((row) => row.name === name);
}

/** @param {string} name */
function isRow(name) {
  return !Object.hasOwn(vocabulary.starts, name);
}

/**
 * The tables of a start.
 *
 * @param {string} name
 * @returns {Promise<states.Tables>}
 */
export async function startOf(name) {
  const known = starts.get(name);
  if (known) return known;
  /** @type {CatalogueRow | Vocabulary["starts"][string]} */
  const found = isRow(name) ? await get(`catalogue/${encodeURIComponent(name)}`) : vocabulary.starts[name];
  starts.set(name, found.case);
  return found.case;
}

/**
 * The tables of a design before its changes; its start is known once it has been shown.
 *
 * @param {states.Design} design
 */
function baseOf(design) {
  return states.base(starts.get(design.start) ?? {}, design);
}

/**
 * The tables of a design whose start is known, as the form shows them.
 *
 * @param {states.Design} design
 */
export function tablesOf(design) {
  return states.tables(baseOf(design), design.changes, schema.fieldOf);
}

/**
 * The case of a design, as a file has it.
 *
 * @param {states.Design} design
 */
export async function caseOf(design) {
  const start = await startOf(design.start);
  const found = tablesOf(design);
  return isRow(design.start) ? states.named(design.start, start, found) : found;
}

/**
 * What files of a design are called.
 *
 * @param {states.Design} design
 */
export function fileName({ name, file, start }) {
  const text = name || file?.replace(/\.[^.]*$/, "") || start;
  return text.replaceAll(NOT_IN_FILES, "-");
}

/**
 * Keep a text of the current design where it differs from its start.
 *
 * @param {string} path
 * @param {string} text
 */
export function change(path, text) {
  const design = current();
  const { changes } = design;
  if (text === "" && states.valueAt(baseOf(design), path) === undefined) delete changes[path];
  else changes[path] = text;
  if (text === "") {
    for (const inner of Object.keys(changes)) if (inner.startsWith(`${path}.`)) delete changes[inner];
  }
}

/** Take all changes of the current design back. */
export function reset() {
  const design = current();
  state.designs[state.show] = states.design(design.start, {}, states.ownOf(design));
}

/**
 * Put another screw in the place of that of the current design.
 *
 * @param {string} start
 */
export function startFrom(start) {
  const own = states.ownOfUse(current());
  state.designs[state.show] = states.design(start, changesOfUse(current()), own);
}

/**
 * The changes that stay when another screw takes the place of the current one: an oil that was changed stays whole.
 *
 * @param {states.Design} design
 */
function changesOfUse(design) {
  const kept = Object.fromEntries(
    Object.entries(design.changes).filter(([path]) => OF_USE.includes(path.split(".")[0])),
  );
  if (Object.keys(kept).some((path) => path.startsWith("lubricant."))) {
    const { lubricant } = tablesOf(design);
    for (const name of OF_OIL) kept[`lubricant.${name}`] = String(lubricant[name] ?? "");
  }
  return kept;
}

// -- for cards --------------------------------------------------------------------------------------

/** The case of the current design, with the sections that the form does not show. */
export function currentCase() {
  return caseOf(current());
}

/**
 * Put whole sections of a case into the current design, such as ``{ motion: {…}, axis: {…} }``; null takes one away.
 * The button Back undoes it, and all edits of one field in a row as one.
 *
 * @param {states.Tables} sections
 * @param {string} [path] the field that was edited, if it was one
 */
export async function setTables(sections, path) {
  const design = current();
  const given = Object.keys(sections);
  // a typed text of such a section is replaced with it
  for (const path of Object.keys(design.changes)) if (given.includes(path.split(".")[0])) delete design.changes[path];
  design.tables = { ...design.tables, ...structuredClone(sections) };
  await follow(schema.areOfCards(given) ? { ofCards: true, keep: !path, path } : { rebuild: true, keep: true });
}
