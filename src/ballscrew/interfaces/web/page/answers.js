// What the server says of the designs, shown as it comes: numbers first, then the charts from the top of the page down.

import * as charts from "./charts.js";
import { showDesigns, showModels } from "./compare.js";
import { byId, csv, save } from "./dom.js";
import { refuse } from "./plot.js";
import * as results from "./results.js";
import { Problem, ask, send } from "./server.js";
import { LETTERS } from "./state.js";
import { sentence } from "./units.js";

const POINTS = 41, POINTS_OF_NUT = 15, MAP = 21, MAP_OF_NUT = 11;
const BAND_WAITS = 600;
const AT_MOST = 50;

const known = new Map(); // answers by their cases, as text
let mechanisms;
let flight = new AbortController();
let banding = new AbortController();
let bandTimer;
let shown = {}; // what is on the page: the case, its answer, its band, what its charts are made of

export function learn(vocabulary) { ({ mechanisms } = vocabulary); }

export function current() { return shown; }

async function answerOf(body, signal) {
  const key = JSON.stringify(body);
  if (!known.has(key)) {
    const found = await ask("run", body, signal);
    if (known.size > AT_MOST) known.delete(known.keys().next().value);
    known.set(key, found);
  }
  return known.get(key);
}

/** Show the answer of one of the cases, and all of them side by side. What is under way for the cases before is dropped. */
export async function follow(cases, { designs, show, band: wanted }, report) {
  flight.abort();
  flight = new AbortController();
  const { signal } = flight;
  const began = performance.now();
  let bodies = [];
  shown.names = designs.map((one) => one.start);
  byId("results").setAttribute("aria-busy", "true");
  try {
    bodies = (await cases()).map((one) => ({ case: one }));
    if (signal.aborted) return;
    const body = bodies[show], key = JSON.stringify(body);
    const answer = await answerOf(body, signal);
    if (signal.aborted) return;
    shown = { body, key, answer, band: shown.key === key ? shown.band : null, designs: shown.designs, names: shown.names };
    report([]);
    results.succeed();
    results.show(answer, shown.band);
    painted("numbers", began, signal);
    band(wanted);
    await Promise.all([draw(body, answer, signal, began), compare(bodies, signal)]);
    await painted("all", began, signal);
  } catch (problem) {
    if (signal.aborted) return;
    const faults = problem instanceof Problem ? problem.faults : [];
    clearTimeout(bandTimer);
    banding.abort();
    report(faults);
    results.fail(problem instanceof Problem ? problem.lines : [silent(problem)]);
    await compare(bodies, signal);
  } finally {
    if (!signal.aborted) byId("results").setAttribute("aria-busy", "false");
  }
}

export function silent(problem) { return `The server does not answer (${problem.message}). Is it still running? The next change asks it again.`; }

/** How long something took until it was on the screen: a task that is put off from within a frame comes after it. */
async function painted(name, began, signal) {
  await new Promise((go) => { requestAnimationFrame(() => setTimeout(go)); setTimeout(go, 500); });
  if (!signal.aborted) performance.measure(name, { start: began });
}

/** Let the page breathe: what was drawn is shown, and what was typed is heard. */
function breath() { return new Promise((go) => { setTimeout(go); }); }

async function draw(body, answer, signal, began) {
  const { axial_load: load, screw_speed: speed } = answer.inputs.operation;
  const nut = Boolean(answer.loads);
  const fast = speed > 0 ? 2 * speed : 200, heavy = load > 0 ? 2 * load : 10_000;
  const parts = Object.keys(answer.results.contributions).map((name) => `contribution_${name}`);
  const films = nut ? ["minimum_film_parameter"] : ["screw_film_parameter", "nut_film_parameter"];
  const pressures = nut ? ["maximum_pressure"] : ["screw_maximum_pressure", "nut_maximum_pressure"];
  const size = nut ? MAP_OF_NUT : MAP;
  const sweep = (vary, outputs) => ask("sweep", { ...body, vary, outputs }, signal);
  const drawn = async (id, asked, chart) => {
    try {
      const found = await asked;
      await breath();
      if (!signal.aborted) await chart(found);
    } catch (problem) {
      if (signal.aborted) return;
      if (!(problem instanceof Problem)) throw problem;
      refuse(id, problem.lines.join("; "));
    }
  };
  const alongSpeed = sweep({ screw_speed: `${fast / 100}:${fast}:${POINTS} rad/s` }, ["screw_torque", ...parts, ...films]);
  await alongSpeed.catch(() => {});
  if (signal.aborted) return;
  // asked for while the first chart is drawn
  const picture = send("drawing", body, signal).then((found) => found.text());
  const alongLoad = sweep({ axial_load: `${heavy / 50}:${heavy}:${nut ? POINTS_OF_NUT : POINTS} N` }, pressures);
  const everywhere = sweep({ axial_load: `${heavy / 20}:${heavy}:${size} N`, screw_speed: `${fast / 20}:${fast}:${size} rad/s` }, ["efficiency"]);
  const others = Promise.allSettled([picture, alongLoad, everywhere]);
  await drawn("torque-chart", alongSpeed, (found) => { shown.alongSpeed = found; return charts.torque(found, answer, mechanisms); });
  painted("chart", began, signal);
  await drawn("map-chart", everywhere, (found) => { shown.everywhere = found; return charts.map(found, answer); });
  await drawn("film-chart", alongSpeed, (found) => charts.film(found, answer));
  await drawn("pressure-chart", alongLoad, (found) => { shown.alongLoad = found; return charts.pressure(found, answer); });
  await drawn("drawing", picture, showDrawing);
  await others;
}

