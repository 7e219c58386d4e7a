// The form, made from the JSON Schema of the case file. It shows the kept texts and reports what is typed.

import { byId, element } from "./dom.js";
import * as units from "./units.js";

const SECTIONS = {
  operation: "Operating point", screw: "Screw", lubricant: "Oil", nut: "Nut", model: "Model",
  losses: "Seals and other losses", installation: "Installation", limits: "Limits",
  bodies: "Elastic bodies", deviations: "Balls that differ",
};
const HINTS = {
  bodies: "Screw and nut of a catalogue row are elastic; those of the paper are rigid, unless something is given here. Sizes left out are the usual ones.",
  installation: "For the checks of the report.", limits: "For the checks of the report.",
};
const OPEN = ["operation", "screw", "lubricant"], OPEN_ON_PHONE = ["operation"];
const LEFT_OUT = ["screw.catalogue", "screw.catalogue_file"];
const INCH_ONLY = ["in", "uin", "lbf", "lbf in", "psi", "degF"];

let schema;
let changed;

export function learn(document, report) {
  schema = document;
  changed = report;
}

function own(table, name) { return table && Object.hasOwn(table, name) ? table[name] : undefined; }

function definition(node) {
  return node?.$ref ? schema.$defs[node.$ref.split("/").pop()] : node;
}

function section(name) {
  const node = own(schema.properties, name);
  return definition(node?.anyOf ? node.anyOf[0] : node);
}

/** The schema of a field of the form by its path: ``screw.lead``, ``model.friction.boundary_friction_coefficient``. */
export function fieldOf(path) {
  const [name, field, inner, ...others] = path.split(".");
  if (!own(SECTIONS, name) || LEFT_OUT.includes(`${name}.${field}`) || others.length) return undefined;
  const node = definition(own(section(name).properties, field));
  if (inner === undefined || !node) return node;
  if (node.properties) return definition(own(node.properties, inner));
  return node.anyOf?.map((one) => own(one.properties, inner)).find((one) => one);
}

function words(name) { return name.replaceAll("_", " "); }

function isLaw(node) { return node.anyOf?.some((one) => one.properties?.law); }

/** Build the whole form. ``value(path)`` is the kept text or number, ``law(path)`` the law in a slot and its coefficients. */
export function build(state, vocabulary, value, law) {
  const form = byId("form");
  const open = new Set([...form.querySelectorAll("details")].filter((one) => one.open).map((one) => one.dataset.section));
  const first = !form.children.length;
  const usual = matchMedia("(max-width: 46rem)").matches ? OPEN_ON_PHONE : OPEN;
  const parts = Object.keys(SECTIONS).map((name) => element("details",
    { "data-section": name, open: first ? usual.includes(name) : open.has(name) },
    element("summary", { id: `s-${name}` }, SECTIONS[name]), element("fieldset", {}, element("legend", { class: "hidden" }, SECTIONS[name]),
      HINTS[name] ? element("p", { class: "small" }, HINTS[name]) : null,
      ...Object.entries(section(name).properties).flatMap(([field, node]) => rows(`${name}.${field}`, definition(node), state, value, law)))));
  // the list of starts stays: who chooses from it by letters is not interrupted
  if (first) form.append(start(vocabulary));
  while (form.children.length > 1) form.lastChild.remove();
  form.append(...parts);
  byId("start").value = state.designs[state.show].start;
  byId("reset").hidden = !Object.keys(state.designs[state.show].changes).length;
  for (const path of Object.keys(state.designs[state.show].changes)) mark(path, true);
}

/** Mark a field that differs from the start. */
export function mark(path, differs) {
  const field = fieldAt(path);
  field?.classList.toggle("changed", differs);
  const words = field?.querySelector(".differs");
  if (words) words.textContent = differs ? " changed" : "";
}

function fieldAt(path) { return [...byId("form").querySelectorAll("[data-path]")].find((one) => one.dataset.path === path); }

function start(vocabulary) {
  const groups = new Map();
  for (const row of vocabulary.rows) groups.set(row.source, [...(groups.get(row.source) ?? []), row]);
  const option = (name, text) => element("option", { value: name }, text);
  const select = element("select", { id: "start", onchange: (event) => changed({ start: event.target.value }) },
    element("optgroup", { label: "Papers" }, ...Object.entries(vocabulary.starts).map(([name, one]) => option(name, one.title))),
    ...[...groups].map(([source, rows]) => element("optgroup", { label: source },
      ...rows.map((row) => option(row.name, `${row.name} (${row.nut} nut)`.replace(/-(\w+) \(\1 nut\)/, " ($1 nut)"))))));
  const reset = element("button", { type: "button", id: "reset", onclick: () => changed({ start: select.value }), title: "Undo all changes of this design" }, "Reset");
  return element("div", { class: "field start given" }, element("label", { for: "start" }, "Start from"), select, reset);
}

function rows(path, node, state, value, law) {
  if (LEFT_OUT.includes(path)) return [];
  if (node.properties) {
    return [element("details", { class: "inner", "data-section": path }, element("summary", { id: `s-${path}` }, words(path.split(".")[1])),
      element("fieldset", {}, element("legend", { class: "hidden" }, words(path.split(".")[1])),
        ...Object.entries(node.properties).flatMap(([name, inner]) => rows(`${path}.${name}`, definition(inner), state, value, law))))];
  }
  if (isLaw(node)) return lawRows(path, node, state, value, law);
  if (node.enum || node.type === "boolean") return [choice(path, node, value(path))];
  return [number(path, node, state, value(path))];
}

