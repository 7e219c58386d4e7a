// The page: a change of its state is followed by the address, the form, the view, its cards and the answer.

import { SET_UPS } from "./all_cards.js";
import { answersAlone } from "./alone.js";
import { answers } from "./answers.js";
import * as bath from "./bath.js";
import * as cards from "./cards.js";
import * as designs from "./designs.js";
import { byId, NARROW, showNotice, within } from "./dom.js";
import * as downloads from "./downloads.js";
import { keepOffline } from "./embedded.js";
import * as files from "./files.js";
import { entries } from "./history.js";
import * as inputs from "./inputs.js";
import { keeping } from "./keeping.js";
import * as results from "./results.js";
import * as schema from "./schema.js";
import * as screwSearch from "./screw_search.js";
import { followScheme } from "./scheme.js";
import { alone, connection, get, linesOf } from "./server.js";
import * as states from "./state.js";
import { store } from "./store.js";
import * as units from "./units.js";
import * as views from "./views.js";
import { fill, vocabulary } from "./vocabulary.js";

/** @typedef {import("./store.js").StateChange} StateChange */

const LONGEST_QUOTE = 40;
/** The calibration of the button: that of both of its numbers, to the vendor whose rows are shown beside it. */
const CALIBRATION = "rexroth-2006";

/** The state of the address; a notice names what is unknown here and ignored. */
function readAddress() {
  const { state: found, unknown } = states.fromFragment(location.hash, schema.fieldOf, units.isUnit);
  const unknownStarts = found.designs.filter((one) => !designs.isKnown(one.start)).map((one) => quoted(one.start));
  found.designs = found.designs.map((one) => (designs.isKnown(one.start) ? one : states.design()));
  const lines = [];
  if (unknownStarts.length) {
    lines.push(
      `The link starts from ${unknownStarts.join(", ")}, not known here: the paper's screw is shown in its place.`,
    );
  }
  if (unknown.length) {
    const names = unknown.slice(0, 3).map(quoted).join(", ") + (unknown.length > 3 ? ", …" : "");
    lines.push(`The link has keys that are not known here and are left out: ${names}.`);
  }
  if (!views.viewAt(found.view)) {
    lines.push(`Unknown view in the link, ignored: ${quoted(found.view)}.`);
    found.view = states.USUAL_VIEW;
  }
  showNotice(lines.join(" "));
  return found;
}

/** @param {string} name */
function quoted(name) {
  return name.length > LONGEST_QUOTE ? `${name.slice(0, LONGEST_QUOTE)}…` : name;
}

// -- state → address, form, cards, answer -----------------------------------------------------------

/**
 * Follow a change of the state: the address, the form and the cards show it, and the server is asked for its answer.
 *
 * @param {import("./store.js").About} about
 */
async function follow({ path, isStep = false, rebuild = false, of, isLook = false }) {
  const { state } = store;
  if (!of) byId("results").setAttribute("aria-busy", "true");
  const fragment = states.toFragment(state);
  keeping.keep(fragment, state.designs.map(designs.titleOf).join(" · "));
  if (isStep) {
    entries.choose(fragment);
    showNotice("");
  } else if (isLook) entries.look(fragment);
  else if (path) entries.edit(fragment, path);
  else entries.replace(fragment);
  try {
    if (rebuild) await inputs.show(answers.current().answer);
    else if (path && !of) inputs.mark(path);
    inputs.showOrigin();
  } catch (error) {
    results.fail(results.refusal(linesOf(error)));
    return;
  }
  views.show();
  if (isLook) answers.look();
  cards.follow();
  if (of === "cards") answers.keepWhole(await designs.currentCase());
  else if (!of) await answers.update();
}

/** @param {string} id */
function select(id) {
  return /** @type {HTMLSelectElement} */ (byId(id));
}

/** @param {string} id */
function checkbox(id) {
  return /** @type {HTMLInputElement} */ (byId(id));
}

// -- the start --------------------------------------------------------------------------------------

