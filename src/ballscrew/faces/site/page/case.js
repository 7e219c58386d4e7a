// The case that is shown: where it starts, what was changed, its numbers, and how it goes to the program.

/**
 * A number that the model takes: where it stands in a case, its unit, and its bounds in SI.
 * @typedef {{
 *   path: string, meaning: string, symbol: string, unit: string, shown_in: string, factor: number, offset: number,
 *   above?: number, at_least?: number, below?: number, at_most?: number, usual: number[] | null, whole: boolean,
 * }} Field
 */
/**
 * @typedef {{
 *   factor: number, offset: number, above?: number, at_least?: number, below?: number, at_most?: number, whole?: boolean,
 * }} Bounded
 */
/** @typedef {{ meaning: string, symbol: string, unit: string, shown_in: string, factor: number, offset: number }} Result */
/** @typedef {Record<string, any>} Tables */
/**
 * @typedef {{
 *   title: string, make: string, source: string, sizes: number[], kind: string, tables: Tables, grade: string | null,
 *   temperature: number | null, values: Record<string, number>,
 *   nuts: Record<string, { values: Record<string, number>, tables: Tables }>, judged: any,
 * }} Start
 */
/** @typedef {{ file: string, function: string, inputs: string[], outputs: string[], constants: Record<string, number> }} Structure */
/**
 * @typedef {{
 *   version: string, models: Record<string, { values: Record<string, number> }>,
 *   kinds: Record<string, { words: string, is_preloaded: boolean, nut: string }>,
 *   structures: Record<string, Structure>,
 *   oils: { file: string, grades: Record<string, any> },
 *   fields: Record<string, Field>, results: Record<string, Result>,
 *   mechanisms: Record<string, { words: string, colour: string }>, reasons: Record<string, string>,
 *   judging: any, bands: import("./bands.js").Bands, usual_temperature: string, units: Record<string, { unit: string, factor: number, offset: number }[]>, symbols: Record<string, string>, starts: Record<string, Start>, rows: Record<string, { source: string, kind: string, sizes: number[] }>,
 * }} Contents
 */
/**
 * What the visitor chose. ``grade`` is empty for an oil that is given by its viscosity; ``edits`` has numbers by the
 * name of the field, in the unit that it is shown in, and ``given`` what is only judged: limits, and the installation.
 * @typedef {{
 *   start: string, model: string, kind: string, grade: string, edits: Record<string, number>,
 *   given: Record<string, number | string>,
 * }} State
 */

/** The start whose oil is given by its viscosity: the other numbers of such an oil are those of any oil. */
const PLAIN_OIL = "paper";

/** How a shaft is held where nobody says. */
const USUAL_ENDS = "fixed-supported";
/** Before the names of what is only judged in a fragment. */
const GIVEN = "given.";
/** What a fragment has beside numbers. */
const CHOICES = ["start", "model", "kind", "grade"];

/** What stands for the bound of what is no number. */
export const NO_NUMBER = "…";
/** No number of a screw is larger in the unit that it is shown in. */
const LARGEST = 1e9;

export class Case {
  /**
   * @param {Contents} contents
   * @param {(grade: string, kelvin: number) => Record<string, Float64Array>} oil
   */
  constructor(contents, oil) {
    this.contents = contents;
    this.oil = oil;
    /** @type {State} */
    this.state = this.begin(Object.keys(contents.starts)[0]);
  }

  /**
   * The state with which a start begins.
   *
   * @param {string} name
   * @param {string} [model]
   * @returns {State}
   */
  begin(name, model = Object.keys(this.contents.models)[0]) {
    const start = this.contents.starts[name];
    const kinds = this.kindsOf(model);
    // a page without elastic nuts begins with rigid ones
    const kind = [start.kind, this.contents.kinds[start.kind].nut].find((one) => kinds.includes(one)) ?? kinds[0];
    return { start: name, model, kind, grade: start.grade ?? "", edits: {}, given: {} };
  }

  /** The kinds of nut that a model is there for. @param {string} model */
  kindsOf(model) {
    return Object.keys(this.contents.structures)
      .filter((name) => name.startsWith(`${model}/`))
      .map((name) => name.slice(model.length + 1));
  }

  get structure() {
    return `${this.state.model}/${this.state.kind}`;
  }

  get spec() {
    return this.contents.structures[this.structure];
  }

  get start() {
    return this.contents.starts[this.state.start];
  }

  /** The names of the fields that the case has: what the model takes, and the temperature of an oil of a grade. */
  fields() {
    const { grade } = this.state;
    const ofGrade = grade ? Object.keys(this.contents.fields).filter((name) => name === "temperature") : [];
    const isShown = (/** @type {string} */ name) =>
      Object.hasOwn(this.contents.fields, name) && !(grade && name === "viscosity");
    return [...this.spec.inputs.filter(isShown), ...ofGrade];
  }

  /** The oil's temperature, K. */
  temperature() {
    const edited = this.state.edits.temperature;
    if (edited !== undefined) return this.inSi("temperature", edited);
    return this.start.temperature ?? this.inSi("temperature", Number.parseFloat(this.contents.usual_temperature));
  }

