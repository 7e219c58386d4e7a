// The model in the browser: the module of the structure of the case on the page, with which its numbers and curves are
// computed while something is moved. No formula stands here: what is computed is recorded from the model.

import { axesAround, textsOf, valueAt } from "./case_values.js";
import { moduleOf } from "./embedded.js";
import { Engine } from "./engine.js";
import { sendJson } from "./server.js";

/** @typedef {{ case: Record<string, unknown> }} Body */
/** @import { Found, Values } from "./engine.js" */
/** @typedef {{ axial_load: number, screw_speed: number }} Point */
/** Values of the axes of curves, by the curve and the axis. @typedef {Record<string, Record<string, number[]>>} Axes */
/**
 * What is known of a case: its tables by their paths, and what the server has said of its structure.
 *
 * @typedef {{ texts: Map<string, string>, about: CaseModule, engine: Engine }} Known
 */

/** Milliseconds until a module that is being made is asked for again. */
const AGAIN = 1500;
/** The one structure of an engine. */
const HERE = "here";
/** How far numbers of both may be apart: another compiler of the same formulas. */
const CLOSE = 1e-9;
const TEMPERATURE = "temperature";
/** Points of which the time says little of that of one. */
const FEW = 10;

/** The engine of the case on the page, as far as it has one. */
class LocalEngine {
  /** @type {Known | undefined} */
  #known;
  #isWanted = false;
  /** Files of modules that were apart from the server. @type {Set<string>} */
  #refused = new Set();
  /** The case that is asked for, as JSON. */
  #asked = "";
  /** @type {ReturnType<typeof setTimeout> | undefined} */
  #timer;
  /** Milliseconds that a point takes, about. */
  #ofPoint = 0;

  /** The engine that inputs are of. @type {WeakMap<Values, Engine>} */
  #engineOf = new WeakMap();

  /** Somebody is about to change something: from now on the module of the case is asked for. */
  want() {
    this.#isWanted = true;
  }

