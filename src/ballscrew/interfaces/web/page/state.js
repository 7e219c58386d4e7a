// The state of the page: up to four designs, each where it starts from and what was changed. All of it is in the address.

export const LETTERS = ["A", "B", "C", "D"];
const OWN = ["show", "units", "band"];

/** A design: the name of its start (``paper`` or a catalogue row), and the texts changed by ``section.field``. */
export function design(start = "paper", changes = {}) { return { start, changes: { ...changes } }; }

export function fresh() { return { designs: [design()], show: 0, system: "metric", band: false, fields: {} }; }

/** The state as the fragment of an address. */
export function written(state) {
  const words = new URLSearchParams();
  state.designs.forEach((one, place) => {
    words.set(LETTERS[place], one.start);
    for (const [path, text] of Object.entries(one.changes)) words.set(`${LETTERS[place]}.${path}`, text);
  });
  if (state.show) words.set("show", LETTERS[state.show]);
  if (state.system !== "metric") words.set("units", state.system);
  for (const [path, unit] of Object.entries(state.fields)) words.set(`unit.${path}`, unit);
  if (state.band) words.set("band", "1");
  return `#${words}`;
}

/**
 * The state that a fragment stands for, and the words of it that are ``strange``: they are left out.
 * ``schema(path)`` knows the fields, ``isUnit(unit, field)`` their units.
 */
export function read(fragment, schema, isUnit) {
  const words = new URLSearchParams(fragment.replace(/^#/, ""));
  const state = fresh();
  const letters = LETTERS.filter((letter) => words.has(letter));
  if (letters.length) state.designs = letters.map((letter) => design(words.get(letter)));
  const strange = [];
  for (const [key, text] of words) {
    const [first, ...others] = key.split("."), path = others.join(".");
    const place = letters.indexOf(first);
    if (place >= 0 && schema(path)) state.designs[place].changes[path] = text;
    else if (first === "unit" && isUnit(text, schema(path))) state.fields[path] = text;
    else if (!OWN.includes(key) && !letters.includes(key)) strange.push(key);
  }
  state.show = Math.max(0, letters.indexOf(words.get("show")));
  state.system = words.get("units") ?? "metric";
  state.band = words.get("band") === "1";
  return { state, strange };
}

/** What is at a path of tables within tables. */
export function inside(tables, path) {
  return path.split(".").reduce((table, name) => (table && typeof table === "object" && Object.hasOwn(table, name) ? table[name] : undefined), tables);
}

/** The tables of a case: those of its start with the changes put in. */
export function tables(start, changes, schema) {
  const found = structuredClone(start);
  for (const [path, text] of Object.entries(changes)) put(found, path.split("."), text === "" ? undefined : typed(schema, path, text));
  for (const [name, table] of Object.entries(found)) if (!(name in start) && !Object.keys(table).length) delete found[name];
  return found;
}

function put(table, [name, ...others], value) {
  if (!others.length) {
    // a law by its name keeps the coefficients that were set beside it
    if (value === undefined) delete table[name];
    else if (typeof table[name] === "object" && typeof value === "string") table[name] = { ...table[name], law: value };
    else table[name] = value;
    return;
  }
  if (typeof table[name] === "string") table[name] = { law: table[name] };
  if (table[name] === undefined) {
    if (value === undefined) return;
    table[name] = {};
  }
  put(table[name], others, value);
  if (others.length && !Object.keys(table[name]).length && others.length === 1 && name !== "nut") delete table[name];
}

/** Text as the case file wants it: a plain number where the schema has one, else as it is. */
function typed(schema, path, text) {
  const field = schema(path);
  if (field?.type === "boolean") return text === "true";
  const plain = field && !field["x-si-unit"] && (field.type === "number" || field.type === "integer" || field.anyOf?.some((one) => one.type === "number"));
  return plain && /^[-+]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?$/i.test(text.trim()) ? Number(text) : text;
}
