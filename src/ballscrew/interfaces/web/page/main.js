// The page: state in the address, a form, and an answer that follows what is typed.

import * as charts from "./charts.js";
import { showDesigns, showModels } from "./compare.js";
import { byId, csv, element, save } from "./dom.js";
import * as downloads from "./downloads.js";
import * as form from "./form.js";
import * as results from "./results.js";
import { Problem, ask, get, send } from "./server.js";
import * as states from "./state.js";
import * as units from "./units.js";

const POINTS = 41, MAP = 21, MAP_OF_NUT = 11;
const BAND_WAITS = 600;

let vocabulary, schema, state;
const starts = new Map(); // tables of the cases to start from, by name
const answers = new Map(); // answers by their cases, as text
let flight = new AbortController();
let banding = new AbortController();
let bandTimer;
let shown = {}; // what is on the page: answer, band, sweeps

// -- the case of a design ---------------------------------------------------------------------------

async function startOf(name) {
  if (!starts.has(name)) {
    const paper = vocabulary.starts[name]?.case;
    starts.set(name, paper ?? (await get(`catalogue/${encodeURIComponent(name)}`)).case);
  }
  return starts.get(name);
}

async function caseOf(design) {
  return states.tables(await startOf(design.start), design.changes, form.fieldOf);
}

function current() { return state.designs[state.show]; }

// -- what people do ---------------------------------------------------------------------------------

function changed({ path, text, unit, start, rebuild }) {
  if (start !== undefined) {
    state.designs[state.show] = states.design(start);
    return go({ rebuild: true, keep: true });
  }
  if (unit !== undefined) { state.fields[path] = unit; return go({ rebuild: true, only: "form" }); }
  const own = starts.get(current().start);
  const usual = path.split(".").reduce((table, name) => table?.[name], own);
  if (text === "" && usual === undefined) delete current().changes[path];
  else current().changes[path] = text;
  if (text === "") for (const inner of Object.keys(current().changes)) if (inner.startsWith(`${path}.`)) delete current().changes[inner];
  return go({ rebuild });
}

/** The state of an address; a design whose start nobody knows becomes the paper's screw, and that is said. */
function readState() {
  const found = states.read(location.hash);
  const known = new Set([...Object.keys(vocabulary.starts), ...vocabulary.rows.map((row) => row.name)]);
  const unknown = found.designs.filter((one) => !known.has(one.start)).map((one) => one.start);
  found.designs = found.designs.map((one) => (known.has(one.start) ? one : states.design()));
  notice(unknown.length ? `The link starts from ${unknown.join(" and ")}, not known here: in its place stands the paper's screw.` : "");
  return found;
}

/** Write the state into the address, and show what it means. ``keep`` leaves the state before to the button Back. */
async function go({ rebuild = false, keep = false, only = "" } = {}) {
  const address = states.written(state);
  if (address !== location.hash) history[keep ? "pushState" : "replaceState"](null, "", address);
  if (keep) notice("");
  try { if (rebuild) await showForm(); }
  catch (problem) { results.fail([silent(problem)]); return; }
  if (only !== "form") await update();
}

async function showForm() {
  units.setSystem(state.system);
  byId("system").value = units.currentSystem();
  byId("band").checked = state.band;
  const start = await startOf(current().start);
  const tables = states.tables(start, current().changes, form.fieldOf);
  const at = (path) => path.split(".").reduce((table, name) => (table && typeof table === "object" ? table[name] : undefined), tables);
  const law = (path) => {
    const known = shown.answer?.inputs[path.split(".")[0]]?.[path.split(".")[1]];
    return typeof known === "string" ? { law: known } : known;
  };
  const focused = document.activeElement?.id;
  form.build(state, vocabulary, at, law);
  if (focused) byId(focused)?.focus();
  tabs();
}

function notice(text) {
  byId("notice").textContent = text;
  byId("notice").hidden = !text;
}

