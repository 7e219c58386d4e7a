// The page: its state in the address, the form, and the answer that follows what is typed.

import * as answers from "./answers.js";
import * as bath from "./bath.js";
import * as cards from "./cards.js";
import { consequences } from "./consequences.js";
import * as designs from "./designs.js";
import { byId, element, within } from "./dom.js";
import * as downloads from "./downloads.js";
import * as files from "./files.js";
import * as form from "./form.js";
import * as entries from "./history.js";
import * as keeping from "./keeping.js";
import * as results from "./results.js";
import * as schema from "./schema.js";
import { get, linesOf, onReturn } from "./server.js";
import * as states from "./state.js";
import { followMenu, text } from "./texts.js";
import * as units from "./units.js";
import { fill, vocabulary } from "./vocabulary.js";

const LONGEST_QUOTE = 40;
/** The calibration of the button: that of both of its numbers, to the vendor whose rows are shown beside it. */
const CALIBRATION = "rexroth-2006";

/** Laws of the answer that the form was built with. @type {string | undefined} */
let laws;
/** Leads in SI that are no plain number in their design, by its screw as it is given. @type {Map<unknown, number>} */
const leads = new Map();

// -- inputs -----------------------------------------------------------------------------------------

/**
 * Follow an input of the form: another start, another unit, or another text of a field.
 *
 * @param {import("./fields.js").Change} change
 */
function onChange({ path = "", text = "", unit, start, reset, rebuild }) {
  if (start !== undefined || reset) {
    if (start !== undefined) designs.startFrom(start);
    else designs.reset();
    follow({ rebuild: true, keep: true });
    return;
  }
  if (unit !== undefined) {
    designs.all().fields[path] = unit;
    follow({ rebuild: true, formOnly: true });
    return;
  }
  const { changes } = designs.current();
  const tables = designs.tablesOf(designs.current());
  const others = Object.entries(consequences(path, text, (one) => states.valueAt(tables, one), vocabulary.nuts));
  for (const [one, value] of [...others, [path, text]]) designs.change(one, value);
  form.mark(path, path in changes);
  byId("reset").hidden = !Object.keys(changes).length;
  // a speed of the nut is shown through the lead
  follow({ rebuild: rebuild || others.length > 0 || path === "screw.lead", path });
}

/** The state of the address; a notice names what is unknown here and ignored. */
function readAddress() {
  const { state: found, unknown } = states.fromFragment(location.hash, schema.fieldOf, units.isUnit);
  const unknownStarts = found.designs.filter((one) => !designs.isKnown(one.start)).map((one) => quoted(one.start));
  found.designs = found.designs.map((one) => (designs.isKnown(one.start) ? one : states.design()));
  const lines = [];
  if (unknownStarts.length) {
    lines.push(text("link.start", { names: unknownStarts.join(", ") }));
  }
  if (unknown.length) {
    const names = unknown.slice(0, 3).map(quoted).join(", ") + (unknown.length > 3 ? ", …" : "");
    lines.push(text("link.keys", { names }));
  }
  showNotice(lines.join(" "));
  return found;
}

/** @param {string} name */
function quoted(name) {
  return name.length > LONGEST_QUOTE ? `${name.slice(0, LONGEST_QUOTE)}…` : name;
}

/** @param {(string | Node)[]} words */
function showNotice(...words) {
  byId("notice").replaceChildren(...words);
  byId("notice").hidden = !words.some(Boolean);
}

/**
 * Write the state into the address, and show it.
 *
 * @param {designs.Follow} options ``rebuild`` makes the form
 *   anew, ``keep`` leaves the state before to the button Back, ``formOnly`` sends no request, ``path`` was edited,
 *   ``ofCards`` changes what only cards ask about
 */
