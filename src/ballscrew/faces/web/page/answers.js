// Answers of the server for the designs, shown as they come: numbers first, then the charts from the top down.

import * as bath from "./bath.js";
import * as charts from "./charts.js";
import * as checks from "./checks.js";
import { showDesigns, showModels } from "./compare.js";
import * as curves from "./curves.js";
import { titleOf } from "./designs.js";
import { byId } from "./dom.js";
import * as drawings from "./drawing.js";
import { inWords, labelOf } from "./faults.js";
import { showFailure } from "./plot.js";
import * as results from "./results.js";
import { withoutCards } from "./schema.js";
import { ask, linesOf, Problem, sendJson } from "./server.js";
import { LETTERS } from "./state.js";
import * as stiffness from "./stiffness.js";
import * as temperatures from "./temperatures.js";
import { text } from "./texts.js";

/** Points of a curve and of one side of the map; fewer for a whole nut, which takes longer. */
const POINTS = { curve: 41, curveOfNut: 15, map: 20, mapOfNut: 10 };
/** Points of a curve of either sign, one more than a multiple of every step of a band. */
const POINTS_OF_SIGN = 29;
/** Digits of a value of an axis: the text of an axis has no room for all. */
const DIGITS_OF_AXIS = 6;
/** Every how many points of the curve over the speed have a band: of a screw, and of a whole nut. */
const STEP_OF_BAND = { screw: 2, nut: 4 };
const BAND_DELAY = 400;
/** Milliseconds to wait where the server has too much to do, as it says itself. */
const BUSY_DELAY = 1000;
/** Milliseconds after which a page in the background counts as painted. */
const PAINT_TIMEOUT = 500;

/** @typedef {{ case: Record<string, unknown> }} Body */
/**
 * Everything on the page: the case, its answer and band, the sweeps of its charts, the other designs and models.
 *
 * @typedef {object} Displayed
 * @property {Body} [body] without what only cards ask about
 * @property {Body} [whole] the case as a file has it
 * @property {string} [key]
 * @property {Run} [answer]
 * @property {checks.Judged} [checks]
 * @property {results.Band | null} band
 * @property {string[]} starts
 * @property {Sweep} [alongSpeed]
 * @property {Sweep | string} [bandAlongSpeed] the band of the torque over the speed, or why there is none
 * @property {Sweep} [alongLoad]
 * @property {Sweep} [everywhere]
 * @property {Sweep} [hotAndCold]
 * @property {Template} [drawing]
 * @property {import("./compare.js").Answers} [designs]
 * @property {Compare} [models]
 */

/** @type {Mechanisms} */
let mechanisms;
let requests = new AbortController();
let bandRequest = new AbortController();
/** That of the checks: an edit of a card asks for them alone. */
let checksRequest = new AbortController();
/** @type {ReturnType<typeof setTimeout>} */
let bandTimer;
/** Adds the bands of the designs that stand side by side. */
let addBandsOfDesigns = () => {};
/** Goes to a field of the form. @type {(path: string) => void} */
let jump = () => {};
/** @type {Displayed} */
let displayed = { band: null, starts: [] };

/**
 * @param {Vocabulary} vocabulary
 * @param {(path: string) => void} goTo goes to a field of the form
 */
export function setVocabulary(vocabulary, goTo) {
  mechanisms = vocabulary.mechanisms;
  stiffness.setVocabulary(vocabulary);
  jump = goTo;
}

/** The answer on the page, or none yet. */
export function current() {
  return displayed;
}

/**
 * Show the answer of the current case, and all designs side by side. Requests of the cases before are cancelled.
 *
 * @param {() => Promise<Record<string, unknown>[]>} cases
 * @param {import("./state.js").State} state
 * @param {(faults: FaultLine[]) => results.Refusal} report shows faults beside their fields
 */