  /**
   * All numbers without those that were changed, SI.
   * @returns {Record<string, number>}
   */
  unchanged() {
    const { model, kind, grade } = this.state;
    const { models, starts, oils, fields } = this.contents;
    const values = { ...models[model].values, ...this.start.values, ...this.start.nuts[kind].values };
    const isOwnOil = grade === (this.start.grade ?? "");
    if (!isOwnOil) {
      for (const [name, value] of Object.entries(starts[PLAIN_OIL].values)) {
        if (fields[name].path.startsWith("lubricant.")) values[name] = value;
      }
    }
    if (grade && !(isOwnOil && this.state.edits.temperature === undefined)) {
      const oil = this.oil(grade, this.temperature());
      for (const name of Object.keys(oil)) values[name] = oil[name][0];
      Object.assign(values, oils.grades[grade].constants);
    }
    return values;
  }

  /** The inputs of the model, SI. @returns {Record<string, number>} */
  inputs() {
    const values = this.unchanged();
    for (const [name, shown] of Object.entries(this.state.edits)) values[name] = this.inSi(name, shown);
    // a nut may have more than its inputs: what follows from others where it is not given
    const names = [...this.spec.inputs, ...Object.keys(this.start.nuts[this.state.kind].values)];
    return Object.fromEntries(names.map((name) => [name, values[name]]));
  }

  /** @param {string} name @param {number} shown */
  inSi(name, shown) {
    const { factor, offset } = this.contents.fields[name];
    return shown * factor + offset;
  }

  /** @param {string} name @param {number} si */
  inShown(name, si) {
    const { factor, offset } = this.contents.fields[name];
    return Number(((si - offset) / factor).toPrecision(12));
  }

  /** The number of a field in the unit it is shown in. @param {string} name */
  shown(name) {
    const edited = this.state.edits[name];
    if (edited !== undefined) return edited;
    return this.inShown(name, name === "temperature" ? this.temperature() : this.unchanged()[name]);
  }

  /** The number with which a field began, in the unit it is shown in. @param {string} name */
  began(name) {
    const { [name]: _, ...edits } = this.state.edits;
    return new Case(this.contents, this.oil).with({ ...this.state, edits }).shown(name);
  }

  /** @param {State} state */
  with(state) {
    this.state = state;
    return this;
  }

  /** Keep of the changes only those of fields that the case has. */
  prune() {
    const known = this.fields();
    this.state.edits = Object.fromEntries(Object.entries(this.state.edits).filter(([name]) => known.includes(name)));
  }

  /** What is given besides the inputs, by the names of what is judged, SI. @returns {Record<string, any>} */
  given() {
    /** @type {Record<string, any>} */
    const found = {};
    for (const [name, shown] of Object.entries(this.state.given)) {
      const { factor = 1, offset = 0 } = this.contents.judging.given[name] ?? {};
      found[name] = typeof shown === "number" ? shown * factor + offset : shown;
    }
    if (found.unsupported_length !== undefined) found.ends ??= USUAL_ENDS;
    return found;
  }

  /** The case as its tables. @returns {Tables} */
  tables() {
    const { start, model, kind, grade, edits } = this.state;
    const own = this.contents.starts[start];
    /** @type {Tables} */
    const found = structuredClone({ ...own.tables, model: { name: model }, ...own.nuts[kind].tables });
    if (grade !== (own.grade ?? "")) {
      found.lubricant = grade ? { grade, temperature: this.contents.usual_temperature } : {};
      if (!grade) this.#put(found, "viscosity", this.shown("viscosity"));
    }
    for (const [name, shown] of Object.entries(edits)) this.#put(found, name, shown);
    if (Object.keys(edits).some((name) => this.contents.fields[name].path.startsWith("screw."))) {
      // what a row or its rating gave is written out: they would follow the geometry
      for (const name of ["loaded_balls", "preload"]) {
        if (this.spec.inputs.includes(name)) this.#put(found, name, this.shown(name));
      }
    }
    this.#putGiven(found);
    return found;
  }

