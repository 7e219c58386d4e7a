// A case as the modules of the page take it, where no server reads it: its start, its structure and all its inputs. What
// the modules do not know is refused by its field, for the program knows it.

import { textsOf, valueAt } from "./case_values.js";
import { Problem } from "./server.js";
import * as units from "./units.js";

/** @typedef {Record<string, any>} Tables */
/** @typedef {import("./engine.js").Engine} Engine */
/**
 * A case that is read: the names of its start and its structure, its inputs in SI, all values of its start with them, what
 * else was given for the checks and is listed of its screw, its oil, and the fields that an input follows from.
 *
 * @typedef {{
 *   tables: Tables, start: string, structure: string, kind: string, inputs: Record<string, number>,
 *   values: Record<string, number>, given: Tables, listed: Tables, grade: string, temperature: number, kept: string[],
 *   places: CaseModule["places"],
 * }} CaseAlone
 */

/** Sections that no module takes: other views ask about them. */
const OF_OTHERS = ["axis", "motion", "motor", "surroundings", "bearings", "guides", "aside", "price", "estimates"];
/** The start whose oil is given by its viscosity, and whose screw is given by its sizes. */
const PLAIN = "paper";
const TEMPERATURE = "temperature";
const SEALS = "losses.seals.seal_torque";
/** Fields that choose the structure and the start. */
const CHOICES = ["screw.catalogue", "nut.type", "nut.spacer_balls", "model.name", "lubricant.grade", "bodies"];
const SHARE = /\s*%\s*$/;
/** Fields of a screw that its number of balls follows from. */
const OF_BALLS = ["pitch_circle_diameter", "lead", "ball_diameter", "starts"].map((name) => `screw.${name}`);
/** What every case gives. */
const ALWAYS = ["operation.axial_load", "operation.screw_speed"];
/** What is read after all others, from which it follows. */
const LAST = ["nut.preload", "operation.screw_speed"];

/**
 * A fault of a field, as the server says it.
 *
 * @param {string} where
 * @param {string} problem
 * @param {string} given
 * @param {string} remedy
 */
function fault(where, problem, given, remedy) {
  return /** @type {FaultLine} */ (/** @type {unknown} */ ({ where, problem, given, remedy, id: "" }));
}

/** @param {FaultLine[]} faults */
function refused(faults) {
  return new Problem({
    title: "This page cannot compute the case.",
    faults,
    lines: faults.map(({ where, problem, given, remedy }) => `${where}: ${problem} ${given}; ${remedy}`),
  });
}

/** What is unknown to the modules. @param {string} path @param {unknown} given */
function unknown(path, given) {
  return fault(
    path,
    "is not computed by a page without a server",
    String(given ?? ""),
    "save the case and give it to the program",
  );
}

/** The name of a kind of nut. @param {Tables} tables */
function kindOf({ nut, bodies }) {
  if (!nut?.type) return "row";
  return `${nut.type}${bodies ? "+elastic" : ""}${nut.spacer_balls === true ? "+spacers" : ""}`;
}

/**
 * Read a case. Throws a {@link Problem} for what the modules do not know, and for what is no number or beyond its bounds.
 *
 * @param {any} contents
 * @param {Engine} engine
 * @param {Tables} tables
 * @returns {Promise<CaseAlone>}
 */