export async function update(cases, { designs, show, band: wanted, own }, report) {
  requests.abort();
  requests = new AbortController();
  const { signal } = requests;
  const start = performance.now();
  clearTimeout(bandTimer);
  bandRequest.abort();
  checksRequest.abort();
  /** @type {Body[]} */
  let bodies = [];
  displayed.starts = designs.map(titleOf);
  byId("results").setAttribute("aria-busy", "true");
  try {
    const found = await cases();
    bodies = found.map((one) => ({ case: withoutCards(one) }));
    if (signal.aborted) return;
    const body = bodies[show];
    const whole = { case: found[show] };
    const key = JSON.stringify(body);
    /** @type {Run} */
    const answer = await ask("run", body, signal);
    if (signal.aborted) return;
    const { designs: before, starts } = displayed;
    /** @type {Displayed} */
    const known = displayed.key === key ? displayed : { band: null, starts };
    const { checks: checked, band, bandAlongSpeed } = known;
    displayed = { body, whole, key, answer, checks: checked, band, bandAlongSpeed, designs: before, starts };
    report([]);
    results.succeed();
    if (wanted && !displayed.band) displayed.band = { state: "pending" };
    results.show(answer, displayed);
    bath.show(answer);
    stiffness.show(answer);
    measurePaint("numbers", start, signal);
    const checking = showChecks(body, answer);
    await Promise.all([checking, drawCharts(body, answer, signal, start), showAll(bodies, own, wanted, signal)]);
    await measurePaint("all", start, signal);
    if (!signal.aborted) showBand(wanted);
  } catch (error) {
    if (signal.aborted) return;
    const refusal =
      error instanceof Problem && error.faults.length ? report(error.faults) : results.refusal(linesOf(error));
    results.fail(refusal);
    await showAll(bodies, own, false, signal);
  } finally {
    if (!signal.aborted) byId("results").setAttribute("aria-busy", "false");
  }
}

/**
 * Show the checks of an answer, and the verdict that they lead to. Those that were asked for before are cancelled.
 *
 * @param {Body} body
 * @param {Run} answer
 */
async function showChecks(body, answer) {
  checksRequest.abort();
  checksRequest = new AbortController();
  const { signal } = checksRequest;
  const { whole } = displayed;
  /** @type {checks.Judged | undefined} */
  let checked;
  try {
    checked = whole && isMoving(whole) ? await checksOfCycle(whole, signal) : await checksOf(body, signal);
  } catch (error) {
    if (signal.aborted) return;
    throw error;
  }
  if (signal.aborted) return;
  displayed.checks = checked;
  results.show(answer, displayed);
  checks.show(checked, jump);
}

/**
 * The checks of a case, which are quick once it has been run; none where they cannot be computed.
 *
 * @param {Body} body
 * @param {AbortSignal} signal
 * @returns {Promise<Checks | undefined>}
 */
async function checksOf(body, signal) {
  try {
    return await ask("check", body, signal);
  } catch (error) {
    if (!(error instanceof Problem)) throw error;
    return undefined;
  }
}

/** True where a case has a cycle, which is judged in place of its operating point. @param {Body} body */
function isMoving({ case: { axis, motion } }) {
  return Boolean(axis && motion);
}

/**
 * The checks over the cycle of a case; none where they cannot be computed.
 *
 * @param {Body} body
 * @param {AbortSignal} signal
 * @returns {Promise<checks.Judged | undefined>}
 */
