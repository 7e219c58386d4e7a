// The sliders, each with a field for the same number.

import { byId, element } from "../../web/page/dom.js";
import { stepOf } from "../../web/page/scale.js";
import { symbol as symbolOf } from "../../web/page/symbols.js";
import { NO_NUMBER } from "./case.js";
import { plainDigits, quantityIn, signOf, spaced } from "./words.js";

/** @typedef {import("./case.js").Case} Case */
/** @typedef {{ min: number, max: number, step: number }} Range */

/** The groups of fields, each with what its paths or names begin with; those above all others stand open. */
const GROUPS = [
  {
    id: "operation",
    words: "Operating point",
    names: ["axial_load", "screw_speed", "preload", "temperature", "viscosity"],
  },
  {
    id: "geometry",
    words: "Geometry",
    names: [
      "ball_diameter",
      "lead",
      "pitch_circle_diameter",
      "contact_angle",
      "screw_conformity",
      "nut_conformity",
      "loaded_balls",
      "losses.seals.seal_torque",
    ],
  },
  { id: "nut", words: "Nut and thread", names: ["starts", "spacing", "axial_play"] },
  { id: "surfaces", words: "Surfaces", names: ["ball_roughness", "screw_roughness", "nut_roughness"] },
  {
    id: "materials",
    words: "Materials",
    names: [
      "ball_material.young_modulus",
      "screw_material.young_modulus",
      "nut_material.young_modulus",
      "ball_material.poisson_ratio",
      "screw_material.poisson_ratio",
      "nut_material.poisson_ratio",
    ],
  },
  { id: "oil", words: "Oil", path: "lubricant." },
  { id: "law", words: "Friction law", path: "model." },
];
/** Labels of fields whose names do not say of what they are. @type {Record<string, string>} */
const LABELS = {
  "ball_material.young_modulus": "Young's modulus of the balls",
  "screw_material.young_modulus": "Young's modulus of the screw",
  "nut_material.young_modulus": "Young's modulus of the nut",
  "ball_material.poisson_ratio": "Poisson's ratio of the balls",
  "screw_material.poisson_ratio": "Poisson's ratio of the screw",
  "nut_material.poisson_ratio": "Poisson's ratio of the nut",
};
/** Groups that stand open at first. */
const OPEN = ["operation", "geometry"];
/** Ranges of fields that begin at zero, in the unit they are shown in. */
const FROM_ZERO = { axial_play: 100, spacing: 100, "losses.seals.seal_torque": 2 };
/** Fields of which the usual range is that of the slider. */
const USUAL = ["contact_angle", "screw_conformity", "nut_conformity"];
const TEMPERATURES = { min: -10, max: 100, step: 1 };
/** Steps of a slider at least. */
const STEPS = 400;

/** The name of a field for everybody. @param {string} name */
export function labelOf(name) {
  return LABELS[name] ?? spaced(name);
}

/**
 * The range of a slider: around the number that the field begins with, within its bounds.
 *
 * @param {Case} one
 * @param {string} name
 * @returns {Range}
 */
export function rangeOf(one, name) {
  const field = one.contents.fields[name];
  const began = one.began(name);
  const usual = (field.usual ?? []).map((value) => one.inShown(name, value));
  if (name === "temperature") return TEMPERATURES;
  if (name === "axial_load") return around(0, 2 * (Math.abs(began) || 1000));
  if (name === "screw_speed") return around(0, 4 * (Math.abs(began) || 500));
  if (USUAL.includes(name) && usual.length) return stepped(Math.min(usual[0], began), Math.max(usual[1], began));
  if (field.whole) return { min: Math.max(1, Math.round(began / 2)), max: Math.max(6, 2 * began), step: 1 };
  const zero = FROM_ZERO[/** @type {keyof typeof FROM_ZERO} */ (name)];
  if (zero !== undefined) return stepped(0, Math.max(zero, 3 * began));
  if (name === "viscosity") return stepped(began / 10, 5 * began);
  if (field.at_least === 0) return stepped(0, 3 * began || 1);
  const high = field.at_most === undefined ? 2 * began : Math.min(2 * began, one.inShown(name, field.at_most));
  return stepped(began / 2, high);
}

/** @param {number} middle @param {number} reach */
function around(middle, reach) {
  return stepped(middle - reach, middle + reach);
}

/** @param {number} min @param {number} max @returns {Range} */
function stepped(min, max) {
  const step = stepOf((max - min) / STEPS);
  const low = tidy(step * Math.round(min / step));
  return { min: low > 0 || min <= 0 ? low : tidy(step), max: tidy(-step * Math.floor(-max / step)), step: tidy(step) };
}

/** @param {number} value */
function tidy(value) {
  return Number(value.toPrecision(12));
}

