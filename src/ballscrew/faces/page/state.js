// What the state of the page is: its designs, each with its start, its own tables and its changes, and how it stands in
// the address. The state that is there has store.js.

export const LETTERS = ["A", "B", "C", "D", "E", "F", "G", "H"];
const OTHER_KEYS = ["need", "show", "units", "band", "at", "view", "hours", "rest", "heat"];
/** What a page shows whose address says nothing, and what it shows of an address that says no view. */
export const USUAL_VIEW = "torque";
/** Hours of work and of rest of a warm-up. */
const HOURS = "4";
const REST = "0";
/** What a design has beside its start and its changes: texts, and tables as JSON. */
const OWN_TEXTS = /** @type {const} */ (["name", "file"]);
const OWN_TABLES = /** @type {const} */ (["tables", "aside"]);
/** Sections that are the screw itself: another start brings its own. */
export const OF_SCREW = ["screw", "nut", "bodies", "deviations"];

/** @typedef {import("./schema.js").SchemaNode} SchemaNode */
/** @typedef {(path: string) => SchemaNode | undefined} Schema */
/** @typedef {Record<string, any>} Tables */
/**
 * What a design may have beside its start and its changes: whole sections in place of those of its start, null for one
 * that it has not; its name; the file that it came from; and tables of that file that no case has, kept for download.
 *
 * @typedef {{ tables?: Tables, aside?: Tables, name?: string, file?: string }} Own
 */
/**
 * A design: its start (``paper`` or a catalogue row), and the changed texts by ``section.field``.
 *
 * @typedef {{ start: string, changes: Record<string, string> } & Own} Design
 */
/**
 * What a screw has to do: texts and units by field, the rest of the tables of a file, and whether the duty of the
 * current design counts.
 *
 * @typedef {{ texts: Record<string, string>, units: Record<string, string>, rest: Tables, duty: boolean }} Need
 */
/**
 * ``show`` is the place of the current design, ``own`` compares each design at its own load and speed, ``fields`` has
 * units chosen for single fields, ``view`` is the address of the pane that is seen, ``heat`` has the hours of work and of rest of a
 * warm-up as they were typed, and whether it has bands. ``table`` is the table of screws that was opened last, which is
 * too large for the address.
 *
 * @typedef {object} State
 * @property {Design[]} designs
 * @property {number} show
 * @property {string} system
 * @property {boolean} band
 * @property {boolean} own
 * @property {Record<string, string>} fields
 * @property {string} view
 * @property {{ hours: string, rest: string, band: boolean }} heat
 * @property {Need} need
 * @property {OwnTable} [table]
 */
/** @typedef {{ file: { name: string, base64: string }, opened: Opened }} OwnTable */
/** What nobody may change who reads it. @template T @typedef {T extends object ? { readonly [Name in keyof T]: Frozen<T[Name]> } : T} Frozen */
/** The state for those who read it. @typedef {Frozen<State>} FrozenState */
/** @typedef {Frozen<Design>} FrozenDesign */

/**
 * @param {string} start
 * @param {Record<string, string>} changes
 * @param {Own} own
 * @returns {Design}
 */
export function design(start = "paper", changes = {}, own = {}) {
  return { start, changes: { ...changes }, ...structuredClone(own) };
}

/**
 * What a design has of its own.
 *
 * @param {Design} one
 * @returns {Own}
 */
export function ownOf({ start, changes, ...own }) {
  return own;
}

/**
 * What stays of a design when another screw takes the place of its own: its name and the tables of its use.
 *
 * @param {Own} own
 * @returns {Own}
 */
export function ownOfUse({ name, tables: sections = {} }) {
  const kept = Object.entries(sections).filter(([section]) => !OF_SCREW.includes(section));
  return { ...(name && { name }), ...(kept.length && { tables: Object.fromEntries(kept) }) };
}

/**
 * The tables of a start with whole sections of a design in place of its own.
 *
 * @param {Tables} start
 * @param {Own} own
 * @returns {Tables}
 */
export function base(start, { tables: sections = {} }) {
  const found = { ...start, ...sections };
  return Object.fromEntries(Object.entries(found).filter(([, section]) => section !== null));
}