export async function read(contents, engine, tables) {
  const { starts, models, structures, oils, judging } = contents;
  const start = tables.screw?.catalogue ?? PLAIN;
  const kind = kindOf(tables);
  const model = tables.model?.name ?? Object.keys(models)[0];
  const structure = `${model}/${kind}`;
  if (!starts[start]) throw refused([unknown("screw.catalogue", start)]);
  if (!models[model]) throw refused([unknown("model.name", model)]);
  if (!structures[structure]) throw refused([unknown("nut.type", kind)]);
  await engine.load(structure);
  const texts = inOrder(
    textsOf(Object.fromEntries(Object.entries(tables).filter(([name]) => !OF_OTHERS.includes(name)))),
  );
  const own = starts[start];
  /** @type {Record<string, number>} */
  const values = { ...models[model].values, ...own.values, ...own.nuts[kind].values, [SEALS]: 0 };
  /** @type {FaultLine[]} */
  const faults = [];
  const { grade = "" } = tables.lubricant ?? {};
  const kept = [...texts.keys()].filter((path) => path.startsWith("lubricant.")).map((path) => path.slice(10));
  let temperature = Number.NaN;
  if (grade) {
    const place = contents.fields[TEMPERATURE];
    const written = texts.get("lubricant.temperature");
    const value = written === undefined ? undefined : valueAt(written, place);
    if (!oils.grades[grade]) faults.push(unknown("lubricant.grade", grade));
    else if (value === undefined) faults.push(fault("lubricant.temperature", "missing", "", "give the temperature"));
    else {
      temperature = value;
      for (const [name, [number]] of Object.entries(engine.oil(grade, value, 1))) values[name] = number;
      Object.assign(values, oils.grades[grade].constants);
    }
  } else {
    for (const [name, value] of Object.entries(starts[PLAIN].values)) {
      if (contents.fields[name]?.path.startsWith("lubricant.")) values[name] = value;
    }
    if (!texts.has("lubricant.viscosity")) faults.push(fault("lubricant.viscosity", "missing", "", "give a viscosity"));
  }
  if (grade && texts.has("lubricant.viscosity")) {
    faults.push(fault("lubricant.viscosity", "stands beside a grade", "", "give one of them"));
  }
  const ofNut = [...texts.keys()].find((path) => path.startsWith("nut.") || path.startsWith("bodies"));
  if (kind === "row" && ofNut) faults.push(fault("nut.type", "missing", "", "choose the kind of nut"));
  if (contents.kinds[kind].is_preloaded && !texts.has("nut.preload")) {
    faults.push(fault("nut.preload", "missing", "", "give the preload"));
  }
  const listed = { ...own.judged.listed };
  /** @type {Tables} */
  const given = {};
  /** @type {CaseModule["places"]} */
  const places = {};
  for (const [path, text] of texts) {
    const written = JSON.parse(text);
    const name = inputAt(contents, path);
    const known = contents.fields[name];
    const judged = judging.given[path] ?? judging.given[path.replace(/^installation\./, "")];
    if (CHOICES.includes(path) || isLaw(contents, structure, path, written)) continue;
    if (path === "installation.ends" && judging.ends[written]) given.ends = written;
    else if (path === "nut.preload" && SHARE.test(String(written))) {
      const share = Number(units.withPoint(units.inASCII(String(written).replace(SHARE, ""))));
      const rating = Number(listed.dynamic_load_rating);
      if (!(share >= 0 && share <= 100)) faults.push(notRead(path, written));
      else if (!rating) faults.push(fault(path, "is a share of a dynamic load rating that is not known", written, ""));
      else values.preload = (share / 100) * rating;
    } else if (judged || contents.listed[path]) {
      const value = readAt(text, judged ?? contents.listed[path]);
      if (value === undefined) faults.push(notRead(path, written));
      else if (judged) given[path.replace(/^installation\./, "")] = value;
      else listed[path.replace(/^screw\./, "")] = value;
    } else if (known && (name === TEMPERATURE ? grade : Object.hasOwn(values, name))) {
      const value = path === "operation.screw_speed" ? speedAt(text, known, values.lead) : readAt(text, known);
      if (name === TEMPERATURE) places[path] = { input: name, ...boundsOf(known) };
      else if (value === undefined) faults.push(notRead(path, written));
      else values[name] = value;
      places[path] = { input: name, ...boundsOf(known) };
    } else faults.push(unknown(path, written));
  }
  const isOfRow = start !== PLAIN && !texts.has("screw.loaded_balls");
  const changed = Object.keys(places).find((path) => isOfRow && OF_BALLS.includes(path));
  if (changed) faults.push(fault(changed, "changes the balls of its row", "", "give the loaded balls, too"));
  const isHeld = given.unsupported_length !== undefined || given.ends !== undefined;
  const needed = [
    ...ALWAYS,
    ...(start === PLAIN ? contents.needed : []),
    ...(isHeld ? ["installation.unsupported_length", "installation.ends"] : []),
  ];
  for (const path of needed) if (!texts.has(path)) faults.push(fault(path, "missing", "", "give a value"));
  if (faults.length) throw refused(faults);
  const names = [...structures[structure].inputs, ...Object.keys(own.nuts[kind].values)];
  const inputs = Object.fromEntries(names.map((name) => [name, values[name]]));
  return { tables, start, structure, kind, inputs, values, given, listed, grade, temperature, kept, places };
}