function tabs() {
  const letter = (place) => states.LETTERS[place];
  const buttons = state.designs.map((one, place) => element("button", { type: "button", class: "tab", "aria-pressed": String(place === state.show),
    onclick: () => { state.show = place; go({ rebuild: true, keep: true }); } }, `Design ${letter(place)}`));
  const add = element("button", { type: "button", id: "add", disabled: state.designs.length === states.LETTERS.length, onclick: () => {
    state.designs.push(states.design(current().start, current().changes));
    state.show = state.designs.length - 1;
    go({ rebuild: true, keep: true });
  } }, "Add design");
  const remove = element("button", { type: "button", id: "remove", disabled: state.designs.length === 1, onclick: () => {
    state.designs.splice(state.show, 1);
    state.show = Math.min(state.show, state.designs.length - 1);
    go({ rebuild: true, keep: true });
  } }, "Remove");
  byId("designs").replaceChildren(...buttons, add, remove);
}

// -- what the server says ---------------------------------------------------------------------------

async function answerOf(body, signal) {
  const key = JSON.stringify(body);
  if (!answers.has(key)) {
    const found = await ask("run", body, signal);
    if (answers.size > 50) answers.delete(answers.keys().next().value);
    answers.set(key, found);
  }
  return answers.get(key);
}

async function update() {
  flight.abort();
  flight = new AbortController();
  const { signal } = flight;
  const began = performance.now();
  let body;
  try {
    body = { case: await caseOf(current()) };
    const answer = await answerOf(body, signal);
    if (signal.aborted) return;
    const known = shown.answer;
    shown = { ...shown, body, answer, band: shown.of === JSON.stringify(body) ? shown.band : null };
    form.showFaults([]);
    results.succeed();
    results.show(answer, shown.band);
    if (!known) showForm(); // the laws of the model are known now
    performance.measure("numbers", { start: began });
    const swept = draw(body, answer, signal, began);
    band(body);
    await Promise.all([swept, compare(signal)]);
  } catch (problem) {
    if (signal.aborted || problem.name === "AbortError") return;
    if (!(problem instanceof Problem)) { results.fail([silent(problem)]); return; }
    const homeless = form.showFaults(problem.faults);
    results.fail(homeless.length < problem.faults.length ? [...problem.lines] : problem.lines);
    compare(signal);
  }
}

function silent(problem) { return `The server does not answer (${problem.message}). Is it still running?`; }

async function draw(body, answer, signal, began) {
  const { axial_load: load, screw_speed: speed } = answer.inputs.operation;
  const nut = Boolean(answer.loads);
  const fast = speed > 0 ? 2 * speed : 200, heavy = load > 0 ? 2 * load : 10_000;
  const parts = Object.keys(answer.results.contributions).map((name) => `contribution_${name}`);
  const films = nut ? ["minimum_film_parameter"] : ["screw_film_parameter", "nut_film_parameter"];
  const pressures = nut ? ["maximum_pressure"] : ["screw_maximum_pressure", "nut_maximum_pressure"];
  const sweep = (vary, outputs) => ask("sweep", { ...body, vary, outputs }, signal);
  const size = nut ? MAP_OF_NUT : MAP;
  const alongSpeed = await sweep({ screw_speed: `${fast / 100}:${fast}:${POINTS} rad/s` }, ["screw_torque", ...parts, ...films]);
  if (signal.aborted) return;
  shown.alongSpeed = alongSpeed;
  await charts.torque(alongSpeed, answer, vocabulary.mechanisms);
  performance.measure("chart", { start: began });
  charts.film(alongSpeed, answer);
  const picture = send("drawing", body, signal).then((found) => found.text()).then(showDrawing);
  const alongLoad = sweep({ axial_load: `${heavy / 50}:${heavy}:${nut ? 15 : POINTS} N` }, pressures).then((found) => charts.pressure(found, answer));
  const everywhere = sweep({ axial_load: `${heavy / 20}:${heavy}:${size} N`, screw_speed: `${fast / 20}:${fast}:${size} rad/s` }, ["efficiency"])
    .then((found) => charts.map(found, answer));
  shown.redraw = () => draw(body, answer, signal, performance.now());
  await Promise.all([picture, alongLoad, everywhere]);
  performance.measure("all", { start: began });
}

