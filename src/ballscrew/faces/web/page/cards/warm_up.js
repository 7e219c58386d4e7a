// The card of warming up: temperatures, preload, torque and growth over hours, and the state in which it ends.

import * as designs from "../designs.js";
import { box, framed, labelled, opened, textField } from "../controls.js";
import { element, redraw, table } from "../dom.js";
import { watch } from "../plot.js";
import * as schema from "../schema.js";
import * as states from "../state.js";
import { store } from "../store.js";
import { text, textOr } from "../texts.js";
import * as units from "../units.js";
import { inPanes } from "../views.js";
import { vocabulary } from "../vocabulary.js";
import { fieldset, placeFaults, showValues } from "./case_fields.js";
import { data, FORCE, GROWTH, HOURS, POWER, quantity, TEMPERATURE, TORQUE } from "./quantities.js";
import { question } from "./question.js";
import { lines } from "./records.js";
import * as charts from "./warm_up_charts.js";

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
/** Numbers of the state in which it ends. @type {[string, ReturnType<typeof quantity>][]} */
const STEADY = [
  ["nut_temperature", TEMPERATURE],
  ["oil_temperature", TEMPERATURE],
  ["shaft_temperature", TEMPERATURE],
  ["preload", FORCE],
  ["screw_torque", TORQUE],
  ["growth", GROWTH],
  ["power", POWER],
];
/** Series that have the meaning of a number of the steady state. @type {Record<string, string>} */
const SERIES = { growth: "shaft_growth", power: "friction_power" };

/**
 * @param {HTMLElement} holder
 * @returns {import("../cards.js").Card}
 */
