// The card of a duty: a cycle of the axis, what it asks of the motor, what happens without, and what it costs.

import * as checks from "../checks.js";
import * as designs from "../designs.js";
import { button, labelled, menu, opened } from "../controls.js";
import { element, redraw, scrollingTable } from "../dom.js";
import { isSmall, sent, tooLarge } from "../opening.js";
import { watch } from "../plot.js";
import * as schema from "../schema.js";
import * as states from "../state.js";
import { store } from "../store.js";
import { text, textOr } from "../texts.js";
import * as units from "../units.js";
import { inPanes } from "../views.js";
import { vocabulary } from "../vocabulary.js";
import { placeFaults, showValues } from "./case_fields.js";
import * as charts from "./duty_charts.js";
import { inputs } from "./motion.js";
import { data, ENERGY, FORCE, POWER, quantity, SPEED, TEMPERATURE, TIME, TORQUE } from "./quantities.js";
import { question } from "./question.js";
import { lines } from "./records.js";

/** @typedef {import("../state.js").Tables} Tables */

/** The example whose motion is shown where a design has none. */
const EXAMPLE = "vertical-axis";
/** Sections that an example gives; those beside the first two may be missing. */
const OF_EXAMPLE = ["axis", "motion", "motor", "bearings", "guides"];
/** A share of a column, or a number in SI, that is rounding. */
const ROUNDING = 1e-9;
/**
 * @param {HTMLElement} holder
 * @returns {import("../cards.js").Card}
 */
