// The checks with their limits, and the ball in its grooves.

import { element } from "../../web/page/dom.js";
import { ofScreen } from "../../web/page/palette.js";
import { CanvasPen } from "../../web/page/pen.js";
import { ballAt, drawBall } from "./ball.js";
import { textOf } from "./judgements.js";
import { View } from "./view.js";
import { digitsOf, inPlace, plainDigits, powerOf, quantityIn, signOf, spaced } from "./words.js";

/** @typedef {import("./judgements.js").JudgedRecord} JudgedRecord */
/** @typedef {{ factor: number, offset: number, shown_in: string }} Shown */

/** What is asked for, in its order. */
const ASKED = [
  "unsupported_length",
  "limits.running_time",
  "limits.static_safety",
  "limits.buckling_safety",
  "limits.critical_speed_share",
  "limits.shaft_stress",
  "limits.diameter_speed_product",
];
const FULL = 1;

/** The limit that is by the maker of the nut where none is given. */
const OF_MAKER = "limits.diameter_speed_product";

/** @param {number} value @param {Shown} quantity */
function inUnitOf(value, { factor, offset }) {
  return (value - offset) / factor;
}

/** A number with the unit it is shown in. @param {number | null} value @param {Shown} quantity */
function shownIn(value, quantity) {
  const unit = quantity.shown_in;
  if (value === null || !Number.isFinite(value)) return "–";
  return `${digitsOf(inUnitOf(value, quantity))} ${signOf(unit)}`.trim().replace(" °", "°");
}

/** What is said of a check that is not judged, beside the word that says so. @type {Record<string, string>} */
const OF_OPEN = {
  "not checked: give {input}": "give {input}",
  "not judged: give {input}": "give {input}",
  "not judged: at rest": "at rest",
};
/** The check whose value is a number of turns. */
const LIFE = "check.life";

/** A number of turns, a large one with a power of ten. @param {number | null} turns */
function turnsIn(turns) {
  if (turns === null || !Number.isFinite(turns)) return "–";
  return `${powerOf(turns)} revolutions`;
}

/** In the panel what is to be given has the name of its field there. */
const IN_PANEL = {
  ...inPlace,
  say: (/** @type {string} */ template) => {
    const name = template === "installation" ? ASKED[0] : template;
    return ASKED.includes(name) ? `“${spaced(name)}”` : (OF_OPEN[template] ?? template);
  },
};

/** The checks with value, limit, what is used of it, and words; above them what is given for them. */
export class Checks extends View {
  /** @param {import("./view.js").Scene} scene @param {string} id */
  constructor(scene, id) {
    super(scene, id, {
      heading: "Checks",
      hint: "Life, strength and speed against their limits.",
      hasChart: false,
    });
    this.asked = element("div", { class: "asked" });
    this.facts = element("p", { class: "hint" });
    this.table = element("table", { class: "checks" });
    this.section.append(this.asked, element("div", { class: "scroll", tabindex: "0" }, this.table), this.facts);
    this.written = "";
  }

  prepare() {
    this.written = "";
    this.asked.replaceChildren(...ASKED.map((name) => this.#asked(name)), this.#ends());
  }

  /** @param {string} name */
  #asked(name) {
    const { case: one } = this.scene;
    const quantity = one.contents.judging.given[name];
    const id = `given-${name}`;
    const field = element("input", { id, type: "text", inputmode: "decimal", autocomplete: "off" });
    const given = one.state.given[name];
    field.value = typeof given === "number" ? plainDigits(given) : "";
    const usual = name === OF_MAKER ? one.start.judged.speed_limit.value : quantity.default;
    field.placeholder = usual === null ? "–" : plainDigits(Number(inUnitOf(usual, quantity).toPrecision(4)));
    field.addEventListener("change", () => {
      const shown = quantityIn(field.value, quantity, one.contents.units);
      const isGiven = field.value.trim() !== "";
      const fault = isGiven ? one.faultOfGiven(name, String(shown)) : "";
      field.setAttribute("aria-invalid", String(fault !== ""));
      if (!fault) this.scene.give(name, isGiven ? shown : undefined);
    });
    return labelled(spaced(name), id, field, signOf(quantity.shown_in));
  }

  #ends() {
    const { contents, state } = this.scene.case;
    const menu = element("select", { id: "given-ends" });
    for (const [name, { words }] of Object.entries(contents.judging.ends)) {
      menu.append(element("option", { value: name }, words));
    }
    menu.value = String(state.given.ends ?? "fixed-supported");
    menu.addEventListener("change", () => this.scene.give("ends", menu.value));
    return labelled("ends of the shaft", "given-ends", menu, "");
  }

