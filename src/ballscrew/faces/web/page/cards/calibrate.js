// The card of a calibration: a log, what its columns were taken for, the fit, and the case with what was found.

import * as designs from "../designs.js";
import { namedButton, primaryButton } from "../controls.js";
import { element, redraw, scrollingTable } from "../dom.js";
import { watch } from "../plot.js";
import { save } from "../saving.js";
import { linesOf, Problem } from "../server.js";
import { askPatiently, sendPatiently } from "../long_work.js";
import { text } from "../texts.js";
import * as units from "../units.js";
import { vocabulary } from "../vocabulary.js";
import * as charts from "./calibrate_charts.js";
import { choices, columns, meaningOf } from "./log_columns.js";
import { caseFile, commandLine, dropZone, exampleButton, faultLines } from "./log_parts.js";
import { flags, optionFields } from "./option_fields.js";
import { quantity, TORQUE } from "./quantities.js";
import { question } from "./question.js";
import { lines } from "./records.js";

/** Numbers of a sensor that the table leaves out: how its zero wanders over hours. */
const WANDER = "torque_wander";
const DIGITS = 4;
/** Milliseconds after the last key until the server is asked about a log, which may be long. */
const REST = 400;
/** Options that have a place of their own. */
const OF_COLUMNS = ["free", "columns"];
/** Sections that a calibration changes. */
const CHANGED = ["model", "lubricant", "screw", "nut", "losses", "calibration"];

/**
 * @param {HTMLElement} holder
 * @returns {import("../cards.js").Card}
 */
