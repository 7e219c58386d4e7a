// Files to save: the case, the answer, the curve, the drawing, the report.

import { byId, csv, element, save } from "./dom.js";
import { linesOf, send } from "./server.js";

/** Kinds of files: what they are, and the address that makes them, if any. @type {Record<string, [string, string?]>} */
const KINDS = {
  TOML: ["case file for the command line", "toml"],
  JSON: ["all results in SI"],
  CSV: ["torque and its parts over speed"],
  SVG: ["drawing of the ball", "drawing"],
  PDF: ["report to file", "report?kind=pdf"],
  HTML: ["report to read", "report?kind=html"],
};

/** @typedef {{ body?: object, answer?: Run, alongSpeed?: Sweep }} Current */

/**
 * Buttons for all kinds; ``current`` gives the case and the answer.
 *
 * @param {() => Current} current
 */
export function build(current) {
  const buttons = Object.entries(KINDS).map(([kind, [words]]) =>
    element(
      "button",
      { type: "button", title: words, "aria-label": `${kind}: ${words}`, onclick: () => saveAs(kind, current()) },
      kind,
    ),
  );
  byId("downloads").replaceChildren(...buttons);
}

/** @param {string} text */
function say(text) {
  byId("download-words").textContent = text;
}

/**
 * @param {string} kind
 * @param {Current} current
 */
async function saveAs(kind, { body, answer, alongSpeed }) {
  if (!body || !answer || byId("results").classList.contains("stale")) {
    say("The input is at fault: correct it first.");
    return;
  }
  const [, address] = KINDS[kind];
  try {
    if (address) {
      say(`making the ${kind} …`);
      save(`.${kind.toLowerCase()}`, await (await send(address, body)).blob());
    } else if (kind === "JSON") {
      const { words, display, ...document } = answer;
      save(".json", new Blob([JSON.stringify(document, null, 2)], { type: "application/json" }));
    } else if (alongSpeed) saveTorqueCsv(alongSpeed);
    say(`${kind} saved`);
  } catch (error) {
    say(linesOf(error).join("; "));
  }
}

/**
 * Save torque and its parts over speed, in SI.
 *
 * @param {Sweep} alongSpeed
 */
function saveTorqueCsv({ axes, outputs }) {
  const columns = Object.entries(outputs);
  const headings = ["screw_speed [rad/s]", ...columns.map(([name, { unit }]) => `${name} [${unit}]`)];
  const rows = axes.screw_speed.values.map((speed, place) => [
    speed,
    ...columns.map(([, { values }]) => values[place]),
  ]);
  const content = csv(headings, /** @type {import("./dom.js").Cell[][]} */ (rows));
  save("-torque_over_speed.csv", new Blob([content], { type: "text/csv" }));
}
