// The form, made from the JSON Schema of the case file. It shows the texts of the state and reports what is typed.

import { current, isOfFile, ownScrewOf, setAside, setTables, tablesOf } from "./designs.js";
import { box, button } from "./controls.js";
import { byId, element, fieldIn, NARROW, within } from "./dom.js";
import { inWords, labelOf, markFaults } from "./messages.js";
import { choiceField, fieldFor, labelIn, numberField, showEffective } from "./fields.js";
import * as help from "./help.js";
import { slidersOf } from "./operating_point.js";
import { definition, fieldOf, fieldsOf, isLaw, LEFT_OUT, SECTIONS } from "./schema.js";
import { valueAt } from "./state.js";
import { vocabulary } from "./vocabulary.js";

/** @import { Source } from "./fields.js" */
/** @import { SchemaNode } from "./schema.js" */
/** @import { FrozenState as State } from "./state.js" */

/** The kind of a fault of what no case has. */
const UNKNOWN = "unknown";
/** @type {Record<string, string>} */
const HINTS = {
  bodies:
    "Screw and nut of a catalogue row are elastic; those of the paper are rigid, unless something is given here. Sizes left out are the usual ones.",
  installation: "For the checks of the report.",
  limits: "For the checks of the report.",
};
/** Fields that nearly everybody gives; the others of their sections are behind "more". @type {Record<string, string[]>} */
const ESSENTIAL = {
  screw: ["pitch_circle_diameter", "lead", "ball_diameter", "loaded_balls"],
  nut: ["type", "preload"],
  lubricant: ["grade", "temperature", "viscosity"],
};
const OPEN = ["operation", "screw", "nut", "lubricant"];
const OPEN_ON_PHONE = ["operation"];

/**
 * Build the whole form.
 *
 * @param {Source & { state: State }} source
 */
export function build(source) {
  const { state } = source;
  const form = byId("form");
  const sections = [...form.querySelectorAll("details")];
  const open = new Set(sections.filter((one) => one.open).map((one) => one.dataset.section));
  const isFirst = !form.children.length;
  const openFirst = NARROW.matches ? OPEN_ON_PHONE : OPEN;
  const parts = Object.entries(SECTIONS).map(([name, title]) =>
    section(
      name,
      title,
      { open: isFirst ? openFirst.includes(name) : open.has(name) },
      HINTS[name] ? element("p", { class: "small" }, HINTS[name]) : null,
      name === "bodies" ? elasticBox() : null,
      ...fieldsOfSection(name, title, open, source),
    ),
  );
  // the list of starts stays: typing the first letters of one is not interrupted
  if (isFirst) form.append(startField(source));
  const helping = help.placeIn(form);
  while (form.children.length > 1) form.lastChild?.remove();
  form.append(...parts, helping);
  const { start, changes } = state.designs[state.show];
  showStart(start, ownScrewOf(state.designs[state.show]));
  showElastic();
  byId("reset").hidden = !Object.keys(changes).length;
  for (const path of Object.keys(changes)) mark(path, true);
}

/**
 * The fields of a section; those that few give are in a part of their own.
 *
 * @param {string} name
 * @param {string} title
 * @param {Set<string | undefined>} open the parts that stay open
 * @param {Source} source
 */
function fieldsOfSection(name, title, open, source) {
  const all = Object.entries(fieldsOf(name));
  const first = ESSENTIAL[name] ?? all.map(([field]) => field);
  /** @param {[string, SchemaNode][]} entries */
  const made = (entries) => entries.flatMap(([field, node]) => fields(`${name}.${field}`, node, source));
  const essential = first.flatMap((wanted) => all.filter(([field]) => field === wanted));
  const others = all.filter(([field]) => !first.includes(field));
  if (!others.length) return made(essential);
  const id = `${name}-more`;
  const more = section(id, `more: ${title}`, { class: "inner", open: open.has(id) }, ...made(others));
  return [...made(essential), more];
}

/**
 * A part of the form that opens and closes.
 *
 * @param {string} name
 * @param {string} title
 * @param {import("./dom.js").Attributes} attributes
 * @param {(Node | null)[]} children
 */
