// Answers of the server for the designs, shown as they come: numbers first, then the charts from the top down.

import * as charts from "./charts.js";
import { showDesigns, showModels } from "./compare.js";
import * as curves from "./curves.js";
import { byId, csv, save } from "./dom.js";
import { showFailure } from "./plot.js";
import * as results from "./results.js";
import { linesOf, Problem, sendJson } from "./server.js";
import { LETTERS } from "./state.js";
import { filled } from "./units.js";

/** Points of a curve and of one side of the map; fewer for a whole nut, which takes longer. */
const POINTS = { curve: 41, curveOfNut: 15, map: 21, mapOfNut: 11 };
const BAND_DELAY = 600;
const MOST_CACHED = 50;
/** Milliseconds after which a page in the background counts as painted. */
const PAINT_TIMEOUT = 500;

/** @typedef {{ case: Record<string, unknown> }} Body */
/**
 * Everything on the page: the case, its answer and band, the sweeps of its charts, the other designs and models.
 *
 * @typedef {object} Displayed
 * @property {Body} [body]
 * @property {string} [key]
 * @property {Run} [answer]
 * @property {results.Band | null} band
 * @property {string[]} starts
 * @property {Sweep} [alongSpeed]
 * @property {Sweep} [alongLoad]
 * @property {Sweep} [everywhere]
 * @property {Template} [drawing]
 * @property {import("./compare.js").Answers} [designs]
 * @property {Compare} [models]
 */

/** Answers by their bodies, as text. @type {Map<string, Run>} */
const cache = new Map();
/** @type {Mechanisms} */
let mechanisms;
let requests = new AbortController();
let bandRequest = new AbortController();
/** @type {ReturnType<typeof setTimeout>} */
let bandTimer;
/** @type {Displayed} */
let displayed = { band: null, starts: [] };

/** @param {Vocabulary} vocabulary */
export function setVocabulary(vocabulary) {
  mechanisms = vocabulary.mechanisms;
}

/** The answer on the page, or none yet. */
export function current() {
  return displayed;
}

/**
 * @param {Body} body
 * @param {AbortSignal} signal
 * @returns {Promise<Run>}
 */
async function run(body, signal) {
  const key = JSON.stringify(body);
  const cached = cache.get(key);
  if (cached) return cached;
  const found = await sendJson("run", body, signal);
  const [oldest] = cache.keys();
  if (cache.size > MOST_CACHED) cache.delete(oldest);
  cache.set(key, found);
  return found;
}

/**
 * Show the answer of the current case, and all designs side by side. Requests of the cases before are cancelled.
 *
 * @param {() => Promise<Record<string, unknown>[]>} cases
 * @param {import("./state.js").State} state
 * @param {(faults: FaultLine[]) => void} report shows faults beside their fields
 */
export async function update(cases, { designs, show, band: wanted }, report) {
  requests.abort();
  requests = new AbortController();
  const { signal } = requests;
  const start = performance.now();
  /** @type {Body[]} */
  let bodies = [];
  displayed.starts = designs.map((one) => one.start);
  byId("results").setAttribute("aria-busy", "true");
  try {
    bodies = (await cases()).map((one) => ({ case: one }));
    if (signal.aborted) return;
    const body = bodies[show];
    const key = JSON.stringify(body);
    const answer = await run(body, signal);
    if (signal.aborted) return;
    const { band, designs: before, starts } = displayed;
    displayed = { body, key, answer, band: displayed.key === key ? band : null, designs: before, starts };
    report([]);
    results.succeed();
    results.show(answer, displayed.band);
    measurePaint("numbers", start, signal);
    showBand(wanted);
    await Promise.all([drawCharts(body, answer, signal, start), showAll(bodies, signal)]);
    await measurePaint("all", start, signal);
  } catch (error) {
    if (signal.aborted) return;
    clearTimeout(bandTimer);
    bandRequest.abort();
    report(error instanceof Problem ? error.faults : []);
    results.fail(linesOf(error));
    await showAll(bodies, signal);
  } finally {
    if (!signal.aborted) byId("results").setAttribute("aria-busy", "false");
  }
}