function showDrawing(text) {
  const found = new DOMParser().parseFromString(text, "image/svg+xml").documentElement;
  if (found.nodeName !== "svg") return;
  shown.picture = text;
  for (const words of found.querySelectorAll("text, tspan")) if (!words.childElementCount) words.textContent = sentence(words.textContent);
  byId("drawing").replaceChildren(document.importNode(found, true));
}

/** Show all of it once more, in other units: nothing is asked for. */
export function again() {
  const { answer, alongSpeed, everywhere, alongLoad, picture, designs, names, models: compared } = shown;
  if (!answer) return;
  results.show(answer, shown.band);
  if (alongSpeed) { charts.torque(alongSpeed, answer, mechanisms); charts.film(alongSpeed, answer); }
  if (everywhere) charts.map(everywhere, answer);
  if (alongLoad) charts.pressure(alongLoad, answer);
  if (picture) showDrawing(picture);
  if (designs) showDesigns(designs, names, mechanisms);
  if (compared) showModels(compared);
}

/** The band, when asked for, once typing has come to rest. */
export function band(wanted) {
  clearTimeout(bandTimer);
  banding.abort();
  if (!shown.answer) return;
  if (!wanted) { shown.band = null; results.show(shown.answer, null); return; }
  if (shown.band && !shown.band.pending) return;
  const first = byId("band-words").childElementCount === 0;
  shown.band = { pending: true };
  results.show(shown.answer, shown.band);
  banding = new AbortController();
  const { signal } = banding, { body } = shown;
  bandTimer = setTimeout(async () => {
    let found;
    try { found = await ask("band", body, signal); }
    catch (problem) { found = { problem: problem.lines?.join("; ") ?? silent(problem) }; }
    if (signal.aborted) return;
    shown.band = found;
    results.show(shown.answer, found);
  }, first ? 0 : BAND_WAITS);
}

async function compare(bodies, signal) {
  const found = {};
  for (const [place, body] of bodies.entries()) {
    try { found[LETTERS[place]] = await answerOf(body, signal); }
    catch (problem) {
      if (signal.aborted) return;
      found[LETTERS[place]] = problem.lines?.[0] ?? silent(problem);
    }
  }
  if (signal.aborted) return;
  shown.designs = found;
  await showDesigns(found, shown.names, mechanisms);
}

/** The case with all models and laws, when asked for. */
export async function models() {
  byId("models").textContent = "computing …";
  const { body } = shown;
  try {
    const found = await ask("compare", body);
    if (body !== shown.body) { forgetModels(); return; }
    shown.models = found;
    showModels(found);
  } catch (problem) { byId("models").textContent = problem.lines?.join("; ") ?? silent(problem); }
}

/** What was computed of another case is not left standing. */
export function forgetModels() {
  delete shown.models;
  byId("models").textContent = "";
}

/** Torque and its parts over speed as a file, in SI. */
export function torqueCsv() {
  const { axes, outputs } = shown.alongSpeed;
  const names = Object.keys(outputs);
  const rows = axes.screw_speed.values.map((speed, place) => [speed, ...names.map((name) => outputs[name].values[place])]);
  save("torque_over_speed.csv", new Blob([csv(["screw_speed [rad/s]", ...names.map((name) => `${name} [${outputs[name].unit}]`)], rows)], { type: "text/csv" }));
}
