// The card of a calibration: a log, what its columns were taken for, the fit, and the case with what was found.

import * as designs from "../designs.js";
import { namedButton, primaryButton } from "../controls.js";
import { element, redraw } from "../dom.js";
import { save } from "../saving.js";
import { linesOf, Problem } from "../server.js";
import { askPatiently, sendPatiently } from "../long_work.js";
import * as units from "../units.js";
import { vocabulary } from "../vocabulary.js";
import { choices, columns } from "./log_columns.js";
import { caseFile, commandLine, dropZone, exampleButton, faultLines } from "./log_parts.js";
import { flags, optionFields } from "./option_fields.js";
import { question } from "./question.js";

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
  /** @type {import("../state.js").Tables} */
  let tables = {};
  /** What the columns were asked with, as text. */
  let asked = "";
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
  const actions = element("div");
  const fit = question({
    address: "fit",
    show: (found) => showActions(found),
    place: (faults) => {
      problems.replaceChildren(...faultLines(faults));
      for (const one of [fit.result, actions]) one.hidden = faults.length > 0; // what another log told is no answer below a fault
      return undefined;
    },
    isLarge: () => true,
    about: () => ({ fitted: fittedCase }),
  });
  const drop = dropZone("calibrate-log", "Drop a log here, or choose one (CSV, XLSX, MAT)", (file) => {
    log = file;
    given = {};
    free = [];
    inspect();
  });
  const example = exampleButton("fit", (logs, numbers) => {
    drop.use(logs[0]);
    free = numbers; // the log has friction that the balls alone do not explain
  });
  holder.replaceChildren(fit.head, drop.zone, example, inspected, fit.line, problems, actions, fit.result);
  fit.resume((about) => {
    fittedCase = about.fitted;
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
    const start = primaryButton("calibrate-fit", "Fit", () => {
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

  /** What may be done with the numbers that were found. @param {FitAnswer} found */
  function showActions(found) {
    const used = element("p", { id: "calibrate-used", role: "status" });
    actions.hidden = false;
    actions.replaceChildren(
      element(
        "p",
        { class: "card-start" },
        namedButton("calibrate-use", "Use this calibration", async () => {
          const design = await designs.currentCase();
          if (ofFit(design) !== ofFit(fittedCase) && ofFit(design) !== ofFit(found.calibrated.case)) {
            isPast = (now) => ofFit(now) !== ofFit(design);
            used.textContent = "The design has changed since the fit: fit again, then use the result.";
            return;
          }
          const before = await torqueOf(design);
          await use(found);
          const after = await designs.currentCase();
          isPast = (now) => JSON.stringify(now.calibration) !== JSON.stringify(after.calibration);
          used.textContent = [
            "The design has these numbers now; Undo takes them back.",
            await change(before, await torqueOf(after)),
          ]
            .join(" ")
            .trim();
        }),
        namedButton("calibrate-save", "Save as case file", () =>
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
    const [from, to] = [before, after].map((torque) => units.formatted("screw_torque", torque));
    return `Friction torque at its operating point: ${from} → ${to}.`;
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

  function follow() {
    fit.showAgain();
    clearTimeout(timer);
    timer = setTimeout(inspect, REST);
  }

  return { follow };
}