  paint() {
    const { judged, case: one } = this.scene;
    if (!judged) return;
    const lines = judged.checks.map((record) => this.#line(record));
    const written = JSON.stringify(lines);
    if (written === this.written) return;
    this.written = written;
    const head = ["Check", "Value", "Limit", "Used", "Result"].map((words) => element("th", { scope: "col" }, words));
    const rows = lines.map(({ title, value, limit, used, state, words }) =>
      element(
        "tr",
        { class: state },
        element("th", { scope: "row" }, title),
        element("td", {}, value),
        element("td", {}, limit),
        element("td", {}, ...barOf(used, title)),
        element("td", { class: "said" }, element("strong", {}, STATES[state]), `${MARKS[state] ?? ""} ${words}`),
      ),
    );
    this.table.replaceChildren(element("thead", {}, element("tr", {}, ...head)), element("tbody", {}, ...rows));
    const { shown } = one.contents.judging;
    const { derived } = judged;
    const newtons = one.contents.results.largest_contact_load ?? one.contents.results.contact_load;
    this.facts.textContent = `Lead angle ${shownIn(derived.lead_angle, shown.lead_angle)}, speed of the nut ${shownIn(derived.nut_speed, shown.nut_speed)}, load ratings ${shownIn(derived.dynamic_load_rating, newtons)} dynamic and ${shownIn(derived.static_load_rating, newtons)} static.`;
  }

  /** @param {JudgedRecord} record */
  #line(record) {
    const { contents } = this.scene.case;
    const quantity = contents.judging.shown[record.id];
    const written = record.id === LIFE ? turnsIn : (/** @type {number | null} */ value) => shownIn(value, quantity);
    const { title } = contents.judging.tables.checks.find((/** @type {any} */ row) => row.id === record.id);
    return {
      title,
      value: written(record.value),
      limit: written(record.limit),
      used: record.utilisation,
      state: record.holds === null ? "open" : record.holds ? "holds" : "fails",
      words: textOf(contents, record.message, IN_PANEL),
    };
  }
}

/** @type {Record<string, string>} */
const STATES = { open: "not judged", holds: "holds", fails: "fails" };
/** @type {Record<string, string>} */
const MARKS = { open: ":" };

/** @param {string} words @param {string} id @param {HTMLElement} field @param {string} unit */
function labelled(words, id, field, unit) {
  const inside = unit ? [field, element("span", { class: "unit" }, unit)] : [field];
  return element("p", {}, element("label", { for: id }, words), element("span", { class: "entry" }, ...inside));
}

/** How much of a limit is used, as a bar and in per cent. @param {number | null} used @param {string} title */
function barOf(used, title) {
  if (used === null || !Number.isFinite(used)) return ["–"];
  const bar = element("span", { class: "bar" });
  bar.style.width = `${100 * Math.min(FULL, used)}%`;
  const track = element("span", { class: "track", title }, bar);
  return [`${digitsOf(100 * used, 3)} %`, track];
}

/** The ball in its grooves, in the section across the path. */
export class BallView extends View {
  /**
   * @param {import("./view.js").Scene} scene
   * @param {string} id
   * @param {import("../../web/page/engine.js").Engine} engine
   */
  constructor(scene, id, engine) {
    super(scene, id, {
      heading: "The ball in its grooves",
      hint: "The section across the path of the balls, to scale; how far the grooves reach is assumed.",
    });
    this.engine = engine;
    /** @type {Record<string, number>} */
    this.places = {};
    this.canvas = element("canvas", { role: "img", "aria-label": this.heading });
    this.chart.replaceWith(element("div", { class: "picture" }, this.canvas));
  }

  paint() {
    const { scene, canvas } = this;
    const size = { width: canvas.clientWidth, height: canvas.clientHeight };
    if (!size.width || !size.height) return;
    const { case: one, inputs, outputs } = scene;
    const all = { ...one.unchanged(), ...inputs };
    this.places = ballAt(this.engine, one.contents, { structure: one.structure, inputs: all, outputs });
    const { ink, soft, line, accent } = ofScreen();
    const colours = { ink, soft, body: line, accent };
    const angles = this.#angles();
    // two pairs of flanks leave no room for both angles
    const words = { nut: "nut", screw: "screw", angle: angles.length > 1 ? "" : `α ${angles[0]}` };
    const pen = new CanvasPen(canvas, size.width, size.height, globalThis.devicePixelRatio || 1);
    drawBall(pen.context, size, this.places, colours, words);
    this.note.className = "hint";
    const said = this.#said();
    if (this.note.textContent !== said) this.note.textContent = said;
    canvas.setAttribute("aria-label", this.description());
  }

  /** The pairs of flanks that the ball touches, the one that carries the load first. */
  #touched() {
    return ["loaded", "other"].filter((flank) => this.places[`${flank}.touches`] === 1);
  }

  #angles() {
    const quantity = this.scene.case.contents.judging.shown.lead_angle;
    return this.#touched().map((flank) => shownIn(this.places[`${flank}.angle`], quantity));
  }

  #said() {
    const { results } = this.scene.case.contents;
    const loads = this.#touched().map((flank) => this.places[`${flank}.load`]);
    if (!loads.some((load) => load > 0)) return `no load on the ball.`;
    const quantity = results.largest_contact_load ?? results.contact_load;
    return `Contact angle ${this.#angles().join(", ")}, load of the ball ${loads.map((load) => shownIn(load, quantity)).join(", ")}.`;
  }

  description() {
    return `${this.heading}. ${this.#said()}`;
  }
}
