// Designs of the page: the case of each, and the changes that the form and the cards make to them.

import * as schema from "./schema.js";
import { get } from "./server.js";
import * as states from "./state.js";
import { vocabulary } from "./vocabulary.js";

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

/** @type {states.State} */
let state;
/** Writes the state into the address and shows it. @type {(options: Follow) => Promise<void>} */
let follow;
/** Tables of the cases to start from, by name. @type {Map<string, states.Tables>} */
const starts = new Map();

/** @typedef {{ rebuild?: boolean, keep?: boolean, formOnly?: boolean, path?: string, ofCards?: boolean }} Follow */

/**
 * @param {(options: Follow) => Promise<void>} listener follows changes that cards make
 */
export function setUp(listener) {
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

/** The state of the page: all designs, and which of them is shown. */
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
  const changes = { ...changesOfUse(current()), ...preloadFor(start) };
  state.designs[state.show] = states.design(start, changes, own);
}

/**
 * The preload that a design has of its own, for a row with the same kind of nut; one in newton is for the same row.
 *
 * @param {string} start
 * @returns {Record<string, string>}
 */
function preloadFor(start) {
  const row = vocabulary.rows.find(({ name }) => name === start);
  const { type, preload } = /** @type {Record<string, unknown>} */ (tablesOf(current()).nut ?? {});
  const listed = states.valueAt(starts.get(current().start) ?? {}, "nut.preload");
  const isOwn = typeof preload === "string" && preload !== "" && preload !== listed;
  const fits = row?.nut === type && (start === current().start || String(preload).endsWith("%"));
  return isOwn && fits ? { "nut.preload": preload } : {};
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

/**
 * Change the need of the card of choosing; all keys of one field are undone at once.
 *
 * @param {states.Need} need
 * @param {string} [path] the field that was edited, if it was one
 */
export function setNeed(need, path) {
  state.need = need;
  follow({ ofCards: true, keep: !path, path });
}

// -- files and several designs ----------------------------------------------------------------------

/** What people call a design: its name, and what it starts from. @param {states.Design} design */
export function titleOf({ name, file, start }) {
  const from = isRow(start) ? start : (file ?? start);
  return name && name !== from ? `${name}: ${from}` : from;
}

/**
 * The design of a case; one of a catalogue row starts from that row, any other one has nothing of its start.
 *
 * @param {states.Tables} sections
 * @param {states.Own} own
 */
export async function ofCase(sections, own) {
  const { catalogue, ...changed } = { ...sections.screw };
  const isShipped = typeof catalogue === "string" && changed.catalogue_file === undefined;
  const row = isShipped
    ? vocabulary.rows.find(({ name }) => name.toLowerCase() === catalogue.toLowerCase())
    : undefined;
  const start = row?.name ?? Object.keys(vocabulary.starts)[0];
  const known = await startOf(start);
  const absent = Object.keys(known).filter((name) => !Object.hasOwn(sections, name));
  const found = { ...Object.fromEntries(absent.map((name) => [name, null])), ...sections };
  if (row) found.screw = { ...known.screw, ...changed };
  return states.design(start, {}, { ...own, tables: found });
}

/**
 * Add designs to those of the page, where one that nobody has touched gives way; the button Back undoes it.
 *
 * @param {states.Design[]} more
 * @returns {number} how many there was no place for
 */
export function add(more) {
  const untouched = state.designs.length === 1 && isUntouched(current());
  const before = untouched ? [] : state.designs;
  const room = states.LETTERS.length - before.length;
  const taken = more.slice(0, room);
  if (taken.length) {
    state.designs = [...before, ...taken];
    state.show = before.length;
    follow({ rebuild: true, keep: true });
  }
  return more.length - taken.length;
}

/** @param {states.Design} design */
function isUntouched(design) {
  return !isRow(design.start) && !Object.keys(design.changes).length && !Object.keys(states.ownOf(design)).length;
}

/** Test whether one more design has its place. */
export function hasRoom() {
  return state.designs.length < states.LETTERS.length;
}

/**
 * Show another design.
 *
 * @param {number} place
 */
export function show(place) {
  state.show = place;
  follow({ rebuild: true, keep: true });
}

/**
 * Add a copy of a design.
 *
 * @param {number} place
 */
export function duplicate(place) {
  const { start, changes, name, ...own } = state.designs[place];
  state.designs.push(states.design(start, changes, own));
  state.show = state.designs.length - 1;
  follow({ rebuild: true, keep: true });
}

/**
 * Take a design away; the last one stays.
 *
 * @param {number} place
 */
export function remove(place) {
  if (state.designs.length === 1) return;
  state.designs.splice(place, 1);
  if (state.show > place || state.show === state.designs.length) state.show -= 1;
  follow({ rebuild: true, keep: true });
}

/**
 * Give a design a name; all keys of one name are undone at once.
 *
 * @param {number} place
 * @param {string} name
 */
export function rename(place, name) {
  if (name) state.designs[place].name = name;
  else delete state.designs[place].name;
  follow({ rebuild: true, path: `${states.LETTERS[place]}.name` });
}

/**
 * Move what stands at a path of the tables of a file, and no case has, to what is kept aside.
 *
 * @param {string} path
 */
export function setAside(path) {
  const design = current();
  const parts = path.split(".");
  const name = parts.pop() ?? "";
  const aside = { ...structuredClone(design.aside) };
  const own = structuredClone(design.tables ?? {});
  const from = parts.length ? states.valueAt(own, parts.join(".")) : own;
  if (!from || typeof from !== "object" || !Object.hasOwn(from, name)) return;
  let to = aside;
  for (const part of parts) to = to[part] ??= {};
  to[name] = from[name];
  delete from[name];
  design.aside = aside;
  design.tables = own;
  follow({ rebuild: true, keep: true });
}

/** Test whether what stands at a path came from a file. @param {string} path */
export function isOfFile(path) {
  return states.valueAt(current().tables, path) !== undefined;
}

/** All designs as a project file has them, each by a name of its own. */
export async function forProject() {
  /** @type {Set<string>} */
  const names = new Set();
  const found = [];
  for (const [place, one] of state.designs.entries()) {
    const wanted = one.name || `${states.LETTERS[place]} ${titleOf(one)}`;
    let name = wanted;
    for (let number = 2; names.has(name); number += 1) name = `${wanted} (${number})`;
    names.add(name);
    found.push({ name, case: await caseOf(one), ...(one.aside && { aside: one.aside }) });
  }
  return found;
}
