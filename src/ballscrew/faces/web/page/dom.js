// Elements, tables and CSV.

/** @typedef {Record<string, string | number | boolean | null | undefined | ((event: Event) => void)>} Attributes */
/** @typedef {string | number | Node | null | undefined} Child */
/** @typedef {string | number | boolean | null | undefined} Cell */

/**
 * An element with attributes and children; texts are texts, never markup.
 *
 * @template {keyof HTMLElementTagNameMap} Name
 * @param {Name} name
 * @param {Attributes} attributes an attribute that is false, null or undefined is left out; ``on…`` is a listener
 * @param {Child[]} children
 * @returns {HTMLElementTagNameMap[Name]}
 */
export function element(name, attributes = {}, ...children) {
  const found = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    if (value === undefined || value === null || value === false) continue;
    if (typeof value === "function") found.addEventListener(key.slice(2), value);
    else found.setAttribute(key, value === true ? "" : String(value));
  }
  for (const child of children) {
    if (child !== null && child !== undefined) found.append(typeof child === "number" ? String(child) : child);
  }
  return found;
}

/**
 * The element of this name, which the page has.
 *
 * @param {string} id
 * @returns {HTMLElement}
 */
export function byId(id) {
  const found = document.getElementById(id);
  if (!found) throw new Error(`no element #${id}`);
  return found;
}

/**
 * The first element inside another one that a selector finds, which is there.
 *
 * @param {Element} holder
 * @param {string} selector
 * @returns {HTMLElement}
 */
export function within(holder, selector) {
  const found = holder.querySelector(selector);
  if (!(found instanceof HTMLElement)) throw new Error(`no element ${selector}`);
  return found;
}

/**
 * A table with a caption, headings above and, where wanted, beside.
 *
 * @param {string} caption
 * @param {string[]} headings
 * @param {Child[][]} rows
 * @param {{ beside?: boolean }} options
 */
export function table(caption, headings, rows, { beside = true } = {}) {
  const head = headings.map((text) => (text ? element("th", { scope: "col" }, text) : element("td")));
  const body = rows.map((cells) =>
    element(
      "tr",
      {},
      ...cells.map((cell, place) =>
        place === 0 && beside ? element("th", { scope: "row" }, cell) : element("td", {}, cell),
      ),
    ),
  );
  return element(
    "table",
    {},
    element("caption", {}, caption),
    element("thead", {}, element("tr", {}, ...head)),
    element("tbody", {}, ...body),
  );
}

/**
 * A table in a frame that scrolls on its own.
 *
 * @param {string} label
 * @param {HTMLTableElement} content
 */
export function scrolling(label, content) {
  return element("div", { class: "scroll whole", tabindex: "0", role: "region", "aria-label": label }, content);
}

/**
 * Show words above the form, or nothing there.
 *
 * @param {(string | Node)[]} words
 */
export function showNotice(...words) {
  byId("notice").replaceChildren(...words);
  byId("notice").hidden = !words.some(Boolean);
}

/**
 * Columns as CSV (RFC 4180).
 *
 * @param {string[]} headings
 * @param {Cell[][]} rows
 */
export function csv(headings, rows) {
  /** @param {Cell} value */
  const cell = (value) => {
    const text = String(value ?? "");
    return /[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
  };
  return `${[headings, ...rows].map((row) => row.map(cell).join(",")).join("\r\n")}\r\n`;
}