  /** Limits, and the installation where its length is given. @param {Tables} tables */
  #putGiven(tables) {
    const { given } = this.state;
    const isMounted = given.unsupported_length !== undefined;
    for (const [name, shown] of Object.entries(isMounted ? { ends: USUAL_ENDS, ...given } : given)) {
      const isLimit = name.startsWith("limits.");
      if (!isLimit && !isMounted) continue;
      const section = isLimit ? "limits" : "installation";
      const unit = this.contents.judging.given[name]?.shown_in ?? "1";
      tables[section] ??= {};
      tables[section][name.replace("limits.", "")] = unit === "1" ? shown : `${shown} ${unit}`;
    }
  }

  /**
   * @param {Tables} tables
   * @param {string} name
   * @param {number} shown
   */
  #put(tables, name, shown) {
    const { path, shown_in: unit } = this.contents.fields[name];
    const names = path.split(".");
    const last = names.pop() ?? path;
    let place = tables;
    for (const one of names) {
      place[one] ??= {};
      place = place[one];
    }
    place[last] = unit === "1" ? shown : `${shown} ${unit}`;
  }

  /** The case as a file for the program. */
  toml() {
    return tomlOf(this.tables());
  }

  /** The case as the fragment that the page of the program reads. */
  programFragment() {
    const { screw, ...others } = this.tables();
    const { screw: begun } = this.start.tables;
    /** @type {Tables} */
    const sections = { nut: null, bodies: null, losses: null, ...others };
    const parameters = new URLSearchParams({ A: this.state.start, "A.tables": JSON.stringify(sections) });
    for (const [field, value] of Object.entries(screw)) {
      if (value !== begun[field]) parameters.set(`A.screw.${field}`, String(value));
    }
    return `#${parameters}`;
  }

  /** The case as the fragment of this page. */
  fragment() {
    const { edits, given, ...chosen } = this.state;
    const changed = Object.entries(edits).map(([name, shown]) => [name, String(shown)]);
    const judged = Object.entries(given).map(([name, shown]) => [`${GIVEN}${name}`, String(shown)]);
    return `#${new URLSearchParams({ ...chosen, ...Object.fromEntries([...changed, ...judged]) })}`;
  }

  /**
   * The state that a fragment of this page describes, and what of it this page does not have, which is left out.
   *
   * @param {string} fragment
   * @returns {{ state: State, unknown: string[] }}
   */
  stateIn(fragment) {
    const given = new URLSearchParams(fragment.replace(/^#/, ""));
    const { starts, models, oils, fields } = this.contents;
    /** @type {string[]} */
    const unknown = [];
    const known = (/** @type {string} */ key, /** @type {string[]} */ names) => {
      const name = given.get(key);
      if (name === null || names.includes(name)) return name;
      unknown.push(name);
      return null;
    };
    const state = this.begin(
      known("start", Object.keys(starts)) ?? this.state.start,
      known("model", Object.keys(models)) ?? Object.keys(models)[0],
    );
    state.kind = known("kind", this.kindsOf(state.model)) ?? state.kind;
    state.grade = known("grade", ["", ...Object.keys(oils.grades)]) ?? state.grade;
    for (const [name, text] of given) {
      if (CHOICES.includes(name)) continue;
      const shown = Number(text);
      const judged = name.startsWith(GIVEN) ? name.slice(GIVEN.length) : "";
      if (judged && text !== "" && !this.faultOfGiven(judged, text)) {
        state.given[judged] = judged === "ends" ? text : shown;
      } else if (Object.hasOwn(fields, name) && text !== "" && !this.fault(name, shown)) state.edits[name] = shown;
      else unknown.push(`${name}=${text}`);
    }
    return { state, unknown };
  }

  /**
   * The bound that a number would break, as text such as "> 0"; nothing where it holds.
   *
   * @param {string} name
   * @param {number} shown
   */
  fault(name, shown) {
    return faultOf(this.contents.fields[name], shown);
  }

  /** The same of what is only judged, as it is written; {@link NO_NUMBER} for what there is not. @param {string} name @param {string} text */
  faultOfGiven(name, text) {
    const { given, ends } = this.contents.judging;
    if (name === "ends") return Object.hasOwn(ends, text) ? "" : NO_NUMBER;
    return Object.hasOwn(given, name) ? faultOf(given[name], Number(text)) : NO_NUMBER;
  }
}

/**
 * The bound of a quantity that a number in the unit it is shown in would break; nothing where it holds.
 *
 * @param {Bounded} quantity
 * @param {number} shown
 */
function faultOf({ factor, offset, above, at_least: least, below, at_most: most, whole }, shown) {
  if (!Number.isFinite(shown)) return NO_NUMBER;
  const si = shown * factor + offset;
  const written = (/** @type {number} */ bound) => Number(((bound - offset) / factor).toPrecision(12));
  if (above !== undefined && si <= above) return `> ${written(above)}`;
  if (below !== undefined && si >= below) return `< ${written(below)}`;
  if (least !== undefined && si < least) return `≥ ${written(least)}`;
  if (most !== undefined && si > most) return `≤ ${written(most)}`;
  if (Math.abs(shown) > LARGEST) return "≤ 10⁹";
  return whole && shown !== Math.round(shown) ? "1, 2, 3 …" : "";
}

/**
 * Tables as a TOML file.
 *
 * @param {Tables} tables
 * @param {string} [above]
 * @returns {string}
 */
function tomlOf(tables, above = "") {
  const entries = Object.entries(tables);
  const plain = entries.filter(([, value]) => typeof value !== "object");
  const lines = plain.map(([name, value]) => `${name} = ${JSON.stringify(value)}`);
  const sections = entries.filter(([, value]) => typeof value === "object");
  const hasHead = lines.length > 0 || sections.length === 0;
  const head = above && hasHead ? [`[${above}]`] : [];
  const inner = sections.map(([name, value]) => tomlOf(value, above ? `${above}.${name}` : name));
  return [...(hasHead ? [[...head, ...lines, ""].join("\n")] : []), ...inner].join("\n");
}
