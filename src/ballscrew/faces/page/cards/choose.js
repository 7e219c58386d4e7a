// The card of choosing: what a screw has to do, and every row of the catalogue judged by the full model, ranked.

import * as designs from "../designs.js";
import { box, button, framed, namedButton, primaryButton } from "../controls.js";
import { element, fieldIn, within } from "../dom.js";
import { inWords, labelOf, markFaults } from "../messages.js";
import { fieldFor, labelIn } from "../fields.js";
import { drop, keptJob } from "../jobs.js";
import { FIELDS, LISTS, OF_MASS } from "../needs.js";
import * as schema from "../schema.js";
import { get, Latest, sendJson } from "../server.js";
import { valueAt } from "../state.js";
import { store } from "../store.js";
import { nameOfCheck } from "../names.js";
import * as units from "../units.js";
import { asTheyCome, candidates } from "./candidates.js";
import { leftOut, missingIn, tables } from "./need_tables.js";
import { question } from "./question.js";

/** Hints in the fields of a need. @type {Record<string, string>} */
const HINTS = {
  accuracy: "e.g. 5 or T7",
  inclination: "90° is upwards",
  mass: "in place of a force",
  preload: "e.g. 5 % or 2 kN",
  unsupported_length: "stroke + nut + run-outs",
};

/** @type {Record<string, import("../schema.js").SchemaNode>} */
const OF_NEEDS = { back_driving: { enum: ["allowed", "needed", "forbidden"], default: "allowed" }, accuracy: {} };
const ADDRESS = "select";

/** @typedef {import("../state.js").Need} Need */
/** @typedef {import("../state.js").Frozen<Need>} FrozenNeed */