async function copyLink() {
  const button = byId("share");
  entries.write();
  try {
    await navigator.clipboard.writeText(location.href);
    button.textContent = "Link copied";
  } catch {
    button.textContent = "Copy it from the address bar";
  }
  setTimeout(() => {
    button.textContent = "Copy link";
  }, 2500);
}

async function changeSystem() {
  await store.change(
    (state) => {
      state.system = select("system").value;
      state.fields = {};
    },
    { rebuild: true, of: "view" },
  );
  answers.redisplay();
}

function changeBand() {
  const band = checkbox("band").checked;
  store.change(
    (state) => {
      state.band = band;
    },
    { of: "view" },
  );
  answers.showBand(band);
  answers.showBandsOfDesigns(band);
}

/** Show the state of the address, as after Back. */
function arrive() {
  const found = readAddress();
  const isLook = states.toFragment({ ...found, view: "" }) === states.toFragment({ ...store.state, view: "" });
  store.use(found, isLook ? { of: "view" } : { rebuild: true });
}

/** Show the same state again, as once the server is there again. */
function showAgain() {
  store.change(() => {}, { rebuild: true });
}

function addListeners() {
  store.addEventListener("change", (event) => {
    const change = /** @type {StateChange} */ (event);
    change.waitUntil(follow(change.about));
  });
  byId("system").addEventListener("change", changeSystem);
  byId("band").addEventListener("change", changeBand);
  byId("own").addEventListener("change", () => {
    store.change((state) => {
      state.own = checkbox("own").checked;
    });
  });
  byId("calibrate").addEventListener("click", () => {
    const path = "model.calibration";
    const tables = designs.tablesOf(designs.current());
    inputs.change({ path, text: states.valueAt(tables, path) ? "" : CALIBRATION, rebuild: true });
  });
  byId("bath").addEventListener("click", bath.turn);
  byId("share").addEventListener("click", copyLink);
  byId("to-cycle").addEventListener("click", () => views.go("duty"));
  byId("models-button").addEventListener("click", () => answers.compareModels());
  for (const id of ["form", "results"]) {
    for (const type of ["focusin", "pointerdown"])
      byId(id).addEventListener(type, () => answers.prepare(), { once: true });
  }
  byId("form").addEventListener("submit", (event) => event.preventDefault());
  // the fragment of the address is the state: the link to the results must not replace it
  within(document.body, ".skip").addEventListener("click", (event) => {
    event.preventDefault();
    byId("results").focus();
  });
  entries.begin();
  addEventListener("popstate", arrive); // after the entries, which put the address in its place
  connection.addEventListener("return", showAgain);
  downloads.build();
  files.setUp();
  screwSearch.setUp();
}

/** On a phone the case is folded: the answer of the view comes first. */
function foldCase() {
  /** @type {HTMLDetailsElement} */ (byId("case-column")).open = !NARROW.matches;
}

/** Say who computes, and lead to the API of a server. */
function showWhoAnswers() {
  document.documentElement.classList.toggle("alone", Boolean(alone.answers));
  if (alone.answers) byId("computed").textContent = "Computed in your browser; nothing leaves it.";
  else Object.assign(byId("api"), { href: "/api", hidden: false });
}

async function begin() {
  alone.answers = answersAlone();
  followScheme();
  foldCase();
  NARROW.addEventListener("change", foldCase);
  cards.begin(SET_UPS);
  const [words, document_, latest] = await Promise.all([get("vocabulary"), get("schema"), keeping.begin()]);
  fill(words);
  schema.fill(document_);
  byId("version").textContent = `Version ${vocabulary.version}.`;
  showWhoAnswers();
  if (latest) history.replaceState(null, "", latest.fragment);
  const state = readAddress();
  if (latest) files.sayRestored(latest);
  addListeners();
  await store.use(state, { rebuild: true });
  document.documentElement.dataset.ready = "true";
  keepOffline();
}

begin().catch((error) => results.fail(results.refusal(linesOf(error))));
