// Verdicts, warnings and checks: what is judged at a point, and the records that say it. The modules judge, the tables
// of the contents have the sentences; here values are put in their places.

/** @typedef {Record<string, any>} Contents */
/** @typedef {Record<string, number | null | undefined>} Numbers */
/** A template with what stands in its places. @typedef {{ template: string, values: Record<string, any> }} Message */
/**
 * What is judged: the names of a structure and a start, the inputs in SI, and what else was given, by the names of the
 * values, ``ends`` by its name.
 * @typedef {{
 *   structure: string, start: string, inputs: Record<string, number>, given: Record<string, any>,
 *   listed?: Record<string, any>,
 * }} Point
 */
/**
 * @typedef {{
 *   id: string, subject: string, severity: string, holds: boolean | null, message: Message,
 *   value: number | null, limit: number | null, unit: string, utilisation: number | null,
 * }} JudgedRecord
 */
/** Digits beyond which a plain number has none. */
const PLAIN = 10;
/** From where on a large number has an exponent, whatever its significant digits. */
const WITH_EXPONENT = 1e6;

/** The first of each array. @param {Record<string, ArrayLike<number>>} found @param {number} place @returns {Numbers} */
function at(found, place) {
  return Object.fromEntries(Object.entries(found).map(([name, values]) => [name, values[place]]));
}

/**
 * What the visitor gave, and what stands for the rest.
 *
 * @param {Contents} contents
 * @param {Point} point
 * @returns {Numbers}
 */
function givenAt({ judging, starts }, { start, given }) {
  const { ends, ...numbers } = given;
  const usual = Object.entries(judging.given).map(([name, { default: value }]) => [name, value]);
  const { buckling_root, whirling_root } = judging.ends[ends] ?? {};
  return {
    ...Object.fromEntries(usual),
    "limits.diameter_speed_product": starts[start].judged.speed_limit.value,
    buckling_root,
    whirling_root,
    ...numbers,
  };
}

/**
 * The outputs at a point and at those beside it, and of the nut with which the screw is checked.
 *
 * @param {import("./engine.js").Engine} engine
 * @param {Contents} contents
 * @param {Point} point
 * @returns {Record<string, Numbers>}
 */
function computedAt(engine, contents, { structure, start, inputs }) {
  const { judging, structures, starts } = contents;
  const places = Object.keys(judging.beside);
  /** @type {import("./engine.js").Values} */
  const varied = { ...inputs };
  for (const name of new Set(places.flatMap((place) => Object.keys(judging.beside[place])))) {
    const others = places.map((place) => judging.beside[place][name] ?? inputs[name]);
    if (name in inputs) varied[name] = [inputs[name], ...others];
  }
  const found = engine.evaluate(structure, varied, places.length + 1);
  const beside = Object.fromEntries(places.map((name, place) => [name, at(found, place + 1)]));
  const outputs = { ...at(found, 0), ...engine.liftOff(structure, inputs) };
  const [model, kind] = structure.split("/");
  const other = judging.checked_as[kind];
  if (other === undefined) return { outputs, ...beside, checked: outputs };
  const name = `${model}/${other}`;
  if (structures[name] === undefined) return { outputs, ...beside, checked: {} };
  const values = { ...starts[start].nuts[other].values, ...inputs };
  return { outputs, ...beside, checked: at(engine.evaluate(name, values, 1), 0) };
}

/**
 * All that is judged at a point: masks and numbers of the rows, which values there are, and what follows from the
 * inputs besides.
 *
 * @param {import("./engine.js").Engine} engine
 * @param {Contents} contents
 * @param {Point} point
 */
export function judgedAt(engine, contents, point) {
  const { judging, starts } = contents;
  const { rule, speed_limit: limit } = starts[point.start].judged;
  const listed = point.listed ?? starts[point.start].judged.listed;
  const kind = point.structure.split("/")[1];
  /** @type {Record<string, Numbers>} */
  const sources = {
    ...computedAt(engine, contents, point),
    inputs: point.inputs,
    given: givenAt(contents, point),
    listed,
  };
  /** @param {[string, string]} place */
  const valueAt = ([source, name]) => sources[source][name];
  const further = Object.entries(judging.for_derived).map(([name, place]) => [name, valueAt(place) ?? null]);
  const derived = at(engine.judge(judging.derived[kind], { ...point.inputs, ...Object.fromEntries(further) }), 0);
  Object.assign(sources, { derived, rule: rule ? { torque: derived[rule.torque] } : {} });
  /** @type {Record<string, number | null>} */
  const values = {};
  /** @type {Set<string>} */
  const known = new Set();
  for (const [name, place] of Object.entries(judging.values)) {
    const value = judging.without[kind].includes(name) ? undefined : valueAt(place);
    values[name] = value ?? null;
    // of what is computed a value that is no number is one; of what is listed or given there is none
    const mayBeNone = !["derived", "given", "rule"].includes(place[0]);
    if (typeof value === "number" && (mayBeNone || !Number.isNaN(value))) known.add(name);
  }
  const isListed = typeof listed.dynamic_load_rating === "number";
  const words = {
    ...(rule?.words ?? {}),
    rating_source: plain(judging.rating_sources[isListed ? 0 : 1]),
    limit_source: "limits.diameter_speed_product" in point.given ? judging.given_limit : limit.words,
    ends: plain(judging.ends[point.given.ends]?.words ?? ""),
  };
  return { found: at(engine.judge(judging.judged, values), 0), known, words, derived, sources };
}

/** @typedef {ReturnType<typeof judgedAt>} Judged */

/** @param {string} template @returns {Message} */
function plain(template) {
  return { template, values: {} };
}

