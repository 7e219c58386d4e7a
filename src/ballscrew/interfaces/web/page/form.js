// The form, made from the JSON Schema of the case file. It shows the kept texts and reports what is typed.

import { byId, element } from "./dom.js";
import * as units from "./units.js";

const SECTIONS = {
  operation: "Operating point", screw: "Screw", lubricant: "Oil", nut: "Nut", model: "Model",
  losses: "Seals and other losses", installation: "Installation", limits: "Limits",
  bodies: "Elastic bodies", deviations: "Balls that differ",
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

function definition(node) {
  return node?.$ref ? schema.$defs[node.$ref.split("/").pop()] : node;
}

function section(name) {
  const node = schema.properties[name];
  return definition(node?.anyOf ? node.anyOf[0] : node);
}

/** The schema of a field by its path: ``screw.lead``, ``model.friction.boundary_friction_coefficient``. */
export function fieldOf(path) {
  const [name, field, inner] = path.split(".");
  const node = definition(section(name)?.properties?.[field]);
  if (!inner) return node;
  if (node?.properties) return definition(node.properties[inner]);
  return node?.anyOf?.map((one) => one.properties?.[inner]).find((one) => one);
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
    element("summary", {}, SECTIONS[name]), element("fieldset", {}, element("legend", { class: "hidden" }, SECTIONS[name]),
      ...Object.entries(section(name).properties).flatMap(([field, node]) => rows(`${name}.${field}`, definition(node), state, value, law)))));
  form.replaceChildren(start(state, vocabulary), ...parts);
}

function start(state, vocabulary) {
  const groups = new Map();
  for (const row of vocabulary.rows) groups.set(row.source, [...(groups.get(row.source) ?? []), row]);
  const current = state.designs[state.show].start;
  const option = (name, text) => element("option", { value: name, selected: name === current }, text);
  const select = element("select", { id: "start", onchange: (event) => changed({ start: event.target.value }) },
    element("optgroup", { label: "Papers" }, ...Object.entries(vocabulary.starts).map(([name, one]) => option(name, one.title))),
    ...[...groups].map(([source, rows]) => element("optgroup", { label: source },
      ...rows.map((row) => option(row.name, `${row.name} (${row.nut} nut)`.replace(/-(\w+) \(\1 nut\)/, " ($1 nut)"))))));
  return element("div", { class: "field start" }, element("label", { for: "start" }, "Start from"), select);
}

function rows(path, node, state, value, law) {
  if (LEFT_OUT.includes(path)) return [];
  if (node.properties) {
    return [element("details", { class: "inner", "data-section": path }, element("summary", {}, words(path.split(".")[1])),
      ...Object.entries(node.properties).flatMap(([name, inner]) => rows(`${path}.${name}`, definition(inner), state, value, law)))];
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

function frame(path, node, control, ...others) {
  const id = `f-${path.replaceAll(".", "-")}`;
  control.id = id;
  control.setAttribute("aria-describedby", `${id}-about ${id}-fault`);
  return element("div", { class: "field", "data-path": path, title: node.description },
    element("label", { for: id }, words(path.split(".").pop())), element("div", { class: "entry" }, control, ...others),
    element("p", { id: `${id}-about`, class: "hidden" }, node.description ?? ""), element("p", { id: `${id}-fault`, class: "fault" }));
}

function choice(path, node, kept, present) {
  const options = node.type === "boolean" ? ["true", "false"] : node.enum;
  const empty = present ? `as in the model: ${present}` : node.default ? `usual: ${node.default}` : "not given";
  const select = element("select", { onchange: (event) => changed({ path, text: event.target.value, rebuild: true }) },
    element("option", { value: "" }, empty),
    ...options.map((name) => element("option", { value: name, selected: String(kept) === name }, name)));
  return frame(path, node, select);
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
    input.addEventListener("input", () => changed({ path, text: input.value }));
    return styled(frame(path, node, input), style);
  }
  const unit = unitOf(path, node, kept, state);
  const shown = kept === undefined ? "" : units.digitsIn(kept, unit, si);
  const asWritten = kept !== undefined && shown === null;
  input.value = kept === undefined ? "" : shown ?? String(kept);
  input.placeholder = kept === undefined ? usual(node.examples?.[0], unit, si) : "";
  const known = [...new Set([unit, ...units.choices(si).map((one) => one.unit)])];
  const select = element("select", { class: "unit", "aria-label": `unit of ${words(path.split(".").pop())}` },
    asWritten ? element("option", { value: "", selected: true }, "as written") : null,
    ...known.map((name) => element("option", { value: name, selected: !asWritten && name === unit }, units.spoken(name))));
  select.addEventListener("change", () => changed({ path, unit: select.value, rebuild: true }));
  input.addEventListener("input", () => {
    const bare = /^[\s\d.eE+-]*$/.test(input.value);
    changed({ path, text: bare && input.value.trim() ? `${input.value.trim()} ${select.value}`.trim() : input.value.trim() });
  });
  return styled(frame(path, node, input, select), style);
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
    const field = [...byId("form").querySelectorAll("[data-path]")].find((one) => one.dataset.path === where);
    if (!field) { homeless.push(line); continue; }
    field.classList.add("wrong");
    field.querySelector(".fault").textContent = line.slice(where.length + 2);
    field.querySelector("input, select").setAttribute("aria-invalid", "true");
    for (let holder = field.closest("details"); holder; holder = holder.parentElement.closest("details")) holder.open = true;
  }
  return homeless;
}
