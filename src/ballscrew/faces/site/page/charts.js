// The charts of the page.

import { element } from "../../web/page/dom.js";
import { linesByValidity, pointAt } from "../../web/page/figure_parts.js";
import { FULL_BATH, fullBath, REPLENISHMENT } from "../../web/page/starvation.js";
import { SPEED, TORQUE } from "./bands.js";
import { evenly, holding, inShownUnit, inSiUnit, reasonsIn, View } from "./view.js";
import { digitsOf, plainDigits, signOf, withUnit } from "./words.js";

/** @typedef {import("./view.js").Columns} Columns */
/** @typedef {import("./view.js").Scene} Scene */
/** @typedef {import("../../web/page/figure.js").Mark} Mark */
/** @typedef {import("../../web/page/figure.js").Values} Values */

const LOAD = "axial_load";
/** Points along an axis, and the least of them while a slider moves. */
const POINTS = 161;
const LEAST = 15;
/** Where an axis begins that cannot begin at zero, as a share of its end. */
export const BEGIN = 1 / 400;
/** Rows and columns of the map. */
const CELLS = 21;
const SOME_CELLS = 11;
const FEW_CELLS = 5;
/** Film parameters between which film and asperities share the load. */
const MIXED = [1, 3];
/** Temperatures beside the present one, degC. */
const COLD = 0;
const HOT = 80;
/** Colours from little to much, for eyes of every kind. */
const RAMP = ["#440154", "#3b528b", "#21918c", "#5ec962", "#fde725"];

/** The sign of the present number of a field. @param {Scene} scene @param {string} name */
function signIn(scene, name) {
  return scene.inputs[name] < 0 ? -1 : 1;
}

/** How far an axis goes, in the unit that it is shown in: away from zero on the side of the present number. @param {Scene} scene @param {string} name */
export function endOf(scene, name) {
  const { min, max } = scene.range(name);
  return signIn(scene, name) < 0 ? Math.min(min, -max) : Math.max(max, -min);
}

/** The words of a field on an axis. @param {Scene} scene @param {string} name */
export function axisOf(scene, name) {
  const field = scene.case.contents.fields[name];
  const words = name === SPEED ? "speed of the screw" : "axial load";
  return withUnit(words, field.shown_in);
}

export function torqueTitle() {
  return withUnit("friction torque", "N m");
}

/** The friction torque as a curve. @param {Values} x @param {Values} torque @returns {Mark} */
export function torqueCurve(x, torque) {
  return { kind: "curve", name: "friction torque", x, y: torque, colour: "ink", style: "line", width: 2 };
}

/**
 * The torque in a full bath of oil, where the operating point is starved of it; none elsewhere.
 *
 * @param {Scene} scene
 * @param {Values} x
 * @param {Record<string, number | ArrayLike<number>>} changes inputs along the curve
 * @returns {Mark[]}
 */
export function bathCurve(scene, x, changes) {
  if (!scene.inputs[REPLENISHMENT] || scene.floodedTorque() === undefined) return [];
  const flooded = scene.evaluate({ ...changes, ...FULL_BATH }, x.length);
  return [fullBath(x, inShownUnit(flooded[TORQUE], scene.case.contents.results[TORQUE]))];
}

/** The friction torque in its parts, piled up over the speed or the load. */
export class Parts extends View {
  /**
   * @param {Scene} scene
   * @param {string} id
   * @param {{ over: string, heading: string, hint: string, hasValues?: boolean }} options
   */
  constructor(scene, id, { over, heading, hint, hasValues = false }) {
    super(scene, id, { heading, hint });
    this.over = over;
    this.hasValues = hasValues;
  }

  paint() {
    const { scene, over } = this;
    const { fields, results } = scene.case.contents;
    const end = endOf(scene, over);
    const x = evenly(end * BEGIN, end, scene.count(POINTS, LEAST));
    const along = { [over]: inSiUnit(x, fields[over]) };
    const found = scene.evaluate(along, x.length);
    const torque = inShownUnit(found[TORQUE], results[TORQUE]);
    const [present] = inShownUnit([scene.outputs[TORQUE]], results[TORQUE]);
    const marks = [
      ...this.#piles(x, found),
      torqueCurve(x, torque),
      ...bathCurve(scene, x, along),
      ...this.marksOf(x, found, scene.case.shown(over), present),
    ];
    this.show(
      { x: { title: axisOf(scene, over), zero: true }, y: { title: torqueTitle(), zero: true }, marks },
      { across: over, said: `At the operating point ${inTorque(scene.outputs[TORQUE], 4)}.` },
    );
    this.sayShaded(found);
  }