/** @param {{ needs: string[] }} row @param {Set<string>} known */
function isKnown(row, known) {
  return row.needs.every((name) => known.has(name));
}

/**
 * The records of verdicts, warnings and checks.
 *
 * @param {Contents} contents
 * @param {Judged} judged
 */
export function recordsOf({ judging }, judged) {
  const { tables } = judging;
  const said = (/** @type {any[]} */ rows) =>
    rows.filter((row) => isKnown(row, judged.known) && isSaid(row, judged)).map((row) => recordOf(row, judged));
  /** @type {JudgedRecord[]} */
  const checks = tables.checks.map((/** @type {any} */ row) =>
    isKnown(row, judged.known) ? recordOf(row, judged) : notChecked(row, tables.not_checked),
  );
  return { verdicts: said(tables.verdicts), warnings: said(tables.warnings), checks };
}

/** @param {any} row @param {Judged} judged */
function isSaid(row, judged) {
  return !row.masks.includes("said") || isTrue(row, judged, "said");
}

/** @param {any} row @param {Judged} judged @param {string} mask */
function isTrue(row, { found }, mask) {
  return found[`${row.id}:${mask}`] === 1;
}

/** @param {any} row @param {Judged} judged @returns {JudgedRecord} */
function recordOf(row, judged) {
  const isJudged = !row.masks.includes("judged") || isTrue(row, judged, "judged");
  const truth = row.masks.includes("holds") ? isTrue(row, judged, "holds") : row.holds;
  const holds = isJudged ? truth : null;
  const hasFailed = holds === false && row.severity_of_failure;
  const number = (/** @type {string} */ name) =>
    row.numbers.includes(name) ? (judged.found[`${row.id}:${name}`] ?? null) : null;
  return {
    id: row.id,
    subject: row.subject,
    severity: hasFailed ? row.severity_of_failure : row.severity,
    holds,
    message: chosen(row.sentences, row, judged),
    value: number("value"),
    limit: isJudged ? number("limit") : null,
    unit: row.unit,
    utilisation: isJudged ? number("utilisation") : null,
  };
}

/** @param {any} row @param {string} template @returns {JudgedRecord} */
function notChecked(row, template) {
  const { id, subject, unit, severity, give } = row;
  const message = { template, values: { input: plain(give) } };
  return {
    id,
    subject,
    severity,
    holds: null,
    message,
    value: null,
    limit: null,
    unit,
    utilisation: null,
  };
}

/**
 * The first of the sentences that is said, with what stands in its places.
 *
 * @param {any[]} sentences
 * @param {any} row
 * @param {Judged} judged
 * @returns {Message}
 */
function chosen(sentences, row, judged) {
  const one = sentences.find(({ said }) => said === null || isTrue(row, judged, said));
  const values = Object.entries(one.places).map(([name, place]) => [name, standing(place, row, judged)]);
  return { template: one.template, values: Object.fromEntries(values) };
}

/** @param {any} place @param {any} row @param {Judged} judged */
function standing(place, row, judged) {
  if ("sentences" in place) return chosen(place.sentences, row, judged);
  if ("words" in place) return /** @type {Record<string, any>} */ (judged.words)[place.words];
  if ("constant" in place) return place.constant;
  return { ...place, value: judged.found[`${row.id}:${place.number}`] };
}

/**
 * A message as text, as the command line writes it.
 *
 * @param {Contents} contents
 * @param {Message} message
 * @returns {string}
 */
export function textOf(contents, { template, values }) {
  const written = (/** @type {any} */ value) => {
    if (typeof value === "string") return value;
    if (Array.isArray(value)) return value.map((each) => textOf(contents, each)).join(", ");
    return "template" in value ? textOf(contents, value) : inUnit(contents, value);
  };
  return template.replace(/\{([\w.]+)\}/g, (/** @type {string} */ place, /** @type {string} */ name) =>
    name in values ? written(values[name]) : place,
  );
}

/**
 * @param {Contents} contents
 * @param {{ value: number, unit: string, shown_in: string, digits: number, decimals?: number }} place
 */
function inUnit({ judging }, { value, unit, shown_in: shownIn, digits, decimals }) {
  if (decimals !== undefined) return Number.isFinite(value) ? value.toFixed(decimals) : general(value, PLAIN);
  if (unit === "1") return general(Number(general(value, digits)), PLAIN);
  const { factor, offset } = judging.units[`${unit}|${shownIn}`];
  return `${toDigits((value - offset) / factor, digits)} ${shownIn.replace("um", "µm")}`;
}

/**
 * A number with so many significant digits for people: a large one has an exponent from {@link WITH_EXPONENT} only.
 *
 * @param {number} number
 * @param {number} digits
 */
function toDigits(number, digits) {
  const text = general(number, digits);
  return text.includes("e+") && Math.abs(Number(text)) < WITH_EXPONENT ? Number(text).toFixed(0) : text;
}

/**
 * A number with so many significant digits, without zeros at the end, with a power of ten where it is far from one.
 *
 * @param {number} number
 * @param {number} digits
 */
function general(number, digits) {
  if (!Number.isFinite(number)) return Number.isNaN(number) ? "nan" : number > 0 ? "inf" : "-inf";
  const [mantissa, power] = number.toExponential(digits - 1).split("e");
  const exponent = Number(power);
  if (exponent < -4 || exponent >= digits) {
    const size = String(Math.abs(exponent)).padStart(2, "0");
    return `${withoutZeros(mantissa)}e${exponent < 0 ? "-" : "+"}${size}`;
  }
  return withoutZeros(number.toFixed(digits - 1 - exponent));
}

/** @param {string} text */
function withoutZeros(text) {
  return text.includes(".") ? text.replace(/\.?0+$/, "") : text;
}
