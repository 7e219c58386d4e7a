// Texts of the page in the language of the visitor: the server puts the table into the page (texts/en.json, de.json).

/** @typedef {keyof typeof import("./texts/en.json")} Key */

/** All texts by key. @type {Record<string, string>} */
const table = JSON.parse(document.querySelector("template")?.content.textContent || "{}");
/** A place in a text that a value takes. */
const PLACEHOLDER = /\{(\w+(?:\.\w+)*)\}/g;
const COOKIE = "ballscrew-language";
const YEAR = 31_536_000;

/** The language of the page, such as "en". */
export const language = document.documentElement.lang;
/** What stands between a number and its decimals. */
const POINT = new Intl.NumberFormat(language).formatToParts(1.5).find(({ type }) => type === "decimal")?.value ?? ".";

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
export function filledIn(pattern, value) {
  return pattern.replace(PLACEHOLDER, (placeholder, name) => String(value(name) ?? placeholder));
}

/**
 * The digits of a number, written with a point, as they are written in the language.
 *
 * @param {string} digits
 */
export function localised(digits) {
  return digits.replace(".", POINT);
}

/** True where the language has a decimal comma. */
export const hasComma = POINT === ",";

/**
 * Follow the menu of languages: the choice stays in the browser as a cookie, and the page is loaded in it.
 *
 * @param {HTMLSelectElement} menu
 */
export function followMenu(menu) {
  menu.value = language; // browsers keep what was chosen before the page was loaded again
  menu.addEventListener("change", () => {
    // biome-ignore lint/suspicious/noDocumentCookie: the other interface needs HTTPS, which a server on one's own machine has not
    document.cookie = `${COOKIE}=${menu.value}; path=/; max-age=${YEAR}; samesite=strict`;
    location.reload();
  });
}