/** Texts in an order in which each can be read. @param {Map<string, string>} texts */
function inOrder(texts) {
  const rank = (/** @type {string} */ path) => (path.startsWith("screw.") ? 0 : LAST.includes(path) ? 2 : 1);
  return new Map([...texts].sort(([one], [other]) => rank(one) - rank(other)));
}

/** The value of a field, which needs its unit where it has one. @param {string} text as JSON @param {any} place */
function readAt(text, place) {
  const written = JSON.parse(text);
  const isPlain = typeof written === "number" && place.unit !== "1";
  return isPlain || typeof written === "object" ? undefined : valueAt(text, place);
}

/** The input that a field is of, by its name. @param {any} contents @param {string} path */
function inputAt({ byPath }, path) {
  return byPath[path] ?? "";
}

/** What a page without a server reads no further. @param {string} path @param {unknown} written */
function notRead(path, written) {
  return fault(
    path,
    "is no number of this field, or beyond its bounds:",
    String(written),
    "write a number with its unit",
  );
}

/** True for a law, or a choice, that the model has anyway. @param {any} contents @param {string} structure @param {string} path @param {unknown} written */
function isLaw({ templates }, structure, path, written) {
  let known = templates[structure];
  for (const name of path.split(".")) known = known?.[name];
  const law = path.endsWith(".law") ? known : (known?.law ?? known);
  return typeof written !== "number" && law === written;
}

/** The speed of the screw, which may be given by that of its nut. @param {string} text @param {any} place @param {number} lead */
function speedAt(text, place, lead) {
  const ofNut = units.parse(JSON.parse(text), "m/s");
  if (!ofNut) return readAt(text, place);
  return (units.toSI(ofNut.number, ofNut.unit, "m/s") / lead) * 2 * Math.PI;
}

/** @param {any} place */
function boundsOf({ unit, above = null, at_least = null, below = null, at_most = null, whole }) {
  return { unit, above, at_least, below, at_most, whole };
}

/**
 * Tables as a TOML file.
 *
 * @param {Tables} tables
 * @param {string} [above]
 * @returns {string}
 */
export function tomlOf(tables, above = "") {
  const entries = Object.entries(tables);
  const isTable = (/** @type {unknown} */ value) =>
    value !== null && typeof value === "object" && !Array.isArray(value);
  const isTables = (/** @type {any} */ value) => Array.isArray(value) && value.length > 0 && value.every(isTable);
  const plain = entries.filter(([, value]) => !isTable(value) && !isTables(value));
  const lines = plain.map(([name, value]) => `${name} = ${JSON.stringify(value)}`);
  const sections = entries.filter(([, value]) => isTable(value));
  const lists = entries.filter(([, value]) => isTables(value));
  const hasHead = lines.length > 0 || sections.length + lists.length === 0;
  const pathOf = (/** @type {string} */ name) => (above ? `${above}.${name}` : name);
  const inner = sections.map(([name, value]) => tomlOf(value, pathOf(name)));
  const rows = lists.flatMap(([name, all]) =>
    all.map((/** @type {Tables} */ row) => `[[${pathOf(name)}]]\n${tomlOf(row)}`),
  );
  const head = above && hasHead ? [`[${above}]`] : [];
  return [...(hasHead ? [[...head, ...lines, ""].join("\n")] : []), ...inner, ...rows].join("\n");
}