function section(name, title, attributes, ...children) {
  return element(
    "details",
    { "data-section": name, ...attributes },
    element("summary", { id: `s-${name}` }, title),
    element("fieldset", {}, element("legend", { class: "hidden" }, title), ...children),
  );
}

/** The box that gives the design elastic bodies of the usual sizes, or takes its bodies out. */
function elasticBox() {
  const turn = (/** @type {boolean} */ isElastic) => setTables({ bodies: isElastic ? {} : null });
  return element("p", { class: "small" }, box("Screw and nut are elastic", false, turn, { id: "elastic" }));
}

function showElastic() {
  const box = /** @type {HTMLInputElement} */ (byId("elastic"));
  box.checked = tablesOf(current()).bodies !== undefined;
}

/**
 * Mark a field that differs from the start.
 *
 * @param {string} path
 * @param {boolean} differs
 */
export function mark(path, differs) {
  showElastic();
  const field = fieldAt(path);
  if (!field) return;
  field.classList.toggle("changed", differs);
  within(field, ".differs").textContent = differs ? " changed" : "";
}

/** @param {string} path */
function fieldAt(path) {
  return fieldIn(byId("form"), path);
}

/** @param {Source} source */
function startField({ onChange }) {
  const { starts, rows } = vocabulary;
  /** @type {Map<string, Vocabulary["rows"]>} */
  const groups = new Map();
  for (const row of rows.filter(({ refusal }) => !refusal)) {
    groups.set(row.group, [...(groups.get(row.group) ?? []), row]);
  }
  /**
   * @param {string} name
   * @param {string} words
   */
  const option = (name, words) => element("option", { value: name }, words);
  const known = Object.entries(starts);
  /** @param {[string, Vocabulary["starts"][string]]} start */
  const startOption = ([name, { title }]) => option(name, title);
  const select = element(
    "select",
    { id: "start", onchange: () => onChange({ start: select.value }) },
    element("optgroup", { label: "Papers" }, ...known.filter(([, { moves }]) => !moves).map(startOption)),
    element("optgroup", { label: "Examples of axes" }, ...known.filter(([, { moves }]) => moves).map(startOption)),
    ...[...groups].map(([label, members]) =>
      element("optgroup", { label }, ...members.map((row) => option(row.name, rowLabel(row)))),
    ),
  );
  const title = "Undo all changes of this design";
  const reset = button("Reset", () => onChange({ reset: true }), { id: "reset", title });
  const label = element("label", { for: "start" }, "Start from");
  return element("div", { class: "field start given" }, label, select, reset);
}

/**
 * Show what a design starts from: a case to start from, a row, or what it has a screw of its own from.
 *
 * @param {string} start
 * @param {string | undefined} file
 */
function showStart(start, file) {
  const select = /** @type {HTMLSelectElement} */ (byId("start"));
  select.querySelector("[data-file]")?.remove();
  if (file) select.prepend(element("option", { value: "", hidden: true, "data-file": file }, file));
  select.value = file ? "" : start;
}

/**
 * A row without the kind of nut at the end of its name, which follows in parentheses.
 *
 * @param {Vocabulary["rows"][number]} row
 */
export function rowLabel({ name, nut }) {
  const end = `-${nut}`;
  return `${name.endsWith(end) ? name.slice(0, -end.length) : name} (${nut} nut)`;
}

/**
 * The fields of a node of the schema.
 *
 * @param {string} path
 * @param {SchemaNode} unresolved
 * @param {Source} source
 * @returns {HTMLElement[]}
 */
function fields(path, unresolved, source) {
  const node = definition(unresolved);
  if (!node || LEFT_OUT.includes(path)) return [];
  if (node.properties) {
    const inner = Object.entries(node.properties);
    const children = inner.flatMap(([name, one]) => fields(`${path}.${name}`, one, source));
    return [section(path, labelIn(path), { class: "inner" }, ...children)];
  }
  if (isLaw(node)) return lawFields(path, node, source);
  const field = fieldFor(path, node, source);
  return [field, ...slidersOf(path, field, labelIn(path), node)];
}