/** @returns {Need} */
function noNeed() {
  return { texts: {}, units: {}, rest: {}, duty: false };
}

/**
 * @param {string | null} text
 * @returns {Need}
 */
function needIn(text) {
  const { texts, units, rest, duty } = tablesIn(text ?? "") ?? {};
  return { texts: plainTexts(texts), units: plainTexts(units), rest: isTable(rest) ? rest : {}, duty: duty === true };
}

/** @param {unknown} value @returns {value is Tables} */
function isTable(value) {
  return value !== null && typeof value === "object" && !Array.isArray(value);
}

/**
 * The texts of a table.
 *
 * @param {unknown} table
 * @returns {Record<string, string>}
 */
function plainTexts(table) {
  return isTable(table) ? Object.fromEntries(Object.entries(table).filter(([, one]) => typeof one === "string")) : {};
}

/** The state of a page that has just been opened. @returns {State} */
export function initial() {
  const heat = { hours: HOURS, rest: REST, band: false };
  return {
    designs: [design()],
    show: 0,
    system: "metric",
    band: true,
    own: false,
    fields: {},
    view: USUAL_VIEW,
    heat,
    need: noNeed(),
  };
}

/**
 * The state as the fragment of an address.
 *
 * @param {FrozenState} state
 */
export function toFragment(state) {
  const parameters = new URLSearchParams();
  state.designs.forEach((one, place) => {
    parameters.set(LETTERS[place], one.start);
    for (const key of OWN_TEXTS) if (one[key]) parameters.set(`${LETTERS[place]}.${key}`, one[key]);
    for (const key of OWN_TABLES) {
      if (Object.keys(one[key] ?? {}).length) parameters.set(`${LETTERS[place]}.${key}`, JSON.stringify(one[key]));
    }
    for (const [path, text] of Object.entries(one.changes)) parameters.set(`${LETTERS[place]}.${path}`, text);
  });
  if (!isSame(state.need, noNeed())) parameters.set("need", JSON.stringify(state.need));
  if (state.show) parameters.set("show", LETTERS[state.show]);
  if (state.system !== "metric") parameters.set("units", state.system);
  for (const [path, unit] of Object.entries(state.fields)) parameters.set(`unit.${path}`, unit);
  if (!state.band) parameters.set("band", "0");
  if (state.own) parameters.set("at", "own");
  if (state.view !== USUAL_VIEW) parameters.set("view", state.view);
  if (state.heat.hours !== HOURS) parameters.set("hours", state.heat.hours);
  if (state.heat.rest !== REST) parameters.set("rest", state.heat.rest);
  if (state.heat.band) parameters.set("heat", "band");
  return `#${parameters}`;
}

/**
 * The state that a fragment describes, and its ``unknown`` keys, which are ignored.
 *
 * @param {string} fragment
 * @param {Schema} schema
 * @param {(unit: string, field: SchemaNode | undefined) => boolean} isUnit
 */
