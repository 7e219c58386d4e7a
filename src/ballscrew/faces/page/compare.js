// Designs side by side.

import { operationOf } from "./chart_parts.js";
import { wordsOf } from "./charts.js";
import { verdict } from "./checks.js";
import { byId, element, scrolling, table } from "./dom.js";
import { labelOf } from "./messages.js";
import { words } from "./fields.js";
import { data, greatestPressure, leastFilm, nameOf, numbersOf, rounded } from "./results.js";
import { OF_CARDS, SECTIONS } from "./schema.js";
import { draw } from "./sheet_charts.js";
import { LETTERS } from "./state.js";
import { store } from "./store.js";
import { RESULTS } from "./names.js";
import * as units from "./units.js";
import { vocabulary } from "./vocabulary.js";

const ROWS = /** @type {const} */ ([
  "screw_torque",
  "drive_torque",
  "efficiency",
  "back_driving_efficiency",
  "holding_torque",
  "friction_power",
  "preload_drag",
]);

/**
 * What is known of a design: its answer, its checks and its band, or the line that says why there is none.
 *
 * @typedef {{ run?: Run, checks?: Checks, band?: BandAnswer, reason?: string }} Known
 */
/** By letter. @typedef {Record<string, Known>} Answers */

/** @param {string[]} names */
function joined(names) {
  return [...new Set(names)].join(", ") || "–";
}

/** The names of the warnings of an answer that are no verdict of it as well. @param {Run | undefined} run */
function beside(run) {
  const said = new Set(run?.verdicts.map(nameOf));
  return (run?.warnings ?? []).map(nameOf).filter((name) => !said.has(name));
}

/**
 * The change of a result against that of the first design, in percent.
 *
 * @param {number | null | undefined} value
 * @param {number | null | undefined} first
 */
function delta(value, first) {
  if (typeof value !== "number" || typeof first !== "number" || first === 0) return null;
  const change = value / first - 1;
  return element(
    "span",
    { class: "delta" },
    change ? `${change > 0 ? "+" : ""}${units.digits(100 * change, 3)} %` : "±0 %",
  );
}

/**
 * A table of all designs, and their torques as bars.
 *
 * @param {Answers} answers
 * @param {string[]} starts
 * @param {Mechanisms} mechanisms
 */
export function showDesigns(answers, starts, mechanisms) {
  const place = byId("compare");
  const letters = Object.keys(answers);
  byId("compare-at").hidden = letters.length < 2;
  if (letters.length < 2) {
    place.replaceChildren(element("p", {}, `Add a design above: up to ${LETTERS.length} are shown here side by side.`));
    byId("compare-chart").hidden = true;
    return;
  }
  /**
   * @param {string} words
   * @param {(run: Run, known: Known, isFirst: boolean) => import("./dom.js").Child} read
   */
  const row = (words, read) => [
    words,
    ...letters.map((letter, at) => {
      const { run } = answers[letter];
      return run ? read(run, answers[letter], at === 0) : "–";
    }),
  ];
  const first = answers[letters[0]].run;
  const runs = letters.flatMap((letter) => answers[letter].run ?? []);
  /** @param {string} name */
  const isKnown = (name) => runs.some((run) => numbersOf(run)[name] !== undefined);
  /** @param {string} name */
  const cell = (name) => (/** @type {Run} */ run, /** @type {Known} */ known, /** @type {boolean} */ isFirst) => {
    const value = numbersOf(run)[name];
    const change = isFirst || !first ? null : delta(value, numbersOf(first)[name]);
    return element("span", {}, data(name, value, rounded(name, value, known.band).text), change);
  };
  const rows = [
    ["start", ...starts],
    ["changed", ...letters.map((letter) => changesOf(LETTERS.indexOf(letter)))],
    row("case", (run) => run.words.title),
    ...ROWS.filter(isKnown).map((name) => row(RESULTS[name], cell(name))),
    row("band of the friction torque, 95 %", (run, { band }) => {
      return rounded("screw_torque", run.results.screw_torque, band).interval ?? "–";
    }),
    row("least λ", (run) => units.digits(leastFilm(run))),
    row("greatest pressure", (run) => units.formatted("maximum_pressure", greatestPressure(run))),
    row("checks at this load and speed, held constant", (_, { checks }) => (checks ? verdict(checks) : "–")),
    row("verdict", (run) => joined(run.verdicts.map(nameOf))),
    ["beware", ...letters.map((letter) => answers[letter].reason ?? joined(beside(answers[letter].run)))],
  ];
  const headings = ["", ...letters.map((letter) => `Design ${letter}`)];
  const caption = `designs side by side ${conditions(runs)}; changes are against Design ${letters[0]}`;
  place.replaceChildren(scrolling("table of the designs", table(caption, headings, rows)));
  byId("compare-chart").hidden = !runs.length;
  if (runs.length) draw("compare-chart", bars(answers, mechanisms));
}

/** The parts of the torque of each design as a bar. @param {Answers} answers @param {Mechanisms} mechanisms */
function bars(answers, mechanisms) {
  const all = Object.entries(answers).flatMap(([letter, { run }]) =>
    run ? [{ letter, parts: run.results.contributions }] : [],
  );
  const names = new Set(all.flatMap(({ parts }) => Object.keys(parts).filter((name) => parts[name])));
  return {
    kind: "bars",
    title: "friction torque of the designs by mechanism",
    quantity: vocabulary.results.screw_torque,
    origin: 0,
    marks: [],
    bars: all.map(({ letter, parts }) => ({
      name: letter,
      parts: [...names].map((name) => [
        wordsOf(name, mechanisms),
        parts[name] ?? 0,
        mechanisms[name]?.colour ?? "grey",
      ]),
      band: null,
      text: "",
      hatched: false,
      start: null,
    })),
  };
}

/**
 * What was changed of a design against its start; load and speed of its own do not count where all have those of the first.
 *
 * @param {number} place
 */
function changesOf(place) {
  const { designs: all, own } = store.state;
  const { changes = {}, tables: sections = {} } = all[place] ?? {};
  const ofFields = Object.entries(changes).map(([path, value]) => {
    const change = `${labelOf(path)}: ${value === "" ? "not given" : value}`;
    const counts = own || place === 0 || !path.startsWith("operation.");
    return counts ? change : `${change} (does not count here)`;
  });
  const ofTables = Object.keys(sections).map((name) => SECTIONS[name] ?? OF_CARDS[name] ?? words(name));
  return element("span", { class: "changes" }, [...ofFields, ...ofTables].join("; ") || "–");
}

/**
 * Where the designs are compared: at one speed of the screw, or of the nut where their leads differ.
 *
 * @param {Run[]} runs
 */
function conditions(runs) {
  const [first] = runs;
  const own = /** @type {HTMLInputElement} */ (byId("own")).checked;
  const { axial_load: load, screw_speed: speed } = /** @type {Record<string, number>} */ (
    first?.inputs.operation ?? {}
  );
  if (own || load === undefined) return "each at its own load and speed";
  const isSame = runs.every((run) => operationOf(run).screw_speed === speed);
  return `all at ${units.formatted("axial_load", load)} and ${isSame ? units.formatted("screw_speed", speed) : units.formattedIn(alongOf(first), "m/min", "m/s")}`;
}

/** The speed of the nut in m/s: one turn is one lead. @param {Run} run */
function alongOf(run) {
  const { lead } = /** @type {{ lead: number }} */ (run.inputs.screw);
  return (operationOf(run).screw_speed * lead) / (2 * Math.PI);
}