function showDrawing(text) {
  const found = new DOMParser().parseFromString(text, "image/svg+xml").documentElement;
  if (found.nodeName === "svg") byId("drawing").replaceChildren(document.importNode(found, true));
}

/** The band, when asked for, once typing has come to rest. */
function band(body) {
  clearTimeout(bandTimer);
  banding.abort();
  if (!state.band) { shown.band = null; return; }
  const key = JSON.stringify(body);
  if (shown.of === key && shown.band && !shown.band.pending) return;
  shown = { ...shown, of: key, band: { pending: true } };
  results.show(shown.answer, shown.band);
  banding = new AbortController();
  const { signal } = banding;
  bandTimer = setTimeout(async () => {
    let found;
    try { found = await ask("band", body, signal); }
    catch (problem) { found = { problem: problem.lines?.join("; ") ?? String(problem) }; }
    if (signal.aborted) return;
    shown.band = found;
    results.show(shown.answer, found);
  }, shown.banded ? BAND_WAITS : 0);
  shown.banded = true;
}

async function compare(signal) {
  const found = {};
  for (const [place, one] of state.designs.entries()) {
    try { found[states.LETTERS[place]] = await answerOf({ case: await caseOf(one) }, signal); }
    catch (problem) {
      if (signal.aborted) return;
      found[states.LETTERS[place]] = problem.lines?.[0] ?? String(problem);
    }
  }
  shown.redrawDesigns = () => showDesigns(found, vocabulary.mechanisms);
  shown.redrawDesigns();
}

async function models() {
  byId("models").textContent = "computing …";
  try { showModels(await ask("compare", shown.body)); }
  catch (problem) { byId("models").textContent = problem.lines?.join("; ") ?? String(problem); }
}

// -- the beginning ----------------------------------------------------------------------------------

function torqueCsv() {
  const { axes, outputs } = shown.alongSpeed;
  const names = Object.keys(outputs);
  const rows = axes.screw_speed.values.map((speed, place) => [speed, ...names.map((name) => outputs[name].values[place])]);
  save("torque_over_speed.csv", new Blob([csv(["screw_speed [rad/s]", ...names.map((name) => `${name} [${outputs[name].unit}]`)], rows)], { type: "text/csv" }));
}

function listen() {
  byId("system").addEventListener("change", async (event) => {
    state.system = event.target.value;
    state.fields = {};
    await go({ rebuild: true, only: "form" });
    if (shown.answer) { results.show(shown.answer, shown.band); shown.redraw?.(); shown.redrawDesigns?.(); }
  });
  byId("band").addEventListener("change", (event) => {
    state.band = event.target.checked;
    go({ only: "form" });
    band(shown.body);
    results.show(shown.answer, shown.band);
  });
  byId("share").addEventListener("click", async (event) => {
    try { await navigator.clipboard.writeText(location.href); event.target.textContent = "Link copied"; }
    catch { event.target.textContent = "Copy it from the address bar"; }
    setTimeout(() => { event.target.textContent = "Copy link"; }, 2500);
  });
  byId("models-button").addEventListener("click", models);
  byId("form").addEventListener("submit", (event) => event.preventDefault());
  addEventListener("popstate", () => { state = readState(); shown.band = null; go({ rebuild: true }); });
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => { shown.redraw?.(); shown.redrawDesigns?.(); });
  downloads.build(() => ({ body: shown.body, answer: shown.answer, csv: torqueCsv, name: `ballscrew-${current().start}` }));
}

async function begin() {
  [vocabulary, schema] = await Promise.all([get("vocabulary"), get("schema")]);
  units.learn(vocabulary);
  form.learn(schema, changed);
  byId("version").textContent = `Version ${vocabulary.version}.`;
  state = readState();
  units.setSystem(state.system);
  listen();
  await go({ rebuild: true });
  document.documentElement.dataset.ready = "true";
}

begin().catch((problem) => results.fail(problem.lines ?? [`The page could not start: ${problem.message}`]));
