// The answers of a page without a server: numbers, curves, checks and bands of the modules in the browser, in the form in
// which a server sends them. No formula stands here: what is computed is recorded from the model.

import { ballAt, ballDrawing } from "./ball_drawing.js";
import { Banding } from "./banding.js";
import { makersIn, uncertainIn } from "./bands.js";
import { read, tomlOf } from "./case_alone.js";
import { axesAround, plain } from "./case_values.js";
import { moduleOf, site } from "./embedded.js";
import { Engine } from "./engine.js";
import { judgedAt, recordsOf, textOf } from "./judgements.js";
import { pointsOf } from "./local_engine.js";
import { Problem } from "./server.js";
import { FLOODED, floodedTorqueIn, FULL_BATH, REPLENISHMENT } from "./starvation.js";
import * as units from "./units.js";

/** @typedef {import("./case_alone.js").CaseAlone} CaseAlone */
/** @typedef {Record<string, any>} Tables */
/** @typedef {Record<string, number[]>} Axes */

const TEMPERATURE = "temperature";
const LOAD = "axial_load";
const SPEED = "screw_speed";
/** Cases whose numbers are kept: the designs of the page, and those of before. */
const MOST_KEPT = 16;
/** Results that only loaded balls alone have. */
const OF_ROWS = ["contact_load", "rolling_share"];

/** Numbers between commas or colons, and a unit. */
const AXIS = /^((?:[-+]?[\d.]+(?:e[-+]?\d+)?(?:\s*[,:]\s*)?)+)(?:\s+(\S.*))?$/i;

class Alone {
  contents;
  #engine;
  #banding;
  /** Cases that were read and run, by their tables as JSON: that on the page, and those beside it. @type {Map<string, Promise<any>>} */
  #runs = new Map();

  /** @param {any} contents @param {string} worker */
  constructor(contents, worker) {
    this.contents = contents;
    this.#engine = new Engine(contents, moduleOf);
    this.#banding = new Banding(this.#engine, contents, { worker, moduleOf });
  }