export function setUp(holder) {
  const note = inPanes(element("p", { class: "small" }), "heat.state");
  const editor = inPanes(element("div", { class: "card-inputs" }), "heat.state");
  const words = inPanes(element("div"), "heat.end");
  const rest = element("div");
  const slider = element("input", { type: "range", id: "warm-instant", min: "0", max: "1", step: "1" });
  const at = labelled(slider, text("warm_up.instant"));
  const places = Object.entries(charts.PLACES).map(([id, pane]) =>
    inPanes(element("div", { id, class: "chart low", hidden: true }), pane),
  );
  const half = (/** @type {HTMLElement[]} */ ...parts) =>
    inPanes(element("div", { class: "half" }, ...parts), "heat.temperatures");
  const pictures = places.flatMap((place) =>
    place.id === "warm-axis-chart" ? [half(at, place), half(rest)] : [place],
  );
  const result = element("div", { class: "card-result", hidden: true }, words, ...pictures);
  const asked = question({
    address: "warm-up",
    result,
    show: (found) => show(found),
    place: (faults) => placeFaults(editor, faults),
  });
  holder.replaceChildren(note, editor, asked.line, result);
  for (const place of places) watch(place);

  /** @type {Tables} */
  let tables = {};
  /** What the inputs show, as text. */
  let shown = "";
  /** @type {WarmUpAnswer | undefined} */
  let answer;
  let system = "";
  slider.addEventListener("input", () => {
    if (!answer) return;
    sayInstant(answer);
    charts.axis(answer.results, Number(slider.value));
  });

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
    note.textContent = text(moves ? "warm_up.of_motion" : "warm_up.of_point");
    if (keyOf() !== shown) {
      shown = keyOf();
      const isOpen = editor.querySelector("details")?.open ?? false;
      redraw(editor, ...inputs(isOpen));
      if (answer) showValues(editor, answer.inputs);
    }
    if (answer && system !== units.currentSystem()) show(answer);
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
    const first = fieldset(SECTION, text("section.surroundings"), FIRST, source);
    const more = opened(text("warm_up.more"), fieldset(SECTION, text("warm_up.more_title"), others, source));
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
        element("label", { for: id }, textOr(`warm_up.${name}`, name)),
        element("div", { class: "entry" }, input, element("span", { class: "unit" }, "h")),
        element("p", { class: "fault", id: `${id}-fault` }),
      );
    };
    const words = text("warm_up.with_band", { samples: SAMPLES });
    return framed(
      text("warm_up.duration"),
      element("div", { class: "grid" }, hours("hours", "--hours"), hours("rest", "--cool-down")),
      element(
        "p",
        { class: "band" },
        box(words, heat.band, (band) => changeHeat({ band }), { id: "warm-band" }),
      ),
    );
  }

  /** @param {WarmUpAnswer} found */
  function show(found) {
    const isFirst = !answer;
    answer = found;
    system = units.currentSystem();
    const { results, warnings, verdicts, band } = found;
    result.hidden = false;
    showValues(editor, found.inputs);
    const last = results.time.length - 1;
    slider.max = String(last);
    if (isFirst || Number(slider.value) > last) slider.value = String(results.works.lastIndexOf(true));
    sayInstant(found);
    words.replaceChildren(...lines(verdicts, warnings), steady(found), margin(found));
    charts.show(results, band, vocabulary, Number(slider.value));
    rest.replaceChildren(compensation(results), assumptions(found));
  }

  /** @param {WarmUpAnswer} found */
  function sayInstant({ results }) {
    slider.setAttribute("aria-valuetext", HOURS.text(results.time[Number(slider.value)]));
  }

  /** The state in which it ends, with its band. @param {WarmUpAnswer} found */
  function steady({ results, band }) {
    const end = /** @type {Record<string, any>} */ (results.equilibrium);
    const ends = /** @type {Record<string, any>} */ (band?.equilibrium ?? {});
    const known = STEADY.filter(([name]) => typeof end[name] === "number");
    const rows = known.map(([name, { text: inUnits, within }]) => {
      const meaning = charts.meaning(SERIES[name] ?? name, vocabulary);
      const found = within(end[name], ends[name]?.low, ends[name]?.high);
      const shown = data(name, end[name], found?.text ?? inUnits(end[name]));
      const interval = found ? text("warm_up.interval", { low: found.low, high: found.high }) : "";
      const beside = element("span", { class: "interval" }, interval);
      return element("div", {}, element("dt", {}, meaning), element("dd", {}, shown, beside));
    });
    return element("div", { class: "numbers" }, element("h3", {}, text("warm_up.ends")), element("dl", {}, ...rows));
  }

  /** How far the loop of heat is from running away. @param {WarmUpAnswer} found */
  function margin({ results: { equilibrium, stopped, heat } }) {
    const sentences = [text("warm_up.margin", { margin: units.digits(equilibrium.margin, units.DIGITS) })];
    if (stopped !== null) sentences.push(text("warm_up.stopped", { time: HOURS.text(stopped) }));
    const energy = quantity("J", "kJ");
    const { generated, stored, lost } = heat;
    sentences.push(
      text("warm_up.heat", { generated: energy.text(generated), stored: energy.text(stored), lost: energy.text(lost) }),
    );
    sentences.push(text("warm_up.growth_note"));
    return element("p", { class: "small" }, sentences.join(" "));
  }

  /** @param {WarmUpAnswer["results"]} results */
  function compensation({ compensation: found }) {
    const { place, growth } = /** @type {{ place: number[], growth: (number | null)[] }} */ (found);
    const { text: inPlace } = quantity("m", "mm");
    const rows = place.map((one, row) => [inPlace(one), GROWTH.text(growth[row])]);
    const content = table(text("warm_up.compensation_caption"), [text("warm_up.place"), text("warm_up.growth")], rows);
    return opened(text("warm_up.compensation"), content);
  }

  /** @param {WarmUpAnswer} found */
  function assumptions({ assumed }) {
    const list = element("ul", {}, ...assumed.map((one) => element("li", {}, one)));
    return opened(text("warm_up.assumed"), list);
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