/**
 * Measure the time until something is on the screen: a task queued within a frame runs after it.
 *
 * @param {string} name
 * @param {number} start
 * @param {AbortSignal} signal
 */
async function measurePaint(name, start, signal) {
  await new Promise((resolve) => {
    requestAnimationFrame(() => setTimeout(resolve));
    setTimeout(resolve, PAINT_TIMEOUT);
  });
  if (!signal.aborted) performance.measure(name, { start });
}

/** Let the browser show what was drawn and handle what was typed. */
function nextTask() {
  return new Promise((resolve) => {
    setTimeout(resolve);
  });
}

/**
 * @param {Body} body
 * @param {Run} answer
 * @param {AbortSignal} signal
 * @param {number} start
 */
async function drawCharts(body, answer, signal, start) {
  const { axial_load: load, screw_speed: speed } = /** @type {Record<string, number>} */ (answer.inputs.operation);
  const isNut = Boolean(answer.loads);
  const topSpeed = speed > 0 ? 2 * speed : 200;
  const topLoad = load > 0 ? 2 * load : 10_000;
  const parts = Object.keys(answer.results.contributions).map((name) => `contribution_${name}`);
  const films = isNut ? ["minimum_film_parameter"] : ["screw_film_parameter", "nut_film_parameter"];
  const pressures = isNut ? ["maximum_pressure"] : ["screw_maximum_pressure", "nut_maximum_pressure"];
  const side = isNut ? POINTS.mapOfNut : POINTS.map;
  /**
   * @param {Record<string, string>} vary
   * @param {string[]} outputs
   * @returns {Promise<Sweep>}
   */
  const sweep = (vary, outputs) => sendJson("sweep", { ...body, vary, outputs }, signal);
  /**
   * Draw a chart when its answer comes, or show why it does not.
   *
   * @template Answer
   * @param {string} id
   * @param {Promise<Answer>} request
   * @param {(answer: Answer) => unknown} chart
   */
  const drawn = async (id, request, chart) => {
    try {
      const found = await request;
      await nextTask();
      if (!signal.aborted) await chart(found);
    } catch (error) {
      if (signal.aborted) return;
      if (!(error instanceof Problem)) throw error;
      showFailure(id, error.lines.join("; "));
    }
  };
  const alongSpeed = sweep({ screw_speed: `${topSpeed / 100}:${topSpeed}:${POINTS.curve} rad/s` }, [
    "screw_torque",
    ...parts,
    ...films,
  ]);
  await alongSpeed.catch(() => {});
  if (signal.aborted) return;
  // requested while the first chart is drawn
  /** @type {Promise<Template>} */
  const drawing = sendJson("drawing/template", body, signal);
  const loads = isNut ? POINTS.curveOfNut : POINTS.curve;
  const alongLoad = sweep({ axial_load: `${topLoad / 50}:${topLoad}:${loads} N` }, pressures);
  const everywhere = sweep(
    {
      axial_load: `${topLoad / 20}:${topLoad}:${side} N`,
      screw_speed: `${topSpeed / 20}:${topSpeed}:${side} rad/s`,
    },
    ["efficiency"],
  );
  const others = Promise.allSettled([drawing, alongLoad, everywhere]);
  await drawn("torque-chart", alongSpeed, (found) => {
    displayed.alongSpeed = found;
    return charts.torque(found, answer, mechanisms);
  });
  measurePaint("chart", start, signal);
  await drawn("map-chart", everywhere, (found) => {
    displayed.everywhere = found;
    return charts.map(found, answer);
  });
  await drawn("film-chart", alongSpeed, (found) => curves.film(found, answer));
  await drawn("pressure-chart", alongLoad, (found) => {
    displayed.alongLoad = found;
    return curves.pressure(found, answer);
  });
  await drawn("drawing", drawing, showDrawing);
  await others;
}

