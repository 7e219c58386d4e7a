// The charts of the page.

import { SPEED, TORQUE } from "./bands.js";
import { colourOf, evenly, evenlyLog, rounded, spanOf } from "./plot.js";
import { inShownUnit, inSiUnit, reasonsIn, View } from "./view.js";
import { digitsOf, element, plainDigits, signOf, withUnit } from "./words.js";

/** @typedef {import("./view.js").Columns} Columns */
/** @typedef {import("./view.js").Scene} Scene */

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
const RAMP = [
  [68, 1, 84],
  [59, 82, 139],
  [33, 145, 140],
  [94, 201, 98],
  [253, 231, 37],
];

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
    this.xs = new Float64Array();
    /** @type {Columns} */
    this.found = {};
    /** @type {{ name: string, value: HTMLElement, item: HTMLElement }[]} */
    this.items = [];
    this.follow(over);
  }

  prepare() {
    const { contents, spec } = this.scene.case;
    this.mechanisms = Object.keys(contents.mechanisms).filter((name) => spec.outputs.includes(`contribution_${name}`));
    this.items = this.mechanisms.map((name) => {
      const { words, colour } = contents.mechanisms[name];
      const swatch = element("span", { class: "swatch", "aria-hidden": "true" });
      swatch.style.background = colour;
      const value = element("span", { class: "value" });
      const item = element("li", {}, swatch, element("span", {}, words), value);
      return { name, value, item };
    });
    this.legend.replaceChildren(...this.items.map(({ item }) => item));
  }

  paint() {
    const { scene, plot } = this;
    if (!plot || !this.mechanisms) return;
    const { fields, results, mechanisms } = scene.case.contents;
    const field = fields[this.over];
    const end = endOf(scene, this.over);
    this.xs = evenly(end * BEGIN, end, scene.count(POINTS, LEAST));
    this.found = scene.evaluate({ [this.over]: inSiUnit(this.xs, field) }, this.xs.length);
    const { xs, found } = this;
    const torque = inShownUnit(found[TORQUE], results[TORQUE]);
    const piles = this.#piles();
    const edge = piles.flatMap(({ lows, highs }) => [lows, highs]);
    plot.begin(
      { from: Math.min(0, end), to: Math.max(0, end), title: axisOf(scene, this.over) },
      { ...rounded(spanOf(torque, ...edge)), title: torqueTitle() },
    );
    plot.inside(() => {
      for (const { name, lows, highs } of piles) plot.area(xs, lows, highs, mechanisms[name].colour);
      plot.shade(xs, found.valid);
    });
    plot.axes();
    plot.inside(() => plot.line(xs, torque, colourOf("ink")));
    plot.point(scene.case.shown(this.over), inShownUnit([scene.outputs[TORQUE]], results[TORQUE])[0]);
    this.sayShaded(found);
    if (this.hasValues) this.#sayValues();
  }

  /** Where each part lies: what is positive is piled up, what is negative down. */
  #piles() {
    const count = this.xs.length;
    const high = new Float64Array(count);
    const low = new Float64Array(count);
    return (this.mechanisms ?? []).map((name) => {
      const part = this.found[`contribution_${name}`];
      const lows = new Float64Array(count);
      const highs = new Float64Array(count);
      for (let place = 0; place < count; place += 1) {
        const pile = part[place] < 0 ? low : high;
        lows[place] = pile[place];
        pile[place] += part[place];
        highs[place] = pile[place];
      }
      return { name, lows, highs };
    });
  }

  #sayValues() {
    for (const { name, value, item } of this.items) {
      const part = this.scene.outputs[`contribution_${name}`];
      value.textContent = `${digitsOf(part, 3)} ${signOf("N m")}`;
      item.classList.toggle("none", part === 0);
    }
  }

  numbers() {
    const { contents } = this.scene.case;
    const names = this.mechanisms ?? [];
    return {
      caption: this.words.heading,
      head: [
        axisOf(this.scene, this.over),
        torqueTitle(),
        ...names.map((name) => contents.mechanisms[name].words),
        "valid",
      ],
      rows: Array.from(this.xs, (x, place) => [
        x,
        this.found[TORQUE][place],
        ...names.map((name) => this.found[`contribution_${name}`][place]),
        this.found.valid[place],
      ]),
    };
  }

  description() {
    const torque = `${digitsOf(this.scene.outputs[TORQUE])} ${signOf("N m")}`;
    return `${this.words.heading}. At the operating point ${torque}.`;
  }
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
    this.xs = new Float64Array();
    /** @type {Columns} */
    this.found = {};
    this.follow(SPEED);
  }

  get sides() {
    return [
      { name: `screw_${this.output}`, words: "ball and screw", colour: colourOf("accent") },
      { name: `nut_${this.output}`, words: "ball and nut", colour: colourOf("second") },
    ];
  }

  prepare() {
    const items = this.sides.map(({ words }, place) => {
      const swatch = element("span", { class: `swatch line ${place ? "second" : "first"}`, "aria-hidden": "true" });
      return element("li", {}, swatch, element("span", {}, words));
    });
    this.legend.replaceChildren(...items);
  }

  paint() {
    const { scene, plot } = this;
    if (!plot) return;
    const field = scene.case.contents.fields[SPEED];
    const sign = signIn(scene, SPEED);
    const end = Math.abs(endOf(scene, SPEED));
    this.xs = evenlyLog(end * BEGIN * BEGIN, end, scene.count(POINTS, LEAST));
    const signed = this.xs.map((value) => sign * value);
    this.found = scene.evaluate({ [SPEED]: inSiUnit(signed, field) }, signed.length);
    const { xs, found } = this;
    const rows = this.sides.map(({ name }) => found[name]);
    const span = spanOf(...rows);
    const least = Math.min(...rows.flatMap((row) => Array.from(row).filter((value) => value > 0)), span.to);
    const up = this.hasLog
      ? { from: 10 ** Math.floor(Math.log10(least)), to: 10 ** -Math.floor(-Math.log10(span.to)), log: true }
      : rounded(span);
    plot.begin({ from: xs[0], to: end, title: axisOf(scene, SPEED), log: true }, { ...up, title: this.title });
    plot.inside(() => plot.shade(xs, found.valid));
    plot.axes();
    plot.inside(() => {
      if (this.hasLog) for (const value of MIXED) plot.level(value);
      this.sides.forEach(({ name, colour }, place) => {
        plot.line(xs, found[name], colour, { dash: place ? [7, 4] : [] });
      });
    });
    const present = Math.abs(scene.case.shown(SPEED));
    if (present >= xs[0]) plot.point(present, scene.outputs[this.sides[0].name]);
    this.sayShaded(found);
  }

  /** The pointer gives how fast, not which way. @param {string} name @param {number} shown */
  take(name, shown) {
    super.take(name, signIn(this.scene, SPEED) * shown);
  }

  numbers() {
    return {
      caption: this.words.heading,
      head: [axisOf(this.scene, SPEED), ...this.sides.map(({ words }) => words), "valid"],
      rows: Array.from(this.xs, (x, place) => [
        x,
        ...this.sides.map(({ name }) => this.found[name][place]),
        this.found.valid[place],
      ]),
    };
  }

  description() {
    const value = digitsOf(this.scene.outputs[this.sides[0].name]);
    return `${this.words.heading}. At the operating point ${value}.`;
  }
}

