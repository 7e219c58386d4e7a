// Work that stays in this browser until it is deleted: one record for each tab, so that no tab writes over another one.

const PREFIX = "ballscrew.work.";
const OWN = "ballscrew.tab";
/** Milliseconds after the last key until it is kept. */
const DELAY = 300;
/** Keys of an address that say how the work is looked at. */
const VIEWS = ["band", "cards", "show", "unit", "units"];

/** What is kept: the state as the fragment of an address, words for a list, and when. */
/** @typedef {{ id: string, fragment: string, title: string, saved: number }} Work */
/** Why nothing is kept. @typedef {"" | "forbidden" | "full"} Trouble */

let id = "";
/** The state that this tab began with, which is no work yet. @type {string | undefined} */
let first;
/** @type {{ fragment: string, title: string } | undefined} */
let pending;
/** @type {ReturnType<typeof setTimeout>} */
let timer;
/** @type {Trouble} */
let trouble = "";
/** Told of changes here and in other tabs. @type {Set<() => void>} */
const listeners = new Set();

/** The storage of the browser, or none where it is forbidden. */
function storage() {
  try {
    return localStorage;
  } catch {
    trouble = "forbidden";
    return undefined;
  }
}

/** @param {() => void} listener is told of what is kept and of what is not, also by other tabs */
export function follow(listener) {
  listeners.add(listener);
}

function tell() {
  for (const listener of listeners) listener();
}

/** Why nothing is kept; empty where all is. */
export function whyNot() {
  return trouble;
}

/**
 * Take an entry for this tab, where no other tab has it. The browser gives it back when the tab ends.
 *
 * @param {string} wanted
 * @returns {Promise<boolean>}
 */
function claim(wanted) {
  if (!wanted || !navigator.locks) return Promise.resolve(false); // without HTTPS each tab begins an entry of its own
  return new Promise((resolve) => {
    const held = navigator.locks.request(PREFIX + wanted, { ifAvailable: true }, (lock) => {
      resolve(lock !== null);
      return lock ? new Promise(() => {}) : undefined;
    });
    held.catch(() => resolve(false)); // where storage is forbidden, locks may be, too
  });
}

/**
 * Find the entry of this tab: that of before it was loaded again, the last one that no tab has open, or a new one.
 *
 * @returns {Promise<Work | undefined>} the last work, where the address says nothing else
 */
export async function begin() {
  addEventListener("storage", tell);
  addEventListener("pagehide", write);
  const [latest] = location.hash ? [] : kept();
  const before = latest ? latest.id : readOwn();
  if (await claim(before)) beOwn(before);
  else await claim(beNew());
  return latest;
}

/** @param {string} one the entry of this tab from now on */
function beOwn(one) {
  id = one;
  try {
    sessionStorage.setItem(OWN, id);
  } catch {
    trouble ||= "forbidden";
  }
}

function beNew() {
  beOwn(crypto.getRandomValues(new Uint32Array(2)).join("-"));
  return id;
}

/**
 * Show other work in this tab. What it has kept stays, and so does what is shown: a change begins an entry of its own.
 *
 * @param {string} fragment
 */
export function show(fragment) {
  write();
  first = fragment;
  claim(beNew());
  tell();
  location.hash = fragment;
}

function readOwn() {
  try {
    return sessionStorage.getItem(OWN) ?? "";
  } catch {
    return "";
  }
}

/**
 * Keep the state of this tab once typing rests.
 *
 * @param {string} fragment
 * @param {string} title
 */
export function keep(fragment, title) {
  first ??= fragment;
  if (fragment === first && !pending && !found(id)) return;
  pending = { fragment, title };
  clearTimeout(timer);
  timer = setTimeout(write, DELAY);
}

function write() {
  clearTimeout(timer);
  if (!pending || !id) return;
  const kept = found(id);
  // to load a page again or to open a card is no edit: a new tab begins with what was edited last
  const saved = kept && edited(kept.fragment) === edited(pending.fragment) ? kept.saved : Date.now();
  const work = { ...pending, id, saved };
  pending = undefined;
  const before = trouble;
  try {
    storage()?.setItem(PREFIX + id, JSON.stringify(work));
    if (trouble === "full") trouble = "";
  } catch {
    trouble = "full";
  }
  if (before !== trouble || trouble === "") tell();
}

/** A state without what is only looked at: cards that are open, the design that is shown, units. @param {string} fragment */
function edited(fragment) {
  const parameters = new URLSearchParams(fragment.replace(/^#/, ""));
  for (const key of [...parameters.keys()]) if (VIEWS.includes(key.split(".")[0])) parameters.delete(key);
  return String(parameters);
}

/**
 * @param {string} wanted
 * @returns {Work | undefined}
 */
function found(wanted) {
  try {
    const work = JSON.parse(storage()?.getItem(PREFIX + wanted) ?? "");
    return typeof work.fragment === "string" ? { title: "", saved: 0, ...work, id: wanted } : undefined;
  } catch {
    return undefined;
  }
}

/** All that is kept, the newest first. */
export function kept() {
  return Object.keys(storage() ?? {})
    .filter((key) => key.startsWith(PREFIX))
    .flatMap((key) => found(key.slice(PREFIX.length)) ?? [])
    .sort((one, other) => other.saved - one.saved);
}

/** The entry of this tab. */
export function own() {
  return id;
}

/**
 * Delete entries; what is on the page stays until the tab is closed, and the next change keeps it again.
 *
 * @param {string[]} ids
 */
export function forget(ids) {
  clearTimeout(timer);
  pending = undefined;
  for (const one of ids) storage()?.removeItem(PREFIX + one);
  if (trouble === "full") trouble = "";
  first = ""; // no state is that: the next change is work
  tell();
}