/** @param {HTMLElement} holder @returns {import("../cards.js").Card} */
export function setUp(holder) {
  const fields = element("div", { class: "grid" });
  const sources = element("div", {});
  const wanted = element("p", { class: "warning", id: "choose-wanted", "aria-live": "polite", hidden: true });
  const faults = element("div", { class: "faults" });
  const counted = element("p", { role: "status", hidden: true });
  const result = element("div", { id: "choose-result", "aria-live": "off" });
  const asked = question({
    address: ADDRESS,
    result,
    show: (found) => {
      candidates(result, found);
      counted.textContent = counts(found);
      counted.hidden = false;
    },
    place: (lines) => {
      place(lines);
      return undefined;
    },
    isLarge: () => true,
    about: () => about,
    begun: () => {
      coming = [];
      counted.hidden = true;
    },
    news: ({ rows }) => {
      if (!rows.length) return;
      coming.push(.../** @type {any[]} */ (rows));
      asTheyCome(result, coming);
    },
    doing: () => cost || "computing …",
  });
  const start = primaryButton("choose-start", "Find screws", () => ask());
  const fill = button("Take load, length, life and oil of the design", () => takeDesign());
  holder.replaceChildren(
    framed(
      "What the screw has to do",
      element(
        "p",
        { class: "small" },
        "Give force and feed, or a mass with acceleration, feed and stroke: the screw is then judged by the cycle there and back, at its peak load and by its mean.",
      ),
      wanted,
      fields,
      sources,
    ),
    element("p", {}, start, " ", fill),
    faults,
    asked.line,
    counted,
    result,
  );
  /** Schemas of the fields that only needs have. @type {Record<string, import("../schema.js").SchemaNode>} */
  let known = {};
  /** What the fields were made of. */
  let shown = "";
  /** The table of one's own that may take the place of the catalogue. @type {typeof store.state.table} */
  let offered;
  /** What is asked for, and the candidates that are known by now. @type {object} */
  let about = {};
  /** @type {import("./candidates.js").Row[]} */
  let coming = [];
  const requests = new Latest();
  let withTable = true;
  /** What a selection costs, and the inputs that somebody has said may stay empty. */
  let [cost, agreed] = ["", ""];

  const need = () => store.state.need;

  function build() {
    const { texts, units } = need();
    const state = { ...store.state, fields: units };
    /** @param {string} path */
    const given = (path) => texts[path.slice("need.".length)];
    const made = Object.entries(FIELDS).map(([name, path]) => {
      const node = (path ? schema.fieldOf(path) : known[name]) ?? {};
      return fieldFor(`need.${name}`, LISTS.includes(name) ? {} : node, { state, given, onChange });
    });
    for (const field of made) {
      const hint = HINTS[nameOf(field)] ?? "";
      if (!hint) continue;
      const input = within(field, "input, select");
      if (!field.querySelector("select.unit")) input.setAttribute("placeholder", hint);
      else {
        // beside a unit there is no room for it
        const id = `${input.id}-hint`;
        input.setAttribute("aria-describedby", `${input.getAttribute("aria-describedby")} ${id}`);
        within(field, ".entry").after(element("span", { id, class: "small" }, hint));
      }
    }
    fields.replaceChildren(...made);
    bar();
    showSources();
    shown = JSON.stringify(need());
  }

  /** Close the fields that others stand for, and say which are still to be given. */
  function bar() {
    const missing = missingIn(need()).map((name) => labelIn(name));
    wanted.hidden = !missing.length;
    wanted.textContent = missing.length ? `Still to be given: ${missing.join(", ")}.` : "";
    const closed = leftOut(need());
    for (const field of /** @type {NodeListOf<HTMLElement>} */ (fields.querySelectorAll(".field"))) {
      /** @type {NodeListOf<HTMLInputElement | HTMLSelectElement>} */
      const controls = field.querySelectorAll("input, select");
      for (const control of controls) control.disabled = closed.includes(nameOf(field));
    }
  }

  /** The duty of the current design, and a table of one's own in place of the catalogue. */
  async function showSources() {
    const { table } = store.state;
    offered = table;
    const moves = "motion" in (await designs.currentCase());
    const ofTable = (/** @type {boolean} */ isChecked) => {
      withTable = isChecked;
    };
    sources.replaceChildren(
      moves
        ? box("by the duty of the design on the page, in place of force and feed", need().duty, (duty) =>
            write({ ...need(), duty }),
          )
        : "",
      table ? box(`from ${table.file.name}, in place of the catalogue`, withTable, ofTable) : "",
    );
  }

  /** @param {FrozenNeed} found @param {string} [path] */
  function write(found, path) {
    shown = path ? JSON.stringify(found) : "";
    designs.setNeed(found, path);
  }

  /** @param {import("../fields.js").Change} change */
  function onChange({ path = "", text: typed = "", unit }) {
    const { texts, units, ...others } = need();
    if (unit !== undefined) write({ ...others, texts, units: { ...units, [path]: unit } });
    else write({ ...others, units, texts: { ...texts, [path.slice("need.".length)]: typed } }, path);
    bar();
  }

  /** Take load, length, life and oil from the design on the page. */
  async function takeDesign() {
    const found = await designs.currentCase();
    const entries = Object.entries(FIELDS).flatMap(([name, path]) => {
      const value = path && !["nut", "preload", ...OF_MASS].includes(name) ? valueAt(found, path) : undefined;
      return typeof value === "string" || typeof value === "number" ? [[name, String(value)]] : [];
    });
    write({ ...need(), texts: { ...need().texts, ...Object.fromEntries(entries) }, duty: "motion" in found });
  }

  async function ask() {
    asked.cancel();
    counted.hidden = true;
    const signal = requests.begin();
    asked.line.replaceChildren(element("p", {}, "computing …"));
    const table = withTable ? store.state.table?.file : undefined;
    try {
      const made = await tables(need());
      const body = { need: made, ...(table && { table }) };
      if (signal.aborted || !(await isAgreed(body, signal))) return;
      about = made;
      if (asked.follow(body, 0)) counted.hidden = false;
    } catch (error) {
      if (!signal.aborted) asked.refuse(error);
    }
  }

  /**
   * Test whether to start: a need that leaves open what checks want is asked about first, once.
   *
   * @param {object} body
   * @param {AbortSignal} signal
   */
  async function isAgreed(body, signal) {
    /** @type {SelectPlan} */
    const plan = await sendJson("select/plan", body, signal);
    const inputs = plan.unasked.map(({ input }) => labelOf(input)).join(", ");
    cost = `Candidates: ${plan.candidates}, ${units.digits(Math.max(1, plan.seconds), 2)} s of a processor at most.`;
    if (!inputs || inputs === agreed) return true;
    const names = [...new Set(plan.unasked.flatMap(({ checks }) => checks))];
    const checks = names.map((name) => nameOfCheck({ name })).join(", ");
    const anyway = namedButton("choose-anyway", "Start without them", () => {
      agreed = inputs;
      ask();
    });
    place([]);
    asked.line.replaceChildren(
      element(
        "p",
        { class: "warning", role: "alert" },
        `Nothing is given for ${inputs}. Without it these checks are not judged: ${checks}; a screw passes only once all checks are judged. Fill it in, or start without.`,
      ),
      element("p", {}, `${cost} `, anyway),
    );
    return false;
  }

  /** Go on with what was begun before the page was loaded again, unless the need has become another one. */
  async function resume() {
    const kept = keptJob(ADDRESS);
    if (!kept) return;
    if (JSON.stringify(await tables(need())) === JSON.stringify(kept.about)) asked.resume();
    else if (keptJob(ADDRESS)?.id === kept.id) drop(ADDRESS); // none that was begun meanwhile
  }

  /**
   * Show faults beside the fields that they name, and the others above the list.
   *
   * @param {FaultLine[]} lines
   */
  function place(lines) {
    const others = markFaults(fields, lines, ({ where }) => {
      const known = Object.entries(FIELDS).find(([name, path]) => [path, `need.${name}`, name].includes(where));
      return known && fieldIn(fields, `need.${known[0]}`);
    });
    faults.replaceChildren(...others.map((fault) => element("p", {}, `${labelOf(fault.where)}: ${inWords(fault)}`)));
    fields.querySelector(".wrong")?.scrollIntoView({ block: "nearest" });
  }

  const ready = get("need-schema").then(async (found) => {
    known = { ...found.$defs.Need.properties, ...OF_NEEDS };
    const { texts, rest } = need();
    if (Object.keys({ ...texts, ...rest }).length) build();
    else await takeDesign();
    resume();
  });
  return {
    follow: () => {
      ready.then(() => {
        if (JSON.stringify(need()) !== shown) build();
        else if (store.state.table !== offered) showSources();
      });
    },
  };
}

/** @param {HTMLElement} field */
function nameOf(field) {
  return (field.dataset.path ?? "").slice("need.".length);
}

/** @param {Select} found */
function counts({ candidates: all, holding }) {
  return `Candidates: ${all.length}, ${holding} of which hold all checks.`;
}