/** The efficiency over load and speed. */
export class EfficiencyMap extends View {
  /** @param {Scene} scene @param {string} id */
  constructor(scene, id) {
    super(scene, id, {
      heading: "Efficiency over load and speed",
      hint: "Where load and speed have opposite signs the load drives the screw.",
    });
    this.loads = new Float64Array();
    this.speeds = new Float64Array();
    /** @type {Float64Array} */
    this.values = new Float64Array();
    /** @type {Columns} */
    this.found = {};
    this.low = element("span");
    this.high = element("span");
    this.follow(SPEED, LOAD);
  }

  prepare() {
    const bar = element("span", { class: "ramp", "aria-hidden": "true" });
    this.legend.replaceChildren(element("li", {}, this.low, bar, this.high));
  }

  paint() {
    const { scene, plot } = this;
    if (!plot) return;
    const { fields } = scene.case.contents;
    const most = scene.count(CELLS * CELLS, FEW_CELLS * FEW_CELLS);
    const count = [CELLS, SOME_CELLS].find((each) => each * each <= most) ?? FEW_CELLS;
    const ends = [endOf(scene, LOAD), endOf(scene, SPEED)];
    this.loads = evenly(ends[0] / (2 * count), ends[0] - ends[0] / (2 * count), count);
    this.speeds = evenly(ends[1] / (2 * count), ends[1] - ends[1] / (2 * count), count);
    const whole = Array.from({ length: count * count }, (_, place) => place);
    const loads = whole.map((place) => this.loads[(place - (place % count)) / count]);
    const speeds = whole.map((place) => this.speeds[place % count]);
    this.found = scene.evaluate(
      { [LOAD]: inSiUnit(loads, fields[LOAD]), [SPEED]: inSiUnit(speeds, fields[SPEED]) },
      whole.length,
    );
    const drives = ends[0] < 0 === ends[1] < 0;
    this.values = this.found[drives ? "efficiency" : "back_driving_efficiency"];
    const finite = this.values.filter((value) => Number.isFinite(value));
    // what is below zero holds by itself: one colour for all of it leaves the others for what moves
    const low = finite.length ? Math.max(0, Math.min(...finite)) : 0;
    const high = finite.length ? Math.max(low, ...finite) : 1;
    plot.begin(
      { from: Math.min(0, ends[1]), to: Math.max(0, ends[1]), title: axisOf(scene, SPEED) },
      { from: Math.min(0, ends[0]), to: Math.max(0, ends[0]), title: axisOf(scene, LOAD) },
    );
    plot.inside(() => {
      plot.cells(this.speeds, this.loads, (row, column) => {
        const place = row * count + column;
        const value = this.values[place];
        const colour = Number.isFinite(value) ? rampAt((value - low) / (high - low || 1)) : colourOf("panel");
        return { colour, isValid: this.found.valid[place] === 1 };
      });
    });
    plot.axes();
    plot.point(scene.case.shown(SPEED), scene.case.shown(LOAD));
    this.low.textContent = `${low === 0 ? "≤ 0" : digitsOf(100 * low, 3)} %`;
    this.high.textContent = `${digitsOf(100 * high, 3)} %`;
    this.sayShaded(this.found);
  }