function lawRows(path, node, state, value, law) {
  const names = node.anyOf.find((one) => one.enum)?.enum ?? [];
  const present = law(path);
  const kept = value(path);
  const named = typeof kept === "object" && kept !== null ? kept.law : kept;
  const found = [choice(path, { enum: names, description: node.description }, named, present?.law)];
  const chosen = named ?? present?.law;
  const table = node.anyOf.find((one) => one.properties?.law?.const === chosen);
  for (const [name, inner] of Object.entries(table?.properties ?? {})) {
    if (name !== "law") found.push(number(`${path}.${name}`, inner, state, value(`${path}.${name}`), present?.[name], "inner"));
  }
  return found;
}

function frame(path, node, given, control, ...others) {
  const id = `f-${path.replaceAll(".", "-")}`;
  control.id = id;
  control.setAttribute("aria-describedby", `${id}-about ${id}-fault`);
  return element("div", { class: given ? "field given" : "field", "data-path": path, title: node.description },
    element("label", { for: id }, words(path.split(".").pop()), element("span", { class: "differs" })), element("div", { class: "entry" }, control, ...others),
    element("p", { id: `${id}-about`, class: "hidden" }, node.description ?? ""), element("p", { id: `${id}-fault`, class: "fault" }));
}

function choice(path, node, kept, present) {
  const options = node.type === "boolean" ? ["true", "false"] : node.enum;
  const empty = present ? `as in the model: ${present}` : node.default ? `usual: ${node.default}` : "not given";
  const select = element("select", { onchange: (event) => changed({ path, text: event.target.value, rebuild: true }) },
    element("option", { value: "" }, empty),
    ...options.map((name) => element("option", { value: name, selected: String(kept) === name }, name)));
  return frame(path, node, kept !== undefined, select);
}

/** The unit that a field is shown in: chosen for it, or that of the system, or that it was typed in. */
export function unitOf(path, node, kept, state) {
  if (state.fields[path]) return state.fields[path];
  const typed = units.taken(kept ?? "", node["x-si-unit"])?.unit ?? node["x-unit"];
  if (units.currentSystem() === "metric") return INCH_ONLY.includes(typed) ? node["x-unit"] : typed;
  return units.unitHere(typed);
}

function number(path, node, state, kept, present, style) {
  const si = node["x-si-unit"];
  const input = element("input", { type: "text", inputmode: "decimal", spellcheck: "false" });
  input.addEventListener("keydown", (event) => step(event, input));
  if (!si) {
    input.value = kept ?? "";
    input.placeholder = String(present ?? node.examples?.[0] ?? "");
    input.addEventListener("input", () => typed(path, input, input.value.trim()));
    return styled(frame(path, node, kept !== undefined, input), style);
  }
  const unit = unitOf(path, node, kept, state);
  const shown = kept === undefined ? "" : units.digitsIn(kept, unit, si);
  const asWritten = kept !== undefined && shown === null;
  input.value = kept === undefined ? "" : shown ?? String(kept);
  input.placeholder = kept === undefined ? usual(node.examples?.[0], unit, si) : "";
  const known = [...new Set([unit, ...units.choices(si).map((one) => one.unit)])];
  const select = element("select", { class: "unit", id: `u-${path.replaceAll(".", "-")}`, "aria-label": `unit of ${words(path.split(".").pop())}` },
    asWritten ? element("option", { value: "", selected: true }, "as typed") : null,
    ...known.map((name) => element("option", { value: name, selected: !asWritten && name === unit }, units.spoken(name))));
  select.addEventListener("change", () => changed({ path, unit: select.value, rebuild: true }));
  input.addEventListener("input", () => {
    const text = input.value.trim();
    const bare = text !== "" && /^[\s\d.eE+±-]*$/.test(text);
    if (bare && !select.value) select.value = unit;
    typed(path, input, bare ? `${text} ${select.value}` : text);
  });
  // a unit that was typed goes where units stand
  input.addEventListener("change", () => {
    const found = units.taken(input.value, si);
    if (found) [input.value, select.value] = [found.digits, found.unit];
  });
  return styled(frame(path, node, kept !== undefined, input, select), style);
}

function typed(path, input, text) {
  input.closest(".field").classList.toggle("given", text !== "");
  changed({ path, text });
}

/** What stands where nothing is typed: the usual value. */
function usual(example, unit, si) {
  const text = units.digitsIn(example ?? "", unit, si);
  return text === null ? "" : units.digits(Number(text));
}

function styled(field, style) {
  if (style) field.classList.add(style);
  return field;
}

/** Arrow keys step the second digit of a number; with shift, the first. */
function step(event, input) {
  if (event.key !== "ArrowUp" && event.key !== "ArrowDown") return;
  const text = input.value || input.placeholder;
  const value = Number(text);
  if (!text.trim() || !Number.isFinite(value)) return;
  event.preventDefault();
  const size = value === 0 ? 1 : 10 ** (Math.floor(Math.log10(Math.abs(value)) + 1e-9) - (event.shiftKey ? 0 : 1));
  input.value = String(Number((value + (event.key === "ArrowUp" ? size : -size)).toPrecision(12)));
  input.dispatchEvent(new Event("input", { bubbles: true }));
}

/** Show faults beside the fields that they name; those of no field are returned. */
export function showFaults(faults) {
  const homeless = [];
  for (const field of byId("form").querySelectorAll(".field.wrong")) {
    field.classList.remove("wrong");
    field.querySelector(".fault").textContent = "";
    field.querySelector("[aria-invalid]")?.removeAttribute("aria-invalid");
  }
  for (const { where, line } of faults) {
    const field = fieldAt(where);
    if (!field) { homeless.push(line); continue; }
    field.classList.add("wrong");
    field.querySelector(".fault").textContent = line.slice(where.length + 2);
    field.querySelector("input, select").setAttribute("aria-invalid", "true");
    for (let holder = field.closest("details"); holder; holder = holder.parentElement.closest("details")) holder.open = true;
  }
  return homeless;
}
