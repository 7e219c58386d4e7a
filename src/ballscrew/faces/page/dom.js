// Elements, tables, CSV, and files that are saved.

/** @typedef {Record<string, string | number | boolean | null | undefined | ((event: Event) => void)>} Attributes */
/** @typedef {string | number | Node | null | undefined} Child */
/** @typedef {string | number | boolean | null | undefined} Cell */

/** Matches a window that is as narrow as a phone. */
export const NARROW = matchMedia("(max-width: 46rem)");

/** Elements with listeners, which stand as they were made. @type {WeakSet<Node>} */
const listening = new WeakSet();

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
    if (typeof value === "function") {
      found.addEventListener(key.slice(2), value);
      listening.add(found);
    } else found.setAttribute(key, value === true ? "" : String(value));
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

/** The field of a path inside another element. @param {Element} holder @param {string} path @returns {HTMLElement | null} */
export function fieldIn(holder, path) {
  return holder.querySelector(`[data-path="${CSS.escape(path)}"]`);
}

/**
 * A table with a caption, headings above and, where wanted, beside.
 *
 * @param {string} caption
 * @param {Child[]} headings
 * @param {Child[][]} rows
 */
export function table(caption, headings, rows) {
  const head = headings.map((text) => (text ? element("th", { scope: "col" }, text) : element("td")));
  const body = rows.map((cells) =>
    element(
      "tr",
      {},
      ...cells.map((cell, place) =>
        place === 0 && cell !== "" ? element("th", { scope: "row" }, cell) : element("td", {}, cell),
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
 * A table in a frame that scrolls on its own, which is labelled by its caption.
 *
 * @param {string} caption
 * @param {Child[]} headings
 * @param {Child[][]} rows
 */
export function scrollingTable(caption, headings, rows) {
  return scrolling(caption, table(caption, headings, rows));
}

/**
 * Keep the focus and the cursor where they are while their element is made anew with the same id.
 *
 * @param {() => void} rebuild
 * @param {() => HTMLElement} [instead] the element that gets the focus where that button is disabled now
 */
export function keepFocus(rebuild, instead) {
  const focused = document.activeElement;
  const id = focused?.id;
  const selection = focused instanceof HTMLInputElement ? [focused.selectionStart, focused.selectionEnd] : [];
  rebuild();
  const again = id && document.activeElement?.id !== id ? document.getElementById(id) : null;
  if (instead && again instanceof HTMLButtonElement && again.disabled) instead().focus();
  else again?.focus({ preventScroll: true });
  const [from, to] = selection;
  if (again instanceof HTMLInputElement && typeof from === "number") again.setSelectionRange(from, to ?? from);
}

/**
 * Put children in place of those that an element has; the focus and the cursor stay in the one with the same id.
 *
 * @param {HTMLElement} holder
 * @param {(string | Node)[]} children
 */
export function redraw(holder, ...children) {
  keepFocus(() => holder.replaceChildren(...children));
}

/**
 * Show children in place of those that an element has, and write only what differs: the browser lays out nothing else
 * anew. An element that has listeners by ``element`` takes the place of that before.
 *
 * @param {Element} holder
 * @param {Child[]} children
 */
export function update(holder, ...children) {
  let before = holder.firstChild;
  for (const child of children) {
    if (child === null || child === undefined) continue;
    const wanted = child instanceof Node ? child : document.createTextNode(String(child));
    const next = before?.nextSibling ?? null;
    if (!before) holder.append(wanted);
    else if (!become(before, wanted)) before.replaceWith(wanted);
    before = next;
  }
  while (before) {
    const next = before.nextSibling;
    before.remove();
    before = next;
  }
}

/**
 * Make a node what another one is; false where that has to take its place.
 *
 * @param {Node} node
 * @param {Node} wanted
 */
function become(node, wanted) {
  if (node.nodeName !== wanted.nodeName || listening.has(node) || listening.has(wanted)) return false;
  if (node instanceof Text && wanted instanceof Text) {
    if (node.data !== wanted.data) node.data = wanted.data;
    return true;
  }
  const [one, other] = /** @type {HTMLElement[]} */ ([node, wanted]);
  /** What is opened or closed by hand stays so. @param {string} name */
  const isOfUser = (name) => name === "open" && node.nodeName === "DETAILS";
  for (const { name } of [...one.attributes]) {
    if (!other.hasAttribute(name) && !isOfUser(name)) one.removeAttribute(name);
  }
  for (const { name, value } of other.attributes) {
    if (isOfUser(name) || one.getAttribute(name) === value) continue;
    // as an attribute the policy of the page refuses it
    if (name === "style") one.style.cssText = value;
    else one.setAttribute(name, value);
  }
  update(one, ...other.childNodes);
  return true;
}

/**
 * Write a text into an element where it has another one.
 *
 * @param {string} id
 * @param {string} words
 */
export function write(id, words) {
  const holder = byId(id);
  if (holder.textContent !== words) holder.textContent = words;
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

/** Save a file. @param {string} name @param {Blob} content */
export function saveFile(name, content) {
  const address = URL.createObjectURL(content);
  const link = element("a", { href: address, download: name });
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(address), 10_000);
}
