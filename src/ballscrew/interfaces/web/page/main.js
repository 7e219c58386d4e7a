// The page: state in the address, a form, and an answer that follows what is typed.

import * as answers from "./answers.js";
import { byId, element } from "./dom.js";
import * as downloads from "./downloads.js";
import * as form from "./form.js";
import * as results from "./results.js";
import { get } from "./server.js";
import * as states from "./state.js";
import * as units from "./units.js";

const ADDRESS_WAITS = 300;
/** The sections that are not of the screw, and what an oil is made from. */
const OF_USE = ["operation", "lubricant", "model", "losses", "installation", "limits"], MADE_FROM = ["viscosity", "grade", "temperature"];

let vocabulary, state;
const starts = new Map(); // tables of the cases to start from, by name
let laws; // of the answer that the form was built with
let addressTimer;
let address; // that is to be written

// -- the case of a design ---------------------------------------------------------------------------

async function startOf(name) {
  if (!starts.has(name)) {
    const paper = Object.hasOwn(vocabulary.starts, name) ? vocabulary.starts[name].case : undefined;
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
    settle();
    state.designs[state.show] = states.design(start, ofUse(current()));
    return go({ rebuild: true, keep: true });
  }
  if (unit !== undefined) { state.fields[path] = unit; return go({ rebuild: true, only: "form" }); }
  const { changes } = current();
  const usual = states.inside(starts.get(current().start), path);
  if (text === "" && usual === undefined) delete changes[path];
  else changes[path] = text;
  if (text === "") for (const inner of Object.keys(changes)) if (inner.startsWith(`${path}.`)) delete changes[inner];
  form.mark(path, path in changes);
  byId("reset").hidden = !Object.keys(changes).length;
  return go({ rebuild });
}

/** What was set of the use of a screw, for another one in its place: an oil that was changed stays as a whole. */
function ofUse({ start, changes }) {
  const kept = Object.fromEntries(Object.entries(changes).filter(([path]) => OF_USE.includes(path.split(".")[0])));
  if (Object.keys(kept).some((path) => path.startsWith("lubricant."))) {
    const { lubricant } = states.tables(starts.get(start), changes, form.fieldOf);
    for (const name of MADE_FROM) kept[`lubricant.${name}`] = String(lubricant[name] ?? "");
  }
  return kept;
}

/** The state of an address; what is not known here is left out, and that is said. */
function readState() {
  const { state: found, strange } = states.read(location.hash, form.fieldOf, units.isUnit);
  const rows = new Set([...Object.keys(vocabulary.starts), ...vocabulary.rows.map((row) => row.name)]);
  const unknown = found.designs.filter((one) => !rows.has(one.start)).map((one) => brief(one.start));
  found.designs = found.designs.map((one) => (rows.has(one.start) ? one : states.design()));
  notice([
    unknown.length ? `The link starts from ${unknown.join(" and ")}, not known here: in its place stands the paper's screw.` : "",
    strange.length ? `The link has words that are not known here and left out: ${strange.slice(0, 3).map(brief).join(", ")}${strange.length > 3 ? ", …" : ""}.` : "",
  ].join(" ").trim());
  return found;
}

function brief(text) { return text.length > 40 ? `${text.slice(0, 40)}…` : text; }

/** Write the address that waits to be written: browsers stop a page that writes it at each key. */
function settle() {
  clearTimeout(addressTimer);
  if (address !== undefined && address !== location.hash) history.replaceState(null, "", address);
  address = undefined;
}

/** Write the state into the address, and show what it means. ``keep`` leaves the state before to the button Back. */
async function go({ rebuild = false, keep = false, only = "" } = {}) {
  if (only !== "form") byId("results").setAttribute("aria-busy", "true");
  const written = states.written(state);
  if (keep) {
    settle();
    if (written !== location.hash) history.pushState(null, "", written);
    notice("");
  } else {
    address = written;
    clearTimeout(addressTimer);
    addressTimer = setTimeout(settle, ADDRESS_WAITS);
  }
  try { if (rebuild) await showForm(); }
  catch (problem) { results.fail(problem.lines ?? [answers.silent(problem)]); return; }
  if (only !== "form") await update();
}

async function update() {
  answers.forgetModels();
  await answers.follow(() => Promise.all(state.designs.map(caseOf)), state, (faults) => {
    // the laws of the model are known with its answer
    const { answer } = answers.current();
    const found = answer && JSON.stringify([answer.inputs.model, answer.inputs.losses]);
    if (found !== laws && !faults.length) { laws = found; showForm(); }
    return form.showFaults(faults);
  });
}