export function setUp(holder) {
  const note = element("p", { class: "small" });
  const editor = element("div", { class: "card-inputs" });
  const words = inPanes(element("div"), "duty.answer");
  const limits = inPanes(element("div"), "duty.limits");
  const parts = inPanes(element("div"), "duty.parts");
  const phasesOf = inPanes(element("div", { class: "half" }), "duty.time");
  const places = charts.PLACES.map((id) =>
    inPanes(element("div", { id, class: "chart low", hidden: true }), "duty.time"),
  );
  const result = element("div", { class: "card-result" }, words, limits, ...places, phasesOf, parts);
  const asked = question({
    address: "duty",
    result,
    show: (found) => show(found),
    place: (faults) => placeFaults(editor, faults),
    isLarge: (body) => "trace" in body,
  });
  const recorded = element("p", { class: "card-start" });
  const begin = inPanes(element("div", {}, examples(vocabulary.starts), recorded, note), "duty.motion");
  holder.replaceChildren(begin, editor, asked.line, result);
  for (const place of places) watch(place);

  /** Sections of the case, with those of the example where it has none. @type {Tables} */
  let tables = {};
  let isExample = false;
  /** What the inputs show, as text. */
  let shown = "";
  /** A recorded motion, which is no part of the design. @type {{ name: string, base64: string } | undefined} */
  let trace;
  /** @type {DutyAnswer | undefined} */
  let answer;
  let system = "";

  /** @param {Tables} found */
  function keyOf(found) {
    const { fields, show: design } = store.state;
    return JSON.stringify([found.axis, found.motion, found.motor, fields, design, units.currentSystem()]);
  }

  /** @type {import("./motion.js").Put} */
  function put(sections, { path, isAnew = false, id }) {
    tables = { ...tables, ...sections };
    // what was typed stands in its field; other changes are shown when the state is followed
    shown = isAnew ? "" : keyOf(tables);
    const given = isExample
      ? Object.fromEntries(["axis", "motion", "motor"].map((name) => [name, tables[name] ?? null]))
      : sections;
    designs.setTables(given, path).then(() => {
      if (isAnew && id) document.getElementById(id)?.focus();
    });
  }

  /** @param {import("../fields.js").Change} change */
  function onChange({ path = "", text: typed = "", unit }) {
    if (unit !== undefined) {
      designs.chooseUnit(path, unit);
      return;
    }
    const [section] = path.split(".");
    const found = states.tables(tables, { [path]: typed }, schema.fieldOf);
    put({ [section]: found[section] ?? {} }, { path });
  }

  async function follow() {
    const design = designs.current();
    const found = await designs.currentCase();
    if (design !== designs.current()) return; // another one was chosen in the meantime, and is followed on its own
    isExample = !found.motion || !found.axis;
    const example = vocabulary.starts[EXAMPLE].case;
    tables = isExample ? { ...found, axis: example.axis, motion: example.motion, motor: example.motor } : found;
    note.textContent = isExample ? text("duty.example") : otherParts();
    if (keyOf(tables) !== shown) {
      shown = keyOf(tables);
      const usual = /** @type {Tables} */ (example.motor);
      const [motion, ...others] = inputs(() => tables, store.state, vocabulary.motions, usual, { put, onChange });
      redraw(editor, inPanes(motion, "duty.motion"), ...others.map((one) => inPanes(one, "duty.axis")));
      if (answer) showValues(editor, answer.inputs);
    }
    if (answer && system !== units.currentSystem()) show(answer);
    asked.follow(trace ? { case: tables, trace } : { case: tables });
  }

  /**
   * Take a recorded motion in place of that of the design, or none.
   *
   * @param {File | undefined} file
   */
  async function take(file) {
    trace = undefined;
    const isTaken = file && isSmall(file);
    if (isTaken) trace = await sent(file);
    showRecorded(file && !isTaken ? tooLarge(file) : "");
    await follow();
  }

  /** @param {string} fault */
  function showRecorded(fault) {
    const input = element("input", {
      type: "file",
      id: "duty-trace",
      hidden: true,
      accept: ".csv,.txt,.tsv,.xlsx,.ods",
    });
    input.addEventListener("change", () => take(input.files?.[0]));
    const label = `${text("log.choose")}: ${text("duty.trace")}`;
    const choose = button(text("log.choose"), () => input.click(), { id: "duty-trace-choose", "aria-label": label });
    const remove = () => take(undefined).then(() => document.getElementById("duty-trace-choose")?.focus());
    const words = trace ? text("duty.recorded", { file: trace.name }) : fault;
    recorded.replaceChildren(
      element("span", {}, text("duty.trace")),
      choose,
      input,
      element("span", { class: fault ? "fault" : "small", role: "status" }, words),
      ...(trace ? [button(text("duty.no_trace"), remove, { id: "duty-trace-remove" })] : []),
    );
  }

  holder.addEventListener("drop", (event) => {
    event.preventDefault(); // the page does not open it as a case
    take(event.dataTransfer?.files[0]);
  });
  showRecorded("");

  /** How a recorded motion was smoothed. @param {DutyAnswer["results"]} results */
  function smoothing(results) {
    const found = /** @type {Record<string, any>} */ (results).smoothing;
    if (!found) return [];
    const { samples, torque_rms_unsmoothed: rms } = found;
    return [element("p", { class: "small" }, text("duty.smoothed", { samples, rms: TORQUE.text(rms) }))];
  }

  /** That bearings and guides of the case count, which are not shown here. */
  function otherParts() {
    return tables.bearings || tables.guides ? text("duty.elements") : "";
  }

  /** @param {Vocabulary["starts"]} starts */
  function examples(starts) {
    const moving = Object.entries(starts).filter(([, { moves }]) => moves);
    const select = menu(
      moving.map(([name, { title }]) => [name, title]),
      "",
      () => {},
      { id: "duty-example" },
    );
    const take = () => {
      const example = /** @type {Tables} */ (starts[select.value].case);
      shown = "";
      designs.setTables(Object.fromEntries(OF_EXAMPLE.map((name) => [name, example[name] ?? null])));
    };
    return labelled(select, text("duty.from_example"), button(text("duty.take"), take, { id: "duty-take" }));
  }

  /** @param {DutyAnswer} found */
  function show(found) {
    answer = found;
    system = units.currentSystem();
    const { results, warnings, verdicts } = found;
    showValues(editor, found.inputs);
    words.replaceChildren(
      ...lines(
        verdicts.filter((one) => one.id !== "verdict.checks"),
        warnings,
      ),
      numbers(results),
      ...smoothing(results),
    );
    limits.replaceChildren(...checks.panel(checks.ofCycle(found), text("duty.checks_caption")));
    charts.show(results, vocabulary.causes);
    phasesOf.replaceChildren(phases(results));
    parts.replaceChildren(partsOf(results), brake(results));
  }

  /** @param {DutyAnswer["results"]} results */
  function numbers(results) {
    const values = /** @type {Record<string, any>} */ (results);
    const least = ROUNDING * (results.energy_drawn ?? 0);
    const shown = Object.entries(vocabulary.of_cycle).filter(
      ([name, of]) => !of.if_any || Math.abs(values[name]) > least,
    );
    const rows = shown.map(([name, of]) => {
      const inUnits = units.withPowers(quantity(of.unit, of.shown_in).text(values[name]));
      return element("div", {}, element("dt", {}, of.meaning), element("dd", {}, data(name, values[name], inUnits)));
    });
    return element("div", { class: "numbers" }, element("dl", {}, ...rows));
  }

  /** Torque and energy by cause: each part of its torque and of the energy, and their sums. @param {DutyAnswer["results"]} results */
  function partsOf(results) {
    const { torque_peak_by: peak, torque_rms_by: rms, energy_by: energy } = results;
    const names = Object.keys(energy).filter((name) =>
      [peak, rms, energy].some((one) => Math.abs(one[name] ?? 0) > ROUNDING),
    );
    /** @param {string} name */
    const meaning = (name) => vocabulary.mechanisms[name]?.words ?? name.replaceAll("_", " ");
    /** @param {Record<string, number | null>} column */
    const sum = (column) => Object.values(column).reduce((/** @type {number} */ found, one) => found + (one ?? 0), 0);
    /** What is rounding is nothing. @param {Record<string, number | null>} column @param {string} name */
    const of = (column, name) => {
      const largest = Math.max(...Object.values(column).map((one) => Math.abs(one ?? 0)));
      return Math.abs(column[name] ?? 0) > ROUNDING * largest ? column[name] : 0;
    };
    const rows = [
      ...names.map((name) => [
        meaning(name),
        TORQUE.text(of(peak, name)),
        TORQUE.text(of(rms, name)),
        ENERGY.text(of(energy, name)),
      ]),
      [
        element("strong", {}, text("duty.sum")),
        TORQUE.text(sum(peak)),
        TORQUE.text(sum(rms)),
        ENERGY.text(sum(energy)),
      ],
    ];
    const headings = [text("duty.part"), text("duty.of_peak"), text("duty.of_rms"), text("duty.of_energy")];
    return scrollingTable(text("duty.parts_caption"), headings, rows);
  }

  /** What the axis does with its motor off. @param {DutyAnswer["results"]} results */
  function brake({ brake: { conditions, brake_torque: torque } }) {
    const rows = /** @type {Record<string, any>[]} */ (conditions).map((one) => [
      textOr(`duty.condition.${one.condition}`, one.condition),
      TEMPERATURE.text(one.temperature),
      text(one.falls ? "duty.falls" : one.goes_on ? "duty.goes_on" : "duty.stays"),
      TORQUE.text(one.load_torque),
      TORQUE.text(one.breakaway_torque),
      one.falls || one.goes_on ? SPEED.text(one.speed_after_stroke) : "–",
      TORQUE.text(one.holding_torque),
    ]);
    const headings = ["condition", "oil", "axis", "load", "breakaway", "speed_after", "holding"].map((name) =>
      textOr(`duty.off.${name}`, name),
    );
    const caption = text("duty.brake_caption", { torque: TORQUE.text(torque) });
    const note = element("p", { class: "small" }, text("duty.brake_note"));
    return element("div", {}, scrollingTable(caption, headings, rows), note);
  }

  /** @param {DutyAnswer["results"]} results */
  function phases(results) {
    const rows = /** @type {Record<string, any>[]} */ (results.phases).map((one) => [
      one.name,
      TIME.text(one.start),
      TIME.text(one.duration),
      FORCE.text(one.largest_load),
      TORQUE.text(one.torque_peak),
      TORQUE.text(one.torque_rms),
      ENERGY.text(one.energy),
    ]);
    const headings = ["name", "start", "duration", "load", "peak", "rms", "energy"].map((name) =>
      textOr(`duty.phase.${name}`, name),
    );
    const heat = Object.entries(results.heat_by_element).map(
      ([name, power]) => `${name.replaceAll("_", " ")} ${POWER.text(power)}`,
    );
    return element(
      "div",
      {},
      element("p", { class: "small" }, text("duty.heat", { parts: heat.join(", ") })),
      opened(text("duty.phases"), scrollingTable(text("duty.phases_caption"), headings, rows)),
    );
  }

  return { follow };
}
