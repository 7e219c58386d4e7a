// Fields for the options of a question, drawn from their declarations in the vocabulary.

import { menu, opened, textField } from "../controls.js";
import { element } from "../dom.js";
import { words } from "../fields.js";
import * as units from "../units.js";

/** @typedef {Vocabulary["options"][string][number]} Option */
/** What is given, by name, as the body of a request has it; what is not given is not in it. @typedef {Record<string, any>} Given */

/** What parts the entries of a table, which has a line for itself. */
const BETWEEN = ";";

/**
 * The options of a question, behind "more"; what is chosen goes into ``given``.
 *
 * @param {string} question
 * @param {Option[]} options
 * @param {Given} given
 * @param {() => void} change is told that it has changed
 */
export function optionFields(question, options, given, change) {
  const fields = options.map((option) => {
    const control = controlOf(option, (value) => {
      if (value === undefined) delete given[option.name];
      else given[option.name] = value;
      change();
    });
    control.id = `${question}-${option.name}`;
    control.setAttribute("aria-describedby", `${control.id}-about`);
    return element(
      "div",
      { class: "field", title: option.meaning },
      element("label", { for: control.id }, words(option.name)),
      element("div", { class: "entry" }, control),
      element("p", { id: `${control.id}-about`, class: "hidden" }, option.meaning),
    );
  });
  const found = opened("More options", element("div", { class: "grid" }, ...fields));
  found.className = "card-fields";
  return found;
}

/**
 * @param {Option} option
 * @param {(value: any) => void} take nothing where it is left empty
 */
function controlOf(option, take) {
  if (option.kind === "switch") {
    const box = element("input", { type: "checkbox" });
    box.addEventListener("change", () => take(box.checked || undefined));
    return box;
  }
  if (option.kind === "choice") {
    const names = ["", ...option.choices];
    return menu(
      names.map((name) => [name, name || "not given"]),
      "",
      (name) => take(name || undefined),
    );
  }
  /** @param {string} typed */
  const read = (typed) => take(typed.trim() ? fromText(option, typed.trim()) : undefined);
  const usual = typeof option.default === "object" ? "" : String(option.default ?? ""); // a table is empty by default
  return textField("", read, { placeholder: usual });
}

/** What was typed, as the body of a request has it. @param {Option} option @param {string} typed */
function fromText({ kind }, typed) {
  if (kind === "whole" || kind === "number") {
    const found = Number(units.withPoint(units.inASCII(typed)));
    return Number.isFinite(found) ? found : typed;
  }
  if (kind === "quantity") return units.inASCII(typed);
  if (kind === "names") return typed.split(",").map((name) => name.trim());
  if (kind !== "texts" && kind !== "ranges") return typed;
  const entries = typed.split(BETWEEN).filter((entry) => entry.trim());
  return Object.fromEntries(entries.map((entry) => entry.split(/=(.*)/s, 2).map((part) => part.trim())));
}

/**
 * What is given, as flags of a command line.
 *
 * @param {Option[]} options
 * @param {Given} given
 */
export function flags(options, given) {
  return options.flatMap(({ name, flag, kind }) => {
    const value = given[name];
    if (value === undefined) return [];
    if (kind === "switch") return [flag];
    if (kind === "names") return [flag, value.join(",")];
    if (kind !== "texts" && kind !== "ranges") return [flag, String(value)];
    return Object.entries(value).flatMap(([key, one]) => [flag, `${key}=${one}`]);
  });
}