async function checksOfCycle(body, signal) {
  try {
    return checks.ofCycle(await ask("duty", body, signal));
  } catch (error) {
    if (!(error instanceof Problem)) throw error;
    return undefined;
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
  const speeds = ends(speed, 200);
  const chartedLoads = ends(load, 10_000);
  const parts = Object.keys(answer.results.contributions).map((name) => `contribution_${name}`);
  const films = isNut ? ["minimum_film_parameter"] : ["screw_film_parameter", "nut_film_parameter"];
  const pressures = isNut ? ["maximum_pressure"] : ["screw_maximum_pressure", "nut_maximum_pressure"];
  const side = isNut ? POINTS.mapOfNut : POINTS.map;
  /** The points of one sign of a curve. @param {[number, number]} range @param {number} count of a curve of one sign */
  const ofCurve = ([low], count) => (low < 0 ? Math.min(count, POINTS_OF_SIGN) : count);
  /** The points of one sign on a side of the map. @param {[number, number]} range */
  const ofSide = ([low]) => (low < 0 ? side / 2 : side);
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
  const alongSpeed = sweep({ screw_speed: `${along(speeds, 100, ofCurve(speeds, POINTS.curve)).join(", ")} rad/s` }, [
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
  const alongLoad = sweep(
    { axial_load: `${along(chartedLoads, 50, ofCurve(chartedLoads, loads)).join(", ")} N` },
    pressures,
  );
  const everywhere = sweep(
    {
      axial_load: `${along(chartedLoads, 20, ofSide(chartedLoads)).join(", ")} N`,
      screw_speed: `${along(speeds, 20, ofSide(speeds)).join(", ")} rad/s`,
    },
    ["efficiency", "back_driving_efficiency"],
  );
  const asked = temperatures.question(answer);
  const hotAndCold = asked && sweep(asked.vary, asked.outputs);
  const others = Promise.allSettled([drawing, alongLoad, everywhere, hotAndCold]);
  await drawn("torque-chart", alongSpeed, (found) => {
    displayed.alongSpeed = found;
    return drawTorque(answer);
  });
  measurePaint("chart", start, signal);
  displayed.hotAndCold = undefined;
  if (!hotAndCold) temperatures.leaveOut(answer);
  else {
    await drawn("temperatures", hotAndCold, (found) => {
      displayed.hotAndCold = found;
      temperatures.show(found, answer);
    });
  }
  await drawn("map-chart", everywhere, (found) => {
    displayed.everywhere = found;
    return charts.map(found, answer);
  });
  await drawn("film-chart", alongSpeed, (found) => curves.film(found, answer));
  await drawn("pressure-chart", alongLoad, (found) => {
    displayed.alongLoad = found;
    return curves.pressure(found, answer);
  });
  await drawn("drawing", drawing, (found) => {
    displayed.drawing = found;
    drawings.show(found);
  });
  await others;
}

/**
 * The ends of a chart around the operating point, in SI: where that is negative, both signs are drawn.
 *
 * @param {number} value
 * @param {number} other the far end where the value is nothing
 * @returns {[number, number]}
 */
function ends(value, other) {
  const far = 2 * Math.abs(value) || other;
  return [value < 0 ? -far : 0, far];
}

/**
 * Values from a share of the far end to it, and their negatives where the range has both signs: none is nothing.
 *
 * @param {[number, number]} range
 * @param {number} share
 * @param {number} count of one sign
 */
function along([low, high], share, count) {
  const found = Array.from(
    { length: count },
    (_, place) => high / share + (place * (high - high / share)) / (count - 1),
  );
  const rounded = found.map((value) => Number(value.toPrecision(DIGITS_OF_AXIS)));
  return low < 0 ? [...rounded.map((value) => -value).toReversed(), ...rounded] : rounded;
}

/** Draw the torque over the speed, with its band where that is there. @param {Run} answer */
function drawTorque(answer) {
  const { alongSpeed, band, bandAlongSpeed } = displayed;
  return alongSpeed && charts.torque(alongSpeed, answer, mechanisms, band ? bandAlongSpeed : undefined);
}

/**
 * The band of the torque over the speed, at some of the points of its curve.
 *
 * @param {Body} body
 * @param {Run} answer
 * @param {AbortSignal} signal
 */
async function addBandAlongSpeed(body, answer, signal) {
  const { alongSpeed } = displayed;
  if (!alongSpeed) return;
  const step = answer.loads ? STEP_OF_BAND.nut : STEP_OF_BAND.screw;
  const all = /** @type {number[]} */ (alongSpeed.axes.screw_speed.values);
  // counted from the ends of the chart, which have a band
  const speeds = all.filter((_, place) => Math.min(place, all.length - 1 - place) % step === 0);
  const vary = { screw_speed: `${speeds.join(", ")} rad/s` };
  /** @type {Sweep | string} */
  let found;
  try {
    found = await sendJson("sweep", { ...body, vary, outputs: ["screw_torque"], band: true }, signal);
  } catch (error) {
    if (signal.aborted) return;
    found = linesOf(error).join("; ");
  }
  if (signal.aborted || alongSpeed !== displayed.alongSpeed) return;
  displayed.bandAlongSpeed = found;
  await drawTorque(answer);
}

/**
 * Keep the case for files, of which only what cards ask about has changed; its cycle is judged anew.
 *
 * @param {Record<string, unknown>} found
 */
export async function keepWhole(found) {
  const before = displayed.whole;
  displayed.whole = { case: found };
  const { answer, body, whole } = displayed;
  if (!answer || !body || !(isMoving(whole) || (before && isMoving(before)))) return;
  try {
    await showChecks(body, answer);
  } catch (error) {
    results.fail(results.refusal(linesOf(error)));
  }
}

/** Show all of it again in other units, without requests. */
export function redisplay() {
  const { answer, checks: checked, alongSpeed, everywhere, alongLoad, drawing, designs, starts, models } = displayed;
  if (!answer) return;
  results.show(answer, displayed);
  stiffness.show(answer);
  checks.show(checked, jump);
  if (alongSpeed) {
    drawTorque(answer);
    curves.film(alongSpeed, answer);
  }
  if (everywhere) charts.map(everywhere, answer);
  if (alongLoad) curves.pressure(alongLoad, answer);
  if (displayed.hotAndCold) temperatures.show(displayed.hotAndCold, answer);
  if (drawing) drawings.show(drawing);
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
    results.show(answer, displayed);
  };
  if (!wanted) {
    display(null);
    drawTorque(answer);
    return;
  }
  if (band && band.state !== "pending") return;
  display({ state: "pending" });
  bandRequest = new AbortController();
  const { signal } = bandRequest;
  bandTimer = setTimeout(async () => {
    /** @type {results.Band} */
    let found;
    try {
      found = { state: "done", answer: await ask("band", body, signal) };
    } catch (error) {
      found = { state: "failed", lines: linesOf(error) };
      if (error instanceof Problem && error.isBusy && !signal.aborted) {
        bandTimer = setTimeout(() => showBand(wanted), BUSY_DELAY); // nobody has asked for it by hand
        return;
      }
    }
    if (signal.aborted) return;
    display(found);
    if (found.state === "done") await addBandAlongSpeed(body, answer, signal);
  }, BAND_DELAY);
}

/**
 * All designs at the load and the speed of the first one, or each at its own.
 *
 * @param {Body[]} bodies
 * @param {boolean} own
 * @param {boolean} withBands
 * @param {AbortSignal} signal
 */
async function showAll(bodies, own, withBands, signal) {
  const { operation } = bodies[0]?.case ?? {};
  /** @type {import("./compare.js").Answers} */
  const found = {};
  for (const [place, body] of bodies.entries()) {
    const at = own || !operation ? body : { case: { ...body.case, operation } };
    try {
      found[LETTERS[place]] = { run: await ask("run", at, signal) };
      if (bodies.length > 1) found[LETTERS[place]].checks = await checksOf(at, signal);
    } catch (error) {
      if (signal.aborted) return;
      const [fault] = error instanceof Problem ? error.faults : [];
      found[LETTERS[place]] = { reason: fault ? `${labelOf(fault.where)}: ${inWords(fault)}` : linesOf(error)[0] };
    }
  }
  if (signal.aborted) return;
  displayed.designs = found;
  addBandsOfDesigns = () => addBands(bodies, own, signal);
  await showDesigns(found, displayed.starts, mechanisms);
  if (withBands && bodies.length > 1) addBandsOfDesigns();
}

/**
 * The bands of the designs side by side, or none of them.
 *
 * @param {boolean} wanted
 */
export function showBandsOfDesigns(wanted) {
  const { designs, starts } = displayed;
  if (!designs || Object.keys(designs).length < 2) return;
  for (const one of Object.values(designs)) delete one.band;
  if (wanted) addBandsOfDesigns();
  else showDesigns(designs, starts, mechanisms);
}

/**
 * The bands of the designs, one after the other, once typing has come to rest.
 *
 * @param {Body[]} bodies
 * @param {boolean} own
 * @param {AbortSignal} signal
 */
async function addBands(bodies, own, signal) {
  await new Promise((resolve) => setTimeout(resolve, BAND_DELAY));
  for (const [place, body] of bodies.entries()) {
    const one = displayed.designs?.[LETTERS[place]];
    if (signal.aborted || !one?.run || !displayed.band) continue;
    const { operation } = bodies[0].case;
    try {
      one.band = await ask("band", own ? body : { case: { ...body.case, operation } }, signal);
    } catch {
      continue; // of this design there is none
    }
    if (!signal.aborted && displayed.designs) showDesigns(displayed.designs, displayed.starts, mechanisms);
  }
}

/** Compute and show the case with all models and laws. */
export async function compareModels() {
  const { body } = displayed;
  if (!body) return;
  byId("models").textContent = text("models.pending");
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
