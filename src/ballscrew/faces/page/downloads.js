// Files to save: the case, the answer, the curve, the drawing, the report.

import { answers } from "./answers.js";
import * as designs from "./designs.js";
import { byId, csv, element } from "./dom.js";
import { runJob } from "./jobs.js";
import { save } from "./saving.js";
import { connection, linesOf, send } from "./server.js";

/** Kinds of files: what they are, and the address that makes them, if any. @type {Record<string, [string, string?]>} */
const KINDS = {
  TOML: ["case file for the command line", "toml"],
  JSON: ["all results in SI"],
  CSV: ["torque and its parts over speed"],
  SVG: ["drawing of the ball", "drawing"],
  PDF: ["report to file", "report?kind=pdf"],
  HTML: ["report to read", "report?kind=html"],
};

/** Of what a kind of file is being made, and what cancels that. @typedef {{ key: string, request: AbortController }} Making */

/** Buttons for all kinds. */
export function build() {
  /** @type {Map<string, Making>} */
  const making = new Map();
  const buttons = Object.entries(KINDS).map(([kind, [words, address]]) => {
    const onclick = () => saveAs(kind, making);
    const marks = {
      title: words,
      "aria-label": `${kind}: ${words}`,
      class: address?.startsWith("report") && "of-server",
    };
    return element("button", { type: "button", ...marks, onclick }, kind);
  });
  byId("downloads").replaceChildren(...buttons);
}

/** @param {string} words */
function say(words) {
  byId("download-words").textContent = words;
}

/**
 * @param {string} kind
 * @param {Map<string, Making>} making
 */
async function saveAs(kind, making) {
  const { whole, answer, curves } = answers.current();
  if (!whole || !answer || byId("results").classList.contains("stale")) {
    say(
      connection.isSilent
        ? "The server, which makes the files, does not answer. Try again once it runs."
        : "The input is at fault: correct it first.",
    );
    return;
  }
  const [, address] = KINDS[kind];
  try {
    if (address) {
      if (!(await saveMade(kind, address, bodyOf(address, whole), making))) return;
    } else if (kind === "JSON") {
      const { words, display, ...document } = await (await send("run", whole)).json();
      save(".json", new Blob([JSON.stringify(document, null, 2)], { type: "application/json" }));
    } else if (curves.over_speed) saveTorqueCsv(curves.over_speed);
    say(`${kind} saved`);
  } catch (error) {
    say(linesOf(error).join("; "));
  }
}

/**
 * Save a file that the server makes. Of what it is made of already, a second click makes no other one.
 *
 * @param {string} kind
 * @param {string} address
 * @param {object} body
 * @param {Map<string, Making>} making
 * @returns {Promise<boolean>} false where another one is on its way in its place
 */
async function saveMade(kind, address, body, making) {
  const key = JSON.stringify(body);
  const before = making.get(kind);
  say(`making the ${kind} …`);
  if (before?.key === key) return false;
  before?.request.abort();
  const request = new AbortController();
  const { signal } = request;
  making.set(kind, { key, request });
  try {
    const place = address.replace(/\W/, "-");
    const isLong = address.startsWith("report");
    const answer = await (isLong ? runJob(address, body, { place, signal }) : send(address, body, signal));
    save(`.${kind.toLowerCase()}`, await answer.blob());
  } catch (error) {
    if (signal.aborted) return false;
    throw error;
  } finally {
    if (!signal.aborted) making.delete(kind);
  }
  return true;
}

/**
 * What makes a file: of a report also the name of a project and a date, where they are wished for.
 *
 * @param {string} address
 * @param {{ case?: object }} whole
 */
function bodyOf(address, whole) {
  if (address === "toml") return withAside(whole);
  if (!address.startsWith("report")) return whole;
  const [project, dated] = ["project", "dated"].map((id) => /** @type {HTMLInputElement} */ (byId(id)));
  const day = new Date().toLocaleDateString("sv-SE"); // as ISO 8601 writes it
  return { ...whole, ...(project.value ? { project: project.value } : {}), ...(dated.checked ? { date: day } : {}) };
}

/**
 * A case with what its design keeps aside, which no command reads.
 *
 * @param {{ case?: object }} body
 */
function withAside(body) {
  const { aside } = designs.current();
  return aside ? { case: { ...body.case, aside } } : body;
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