/** What is wrong with a number that was typed. @param {string} bound as the case says it */
function wordsOfFault(bound) {
  if (bound !== NO_NUMBER) return `must be ${bound}`;
  return "not understood: write 4000 or 4.5, with a unit where it is another one";
}

export class Controls {
  /** @type {Map<string, { slider: HTMLInputElement, field: HTMLInputElement, fault: HTMLElement, range: Range }>} */
  #rows = new Map();

  /**
   * @param {Case} one
   * @param {(name: string, shown: number) => void} changed
   */
  constructor(one, changed) {
    this.case = one;
    this.changed = changed;
    /** @type {Set<string>} */
    this.open = new Set(OPEN);
  }

  /** Make the sliders of the fields that the case has. */
  build() {
    const known = this.case.fields();
    const placed = new Set();
    this.#rows.clear();
    const groups = GROUPS.map(({ id, words, names = [], path }) => {
      const own = path
        ? known.filter((name) => !placed.has(name) && this.case.contents.fields[name].path.startsWith(path))
        : names.filter((name) => known.includes(name));
      for (const name of own) placed.add(name);
      return { id, words, own };
    });
    const found = groups
      .filter(({ own }) => own.length)
      .map(({ id, words, own }) => {
        const details = element("details", { id: `group-${id}` }, element("summary", {}, words));
        details.open = this.open.has(id);
        details.addEventListener("toggle", () => (details.open ? this.open.add(id) : this.open.delete(id)));
        details.append(...own.map((name) => this.#row(name)));
        return details;
      });
    byId("sliders").replaceChildren(...found);
    this.refresh();
  }

  /** @param {string} name */
  #row(name) {
    const { path, symbol, shown_in: unit, meaning } = this.case.contents.fields[name];
    const id = `f-${path.replaceAll(".", "-")}`;
    const range = { ...rangeOf(this.case, name) };
    const label = labelOf(name);
    const sign = signOf(unit);
    const slider = element("input", { type: "range", name: path, "aria-label": sign ? `${label}, ${sign}` : label });
    const field = element("input", {
      type: "text",
      id,
      inputmode: "decimal",
      autocomplete: "off",
      "aria-describedby": `${id}-fault`,
    }); // prettier-ignore
    const fault = element("p", { class: "fault", id: `${id}-fault` });
    slider.addEventListener("input", () => this.#take(name, Number(slider.value), slider));
    const { contents } = this.case;
    const typed = () => quantityIn(field.value, contents.fields[name], contents.units);
    field.addEventListener("input", () => this.#take(name, typed(), field));
    field.addEventListener("change", () => this.show(name));
    this.#rows.set(name, { slider, field, fault, range });
    const words = element("label", { for: id, title: meaning }, label, " ", symbolOf(symbol));
    const entry = element("span", { class: "entry" }, field, element("span", { class: "unit" }, sign));
    return element("div", { class: "control" }, words, entry, slider, fault);
  }

  /**
   * @param {string} name
   * @param {number} shown
   * @param {HTMLInputElement} from
   */
  #take(name, shown, from) {
    const row = this.#rows.get(name);
    if (!row) return;
    const wrong = this.case.fault(name, shown);
    row.field.setAttribute("aria-invalid", String(Boolean(wrong)));
    row.fault.textContent = wrong && wordsOfFault(wrong);
    if (wrong) return;
    this.changed(name, shown);
    this.show(name, from);
  }

  /**
   * Show the number of a field.
   *
   * @param {string} name
   * @param {HTMLInputElement} [from] what is being changed, which keeps its text
   */
  show(name, from) {
    const row = this.#rows.get(name);
    if (!row) return;
    const { slider, field, fault, range } = row;
    const shown = this.case.shown(name);
    if (from !== slider) {
      if (shown < range.min) range.min = shown;
      if (shown > range.max) range.max = shown;
      slider.min = String(range.min);
      slider.max = String(range.max);
      slider.step = String(range.step);
      slider.value = String(shown);
    }
    if (from !== field) {
      field.value = plainDigits(Number(shown.toPrecision(7)));
      field.setAttribute("aria-invalid", "false");
      fault.textContent = "";
    }
    const share = (shown - range.min) / (range.max - range.min);
    slider.style.setProperty("--share", `${100 * share}%`);
    slider.closest(".control")?.classList.toggle("changed", name in this.case.state.edits);
  }

  /** Show the numbers of all fields but that which is being typed. */
  refresh() {
    for (const [name, { field }] of this.#rows) {
      if (field !== document.activeElement) this.show(name);
    }
  }

  /** @param {string} name */
  range(name) {
    return this.#rows.get(name)?.range ?? rangeOf(this.case, name);
  }

  /**
   * The number of a field as its slider would give it, for a number that a pointer gave.
   *
   * @param {string} name
   * @param {number} shown
   */
  snapped(name, shown) {
    const { min, max, step } = this.range(name);
    return tidy(Math.max(min, Math.min(max, step * Math.round(shown / step))));
  }
}