  /** Where each part lies: what is positive is piled up, what is negative down. @param {Values} x @param {Columns} found @returns {Mark[]} */
  #piles(x, found) {
    const { contents, spec } = this.scene.case;
    const names = Object.keys(contents.mechanisms).filter((name) => spec.outputs.includes(`contribution_${name}`));
    const [above, below] = [x.map(() => 0), x.map(() => 0)];
    return names.map((name) => {
      const [low, high] = [x.map(() => 0), x.map(() => 0)];
      for (const [place, part] of found[`contribution_${name}`].entries()) {
        const pile = part < 0 ? below : above;
        low[place] = pile[place];
        pile[place] += part;
        high[place] = pile[place];
      }
      const { words, colour } = contents.mechanisms[name];
      const own = this.scene.outputs[`contribution_${name}`];
      const note = this.hasValues ? element("span", { class: "value" }, inTorque(own, 3)) : undefined;
      return { kind: "band", name: words, x, low, high, colour, solid: true, note };
    });
  }
}

/** @param {number} torque @param {number} digits */
function inTorque(torque, digits) {
  return `${digitsOf(torque, digits)} ${signOf("N m")}`;
}

/** One or two numbers of the contacts over the speed, whose axis is logarithmic. */
export class OverSpeed extends View {
  /**
   * @param {Scene} scene
   * @param {string} id
   * @param {{ heading: string, hint: string, output: string, title: string, hasLog?: boolean }} options
   */
  constructor(scene, id, { heading, hint, output, title, hasLog = false }) {
    super(scene, id, { heading, hint });
    this.output = output;
    this.title = title;
    this.hasLog = hasLog;
  }

  paint() {
    const { scene, output } = this;
    const field = scene.case.contents.fields[SPEED];
    const sign = signIn(scene, SPEED);
    const end = Math.abs(endOf(scene, SPEED));
    const x = evenlyLog(end * BEGIN * BEGIN, end, scene.count(POINTS, LEAST));
    const signed = x.map((value) => sign * value);
    const found = scene.evaluate({ [SPEED]: inSiUnit(signed, field) }, signed.length);
    const plain = { factor: 1, offset: 0 };
    const present = Math.abs(scene.case.shown(SPEED));
    const value = scene.outputs[`screw_${output}`];
    /** @type {Mark[]} */
    const marks = [
      ...MIXED.filter(() => this.hasLog).map(
        (y) => /** @type {Mark} */ ({ kind: "level", name: "", y, colour: "soft" }),
      ),
      {
        kind: "curve",
        name: "ball and screw",
        x,
        y: inShownUnit(found[`screw_${output}`], plain),
        colour: "accent",
        style: "line",
        width: 2,
      },
      {
        kind: "curve",
        name: "ball and nut",
        x,
        y: inShownUnit(found[`nut_${output}`], plain),
        colour: "second",
        style: "dashed",
      },
      ...this.marksOf(x, found, present >= x[0] ? present : Number.NaN, value),
    ];
    const across = { title: axisOf(scene, SPEED), log: true, from: x[0], to: end };
    this.show(
      { x: across, y: { title: this.title, log: this.hasLog, zero: !this.hasLog }, marks },
      { across: SPEED, said: `At the operating point ${digitsOf(value)}.` },
    );
    this.sayShaded(found);
  }

  /** The pointer gives how fast, not which way. @param {string} name @param {number} shown */
  take(name, shown) {
    super.take(name, signIn(this.scene, SPEED) * shown);
  }
}

/** Numbers at equal ratios. @param {number} from @param {number} to @param {number} count */
function evenlyLog(from, to, count) {
  return evenly(Math.log10(from), Math.log10(to), count).map((exponent) => 10 ** exponent);
}

/** The efficiency over load and speed. */
export class EfficiencyMap extends View {
  /** @param {Scene} scene @param {string} id */
  constructor(scene, id) {
    super(scene, id, {
      heading: "Efficiency over load and speed",
      hint: "Where load and speed have opposite signs the load drives the screw.",
    });
  }