  numbers() {
    const count = this.speeds.length;
    return {
      caption: "efficiency over axial load (down) and speed (across)",
      head: [axisOf(this.scene, LOAD), ...Array.from(this.speeds, (value) => digitsOf(value, 3))],
      rows: Array.from(this.loads, (load, row) => [load, ...this.values.slice(row * count, (row + 1) * count)]),
    };
  }
}

/** A colour between little and much. @param {number} share */
function rampAt(share) {
  const place = Math.max(0, Math.min(1, share)) * (RAMP.length - 1);
  const first = Math.min(RAMP.length - 2, Math.floor(place));
  const mixed = RAMP[first].map((value, part) => value + (RAMP[first + 1][part] - value) * (place - first));
  return `rgb(${mixed.map((value) => Math.round(value)).join(" ")})`;
}

/** The torque over the speed with cold and with hot oil. */
export class Temperatures extends View {
  /** @param {Scene} scene @param {string} id */
  constructor(scene, id) {
    super(scene, id, { heading: "Cold and hot", hint: "" });
    this.xs = new Float64Array();
    /** @type {{ degrees: number, found: Columns, colour: string, dash: number[] }[]} */
    this.lines = [];
    this.without = element("p", { class: "hint" });
    this.hint.after(this.without);
  }

  /** Only an oil of a grade has a viscosity at each temperature. */
  get isThere() {
    return Boolean(this.scene.case.state.grade) && !("viscosity" in this.scene.case.state.edits);
  }

