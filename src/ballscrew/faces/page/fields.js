// Fields of the form: a choice, or a number beside its unit.

import { element } from "./dom.js";
import { symbol } from "./symbols.js";
import * as units from "./units.js";
import { vocabulary } from "./vocabulary.js";

/** @typedef {import("./schema.js").SchemaNode} SchemaNode */
/** @typedef {import("./state.js").FrozenState} State */
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
 * @property {(path: string) => Record<string, any> | undefined} [lawOf]
 * @property {(change: Change) => void} onChange
 */

/** A number without a unit, and what is told of its spread: ± another one, or ± a share in per cent. */
const BARE = /^(?=[^±]*\d)([\s\d.,'eE+-]+)((?:±[\s\d.,'eE+-]+%?)?)$/;
/** Labels of fields whose names do not say what they are, by path or name. @type {Record<string, string>} */
const LABELS = {
  ball_to_ball_force: "force between balls",
  density_15: "density at 15 °C",
  diameter_speed_product: "largest d·n",
  ends: "support of the ends",
  full_film_friction_coefficient: "full-film friction coefficient",
  kinematic_viscosity_100: "kinematic viscosity at 100 °C",
  kinematic_viscosity_40: "kinematic viscosity at 40 °C",
  oil: "oil of the library",
  poisson_ratio: "Poisson's ratio",
  pressure_viscosity_coefficient: "pressure–viscosity coefficient",
  spacing: "distance of the halves",
  starts: "thread starts",
  young_modulus: "Young's modulus",
};
/** @param {string} name */
export function words(name) {
  return name.replaceAll("_", " ");
}

/**
 * The label of a field: its name in words, or the text for its path or its name.
 *
 * @param {string} path
 */
export function labelIn(path) {
  const name = path.slice(path.lastIndexOf(".") + 1);
  return LABELS[path] ?? LABELS[name] ?? words(name);
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
  const help = description ?? "";
  control.id = id;
  control.setAttribute("aria-describedby", `${id}-about ${id}-fault`);
  return element(
    "div",
    { class: isGiven ? "field given" : "field", "data-path": path, title: help || null },
    element("label", { for: id }, labelIn(path), symbol(tex), element("span", { class: "differs" })),
    element("div", { class: "entry" }, control, ...others),
    element("p", { id: `${id}-about`, class: "hidden" }, help),
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
  const none = node.default ? `usual: ${String(node.default)}` : "not given";
  const select = element(
    "select",
    { onchange: () => onChange({ path, text: select.value, rebuild: true }) },
    element("option", { value: "" }, present ? `as in the model: ${present}` : none),
    ...options.map((name) => element("option", { value: name, selected: String(value) === name }, name)),
  );
  return frame(path, node, value !== undefined, select);
}

/** The field of a node without laws: a choice or a number. @param {string} path @param {SchemaNode} node @param {Source} source */
export function fieldFor(path, node, source) {
  const isChoice = node.enum || node.type === "boolean";
  return isChoice ? choiceField(path, node, source.given(path), source.onChange) : numberField(path, node, source);
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
  const chosen = state.fields[path];
  if (chosen && units.choicesOf(node).includes(chosen)) return chosen;
  const usual = node["x-unit"] ?? "";
  const typed = units.parse(value ?? "", node["x-si-unit"])?.unit ?? usual;
  if (units.currentSystem() === "metric") return Object.values(vocabulary.systems.inch).includes(typed) ? usual : typed;
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
  input.value = String(value ?? "");
  input.placeholder = String(present ?? "");
  input.addEventListener("input", () => reportText(onChange, path, input, units.inASCII(input.value.trim())));
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
  const known = [...new Set([unit, ...units.choicesOf(node)])];
  const select = element(
    "select",
    { class: "unit", id: `u-${idOf(path)}`, "aria-label": `unit of ${labelIn(path)}` },
    isOther ? element("option", { value: "", selected: true }, "as typed") : null,
    ...known.map((name) => element("option", { value: name, selected: !isOther && name === unit }, units.symbol(name))),
  );
  select.addEventListener("change", () => onChange({ path, unit: select.value, rebuild: true }));
  input.addEventListener("input", () => {
    const typed = units.inASCII(input.value.trim());
    const [, number, spread] = BARE.exec(typed) ?? [];
    if (number && !select.value) select.value = unit;
    reportText(onChange, path, input, number ? `${number.trim()} ${select.value} ${spread}`.trim() : typed);
  });
  // a unit that was typed moves to the list of units
  input.addEventListener("change", () => {
    const found = units.parse(units.inASCII(input.value), si);
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
 * @param {string} typed
 */
function reportText(onChange, path, input, typed) {
  input.closest(".field")?.classList.toggle("given", typed !== "");
  onChange({ path, text: typed });
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
  input.dispatchEvent(new Event("effective")); // for its slider
}

/**
 * Step the second digit of a number by an arrow key; with shift, the first.
 *
 * @param {KeyboardEvent} event
 * @param {HTMLInputElement} input
 */
function step(event, input) {
  if (event.key !== "ArrowUp" && event.key !== "ArrowDown") return;
  const shown = input.value || input.placeholder;
  const value = Number(units.withPoint(units.inASCII(shown)));
  if (!shown.trim() || !Number.isFinite(value)) return;
  event.preventDefault();
  const power = Math.floor(Math.log10(Math.abs(value)) + 1e-9) - (event.shiftKey ? 0 : 1);
  const size = value === 0 ? 1 : 10 ** power;
  const stepped = value + (event.key === "ArrowUp" ? size : -size);
  input.value = String(Number(stepped.toPrecision(12)));
  input.dispatchEvent(new Event("input", { bubbles: true }));
}