  /**
   * Be ready for changes of a case, once one is wanted. Where there is no module the server is asked for everything.
   *
   * @param {Body} body
   */
  async learn(body) {
    const key = JSON.stringify(body);
    if (!this.#isWanted || key === this.#asked || this.valuesOf(body)) return;
    clearTimeout(this.#timer);
    this.#asked = key;
    /** @type {CaseModule} */
    let about;
    try {
      about = await sendJson("module", body);
    } catch {
      if (key === this.#asked) this.#asked = ""; // what cannot be reached, or refuses, says so for the answers, too
      return;
    }
    try {
      if (key !== this.#asked) return;
      if (about.state === "pending") {
        this.#timer = setTimeout(() => {
          this.#asked = "";
          this.learn(body);
        }, AGAIN);
      } else if (about.state === "ready") await this.#take(body, about, key);
    } catch (error) {
      console.error(error); // the server is asked for everything, as without a module
      if (key === this.#asked) this.#asked = "";
    }
  }

  /**
   * @param {Body} body
   * @param {CaseModule} about
   * @param {string} key
   */
  async #take(body, about, key) {
    const { structure, oil, solver } = about;
    if (!structure || this.#refused.has(String(structure.file))) return;
    const one = /** @type {import("./engine.js").Structure} */ (/** @type {unknown} */ (structure));
    const oils = oil ? { file: oil.file, grades: { [HERE]: oil } } : { file: one.file, grades: {} };
    const contents = { structures: { [HERE]: one }, oils, solver: solver ?? "" };
    const engine = new Engine(/** @type {any} */ (contents), moduleOf);
    await engine.load(HERE);
    if (key !== this.#asked) return;
    this.#known = { texts: textsOf(body.case), about, engine };
    this.#ofPoint = 0;
    document.documentElement.dataset.engine = "ready"; // for those who wait for it from outside
  }

  /**
   * All inputs of a case; none where it is of another structure, or something in it has changed that others follow from.
   *
   * @param {Body} body
   * @returns {Values | undefined}
   */
  valuesOf(body) {
    if (!this.#known) return undefined;
    const { texts, about, engine } = this.#known;
    const now = textsOf(body.case);
    /** @type {Values} */
    const values = { ...about.values };
    if (now.size !== texts.size) return undefined;
    for (const [path, text] of now) {
      const before = texts.get(path);
      if (before === text) continue;
      const place = about.places[path];
      const value = before !== undefined && place ? valueAt(text, place) : undefined;
      if (value === undefined) return undefined;
      if (place.input === TEMPERATURE) {
        for (const [name, [number]] of Object.entries(engine.oil(HERE, value, 1))) values[name] = number;
      } else values[place.input] = value;
    }
    this.#engineOf.set(values, engine);
    return values;
  }

  /**
   * All inputs of a case at another temperature of its oil; none where its module does not know the oil by that alone.
   *
   * @param {Body} body
   * @param {number} temperature in kelvin
   * @returns {Values | undefined}
   */
  valuesAt(body, temperature) {
    const values = this.valuesOf(body);
    if (!values || !this.#known) return undefined;
    const { about, engine } = this.#known;
    if (!Object.values(about.places).some(({ input }) => input === TEMPERATURE)) return undefined;
    for (const [name, [number]] of Object.entries(engine.oil(HERE, temperature, 1))) values[name] = number;
    return values;
  }

  /**
   * The axes of the curves around a point.
   *
   * @param {Point} point
   * @returns {Axes}
   */
  axesAround(point) {
    return axesAround(this.#known?.about.axes ?? {}, point);
  }

  /**
   * The outputs at points.
   *
   * @param {Values} values
   * @param {Point[]} points
   * @param {Values} [changed] inputs in place of those among the values
   * @returns {Found}
   */
  at(values, points, changed = {}) {
    // that of the case which the values are of: another one may have come meanwhile
    const engine = this.#engineOf.get(values) ?? /** @type {Known} */ (this.#known).engine;
    const start = performance.now();
    const given = {
      ...values,
      ...changed,
      axial_load: Float64Array.from(points, (point) => point.axial_load),
      screw_speed: Float64Array.from(points, (point) => point.screw_speed),
    };
    const found = engine.evaluate(HERE, given, points.length);
    if (points.length > FEW) {
      const ofPoint = (performance.now() - start) / points.length;
      this.#ofPoint = this.#ofPoint ? (this.#ofPoint + ofPoint) / 2 : ofPoint;
    }
    return found;
  }

  /** Milliseconds that so many points take, about. @param {number} points */
  timeOf(points) {
    return this.#ofPoint * points;
  }

  /**
   * Compare the answer of the server with its own. Where both are apart the module is not used again: that is a defect,
   * which is said, and nobody shall see numbers that jump.
   *
   * @param {Body} body
   * @param {Run} answer
   */
  check(body, answer) {
    const values = this.valuesOf(body);
    if (!values) return;
    const found = this.at(values, [pointOf(values)]);
    const [own, theirs] = [found.screw_torque[0], answer.results.screw_torque];
    const isClose = theirs === null ? !Number.isFinite(own) : Math.abs(own - theirs) <= CLOSE * Math.abs(theirs);
    const file = String(this.#known?.about.structure?.file ?? "");
    if ((isClose && Boolean(found.valid[0]) === answer.results.valid) || !file) return;
    console.error(file, own, theirs);
    this.#refused.add(file);
    this.#known = undefined;
  }
}

/** The operating point among the inputs. @param {Values} values @returns {Point} */
export function pointOf({ axial_load: load, screw_speed: speed }) {
  return { axial_load: Number(load), screw_speed: Number(speed) };
}

/**
 * The points of a grid of axes, the last one the fastest.
 *
 * @template {Record<string, number>} Of
 * @param {Of} point what no axis varies
 * @param {Record<string, number[]>} axes
 */
export function pointsOf(point, axes) {
  let found = [point];
  for (const [name, values] of Object.entries(axes)) {
    found = found.flatMap((one) => values.map((value) => ({ ...one, [name]: value })));
  }
  return found;
}

export const localEngine = new LocalEngine();
