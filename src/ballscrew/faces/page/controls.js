// Controls: buttons, menus, boxes and fields of text, each with its listener; and what stays hidden until it is opened.

import { element } from "./dom.js";

/** @import { Attributes, Child } from "./dom.js" */

/**
 * A button with words.
 *
 * @param {Child} words
 * @param {() => void} onclick
 * @param {Attributes} [more] further attributes
 */
export function button(words, onclick, more = {}) {
  return element("button", { type: "button", ...more, onclick }, words);
}

/**
 * A button with an id, and words of the page.
 *
 * @param {string} id
 * @param {string} words
 * @param {() => void} onclick
 */
export function namedButton(id, words, onclick) {
  return button(words, onclick, { id });
}

/**
 * The button that a view is about: one in each.
 *
 * @param {string} id
 * @param {string} words
 * @param {() => void} onclick
 */
export function primaryButton(id, words, onclick) {
  return button(words, onclick, { id, class: "primary" });
}

/**
 * A menu.
 *
 * @param {[value: string, words: string][]} options
 * @param {string} chosen the value that is chosen at first
 * @param {(value: string) => void} take gets the value that is chosen
 * @param {Attributes} [more] further attributes
 */
export function menu(options, chosen, take, more = {}) {
  const made = options.map(([value, words]) => element("option", { value, selected: value === chosen }, words));
  const found = element("select", more, ...made);
  found.addEventListener("change", () => take(found.value));
  return found;
}

/**
 * A field of text, whose every change counts at once.
 *
 * @param {string} value
 * @param {(typed: string) => void} take gets the text as it is by then
 * @param {Attributes} [more] further attributes
 */
export function textField(value, take, more = {}) {
  const found = element("input", { type: "text", ...more });
  found.value = value;
  found.addEventListener("input", () => take(found.value));
  return found;
}

/**
 * A line with a control behind its label.
 *
 * @param {HTMLElement} control has an id
 * @param {string} words
 * @param {Child[]} others what follows in the line
 */
export function labelled(control, words, ...others) {
  return element("p", { class: "card-start" }, element("label", { for: control.id }, words), control, ...others);
}

/**
 * A box to check, with words behind it.
 *
 * @param {string} words
 * @param {boolean} isChecked
 * @param {(isChecked: boolean) => void} take gets whether it is checked
 * @param {Attributes} [more] further attributes of the box
 */
export function box(words, isChecked, take, more = {}) {
  const found = element("input", { type: "checkbox", checked: isChecked, ...more });
  found.addEventListener("change", () => take(found.checked));
  return element("label", {}, found, ` ${words}`);
}

/**
 * What is hidden below its words until it is opened.
 *
 * @param {string} words
 * @param {Child[]} children
 */
export function opened(words, ...children) {
  return element("details", {}, element("summary", {}, words), ...children);
}

/**
 * Fields in a frame with a title.
 *
 * @param {string} title
 * @param {Child[]} children
 */
export function framed(title, ...children) {
  return element("fieldset", { class: "card-fields" }, element("legend", {}, title), ...children);
}