/** @param {Template} template */
function showDrawing(template) {
  const found = new DOMParser().parseFromString(filled(template), "image/svg+xml").documentElement;
  if (found.nodeName !== "svg") return;
  displayed.drawing = template;
  byId("drawing").replaceChildren(document.importNode(found, true));
}

/** Show all of it again in other units, without requests. */
export function redisplay() {
  const { answer, alongSpeed, everywhere, alongLoad, drawing, designs, starts, models, band } = displayed;
  if (!answer) return;
  results.show(answer, band);
  if (alongSpeed) {
    charts.torque(alongSpeed, answer, mechanisms);
    curves.film(alongSpeed, answer);
  }
  if (everywhere) charts.map(everywhere, answer);
  if (alongLoad) curves.pressure(alongLoad, answer);
  if (drawing) showDrawing(drawing);
  if (designs) showDesigns(designs, starts, mechanisms);
  if (models) showModels(models);
}

/**
 * Compute and show the band where it is wanted, once typing has come to rest.
 *
 * @param {boolean} wanted
 */
export function showBand(wanted) {
  clearTimeout(bandTimer);
  bandRequest.abort();
  const { answer, body, band } = displayed;
  if (!answer || !body) return;
  /** @param {results.Band | null} found */
  const display = (found) => {
    displayed.band = found;
    results.show(answer, found);
  };
  if (!wanted) {
    display(null);
    return;
  }
  if (band && band.state !== "pending") return;
  const isFirst = byId("band-words").childElementCount === 0;
  display({ state: "pending" });
  bandRequest = new AbortController();
  const { signal } = bandRequest;
  bandTimer = setTimeout(
    async () => {
      /** @type {results.Band} */
      let found;
      try {
        found = { state: "done", answer: await sendJson("band", body, signal) };
      } catch (error) {
        found = { state: "failed", lines: linesOf(error) };
      }
      if (!signal.aborted) display(found);
    },
    isFirst ? 0 : BAND_DELAY,
  );
}

/**
 * @param {Body[]} bodies
 * @param {AbortSignal} signal
 */
async function showAll(bodies, signal) {
  /** @type {import("./compare.js").Answers} */
  const found = {};
  for (const [place, body] of bodies.entries()) {
    try {
      found[LETTERS[place]] = await run(body, signal);
    } catch (error) {
      if (signal.aborted) return;
      found[LETTERS[place]] = linesOf(error)[0];
    }
  }
  if (signal.aborted) return;
  displayed.designs = found;
  await showDesigns(found, displayed.starts, mechanisms);
}

/** Compute and show the case with all models and laws. */
export async function compareModels() {
  const { body } = displayed;
  if (!body) return;
  byId("models").textContent = "computing …";
  try {
    const found = await sendJson("compare", body);
    if (body !== displayed.body) {
      clearModels();
      return;
    }
    displayed.models = found;
    showModels(found);
  } catch (error) {
    byId("models").textContent = linesOf(error).join("; ");
  }
}

/** Remove the models and laws of another case. */
export function clearModels() {
  delete displayed.models;
  byId("models").textContent = "";
}

/** Save torque and its parts over speed, in SI. */
export function saveTorqueCsv() {
  if (!displayed.alongSpeed) return;
  const { axes, outputs } = displayed.alongSpeed;
  const columns = Object.entries(outputs);
  const headings = ["screw_speed [rad/s]", ...columns.map(([name, { unit }]) => `${name} [${unit}]`)];
  const rows = axes.screw_speed.values.map((speed, place) => [
    speed,
    ...columns.map(([, { values }]) => values[place]),
  ]);
  const content = csv(headings, /** @type {import("./dom.js").Cell[][]} */ (rows));
  save("torque_over_speed.csv", new Blob([content], { type: "text/csv" }));
}