export function fromFragment(fragment, schema, isUnit) {
  const parameters = new URLSearchParams(fragment.replace(/^#/, ""));
  const state = initial();
  const letters = LETTERS.filter((letter) => parameters.has(letter));
  if (letters.length) state.designs = letters.map((letter) => design(parameters.get(letter) ?? ""));
  /** @type {string[]} */
  const unknown = [];
  for (const [key, text] of parameters) {
    const [first, ...others] = key.split(".");
    const path = others.join(".");
    const place = letters.indexOf(first);
    if (place >= 0 && takeOwn(state.designs[place], path, text)) continue;
    if (place >= 0 && schema(path)) state.designs[place].changes[path] = text;
    else if (first === "unit" && isUnit(text, schema(path))) state.fields[path] = text;
    else if (!OTHER_KEYS.includes(key) && !letters.includes(key)) unknown.push(key);
  }
  state.show = Math.max(0, letters.indexOf(parameters.get("show") ?? ""));
  state.system = parameters.get("units") ?? "metric";
  state.band = parameters.get("band") !== "0";
  state.own = parameters.get("at") === "own";
  state.need = needIn(parameters.get("need"));
  if (parameters.size) state.view = parameters.get("view") ?? USUAL_VIEW;
  state.heat = {
    hours: parameters.get("hours") ?? HOURS,
    rest: parameters.get("rest") ?? REST,
    band: parameters.get("heat") === "band",
  };
  return { state, unknown };
}

/**
 * Take what a design has of its own from an address; false where it is something else.
 *
 * @param {Design} one
 * @param {string} key
 * @param {string} text
 */
function takeOwn(one, key, text) {
  for (const known of OWN_TEXTS) if (key === known) one[known] = text;
  for (const known of OWN_TABLES) {
    if (key !== known) continue;
    const found = tablesIn(text);
    if (!found) return false;
    one[known] = found;
  }
  return /** @type {readonly string[]} */ ([...OWN_TEXTS, ...OWN_TABLES]).includes(key);
}

/**
 * Tables written as JSON; none where it is none.
 *
 * @param {string} text
 * @returns {Tables | undefined}
 */
function tablesIn(text) {
  try {
    const found = JSON.parse(text);
    return isTable(found) ? found : undefined;
  } catch {
    return undefined;
  }
}

/**
 * The value at a path of nested tables.
 *
 * @param {Tables | undefined} tables
 * @param {string} path
 * @returns {any}
 */
export function valueAt(tables, path) {
  /** @type {any} */
  let found = tables;
  for (const name of path.split(".")) {
    found = found && typeof found === "object" && Object.hasOwn(found, name) ? found[name] : undefined;
  }
  return found;
}

/**
 * The tables of a case: those of its start with the changes applied.
 *
 * @param {Tables} start
 * @param {Record<string, string>} changes
 * @param {Schema} schema
 */
export function tables(start, changes, schema) {
  const found = structuredClone(start);
  for (const [path, text] of Object.entries(changes)) {
    put(found, path.split("."), text === "" ? undefined : typed(schema, path, text));
  }
  for (const [name, table] of Object.entries(found)) {
    if (!(name in start) && !Object.keys(table).length) delete found[name];
  }
  return found;
}

/**
 * @param {Tables} table
 * @param {string[]} path
 * @param {string | number | boolean | undefined} value
 */
function put(table, [name, ...others], value) {
  if (!others.length) {
    // a law by its name keeps the coefficients that were set beside it
    if (value === undefined) delete table[name];
    else if (typeof table[name] === "object" && typeof value === "string") table[name] = { ...table[name], law: value };
    else table[name] = value;
    return;
  }
  if (typeof table[name] === "string") table[name] = { law: table[name] };
  if (typeof table[name] !== "object" || Array.isArray(table[name])) {
    if (value === undefined) return;
    table[name] = {};
  }
  put(table[name], others, value);
  if (!Object.keys(table[name]).length && others.length === 1 && name !== "nut") delete table[name];
}

/**
 * Text in the type of the case file: a plain number where the schema has one, else as it is.
 *
 * @param {Schema} schema
 * @param {string} path
 * @param {string} text
 */
function typed(schema, path, text) {
  const field = schema(path);
  if (field?.type === "boolean") return text === "true";
  const types = [field?.type, ...(field?.anyOf ?? []).map((one) => one.type)];
  const plain = field && !field["x-si-unit"] && (types.includes("number") || field.type === "integer");
  return plain && /^[-+]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?$/i.test(text.trim()) ? Number(text) : text;
}

/**
 * The tables of a catalogue row by its name: a file of it, a report and a check keep the name. Where a number of the row
 * was taken away they stay as they are, since the row would bring it back.
 *
 * @param {string} name
 * @param {Tables} start
 * @param {Tables} found
 * @returns {Tables}
 */
export function named(name, start, found) {
  const { screw: listed = {} } = start;
  const { screw = {} } = found;
  if (!isTable(screw) || Object.keys(listed).some((field) => !(field in screw))) return found;
  const changed = Object.entries(screw).filter(([field, value]) => !isSame(value, listed[field]));
  return { ...found, screw: { catalogue: name, ...Object.fromEntries(changed) } };
}

/** Test whether both are the same as JSON. @param {unknown} one @param {unknown} other */
export function isSame(one, other) {
  return JSON.stringify(one) === JSON.stringify(other);
}
