// The card of warming up: temperatures, preload, torque and growth over hours, and the state in which it ends.

import * as designs from "../designs.js";
import { box, framed, opened, textField } from "../controls.js";
import { element, redraw } from "../dom.js";
import * as schema from "../schema.js";
import * as states from "../state.js";
import { store } from "../store.js";
import * as units from "../units.js";
import { fieldset, placeFaults, showValues } from "./case_fields.js";
import { question } from "./question.js";

/** Fields in words. @type {Record<string, string>} */
const HOURS = {
  hours: "hours of work",
  rest: "hours of rest after it",
};

/** @typedef {import("../state.js").Tables} Tables */

const SECTION = "surroundings";
/** Samples of a band on the page; on the command line it has more. */
const SAMPLES = 64;
/** What is known of the surroundings of most axes; the others are behind "more". */
const FIRST = [
  "ambient",
  "nut_conductance",
  "shaft_length",
  "first_position",
  "stroke",
  "bearing_conductance",
  "bracing",
];
/**
 * @param {HTMLElement} holder
 * @returns {import("../cards.js").Card}
 */
export function setUp(holder) {
  const note = element("p", { class: "small" });
  const editor = element("div", { class: "card-inputs" });
  const asked = question({
    address: "warm-up",
    show: ({ inputs: found }) => {
      effective = found;
      showValues(editor, found);
    },
    place: (faults) => placeFaults(editor, faults),
  });
  holder.replaceChildren(asked.head, note, editor, asked.line, asked.result);

  /** @type {Tables} */
  let tables = {};
  /** What the inputs show, as text. */
  let shown = "";
  /** What counted in the answer. @type {Tables | undefined} */
  let effective;
  function keyOf(heat = store.state.heat) {
    const { fields, show: design } = store.state;
    return JSON.stringify([tables[SECTION], heat, fields, design, units.currentSystem()]);
  }

  /** @param {import("../fields.js").Change} change */
  function onChange({ path = "", text: typed = "", unit }) {
    if (unit !== undefined) {
      designs.chooseUnit(path, unit);
      return;
    }
    const found = states.tables({ [SECTION]: {}, ...tables }, { [path]: typed }, schema.fieldOf);
    const section = Object.keys(found[SECTION]).length ? found[SECTION] : null;
    tables = { ...tables, [SECTION]: section ?? undefined };
    shown = keyOf();
    designs.setTables({ [SECTION]: section }, path);
  }

  async function follow() {
    const design = designs.current();
    const given = await designs.currentCase();
    if (design !== designs.current()) return; // another one was chosen in the meantime, and is followed on its own
    tables = given;
    const { heat } = store.state;
    const moves = Boolean(tables.motion && tables.axis);
    note.textContent = moves
      ? "The heat is that of the motion under Duty."
      : "The heat is that of the operating point, with the nut moving to and fro over the stroke; where a motion is given, that of the motion.";
    if (keyOf() !== shown) {
      shown = keyOf();
      const isOpen = editor.querySelector("details")?.open ?? false;
      redraw(editor, ...inputs(isOpen));
      if (effective) showValues(editor, effective);
    }
    const hours = hoursOf(heat.hours);
    const cool = heat.rest ? hoursOf(heat.rest) : 0;
    const found = { case: tables, hours: hours ?? 0, cool_down: cool ?? -1 };
    asked.follow(heat.band ? { ...found, band: true, samples: SAMPLES } : found);
  }

  /** @param {boolean} isOpen */
  function inputs(isOpen) {
    const source = { state: store.state, tables, onChange };
    const names = Object.keys(schema.fieldsOf(SECTION));
    const others = names.filter((name) => !FIRST.includes(name));
    const first = fieldset(SECTION, "Surroundings", FIRST, source);
    const more = opened(
      "More of the surroundings",
      fieldset(SECTION, "Other numbers of the surroundings", others, source),
    );
    more.open = isOpen;
    return [options(), first, more];
  }

  /**
   * Change what is asked; what was typed stands in its field already.
   *
   * @param {Partial<import("../state.js").State["heat"]>} found
   */
  function changeHeat(found) {
    const heat = { ...store.state.heat, ...found };
    shown = keyOf(heat);
    store.change(
      (state) => {
        state.heat = heat;
      },
      { of: "cards" },
    );
  }

  /** The hours of work and of rest, and the band. */
  function options() {
    const { heat } = store.state;
    /** @param {"hours" | "rest"} name @param {string} option */
    const hours = (name, option) => {
      const id = `warm-${name}`;
      const input = textField(heat[name], (typed) => changeHeat({ [name]: units.inASCII(typed.trim()) }), {
        inputmode: "decimal",
        id,
        "aria-describedby": `${id}-fault`,
      });
      return element(
        "div",
        { class: "field", "data-path": option },
        element("label", { for: id }, HOURS[name] ?? name),
        element("div", { class: "entry" }, input, element("span", { class: "unit" }, "h")),
        element("p", { class: "fault", id: `${id}-fault` }),
      );
    };
    const words = `with bands, of ${SAMPLES} samples (takes some seconds)`;
    return framed(
      "Hours",
      element("div", { class: "grid" }, hours("hours", "--hours"), hours("rest", "--cool-down")),
      element(
        "p",
        { class: "band" },
        box(words, heat.band, (band) => changeHeat({ band }), { id: "warm-band" }),
      ),
    );
  }

  return { follow };
}

/**
 * Hours as they were typed, with a point or a comma; null where they are none.
 *
 * @param {string} typed
 */
function hoursOf(typed) {
  const found = Number(units.withPoint(typed));
  return typed && Number.isFinite(found) ? found : null;
}