  paint() {
    const { scene } = this;
    const { fields } = scene.case.contents;
    const most = scene.count(CELLS * CELLS, FEW_CELLS * FEW_CELLS);
    const count = [CELLS, SOME_CELLS].find((each) => each * each <= most) ?? FEW_CELLS;
    const [loads, speeds] = [LOAD, SPEED].map((name) => {
      const end = endOf(scene, name);
      return evenly(end * BEGIN, end, count);
    });
    const points = loads.flatMap((load) => speeds.map((speed) => [load, speed]));
    const [ofLoads, ofSpeeds] = [LOAD, SPEED].map((name, place) =>
      inSiUnit(
        points.map((point) => point[place]),
        fields[name],
      ),
    );
    const found = scene.evaluate({ [LOAD]: ofLoads, [SPEED]: ofSpeeds }, points.length);
    const drives = loads[0] < 0 === speeds[0] < 0;
    const values = inShownUnit(found[drives ? "efficiency" : "back_driving_efficiency"], { factor: 0.01, offset: 0 });
    const valid = holding(found.valid);
    const finite = values.filter((value) => value !== null);
    // what is below zero holds by itself: one colour for all of it leaves the others for what moves
    const from = finite.length ? Math.max(0, Math.min(...finite)) : 0;
    const to = finite.length ? Math.max(from, ...finite) : 100;
    const rowsOf = (/** @type {any[]} */ all) => loads.map((_, row) => all.slice(row * count, (row + 1) * count));
    const shades = { from, to, title: "efficiency (%)", colours: RAMP };
    this.show(
      {
        x: { title: axisOf(scene, SPEED) },
        y: { title: axisOf(scene, LOAD) },
        marks: [
          {
            kind: "grid",
            name: "",
            x: speeds,
            y: loads,
            values: rowsOf(values),
            shades,
            valid: rowsOf(valid),
            colour: "",
          },
          pointAt(scene.case.shown(SPEED), scene.case.shown(LOAD), "accent"),
        ],
      },
      { across: SPEED, up: LOAD },
    );
    this.sayShaded(found);
  }
}

/** The torque over the speed with cold and with hot oil. */
export class Temperatures extends View {
  /** @param {Scene} scene @param {string} id */
  constructor(scene, id) {
    super(scene, id, { heading: "Cold and hot" });
  }

  /** Only an oil of a grade has a viscosity at each temperature. */
  get isThere() {
    return Boolean(this.scene.case.state.grade) && !("viscosity" in this.scene.case.state.edits);
  }

  prepare() {
    this.hint.textContent = this.isThere
      ? ""
      : "The oil is given by one viscosity, at one temperature. Choose a grade to see it cold and hot.";
    this.chart.hidden = this.note.hidden = !this.isThere;
  }