  prepare() {
    const isThere = this.isThere;
    this.without.textContent = isThere
      ? ""
      : "The oil is given by one viscosity, at one temperature. Choose a grade to see it cold and hot.";
    for (const one of [this.plot?.canvas.parentElement, this.legend, this.note, this.details]) {
      if (one) one.hidden = !isThere;
    }
  }

  paint() {
    const { scene, plot } = this;
    if (!plot || !this.isThere) return;
    const { fields, results } = scene.case.contents;
    const end = endOf(scene, SPEED);
    const count = scene.count(3 * POINTS, 3 * LEAST) / 3;
    this.xs = evenly(end * BEGIN, end, Math.floor(count));
    const speeds = inSiUnit(this.xs, fields[SPEED]);
    const colours = ["accent", "ink", "second"].map(colourOf);
    const present = scene.case.shown("temperature");
    const all = [COLD, present, HOT].map((degrees, place) => {
      const { viscosity, pressure_viscosity_coefficient, temperature_coefficient } = scene.oil(
        inSiUnit([degrees], fields.temperature),
      );
      const oil = { viscosity: viscosity[0], pressure_viscosity_coefficient: pressure_viscosity_coefficient[0] };
      const changes = { ...oil, temperature_coefficient: temperature_coefficient[0] };
      const kept = Object.fromEntries(Object.entries(changes).filter(([name]) => !(name in scene.case.state.edits)));
      const found = scene.evaluate({ ...kept, [SPEED]: speeds }, speeds.length);
      return { degrees, found, colour: colours[place], dash: [[8, 4], [], [2, 4]][place] };
    });
    this.lines = all.filter(({ degrees }, place) => place === 1 || degrees !== present);
    const torques = this.lines.map(({ found }) => inShownUnit(found[TORQUE], results[TORQUE]));
    plot.begin(
      { from: Math.min(0, end), to: Math.max(0, end), title: axisOf(scene, SPEED) },
      { ...rounded(spanOf(...torques)), title: torqueTitle() },
    );
    plot.axes();
    plot.inside(() => {
      this.lines.forEach(({ found }, place) => {
        // only along the line itself: the others may hold there
        plot.halo(
          this.xs,
          torques[place].map((value, point) => (found.valid[point] === 1 ? Number.NaN : value)),
        );
      });
      this.lines.forEach(({ colour, dash }, place) => {
        plot.line(this.xs, torques[place], colour, { dash });
      });
    });
    plot.point(scene.case.shown(SPEED), scene.outputs[TORQUE]);
    const items = this.lines.map(({ degrees, colour }) => {
      const swatch = element("span", { class: "swatch line", "aria-hidden": "true" });
      swatch.style.background = colour;
      return element("li", {}, swatch, element("span", {}, inDegrees(degrees)));
    });
    const reasons = this.lines
      .map(({ degrees, found }) => ({ degrees, own: reasonsIn(scene.case, found) }))
      .filter(({ own }) => own.length)
      .map(({ degrees, own }) => `${inDegrees(degrees)}: ${own.join("; ")}`);
    this.sayReasons(reasons);
    this.legend.replaceChildren(...items);
  }

  numbers() {
    if (!this.isThere || !this.lines.length) return undefined;
    return {
      caption: `Cold and hot: ${torqueTitle()}`,
      head: [axisOf(this.scene, SPEED), ...this.lines.map(({ degrees }) => inDegrees(degrees))],
      rows: Array.from(this.xs, (x, place) => [x, ...this.lines.map(({ found }) => found[TORQUE][place])]),
    };
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
      hasCanvas: false,
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
