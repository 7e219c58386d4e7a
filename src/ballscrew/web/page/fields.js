// Fields of the form: a choice, or a number beside its unit.

import { element } from "./dom.js";
import { symbol } from "./symbols.js";
import * as units from "./units.js";

/** @typedef {import("./schema.js").SchemaNode} SchemaNode */
/** @typedef {import("./state.js").State} State */
/**
 * A change by the user: of the text or the unit of a field, or of the start of the design; or all of them taken back.
 *
 * @typedef {{ path?: string, text?: string, unit?: string, start?: string, reset?: true, rebuild?: boolean }} Change
 */
/**
 * Where the texts of the fields come from and where changes go: the state, the value given at a path, the law in a slot
 * with its coefficients, and the listener.
 *
 * @typedef {object} Source
 * @property {State} state
 * @property {(path: string) => any} given
 * @property {(path: string) => Record<string, any> | undefined} lawOf
 * @property {(change: Change) => void} onChange
 */

/** Units that are displayed only where inches are chosen. */
const INCH_ONLY = ["in", "uin", "lbf", "lbf in", "psi", "degF"];

/** @param {string} name */
export function words(name) {
  return name.replaceAll("_", " ");
}

/** The last name of a path, in words. @param {string} path */
function label(path) {
  return words(path.slice(path.lastIndexOf(".") + 1));
}

/** @param {string} path */
function idOf(path) {
  return path.replaceAll(".", "-");
}

/**
 * A field with its label, its control and the places for its description and its fault.
 *
 * @param {string} path
 * @param {SchemaNode} node
 * @param {boolean} isGiven
 * @param {HTMLElement} control
 * @param {HTMLElement[]} others
 */
function frame(path, { description, "x-symbol": tex }, isGiven, control, ...others) {
  const id = `f-${idOf(path)}`;
  control.id = id;
  control.setAttribute("aria-describedby", `${id}-about ${id}-fault`);
  return element(
    "div",
    { class: isGiven ? "field given" : "field", "data-path": path, title: description },
    element("label", { for: id }, label(path), symbol(tex), element("span", { class: "differs" })),
    element("div", { class: "entry" }, control, ...others),
    element("p", { id: `${id}-about`, class: "hidden" }, description ?? ""),
    element("p", { id: `${id}-fault`, class: "fault" }),
  );
}

/**
 * @param {string} path
 * @param {SchemaNode} node
 * @param {unknown} value
 * @param {Source["onChange"]} onChange
 * @param {string} [present] the law of the model, where none is chosen
 */
export function choiceField(path, node, value, onChange, present) {
  const options = node.type === "boolean" ? ["true", "false"] : (node.enum ?? []);
  const none = node.default ? `usual: ${node.default}` : "not given";
  const select = element(
    "select",
    { onchange: () => onChange({ path, text: select.value, rebuild: true }) },
    element("option", { value: "" }, present ? `as in the model: ${present}` : none),
    ...options.map((name) => element("option", { value: name, selected: String(value) === name }, name)),
  );
  return frame(path, node, value !== undefined, select);
}

/**
 * The unit that a field is displayed in: chosen for it, or that of the system, or that it was typed in.
 *
 * @param {string} path
 * @param {SchemaNode} node
 * @param {unknown} value
 * @param {State} state
 */
function unitOf(path, node, value, state) {
  if (state.fields[path]) return state.fields[path];
  const usual = node["x-unit"] ?? "";
  const typed = units.parse(value ?? "", node["x-si-unit"])?.unit ?? usual;
  if (units.currentSystem() === "metric") return INCH_ONLY.includes(typed) ? usual : typed;
  return units.inSystem(typed);
}

/**
 * @param {string} path
 * @param {SchemaNode} node
 * @param {Source} source
 * @param {unknown} [present] the coefficient of the model, where none is given
 */
export function numberField(path, node, { state, given, onChange }, present) {
  const value = given(path);
  const input = element("input", { type: "text", inputmode: "decimal", spellcheck: "false" });
  input.addEventListener("keydown", (event) => step(event, input));
  if (node["x-si-unit"]) return quantityField(path, node, input, value, state, onChange);
  input.value = value ?? "";
  input.placeholder = String(present ?? "");
  input.addEventListener("input", () => reportText(onChange, path, input, input.value.trim()));
  return frame(path, node, value !== undefined, input);
}

/**
 * A number beside its unit, or text as it was typed.
 *
 * @param {string} path
 * @param {SchemaNode} node
 * @param {HTMLInputElement} input
 * @param {any} value
 * @param {State} state
 * @param {Source["onChange"]} onChange
 */
function quantityField(path, node, input, value, state, onChange) {
  const si = node["x-si-unit"];
  const unit = unitOf(path, node, value, state);
  const shown = value === undefined ? "" : units.digitsIn(value, unit, si);
  const isOther = shown === null;
  input.value = shown ?? String(value);
  const known = [...new Set([unit, ...units.choices(si).map((one) => one.unit)])];
  const select = element(
    "select",
    { class: "unit", id: `u-${idOf(path)}`, "aria-label": `unit of ${label(path)}` },
    isOther ? element("option", { value: "", selected: true }, "as typed") : null,
    ...known.map((name) => element("option", { value: name, selected: !isOther && name === unit }, units.symbol(name))),
  );
  select.addEventListener("change", () => onChange({ path, unit: select.value, rebuild: true }));
  input.addEventListener("input", () => {
    const text = input.value.trim();
    const isBare = text !== "" && /^[\s\d.,'eE+±-]*$/.test(text);
    if (isBare && !select.value) select.value = unit;
    reportText(onChange, path, input, isBare ? `${text} ${select.value}` : text);
  });
  // a unit that was typed moves to the list of units
  input.addEventListener("change", () => {
    const found = units.parse(input.value, si);
    if (!found) return;
    input.value = found.digits;
    select.value = found.unit;
  });
  return frame(path, node, value !== undefined, input, select);
}

/**
 * @param {Source["onChange"]} onChange
 * @param {string} path
 * @param {HTMLInputElement} input
 * @param {string} text
 */
function reportText(onChange, path, input, text) {
  input.closest(".field")?.classList.toggle("given", text !== "");
  onChange({ path, text });
}

/**
 * Show the value that counts in a field where nothing is typed; nothing where it is not known.
 *
 * @param {HTMLElement} field
 * @param {SchemaNode | undefined} node
 * @param {unknown} value in SI
 */
export function showEffective(field, node, value) {
  const input = field.querySelector("input");
  if (!input) return;
  const select = field.querySelector("select");
  const si = node?.["x-si-unit"];
  const number = typeof value === "number" ? value : undefined;
  const shown =
    number !== undefined && si ? units.fromSI(number, select?.value || (node?.["x-unit"] ?? ""), si) : number;
  input.placeholder = shown === undefined ? "" : units.digits(shown);
}

/**
 * Step the second digit of a number by an arrow key; with shift, the first.
 *
 * @param {KeyboardEvent} event
 * @param {HTMLInputElement} input
 */
function step(event, input) {
  if (event.key !== "ArrowUp" && event.key !== "ArrowDown") return;
  const text = input.value || input.placeholder;
  const value = Number(units.withPoint(text));
  if (!text.trim() || !Number.isFinite(value)) return;
  event.preventDefault();
  const power = Math.floor(Math.log10(Math.abs(value)) + 1e-9) - (event.shiftKey ? 0 : 1);
  const size = value === 0 ? 1 : 10 ** power;
  input.value = String(Number((value + (event.key === "ArrowUp" ? size : -size)).toPrecision(12)));
  input.dispatchEvent(new Event("input", { bubbles: true }));
}
