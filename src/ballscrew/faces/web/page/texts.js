// Texts of the page: the server puts the table into it (texts.json).

/** @typedef {keyof typeof import("./texts.json")} Key */

/** All texts by key. @type {Record<string, string>} */
const table = JSON.parse(document.querySelector("template")?.content.textContent || "{}");
/** A place in a text that a value takes. */
const PLACEHOLDER = /\{(\w+(?:\.\w+)*)\}/g;

/**
 * The text of a key, with values in the places of their names in braces.
 *
 * @param {Key} key
 * @param {Record<string, string | number>} [values]
 */
export function text(key, values = {}) {
  return filledIn(table[key] ?? key, (name) => values[name]);
}

/**
 * The text of a key that is made of a name of the server, such as a check's; the other text where there is none.
 *
 * @param {string} key
 * @param {string} other
 * @param {Record<string, string | number>} [values]
 */
export function textOr(key, other, values = {}) {
  return filledIn(Object.hasOwn(table, key) ? table[key] : other, (name) => values[name]);
}

/**
 * A text with values in the places of their names; a place of no value stays.
 *
 * @param {string} pattern
 * @param {(name: string) => string | number | undefined} value
 */
function filledIn(pattern, value) {
  return pattern.replace(PLACEHOLDER, (placeholder, name) => String(value(name) ?? placeholder));
}

/** A sentence with its capital letter and its full stop. @param {string} words */
export function sentence(words) {
  const line = words.trim();
  const isWord = /^[a-z]+(?=[\s,:;–]|$)/.test(line); // the name of a file stays as it is
  return `${isWord ? line.charAt(0).toUpperCase() : line.charAt(0)}${line.slice(1)}${/[.:]$/.test(line) ? "" : "."}`;
}