  paint() {
    const { scene } = this;
    if (!this.isThere) return;
    const { fields, results } = scene.case.contents;
    const end = endOf(scene, SPEED);
    const x = evenly(end * BEGIN, end, Math.floor(scene.count(3 * POINTS, 3 * LEAST) / 3));
    const present = scene.case.shown("temperature");
    const lines = [COLD, present, HOT]
      .map((degrees, place) => ({ degrees, found: this.#at(degrees, inSiUnit(x, fields[SPEED])), place }))
      .filter(({ degrees, place }) => place === 1 || degrees !== present);
    const marks = lines.flatMap(({ degrees, found, place }) => {
      const torque = inShownUnit(found[TORQUE], results[TORQUE]);
      const [colour, style] = [["accent", "ink", "second"][place], ["dashed", "line", "dashdot"][place]];
      return linesByValidity(x, torque, holding(found.valid), inDegrees(degrees), colour, style);
    });
    const [now] = inShownUnit([scene.outputs[TORQUE]], results[TORQUE]);
    this.show({
      x: { title: axisOf(scene, SPEED), zero: true },
      y: { title: torqueTitle(), zero: true },
      marks: [...marks, pointAt(scene.case.shown(SPEED), now, "accent")],
    });
    const reasons = lines
      .map(({ degrees, found }) => ({ degrees, own: reasonsIn(scene.case, found) }))
      .filter(({ own }) => own.length)
      .map(({ degrees, own }) => `${inDegrees(degrees)}: ${own.join("; ")}`);
    this.sayReasons(reasons);
  }

  /** The model with the oil at a temperature, but for what was given of it. @param {number} degrees @param {Float64Array} speeds */
  #at(degrees, speeds) {
    const { scene } = this;
    const oil = scene.oil(inSiUnit([degrees], scene.case.contents.fields.temperature));
    const changes = ["viscosity", "pressure_viscosity_coefficient", "temperature_coefficient"]
      .filter((name) => !(name in scene.case.state.edits))
      .map((name) => [name, oil[name][0]]);
    return scene.evaluate({ ...Object.fromEntries(changes), [SPEED]: speeds }, speeds.length);
  }
}

/** @param {number} degrees */
function inDegrees(degrees) {
  return `${plainDigits(Number(degrees.toPrecision(4)))} ${signOf("degC")}`;
}

/** What the shaft needs in the four quadrants of load and speed. */
export class Quadrants extends View {
  /** @param {Scene} scene @param {string} id */
  constructor(scene, id) {
    super(scene, id, {
      heading: "Back-driving in four quadrants",
      hint: "With this load and this speed, each with both signs.",
      hasChart: false,
    });
    this.grid = element("table", { class: "quadrants" });
    this.section.append(element("div", { class: "scroll", tabindex: "0" }, this.grid), this.note);
  }

  paint() {
    const { scene } = this;
    const load = Math.abs(scene.inputs[LOAD]);
    const speed = Math.abs(scene.inputs[SPEED]);
    const pairs = [
      [1, -1],
      [1, 1],
      [-1, -1],
      [-1, 1],
    ];
    const found = scene.evaluate(
      { [LOAD]: pairs.map(([sign]) => sign * load), [SPEED]: pairs.map(([, sign]) => sign * speed) },
      pairs.length,
    );
    const greatest = Math.max(...Array.from(found.drive_torque, Math.abs).filter(Number.isFinite), 1e-300);
    const cell = (/** @type {number} */ place) => {
      const [ofLoad, ofSpeed] = pairs[place];
      const torque = found.drive_torque[place];
      const screwDrives = ofLoad === ofSpeed;
      const bar = element("span", { class: "bar", "aria-hidden": "true" });
      bar.style.width = `${Math.round((100 * Math.abs(torque)) / greatest) || 0}%`;
      const holds = found.self_locking[place] === 1;
      const efficiency = found[screwDrives ? "efficiency" : "back_driving_efficiency"][place];
      const holding = `${digitsOf(found.holding_torque[place], 3)} ${signOf("N m")}`;
      const words = screwDrives
        ? "the screw drives"
        : holds
          ? `self-locking, ${holding} lower it`
          : `back-drives, ${holding} hold it`;
      const share = Number.isFinite(efficiency) ? `η ${digitsOf(100 * efficiency, 3)} %` : "";
      const isHere = ofLoad === signIn(scene, LOAD) && ofSpeed === signIn(scene, SPEED);
      const isValid = found.valid[place] === 1;
      const inside = [
        element("strong", {}, `${digitsOf(torque, 4)} ${signOf("N m")}`),
        element("span", { class: "track" }, bar),
        element("span", {}, words),
        element("span", {}, [share, isValid ? "" : "not valid"].filter(Boolean).join(" · ")),
      ];
      const marks = [isHere ? "here" : "", isValid ? "" : "outside"].join(" ");
      return element("td", { class: marks }, element("div", {}, ...inside));
    };
    const corner = element("td", { class: "corner" }, withUnit("drive torque", "N m"));
    const top = ["speed −", "speed +"].map((text) => element("th", { scope: "col" }, text));
    const row = (/** @type {string} */ words, /** @type {number} */ first) =>
      element("tr", {}, element("th", { scope: "row" }, words), cell(first), cell(first + 1));
    this.grid.replaceChildren(
      element("caption", { class: "hidden" }, "Back-driving in four quadrants"),
      element("thead", {}, element("tr", {}, corner, ...top)),
      element("tbody", {}, row("load +", 0), row("load −", 2)),
    );
    this.sayShaded(found);
  }
}