/**
 * The choice of a law, and its coefficients.
 *
 * @param {string} path
 * @param {SchemaNode} node
 * @param {Source} source
 */
function lawFields(path, node, source) {
  const options = node.anyOf ?? [];
  const names = options.find((one) => one.enum)?.enum ?? [];
  const present = source.lawOf?.(path);
  const value = source.given(path);
  const named = typeof value === "object" && value !== null ? value.law : value;
  const chosen = named ?? present?.law;
  const coefficients = options.find((one) => one.properties?.law?.const === chosen)?.properties ?? {};
  return [
    choiceField(path, { enum: names, description: node.description }, named, source.onChange, present?.law),
    ...Object.entries(coefficients)
      .filter(([name]) => name !== "law")
      .flatMap(([name, inner]) => {
        const field = numberField(`${path}.${name}`, inner, source, present?.[name]);
        field.classList.add("inner");
        return [field, ...slidersOf(`${path}.${name}`, field, labelIn(name), inner)];
      }),
  ];
}

/**
 * Show what counts where nothing is typed.
 *
 * @param {import("./state.js").Tables} values in SI
 */
export function showValues(values) {
  /** @type {NodeListOf<HTMLElement>} */
  const fields = byId("form").querySelectorAll("[data-path]");
  for (const field of fields) {
    const path = field.dataset.path ?? "";
    showEffective(field, fieldOf(path), valueAt(values, path) ?? undefined);
  }
}

/**
 * Show faults beside the fields that they name, and bring the first one into view.
 *
 * @param {FaultLine[]} faults
 * @returns {import("./results.js").Refusal} what stands above the answer: links to the fields, and faults of no field
 */
export function showFaults(faults) {
  const others = markFaults(byId("form"), faults, ({ where }) => fieldAt(pathOf(where))).map(ofNoField);
  const wrong = [.../** @type {NodeListOf<HTMLElement>} */ (byId("form").querySelectorAll(".field.wrong"))];
  wrong.forEach(open);
  const [first] = wrong;
  if (first && !first.contains(document.activeElement)) first.scrollIntoView({ block: "nearest" });
  const links = wrong.map((field) => button(labelOf(field.dataset.path ?? ""), () => jumpTo(field)));
  const intro = `${links.length === 1 ? "Not computed. Correct this field:" : "Not computed. Correct these fields:"} `;
  const line = links.length ? [element("span", {}, intro, ...links)] : [];
  const said = faults.map((fault) => `${labelOf(fault.where)}: ${inWords(fault)}`).join(" ");
  return { lines: [...line, ...others], said };
}

/**
 * A fault that has no field; what a file has beyond a case can be kept aside.
 *
 * @param {FaultLine} fault
 */
function ofNoField(fault) {
  const line = `${labelOf(fault.where)}: ${inWords(fault)}`;
  if (fault.id !== UNKNOWN || !isOfFile(fault.where)) return line;
  const label = `Keep ${labelOf(fault.where)} aside: it is not computed with`;
  const keep = button("Keep it aside", () => setAside(fault.where), { "aria-label": label });
  return element("span", {}, `${line} `, keep);
}

/**
 * The field that a fault names; a section that is missing has its first field.
 *
 * @param {string} where
 */
function pathOf(where) {
  if (fieldAt(where)) return where;
  const parts = where.split(".");
  while (parts.length > 2) {
    parts.pop();
    if (fieldAt(parts.join("."))) return parts.join(".");
  }
  return where;
}

/** @param {HTMLElement} field */
function open(field) {
  for (let holder = field.closest("details"); holder; ) {
    holder.open = true;
    holder = holder.parentElement?.closest("details") ?? null;
  }
}

/** @param {HTMLElement} field */
function jumpTo(field) {
  open(field);
  field.scrollIntoView({ block: "center" });
  within(field, "input, select").focus();
}

/**
 * Go to the field at a path, as a check that lacks it asks for.
 *
 * @param {string} path
 */
export function jump(path) {
  const field = fieldAt(path);
  if (field) jumpTo(field);
}