async function showForm() {
  units.setSystem(state.system);
  byId("system").value = units.currentSystem();
  byId("band").checked = state.band;
  const design = current(), start = await startOf(design.start);
  if (design !== current()) return; // chosen in the meantime: the form of another one is made
  const tables = states.tables(start, design.changes, form.fieldOf);
  // a text stays as it was typed while it is typed on: 0.10 may become 0.107
  const kept = (path) => (design.changes[path] === "" ? undefined : design.changes[path]) ?? states.inside(tables, path);
  const law = (path) => {
    const known = states.inside(answers.current().answer?.inputs, path);
    return typeof known === "string" ? { law: known } : known;
  };
  keepingFocus(() => {
    form.build(state, vocabulary, kept, law);
    tabs();
  });
}

/** Focus, and the place of the cursor, stay where they are when what has them is made anew. */
function keepingFocus(rebuild) {
  const { id, selectionStart: from, selectionEnd: to } = document.activeElement;
  rebuild();
  const again = id && document.activeElement.id !== id ? byId(id) : null;
  if (again?.disabled) byId(`design-${states.LETTERS[state.show]}`).focus();
  else again?.focus({ preventScroll: true });
  if (again && typeof from === "number") again.setSelectionRange(from, to);
}

function notice(text) {
  byId("notice").textContent = text;
  byId("notice").hidden = !text;
}

function tabs() {
  const turn = (act) => () => { settle(); act(); go({ rebuild: true, keep: true }); };
  const buttons = state.designs.map((_, place) => element("button", { type: "button", class: "tab", id: `design-${states.LETTERS[place]}`,
    "aria-pressed": String(place === state.show), onclick: turn(() => { state.show = place; }) },
  element("span", { class: "long" }, "Design "), states.LETTERS[place]));
  const add = element("button", { type: "button", id: "add", disabled: state.designs.length === states.LETTERS.length, onclick: turn(() => {
    state.designs.push(states.design(current().start, current().changes));
    state.show = state.designs.length - 1;
  }) }, "Add design");
  const remove = element("button", { type: "button", id: "remove", disabled: state.designs.length === 1, onclick: turn(() => {
    state.designs.splice(state.show, 1);
    state.show = Math.min(state.show, state.designs.length - 1);
  }) }, "Remove");
  byId("designs").replaceChildren(...buttons, add, remove);
}

// -- the beginning ----------------------------------------------------------------------------------

function listen() {
  byId("system").addEventListener("change", async (event) => {
    state.system = event.target.value;
    state.fields = {};
    await go({ rebuild: true, only: "form" });
    answers.again();
  });
  byId("band").addEventListener("change", (event) => {
    state.band = event.target.checked;
    go({ only: "form" });
    answers.band(state.band);
  });
  byId("share").addEventListener("click", async (event) => {
    settle();
    try { await navigator.clipboard.writeText(location.href); event.target.textContent = "Link copied"; }
    catch { event.target.textContent = "Copy it from the address bar"; }
    setTimeout(() => { event.target.textContent = "Copy link"; }, 2500);
  });
  byId("models-button").addEventListener("click", answers.models);
  byId("form").addEventListener("submit", (event) => event.preventDefault());
  // the fragment of the address is the state: the link to the results must not take its place
  document.querySelector(".skip").addEventListener("click", (event) => {
    event.preventDefault();
    byId("results").focus();
  });
  addEventListener("popstate", () => {
    clearTimeout(addressTimer);
    address = undefined;
    state = readState();
    go({ rebuild: true });
  });
  addEventListener("pagehide", settle);
  downloads.build(() => ({ ...answers.current(), csv: answers.torqueCsv, name: `ballscrew-${current().start}` }));
}

async function begin() {
  let schema;
  [vocabulary, schema] = await Promise.all([get("vocabulary"), get("schema")]);
  units.learn(vocabulary);
  answers.learn(vocabulary);
  form.learn(schema, changed);
  byId("version").textContent = `Version ${vocabulary.version}.`;
  state = readState();
  units.setSystem(state.system);
  listen();
  await go({ rebuild: true });
  document.documentElement.dataset.ready = "true";
}

begin().catch((problem) => results.fail(problem.lines ?? [`The page could not start: ${problem.message}`]));