async function follow({ rebuild = false, keep = false, formOnly = false, path, ofCards = false } = {}) {
  const state = designs.all();
  if (!formOnly && !ofCards) byId("results").setAttribute("aria-busy", "true");
  const fragment = states.toFragment(state);
  keeping.keep(fragment, state.designs.map(designs.titleOf).join(" · "));
  if (keep) {
    entries.choose(fragment);
    showNotice("");
  } else if (path) entries.edit(fragment, path);
  else entries.replace(fragment);
  try {
    if (rebuild) await showForm();
  } catch (error) {
    results.fail(results.refusal(linesOf(error)));
    return;
  }
  cards.follow();
  if (ofCards) answers.keepWhole(await designs.currentCase());
  else if (!formOnly) await update();
}

async function update() {
  const state = designs.all();
  answers.clearModels();
  await answers.update(
    () => Promise.all(state.designs.map(designs.caseOf)),
    state,
    (faults) => {
      // the laws of the model are known with its answer
      const { answer } = answers.current();
      const found = answer && JSON.stringify([answer.inputs.model, answer.inputs.losses]);
      if (!faults.length && (keepLead(answer) || found !== laws)) {
        laws = found;
        showForm();
      }
      form.showValues(faults.length ? {} : effective());
      return form.showFaults(faults);
    },
  );
}

/**
 * Keep the lead that the design on the page was computed with, where it is no plain number. Returns whether it is new.
 *
 * @param {Run | undefined} answer
 */
function keepLead(answer) {
  const tables = designs.tablesOf(designs.current());
  const lead = states.valueAt(answer?.inputs, "screw.lead");
  const screw = JSON.stringify(tables.screw);
  if (units.parse(states.valueAt(tables, "screw.lead"), "m") || typeof lead !== "number") return false;
  if (leads.get(screw) === lead) return false;
  leads.set(screw, lead);
  return true;
}

/** The values in SI that count: those of the answer, and the usual limits. @returns {states.Tables} */
function effective() {
  const { inputs } = answers.current().answer ?? {};
  const given = /** @type {Record<string, unknown>} */ (inputs?.limits ?? {});
  const limits = Object.entries(vocabulary.limits).map(([name, usual]) => [name, given[name] ?? usual]);
  return { ...inputs, limits: { ...given, ...Object.fromEntries(limits) } };
}

async function showForm() {
  const state = designs.all();
  units.setSystem(state.system);
  select("system").value = units.currentSystem();
  checkbox("band").checked = state.band;
  checkbox("own").checked = state.own;
  const design = designs.current();
  await designs.startOf(design.start);
  if (design !== designs.current()) return; // another one was chosen in the meantime
  const tables = designs.tablesOf(design);
  units.setLead(states.valueAt(tables, "screw.lead"), leads.get(JSON.stringify(tables.screw)));
  // a text stays as it was typed while typing goes on: 0.10 may become 0.107
  /** @param {string} path */
  const given = (path) => {
    const changed = design.changes[path];
    return changed ? changed : states.valueAt(tables, path);
  };
  /** @param {string} path */
  const lawOf = (path) => {
    const known = states.valueAt(answers.current().answer?.inputs, path);
    return typeof known === "string" ? { law: known } : known;
  };
  keepFocus(() => {
    form.build({ state, given, lawOf, onChange });
    form.showValues(effective());
    showTabs();
  });
}

/**
 * Keep the focus and the cursor where they are while their element is made anew.
 *
 * @param {() => void} rebuild
 */
function keepFocus(rebuild) {
  const focused = document.activeElement;
  const id = focused?.id;
  const selection = focused instanceof HTMLInputElement ? [focused.selectionStart, focused.selectionEnd] : [];
  rebuild();
  const again = id && document.activeElement?.id !== id ? document.getElementById(id) : null;
  const { show } = designs.all();
  if (again instanceof HTMLButtonElement && again.disabled) byId(`design-${states.LETTERS[show]}`).focus();
  else again?.focus({ preventScroll: true });
  const [from, to] = selection;
  if (again instanceof HTMLInputElement && typeof from === "number") again.setSelectionRange(from, to ?? from);
}

