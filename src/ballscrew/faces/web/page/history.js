// The state in the address, and in the history of the browser: Back undoes an edit, Forward makes it again.

import { byId } from "./dom.js";

/** Browsers stop a page that writes its address at each key. */
const ADDRESS_DELAY = 300;

/** The place of this entry among those of the page, and that of the last one. */
let place = 0;
let last = 0;
/** The field that this entry is an edit of. @type {string | undefined} */
let edited;
/** True while several fields are edited at once; then whether their entry is there. @type {"" | "begun" | "there"} */
let together = "";
/** The address to be written. @type {string | undefined} */
let pending;
/** @type {ReturnType<typeof setTimeout>} */
let timer;
/** Addresses that were left before they were written, by place. @type {Map<number, string>} */
const late = new Map();

function showButtons() {
  button("undo").disabled = place === 0;
  button("redo").disabled = place >= last;
}

/** @param {string} id */
function button(id) {
  return /** @type {HTMLButtonElement} */ (byId(id));
}

/** Write the pending address. */
export function write() {
  clearTimeout(timer);
  if (pending !== undefined && pending !== location.hash) history.replaceState({ place }, "", pending);
  pending = undefined;
}

/**
 * A new entry, to which Back leads from the next one; none for the address that is there already.
 *
 * @param {string} fragment
 * @returns {boolean} true where there is a new one
 */
function push(fragment) {
  write();
  if (fragment === location.hash) return false;
  place += 1;
  last = place;
  late.clear();
  history.pushState({ place }, "", fragment);
  showButtons();
  return true;
}

/**
 * An entry for a choice, such as another start.
 *
 * @param {string} fragment
 */
export function choose(fragment) {
  edited = undefined;
  push(fragment);
}

/**
 * An entry for an edit: all keys in one field, or all movements of one slider, until it is let go.
 *
 * @param {string} fragment
 * @param {string} path
 */
export function edit(fragment, path) {
  if (together === "there" || (path === edited && !together)) {
    replace(fragment);
    return;
  }
  if (!push(fragment)) return;
  edited = path;
  if (together) together = "there";
}

/**
 * One entry for edits of several fields, such as a point that was dragged.
 *
 * @param {() => void} edits
 */
export function asOne(edits) {
  together = "begun";
  edits();
  together = "";
  edited = undefined;
}

/**
 * The same entry with another address.
 *
 * @param {string} fragment
 */
export function replace(fragment) {
  pending = fragment;
  clearTimeout(timer);
  timer = setTimeout(write, ADDRESS_DELAY);
}

/**
 * Follow the buttons of the page and of the browser.
 *
 * @param {() => void} arrive reads the address
 */
export function begin(arrive) {
  place = history.state?.place ?? 0;
  last = place;
  history.replaceState({ place }, "", location.href);
  button("undo").addEventListener("click", () => {
    write();
    history.back();
  });
  button("redo").addEventListener("click", () => {
    write();
    history.forward();
  });
  addEventListener("pagehide", write);
  // a field that is left or a slider that is let go ends its edit: the next one is another step
  addEventListener("change", () => {
    edited = undefined;
  });
  addEventListener("popstate", (event) => {
    clearTimeout(timer);
    if (pending !== undefined) late.set(place, pending);
    pending = undefined;
    edited = undefined;
    // a link within the page has no place yet: it is the next one
    if (event.state?.place === undefined) last = place + 1;
    place = event.state?.place ?? last;
    history.replaceState({ place }, "", late.get(place) ?? location.href);
    late.delete(place);
    showButtons();
    arrive();
  });
  showButtons();
}