  /**
   * The answer of an address.
   *
   * @param {string} address
   * @param {any} body
   * @param {AbortSignal} [signal]
   * @returns {Promise<Response>}
   */
  async answer(address, body, signal) {
    const [name, of = ""] = address.split("/");
    const { contents } = this;
    if (name === "vocabulary" || name === "schema") return Response.json(contents[name]);
    if (name === "catalogue" && contents.starts[decodeURIComponent(of)]) {
      return Response.json({ case: contents.starts[decodeURIComponent(of)].case });
    }
    if (name === "toml") return new Response(tomlOf(body.case), { headers: { "Content-Type": "application/toml" } });
    const asked = body?.case;
    if (name === "run") return Response.json((await this.#ran(asked)).run);
    if (name === "check") return Response.json((await this.#ran(asked)).check);
    if (name === "drawing") {
      const svg = await this.#drawing(asked);
      return new Response(svg, { headers: { "Content-Type": "image/svg+xml" } });
    }
    if (name === "module") return Response.json(await this.#module(asked));
    if (name === "band") return Response.json(await this.#band(asked, signal));
    if (name === "sweep") return Response.json(await this.#sweep(body, signal));
    throw new Problem({
      title: "This page has no server: the program answers that. Save the case, and give it to ballscrew.",
    });
  }

  /**
   * The lines that answer a case and the designs beside it.
   *
   * @param {{ case: Tables, beside?: Tables[] }} body
   * @returns {AsyncGenerator<any>}
   */
  async *lines({ case: tables, beside = [] }) {
    const own = await this.#ran(tables);
    yield { question: "run", place: 0, answer: own.run };
    yield { question: "check", place: 0, answer: own.check };
    const curves = this.#curves(own);
    yield { question: "over_speed", place: 0, answer: curves.over_speed() };
    for (const [place, other] of beside.entries()) {
      try {
        const { run, check } = await this.#ran(other);
        yield { question: "run", place: place + 1, answer: run };
        yield { question: "check", place: place + 1, answer: check };
      } catch (error) {
        if (!(error instanceof Problem)) throw error;
        const { message: title, lines, faults } = error;
        yield { question: "run", place: place + 1, problem: { title, lines, faults } };
      }
    }
    if (curves.cold_and_hot) yield { question: "cold_and_hot", place: 0, answer: curves.cold_and_hot() };
    yield { question: "over_both", place: 0, answer: curves.over_both() };
    yield { question: "over_load", place: 0, answer: curves.over_load() };
    yield { question: "drawing", place: 0, answer: { text: await this.#drawing(tables) } };
  }

  /** A case with its run and its checks. @param {Tables} tables */
  #ran(tables) {
    const key = JSON.stringify(tables);
    const before = this.#runs.get(key);
    if (before) return before;
    const made = read(this.contents, this.#engine, tables).then((subject) => this.#computed(subject));
    this.#runs.set(key, made);
    made.catch(() => this.#runs.delete(key));
    const [oldest] = this.#runs.keys();
    if (this.#runs.size > MOST_KEPT) this.#runs.delete(oldest);
    return made;
  }

  /**
   * The outputs at points.
   *
   * @param {CaseAlone} subject
   * @param {Record<string, number | ArrayLike<number>>} changes
   * @param {number} count
   */
  #at(subject, changes, count) {
    return this.#engine.evaluate(subject.structure, { ...subject.inputs, ...changes }, count);
  }

  /** @param {CaseAlone} subject */
  #computed(subject) {
    const { contents } = this;
    const { structure, start, given, listed, inputs } = subject;
    const point = { structure, start, inputs: { ...subject.values, ...inputs }, given, listed };
    const judged = judgedAt(this.#engine, contents, point);
    const { verdicts, warnings, checks } = recordsOf(contents, judged);
    const said = (/** @type {any[]} */ records) =>
      records.map(({ message, ...record }) => ({ ...record, text: textOf(contents, message) }));
    const { outputs } = judged.sources;
    const model = structure.split("/")[0];
    const run = {
      inputs: inputsOf(contents, subject),
      results: this.#results(subject, outputs),
      verdicts: said(verdicts),
      warnings: said(warnings),
      checks: [],
      provenance: { version: contents.version, model, references: contents.models[model].references },
      words: {
        title: titleOf(subject),
        verdicts: [],
        assumed: ["whether inputs are plausible: judged by the program alone"],
        rigidity: [],
        rules: ruleOf(contents.starts[start].judged.rule, judged.derived),
      },
    };
    const lines = said(checks).map((record, place) => ({
      ...record,
      name: record.id.replace("check.", ""),
      missing: record.holds === null ? missingIn(checks[place].message) : "",
    }));
    const check = {
      checks: lines,
      judged: lines.filter(({ holds }) => holds !== null).length,
      holds: lines.every(({ holds }) => holds === true),
    };
    if (subject.kind !== "row") Object.assign(run, { loads: this.#loads(subject, outputs) });
    return { subject, outputs, run, check, flooded: floodedTorqueIn(run.verdicts) ?? floodedTorqueIn(run.warnings) };
  }

  /**
   * The results as a run has them: those of the contacts, the parts of the torque and the conditions in tables of their own.
   *
   * @param {CaseAlone} subject
   * @param {Record<string, number | null | undefined>} outputs
   */
  #results(subject, outputs) {
    const { race_names: races, results: known } = this.contents;
    /** @type {Tables} */
    const results = { contributions: {}, validity: {}, screw: {}, nut: {} };
    for (const [name, value] of Object.entries(outputs)) {
      const [first, ...rest] = name.split("_");
      const inner = rest.join("_");
      if (first === "contribution") results.contributions[inner] = plain(value ?? undefined);
      else if (first === "validity") results.validity[inner] = value === 1;
      else if ((first === "screw" || first === "nut") && races.includes(inner))
        results[first][inner] = plain(value ?? undefined);
      else if (Object.hasOwn(known, name)) results[name] = plain(value ?? undefined);
    }
    results.valid = outputs.valid === 1;
    results.self_locking = outputs.self_locking === 1;
    if (subject.kind === "row") results.rigidity = undefined;
    else for (const name of OF_ROWS) delete results[name];
    if (subject.kind !== "row") results.preload_drag = plain(this.#at(subject, { [LOAD]: 0 }, 1).screw_torque[0]);
    results.quadrants = this.#quadrants(subject);
    return results;
  }

  /** Load and speed, each with both signs: at rest the friction is that at which it begins to turn. @param {CaseAlone} subject */
  #quadrants(subject) {
    const [load, speed] = [Math.abs(subject.inputs[LOAD]), Math.abs(subject.inputs[SPEED])];
    /** @type {[string, number, number][]} */
    const signs = this.contents.quadrants;
    const columns = { [LOAD]: signs.map(([, sign]) => sign * load), [SPEED]: signs.map(([, , sign]) => sign * speed) };
    const numbers = this.#at(subject, columns, signs.length);
    return Object.fromEntries(
      signs.map(([name, load_sign, speed_sign], place) => {
        const [ideal, friction] = [numbers.ideal_torque[place], numbers.screw_torque[place]];
        const torque = speed ? numbers.drive_torque[place] : ideal + speed_sign * friction;
        const moving = numbers[load_sign === speed_sign ? "efficiency" : "back_driving_efficiency"][place];
        const atRest = load_sign === speed_sign ? ideal / torque : torque / ideal;
        const efficiency = plain(speed ? moving : atRest);
        return [name, { load_sign, speed_sign, shaft_torque: plain(torque), efficiency }];
      }),
    );
  }

  /** The loads of a nut: of each ball where its bodies are elastic. @param {CaseAlone} subject @param {Tables} outputs */
  #loads(subject, outputs) {
    const balls = this.#engine.balls(subject.structure, subject.inputs);
    const names = ["deflection", "rigidity", "remaining_preload", "lift_off_load"];
    return {
      ...Object.fromEntries(names.map((name) => [name, plain(outputs[name])])),
      ...(balls && { balls: Object.fromEntries(Object.entries(balls).map(([name, all]) => [name, [...all]])) }),
    };
  }

  /**
   * The curves around the operating point, each computed when it is asked for.
   *
   * @param {{ subject: CaseAlone, outputs: Tables, flooded: number | undefined }} own
   */
  #curves({ subject, outputs, flooded }) {
    const axes = axesAround(this.#axesOf(subject), {
      axial_load: subject.inputs[LOAD],
      screw_speed: subject.inputs[SPEED],
    });
    const isNut = subject.kind !== "row";
    const films = isNut ? ["minimum_film_parameter"] : ["screw_film_parameter", "nut_film_parameter"];
    const pressures = isNut ? ["maximum_pressure"] : ["screw_maximum_pressure", "nut_maximum_pressure"];
    const parts = Object.keys(outputs).filter((name) => name.startsWith("contribution_"));
    const bath = flooded === undefined ? [] : [FLOODED];
    const follows =
      subject.grade && subject.inputs[LOAD] && subject.inputs[SPEED] && !subject.kept.includes("viscosity");
    const temperatures = [...new Set([...this.contents.cold_and_hot, subject.temperature])].sort((a, b) => a - b);
    const constant = subject.inputs[REPLENISHMENT];
    const hot = {
      [TEMPERATURE]: temperatures,
      [SPEED]: [0, subject.inputs[SPEED]],
      ...(constant && { [REPLENISHMENT]: [0, constant] }),
    };
    return {
      over_speed: () => this.#swept(subject, axes.over_speed, ["screw_torque", ...parts, ...films, ...bath]),
      over_both: () => this.#swept(subject, axes.over_both, ["efficiency", "back_driving_efficiency"]),
      over_load: () => this.#swept(subject, axes.over_load, pressures),
      ...(follows && { cold_and_hot: () => this.#swept(subject, hot, ["screw_torque", "holding_torque"]) }),
    };
  }

  /** @param {CaseAlone} subject @returns {CaseModule["axes"]} */
  #axesOf({ kind }) {
    return this.contents.axes[kind === "row" ? "row" : "nut"];
  }

  /**
   * A sweep over axes, by the names of their inputs.
   *
   * @param {CaseAlone} subject
   * @param {Axes} axes
   * @param {string[]} outputs
   */
  #swept(subject, axes, outputs) {
    const names = Object.keys(axes);
    const points = pointsOf(/** @type {Record<string, number>} */ ({}), axes);
    /** @type {Record<string, Float64Array>} */
    const changes = {};
    for (const name of names) {
      const values = Float64Array.from(points, (point) => point[name]);
      if (name !== TEMPERATURE) changes[name] = values;
      else {
        for (const [input, numbers] of Object.entries(this.#engine.oil(subject.grade, values, points.length))) {
          if (input in subject.inputs && !subject.kept.includes(input)) changes[input] = numbers;
        }
      }
    }
    const numbers = this.#at(subject, changes, points.length);
    if (outputs.includes(FLOODED)) {
      numbers[FLOODED] = this.#at(subject, { ...changes, ...FULL_BATH }, points.length).screw_torque;
    }
    const sizes = names.map((name) => axes[name].length);
    const column = (/** @type {string} */ name) => {
      const flat = Array.from(numbers[name], (value) => (name === "valid" ? value === 1 : plain(value)));
      return { values: nested(flat, sizes), ...this.#described(name) };
    };
    return {
      axes: Object.fromEntries(names.map((name) => [name, { values: axes[name], ...this.#described(name) }])),
      outputs: Object.fromEntries([...outputs, "valid"].map((name) => [name, column(name)])),
    };
  }

  /** @param {string} name */
  #described(name) {
    const { unit = "1", meaning = name } = this.contents.fields[name] ?? this.contents.results[name] ?? {};
    return { unit, meaning };
  }

  /**
   * A sweep as it is asked for; with a band that of the torque over the speed.
   *
   * @param {{ case: Tables, vary: Record<string, string>, outputs: string[], band?: boolean }} body
   * @param {AbortSignal} [signal]
   */
  async #sweep({ case: tables, vary, outputs, band }, signal) {
    const { subject } = await this.#ran(tables);
    const { fields } = this.contents;
    const unknown = Object.keys(vary).find(
      (name) => !(name in subject.inputs) && !(name === TEMPERATURE && subject.grade),
    );
    if (unknown !== undefined) throw new Problem({ title: `${unknown} is not varied by a page without a server.` });
    const axes = Object.fromEntries(Object.entries(vary).map(([name, text]) => [name, valuesIn(text, fields[name])]));
    if (!band) return this.#swept(subject, axes, outputs);
    const fan = await this.#banded(subject, "fan", axes[SPEED], signal);
    const ends = { low: fan.lows.map(plain), high: fan.highs.map(plain) };
    const swept = this.#swept(subject, axes, outputs);
    Object.assign(swept.outputs.screw_torque, ends);
    return { ...swept, band: { level: this.contents.bands.level } };
  }

  /** The band at the operating point. @param {Tables} tables @param {AbortSignal} [signal] */
  async #band(tables, signal) {
    const { subject, run } = await this.#ran(tables);
    const { ends, count, invalid } = await this.#banded(subject, "point", [], signal);
    const { bands } = this.contents;
    const { low, high } = ends.screw_torque;
    const shown = (/** @type {number} */ value) => units.formatted("screw_torque", value);
    const text = `friction torque ${shown(run.results.screw_torque)} at the values of the case, ${100 * bands.level} % of the samples of inputs between ${shown(low)} and ${shown(high)}`;
    const share =
      invalid > 0 ? [`${units.digits(100 * invalid, 2)} % of the samples lie outside the model's validity.`] : [];
    const record = {
      id: "band.torque",
      subject: "screw_torque",
      value: null,
      unit: "N m",
      limit: null,
      holds: null,
      severity: "info",
      text,
    };
    const laws = {
      ...record,
      id: "band.laws",
      text: "Laws are not varied here: with them, in the program, the low end is usually 5 to 25 % lower, and the high end up to 10 % lower.",
    };
    const question = this.#asked(subject, "point", []);
    const makers = makersIn(bands, question);
    const of = `${count} samples of ${uncertainIn(bands, question)?.length ?? 0} uncertain inputs${makers.length ? `, and the calibrations of ${makers.length} makers` : ""}. ${share.join(" ")}`;
    return {
      band: { ...ends, laws: {} },
      verdicts: [record, laws],
      warnings: [],
      words: { sentences: [text], inputs: of },
    };
  }

  /** What a band is asked of. @param {CaseAlone} subject @param {"point" | "fan"} kind @param {number[]} speeds */
  #asked({ structure, start, inputs, grade, temperature, places }, kind, speeds) {
    const kept = Object.entries(places).flatMap(([path, { input }]) => (path.startsWith("lubricant.") ? [input] : []));
    return { structure, start, inputs, grade, temperature, kept, kind, speeds };
  }

  /** @param {CaseAlone} subject @param {"point" | "fan"} kind @param {number[]} speeds @param {AbortSignal} [signal] @returns {Promise<any>} */
  async #banded(subject, kind, speeds, signal = new AbortController().signal) {
    const band = await this.#banding.ask(this.#asked(subject, kind, speeds), signal);
    if (!band) throw new Problem({ title: "This page has no band of such a case; the program has it." });
    return band;
  }

  /** The ball between its grooves. @param {Tables} tables */
  async #drawing(tables) {
    const { subject, outputs } = await this.#ran(tables);
    const inputs = { ...subject.values, ...subject.inputs };
    return ballDrawing(ballAt(this.#engine, this.contents, { structure: subject.structure, inputs, outputs }));
  }

  /** What computes the case while something is moved. @param {Tables} tables */
  async #module(tables) {
    const { subject } = await this.#ran(tables);
    const { contents } = this;
    const spec = contents.structures[subject.structure];
    const places = Object.entries(subject.places).filter(
      ([path]) => path !== "operation.screw_speed" || !isOfNut(tables),
    );
    const { file, grades } = contents.oils;
    return {
      state: "ready",
      structure: spec,
      solver: "by_ball" in spec ? contents.solver : null,
      oil: subject.grade ? { file, ...grades[subject.grade] } : null,
      values: Object.fromEntries(Object.entries(subject.inputs).map(([name, value]) => [name, plain(value)])),
      places: Object.fromEntries(places),
      axes: this.#axesOf(subject),
    };
  }
}

/** The input that a sentence asks for; none where it asks for nothing. @param {any} message @returns {string} */
function missingIn(message) {
  for (const [name, value] of Object.entries(message.values)) {
    if (name === "input") return typeof value === "string" ? value : value.template;
    const inner = value?.values ? missingIn(value) : "";
    if (inner) return inner;
  }
  return "";
}

/** True where the speed is that of the nut. @param {Tables} tables */
function isOfNut({ operation }) {
  return units.parse(operation?.[SPEED], "m/s") !== null;
}

/** @param {unknown[]} flat @param {number[]} sizes @returns {unknown[]} */
function nested(flat, [size, ...inner]) {
  if (!inner.length) return flat;
  const step = flat.length / size;
  return Array.from({ length: size }, (_, row) => nested(flat.slice(row * step, (row + 1) * step), inner));
}

/**
 * The values of an axis as it is written: ``low:high:count unit``, or numbers with a unit.
 *
 * @param {string} text
 * @param {any} field
 * @returns {number[]}
 */
function valuesIn(text, { unit }) {
  const [, numbers = "", written = ""] = AXIS.exec(text.trim()) ?? [];
  const [low, high, count] = numbers.split(":").map(Number);
  const values =
    count === undefined
      ? numbers.split(",").map(Number)
      : Array.from({ length: count }, (_, place) => low + ((high - low) * place) / (count - 1));
  if (!numbers || !values.every(Number.isFinite)) throw new Problem({ title: `${text} is no axis.` });
  return values.map((value) => (written && unit !== "1" ? units.toSI(value, written, unit) : value));
}

/** The inputs in their tables, those of the laws of the model among them. @param {any} contents @param {CaseAlone} subject */
function inputsOf(contents, { structure, inputs, given, grade, temperature, listed }) {
  const tables = structuredClone(contents.templates[structure]);
  for (const [name, value] of Object.entries(inputs)) put(tables, contents.fields[name]?.path, plain(value));
  tables.lubricant = { ...tables.lubricant, ...(grade && { grade, temperature }) };
  for (const [name, value] of Object.entries(listed)) if (value !== null) put(tables, `screw.${name}`, value);
  for (const [name, value] of Object.entries(given))
    put(tables, name.includes(".") ? name : `installation.${name}`, value);
  return tables;
}

/** @param {Tables} tables @param {string | undefined} path @param {unknown} value */
function put(tables, path, value) {
  if (!path) return;
  const names = path.split(".");
  const last = names.pop() ?? path;
  let place = tables;
  for (const name of names) {
    if (typeof place[name] !== "object" || place[name] === null) place[name] = {};
    place = place[name];
  }
  place[last] = value;
}

/**
 * The drag torque beside that of the rule of the maker of a row, in words; none where there is none.
 *
 * @param {any} rule
 * @param {Record<string, any>} derived
 */
function ruleOf(rule, derived) {
  const [drag, ruled] = [derived.preload_drag_of_balls, rule && derived[rule.torque]];
  if (!(drag > 0 && ruled > 0)) return [];
  const shown = (/** @type {number} */ torque) => units.formatted("screw_torque", torque);
  return [
    `Drag torque without seals ${shown(drag)}; by the rule of its maker, ${rule.words.rule}, ${shown(ruled)} (model / rule ${units.digits(drag / ruled, 3)}).`,
  ];
}

/** The operating point and the model of a case in words. @param {CaseAlone} subject */
function titleOf({ inputs, structure, tables }) {
  const shown = [LOAD, SPEED].map((name) => units.formatted(name, inputs[name]));
  const { type } = tables.nut ?? {};
  const preload = inputs.preload ? `, preload ${units.formattedIn(inputs.preload, "N", "N")}` : "";
  return `${shown.join(", ")}${type ? `, ${type} nut${preload}` : ""}, model ${structure.split("/")[0]}`;
}

/** What answers in place of a server; none where one does. */
export function answersAlone() {
  const { contents, worker = "" } = site();
  return contents ? new Alone(contents, worker) : undefined;
}