function showTabs() {
  const state = designs.all();
  /** @param {() => void} action */
  const turn = (action) => () => {
    action();
    follow({ rebuild: true, keep: true });
  };
  const buttons = state.designs.map((one, place) =>
    element(
      "button",
      {
        type: "button",
        class: "tab",
        id: `design-${states.LETTERS[place]}`,
        "aria-pressed": String(place === state.show),
        onclick: turn(() => {
          state.show = place;
        }),
      },
      element("span", { class: "long" }, text("designs.long")),
      states.LETTERS[place],
      " ", // a space within a block of its own is not seen
      one.name ? element("span", { class: "own-name" }, one.name) : null,
    ),
  );
  const add = turn(() => {
    const { start, changes, name, ...own } = designs.current();
    state.designs.push(states.design(start, changes, own));
    state.show = state.designs.length - 1;
  });
  const remove = turn(() => {
    state.designs.splice(state.show, 1);
    state.show = Math.min(state.show, state.designs.length - 1);
  });
  const full = state.designs.length === states.LETTERS.length;
  byId("designs").replaceChildren(
    ...buttons,
    element("button", { type: "button", id: "add", disabled: full, onclick: add }, text("designs.add")),
    element(
      "button",
      { type: "button", id: "remove", disabled: state.designs.length === 1, onclick: remove },
      text("designs.remove"),
    ),
  );
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
    button.textContent = text("share.copied");
  } catch {
    button.textContent = text("share.by_hand");
  }
  setTimeout(() => {
    button.textContent = text("share.copy");
  }, 2500);
}

async function changeSystem() {
  const state = designs.all();
  state.system = select("system").value;
  state.fields = {};
  await follow({ rebuild: true, formOnly: true });
  answers.redisplay();
}

function addListeners() {
  followMenu(select("language"));
  byId("system").addEventListener("change", changeSystem);
  byId("band").addEventListener("change", () => {
    const band = checkbox("band").checked;
    designs.all().band = band;
    follow({ formOnly: true });
    answers.showBand(band);
    answers.showBandsOfDesigns(band);
  });
  byId("own").addEventListener("change", () => {
    designs.all().own = checkbox("own").checked;
    follow();
  });
  byId("calibrate").addEventListener("click", () => {
    const path = "model.calibration";
    const tables = designs.tablesOf(designs.current());
    onChange({ path, text: states.valueAt(tables, path) ? "" : CALIBRATION, rebuild: true });
  });
  byId("bath").addEventListener("click", () => {
    bath.turn();
    follow({ rebuild: true, keep: true });
  });
  byId("share").addEventListener("click", copyLink);
  byId("models-button").addEventListener("click", answers.compareModels);
  byId("form").addEventListener("submit", (event) => event.preventDefault());
  // the fragment of the address is the state: the link to the results must not replace it
  within(document.body, ".skip").addEventListener("click", (event) => {
    event.preventDefault();
    byId("results").focus();
  });
  entries.begin(() => {
    designs.use(readAddress());
    follow({ rebuild: true });
    cards.openAll();
  });
  onReturn(() => {
    follow({ rebuild: true });
    cards.openAll();
  });
  downloads.build(answers.current);
  files.setUp(showNotice);
}

async function begin() {
  const [words, document_, latest] = await Promise.all([get("vocabulary"), get("schema"), keeping.begin()]);
  fill(words);
  units.setVocabulary(words);
  schema.setSchema(document_);
  byId("version").textContent = text("page.version", { version: vocabulary.version });
  designs.setUp(follow);
  if (latest) history.replaceState(null, "", latest.fragment);
  designs.use(readAddress());
  if (latest) files.sayRestored(latest, showNotice);
  units.setSystem(designs.all().system);
  addListeners();
  cards.setUp({
    vocabulary,
    setUnit: (path, unit) => onChange({ path, unit }),
    jump: form.jump,
    keep: () => follow({ ofCards: true }),
  });
  await follow({ rebuild: true });
  document.documentElement.dataset.ready = "true";
  await cards.openAll();
}

begin().catch((error) => results.fail(results.refusal(linesOf(error))));
