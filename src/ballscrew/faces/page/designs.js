// Designs of the page: the case of each, and the changes that the form and the cards make to them.

import * as schema from "./schema.js";
import { alone, get } from "./server.js";
import * as states from "./state.js";
import { store } from "./store.js";
import { vocabulary } from "./vocabulary.js";

/** Sections that belong to the use of a screw, not to the screw. */
export const OF_USE = ["operation", "lubricant", "model", "losses", "installation", "limits"];
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
/** What another design on the page is: a step, with a form of its own. */
const STEP = { rebuild: true, isStep: true };

/** Tables of the cases to start from, by name, which the server has said. @type {Map<string, states.Tables>} */
const starts = new Map();
/** Leads in SI of screws whose lead is no plain number, by the screw as it is given. @type {Map<string, number>} */
const leads = new Map();

/** The design on the page. */
export function current() {
  return designIn(store.state);
}

/**
 * The design that a state shows.
 *
 * @template {states.FrozenState} State
 * @param {State} state
 * @returns {State["designs"][number]}
 */
function designIn({ designs, show }) {
  return designs[show];
}

/**
 * Test whether the page can start from this name.
 *
 * @param {string} name
 */
export function isKnown(name) {
  return (
    Object.hasOwn(vocabulary.starts, name) ||
    vocabulary.rows.some((row) => row.name === name && !(alone.answers && row.refusal))
  );
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
 * @param {states.FrozenDesign} design
 */
function baseOf(design) {
  return states.base(starts.get(design.start) ?? {}, design);
}

/**
 * The tables of a design whose start is known, as the form shows them.
 *
 * @param {states.FrozenDesign} design
 */
export function tablesOf(design) {
  return states.tables(baseOf(design), design.changes, schema.fieldOf);
}

/** The lead of the current design as it is given, and in SI, where it was computed with one. */
export function currentLead() {
  const { screw } = tablesOf(current());
  return { given: screw?.lead, computed: leads.get(JSON.stringify(screw)) };
}

/**
 * Keep the lead that the current design was computed with.
 *
 * @param {number} lead in SI
 */
export function keepLead(lead) {
  leads.set(JSON.stringify(tablesOf(current()).screw), lead);
}

/**
 * The case of a design, as a file has it.
 *
 * @param {states.FrozenDesign} design
 */
export async function caseOf(design) {
  const start = await startOf(design.start);
  const found = tablesOf(design);
  if (isWrittenOut(design) && found.screw?.catalogue) {
    const { catalogue, ...changed } = found.screw;
    return { ...found, screw: { ...(await startOf(catalogue)).screw, ...changed } };
  }
  return isRow(design.start) && !isWrittenOut(design) ? states.named(design.start, start, found) : found;
}

/**
 * True where a design says all of a row itself: by the program what follows from the geometry of a row would follow another
 * one, and without a server nothing does.
 *
 * @param {states.FrozenDesign} design
 */
function isWrittenOut({ changes }) {
  return Boolean(alone.answers) && Object.keys(changes).some((path) => path.startsWith("screw."));
}

/**
 * What files of a design are called.
 *
 * @param {states.FrozenDesign} design
 */
export function fileName({ name, file, start }) {
  const text = name || file?.replace(/\.[^.]*$/, "") || start;
  return text.replaceAll(NOT_IN_FILES, "-");
}

/**
 * Change texts of the current design; a text is kept where it differs from its start.
 *
 * @param {Record<string, string>} texts by their paths, in their order
 * @param {import("./store.js").About} about
 */
export function change(texts, about) {
  return store.change((state) => {
    const design = designIn(state);
    for (const [path, text] of Object.entries(texts)) changeText(design, path, text);
  }, about);
}

/**
 * @param {states.Design} design
 * @param {string} path
 * @param {string} text
 */
function changeText(design, path, text) {
  const { changes } = design;
  if (text === "" && states.valueAt(baseOf(design), path) === undefined) delete changes[path];
  else changes[path] = text;
  if (text === "") {
    for (const inner of Object.keys(changes)) if (inner.startsWith(`${path}.`)) delete changes[inner];
  }
}

/**
 * Take the change of a text of the current design back: its start has it again.
 *
 * @param {string} path
 */
export function takeBack(path) {
  store.change((state) => delete designIn(state).changes[path], STEP);
}

/** Take all changes of the current design back. */
export function reset() {
  replaceBy(states.design(current().start, {}, states.ownOf(current())));
}

/**
 * Put another screw in the place of that of the current design.
 *
 * @param {string} start
 * @param {Record<string, string>} units in which fields go on to be shown
 */
export function startFrom(start, units) {
  const changes = { ...changesOfUse(current()), ...preloadFor(start) };
  replaceBy(states.design(start, changes, states.ownOfUse(current())), units);
}

/**
 * Put a design in the place of the current one.
 *
 * @param {states.Design} design
 * @param {Record<string, string>} [units]
 */
function replaceBy(design, units) {
  store.change((state) => {
    state.designs[state.show] = design;
    Object.assign(state.fields, units);
  }, STEP);
}

/**
 * Show a field in another unit.
 *
 * @param {string} path
 * @param {string} unit
 */
export function chooseUnit(path, unit) {
  store.change(
    (state) => {
      state.fields[path] = unit;
    },
    { rebuild: true, of: "view" },
  );
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
 * @param {states.FrozenDesign} design
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
export function setTables(sections, path) {
  const given = Object.keys(sections);
  return store.change(
    (state) => {
      const design = designIn(state);
      // a typed text of such a section is replaced with it
      for (const one of Object.keys(design.changes)) if (given.includes(one.split(".")[0])) delete design.changes[one];
      design.tables = { ...design.tables, ...structuredClone(sections) };
    },
    schema.areOfCards(given) ? { of: "cards", isStep: !path, path } : STEP,
  );
}

/**
 * Change the need of the card of choosing; all keys of one field are undone at once.
 *
 * @param {states.Frozen<states.Need>} need
 * @param {string} [path] the field that was edited, if it was one
 */
export function setNeed(need, path) {
  store.change(
    (state) => {
      state.need = structuredClone(need);
    },
    { of: "cards", isStep: !path, path },
  );
}

/**
 * Have a table of screws to choose from.
 *
 * @param {states.OwnTable} table
 */
export function useTable(table) {
  store.change(
    (state) => {
      state.table = table;
    },
    { of: "cards" },
  );
}

// -- files and several designs ----------------------------------------------------------------------

/**
 * What a design of no row has its screw from: its file, or its own tables; nothing where that is its start.
 *
 * @param {states.FrozenDesign} design
 */
export function ownScrewOf({ name, file, start, tables }) {
  if (isRow(start)) return undefined;
  return file ?? (tables?.screw ? name || "a screw of your own" : undefined);
}

/**
 * The start whose screw and axis a design has as they are: an example, where it is no row of the catalogue.
 *
 * @param {states.FrozenDesign} design
 */
export function exampleOf(design) {
  const { start, changes, tables } = design;
  const changed = [...Object.keys(changes), ...Object.keys(tables ?? {})].map((path) => path.split(".")[0]);
  const ofExample = [...states.OF_SCREW, ...Object.keys(schema.OF_CARDS)];
  const isOwn = design.file !== undefined || changed.some((section) => ofExample.includes(section));
  return isRow(start) || isOwn ? undefined : start;
}

/** What people call a design: its name, and what it starts from. @param {states.FrozenDesign} design */
export function titleOf(design) {
  const { name, start } = design;
  const from = ownScrewOf(design) ?? start;
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
  const { designs } = store.state;
  const first = designs.length === 1 && isUntouched(current()) ? 0 : designs.length;
  const taken = more.slice(0, states.LETTERS.length - first);
  if (taken.length) {
    store.change((state) => {
      state.designs.splice(first, state.designs.length, ...taken);
      state.show = first;
    }, STEP);
  }
  return more.length - taken.length;
}

/** @param {states.FrozenDesign} design */
function isUntouched(design) {
  return !isRow(design.start) && !Object.keys(design.changes).length && !Object.keys(states.ownOf(design)).length;
}

/** Test whether one more design has its place. */
export function hasRoom() {
  return store.state.designs.length < states.LETTERS.length;
}

/**
 * Show another design.
 *
 * @param {number} place
 */
export function show(place) {
  store.change((state) => {
    state.show = place;
  }, STEP);
}

/**
 * Add a copy of a design.
 *
 * @param {number} place
 */
export function duplicate(place) {
  store.change((state) => {
    const { start, changes, name, ...own } = state.designs[place];
    state.designs.push(states.design(start, changes, own));
    state.show = state.designs.length - 1;
  }, STEP);
}

/**
 * Take a design away; the last one stays.
 *
 * @param {number} place
 */
export function remove(place) {
  if (store.state.designs.length === 1) return;
  store.change((state) => {
    state.designs.splice(place, 1);
    if (state.show > place || state.show === state.designs.length) state.show -= 1;
  }, STEP);
}

/**
 * Give a design a name; all keys of one name are undone at once.
 *
 * @param {number} place
 * @param {string} name
 */
export function rename(place, name) {
  store.change(
    (state) => {
      if (name) state.designs[place].name = name;
      else delete state.designs[place].name;
    },
    { rebuild: true, path: `${states.LETTERS[place]}.name` },
  );
}

/**
 * Move what stands at a path of the tables of a file, and no case has, to what is kept aside.
 *
 * @param {string} path
 */
export function setAside(path) {
  const parts = path.split(".");
  const name = parts.pop() ?? "";
  /** @type {states.Tables} */
  const aside = { ...structuredClone(current().aside) };
  /** @type {states.Tables} */
  const own = { ...structuredClone(current().tables) };
  const from = parts.length ? states.valueAt(own, parts.join(".")) : own;
  if (!from || typeof from !== "object" || !Object.hasOwn(from, name)) return;
  let to = aside;
  for (const part of parts) to = to[part] ??= {};
  to[name] = from[name];
  delete from[name];
  store.change((state) => Object.assign(designIn(state), { aside, tables: own }), STEP);
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
  for (const [place, one] of store.state.designs.entries()) {
    const wanted = one.name || `${states.LETTERS[place]} ${titleOf(one)}`;
    let name = wanted;
    for (let number = 2; names.has(name); number += 1) name = `${wanted} (${number})`;
    names.add(name);
    found.push({ name, case: await caseOf(one), ...(one.aside && { aside: one.aside }) });
  }
  return found;
}