export function setUp(holder) {
  /** @type {import("./log_parts.js").SentFile | undefined} */
  let log;
  /** Columns given by hand. @type {Record<string, string>} */
  let given = {};
  /** @type {string[]} */
  let free = [];
  /** @type {LogAnswer | undefined} */
  let seen;
  /** What may be fitted to the log. @type {LogAnswer["free"]} */
  let known = [];
  /** @type {FitAnswer | undefined} */
  let answer;
  /** @type {import("../state.js").Tables} */
  let tables = {};
  /** What the columns were asked with, as text. */
  let asked = "";
  let system = "";
  /**
   * Whether what is said beside the button is no longer so of a design: that it was given a calibration which is gone,
   * or that it is another one than was fitted. @type {(design: import("../state.js").Tables) => boolean}
   */
  let isPast = () => false;
  /** The case of the fit that is shown. @type {import("../state.js").Tables} */
  let fittedCase = {};
  /** @type {ReturnType<typeof setTimeout> | undefined} */
  let timer;

  const options = vocabulary.options.fit.filter(({ name }) => !OF_COLUMNS.includes(name));
  /** What is given of them. @type {import("./option_fields.js").Given} */
  const chosen = {};
  const more = optionFields("fit", options, chosen, () => {
    showCommand();
    fit.compare(body());
  });
  const command = element("div");
  const inspected = element("div", { class: "card-inputs" });
  const problems = element("div");
  const words = element("div");
  const rest = element("div");
  const places = charts.PLACES.map((id) => element("div", { id, class: "chart low", hidden: true }));
  const result = element("div", { class: "card-result" }, words, ...places, rest);
  const fit = question({
    address: "fit",
    result,
    show: (found) => show(found),
    place: (faults) => {
      problems.replaceChildren(...faultLines(faults));
      result.hidden = faults.length > 0; // what another log told is no answer below a fault
      return undefined;
    },
    isLarge: () => true,
    about: () => ({ fitted: fittedCase, free: known }),
  });
  const drop = dropZone("calibrate-log", text("calibrate.drop"), (file) => {
    log = file;
    given = {};
    free = [];
    inspect();
  });
  const example = exampleButton("fit", (logs, numbers) => {
    drop.use(logs[0]);
    free = numbers; // the log has friction that the balls alone do not explain
  });
  holder.replaceChildren(drop.zone, example, inspected, fit.line, problems, result);
  for (const place of places) watch(place);
  fit.resume((about) => {
    fittedCase = about.fitted;
    known = about.free;
  });

  function body() {
    return { case: tables, log, columns: given, free, ...chosen };
  }

  /** Ask what the columns of the log are taken for. */
  async function inspect() {
    if (!log) return;
    tables = await designs.currentCase();
    const used = document.getElementById("calibrate-used");
    if (used?.textContent && isPast(tables)) used.textContent = "";
    const question = { case: tables, log, columns: given };
    const key = JSON.stringify(question);
    if (key === asked) return;
    asked = key;
    try {
      /** @type {LogAnswer} */
      const found = await sendPatiently("log", question);
      if (asked !== key) return;
      seen = found;
      known = found.free;
      if (!free.length) free = [found.free[0].name];
      problems.replaceChildren();
      showColumns();
    } catch (error) {
      if (asked !== key) return;
      asked = "";
      seen = undefined;
      const faults = error instanceof Problem ? error.faults : [];
      inspected.replaceChildren(
        ...(faults.length ? faultLines(faults) : [element("p", { class: "warning" }, linesOf(error).join("; "))]),
      );
    }
    fit.compare(body());
  }

  function showColumns() {
    if (!seen || !log) return;
    const isReady = !seen.moving && !seen.faults.length;
    const start = primaryButton("calibrate-fit", "calibrate.fit", () => {
      fittedCase = tables;
      fit.follow(body(), 0);
    });
    start.disabled = !isReady;
    redraw(
      inspected,
      columns(seen, given, (changed) => {
        given = changed;
        inspect();
      }),
      choices(seen.free, free, (names) => {
        free = names;
        showColumns();
        fit.compare(body());
      }),
      more,
      element("p", { class: "card-start" }, start),
      command,
    );
    showCommand();
  }

  function showCommand() {
    const column = Object.entries(given).flatMap(([name, heading]) => ["--column", `${name}=${heading}`]);
    const others = [...column, ...flags(options, chosen)];
    const words = ["ballscrew", "fit", log?.name ?? "", "--case", caseFile(), "--free", free.join(","), ...others];
    command.replaceChildren(commandLine(words));
  }

  /** @param {FitAnswer} found */
  function show(found) {
    answer = found;
    system = units.currentSystem();
    const { rows, words: texts } = found;
    words.replaceChildren(
      ...lines(found.verdicts, []),
      element("p", {}, text("calibrate.rows", { used: rows.used, read: rows.read, held: rows.held_out })),
      element("p", { class: "small" }, texts.rows.join("; ")),
      estimates(found),
      ...lines([], found.warnings),
      element("p", {}, texts.trade_off),
      ...(texts.next_test.length ? [element("h3", {}, text("calibrate.next"))] : []),
      ...texts.next_test.map((line) => element("p", {}, line)),
    );
    charts.show(found);
    const untold = Object.entries(found.estimates)
      .filter(([, one]) => !one.identified)
      .map(([name]) => meaningOf(name, known));
    const used = element("p", { id: "calibrate-used", role: "status" });
    rest.replaceChildren(
      ...(untold.length
        ? [element("p", { class: "warning" }, text("calibrate.untold", { names: untold.join(", ") }))]
        : []),
      element(
        "p",
        { class: "card-start" },
        namedButton("calibrate-use", "calibrate.use", async () => {
          const design = await designs.currentCase();
          if (ofFit(design) !== ofFit(fittedCase) && ofFit(design) !== ofFit(found.calibrated.case)) {
            isPast = (now) => ofFit(now) !== ofFit(design);
            used.textContent = text("calibrate.other");
            return;
          }
          const before = await torqueOf(design);
          await use(found);
          const after = await designs.currentCase();
          isPast = (now) => JSON.stringify(now.calibration) !== JSON.stringify(after.calibration);
          used.textContent = [text("calibrate.used"), await change(before, await torqueOf(after))].join(" ").trim();
        }),
        namedButton("calibrate-save", "calibrate.save", () =>
          save("-calibrated.toml", new Blob([found.calibrated.toml], { type: "application/toml" })),
        ),
      ),
      used,
    );
  }

  /** The sections of a case that a fit starts from, as text. @param {import("../state.js").Tables} tables */
  function ofFit(tables) {
    return JSON.stringify(CHANGED.filter((name) => name !== "calibration").map((name) => tables[name] ?? {}));
  }

  /** The friction torque of a case; null of one at fault. @param {import("../state.js").Tables} tables */
  async function torqueOf(tables) {
    try {
      const found = await askPatiently("run", { case: tables }, new AbortController().signal);
      return found.results.screw_torque;
    } catch {
      return null;
    }
  }

  /** @param {number | null} before @param {number | null} after */
  function change(before, after) {
    if (before === null || after === null) return "";
    return text("calibrate.change", { before: TORQUE.text(before), after: TORQUE.text(after) });
  }

  /** Put what was found into the design; the button Undo takes it back. @param {FitAnswer} found */
  async function use({ calibrated }) {
    /** @type {import("../state.js").Tables} */
    const fitted = calibrated.case;
    const before = await designs.currentCase();
    const isNew = (/** @type {string} */ name) => JSON.stringify(fitted[name]) !== JSON.stringify(before[name]);
    const changed = CHANGED.filter((name) => name in fitted && isNew(name));
    await designs.setTables(Object.fromEntries(changed.map((name) => [name, fitted[name]])));
  }

  /** Values before and after, with their intervals. @param {FitAnswer} found */
  function estimates({ estimates: numbers, sensor, residual_rms: rms, holdout_rms: held }) {
    const shown = Object.entries({ ...numbers, ...sensor }).filter(([name]) => !name.startsWith(WANDER));
    const rows = shown.map(([name, one]) => {
      const { text: written } = quantity(one.unit, metricOf(name, one.unit));
      const ends = `${written(one.low, DIGITS)} – ${written(one.high, DIGITS)}`;
      return [
        meaningOf(name, known),
        written(one.start, DIGITS),
        element("data", { value: String(one.value), "data-name": name }, written(one.value, DIGITS)),
        one.identified && one.low !== null ? ends : text("calibrate.not_told"),
      ];
    });
    const caption = text("calibrate.values", { rms: TORQUE.text(rms), held: TORQUE.text(held) });
    const headings = ["", text("calibrate.before"), text("calibrate.after"), text("calibrate.interval")];
    return scrollingTable(caption, headings, rows);
  }

  /** @param {string} name @param {string} si */
  function metricOf(name, si) {
    return known.find((one) => one.name === name)?.shown_in ?? si;
  }

  function follow() {
    if (answer && system !== units.currentSystem()) show(answer);
    clearTimeout(timer);
    timer = setTimeout(inspect, REST);
  }

  return { follow };
}
