// Views: the tasks of the page, of which one is seen. Where a section stands says the page itself: ``data-in="torque"``, or
// several views. An address may name a part of a view, ``torque.map``, to which the page scrolls.

import { byId, element, keepFocus } from "./dom.js";
import { store } from "./store.js";

/** Names of the views, in the order of their tabs. @type {Record<string, string>} */
const NAMES = {
  torque: "Torque",
  nut: "Nut",
  checks: "Checks",
  duty: "Duty",
  heat: "Heat",
  axis: "Axis",
  choose: "Choose",
  measure: "Measure",
  handover: "Hand over",
};
const VIEWS = Object.keys(NAMES);
/** Milliseconds for which a part stays where it was scrolled to. */
const KEPT = 4000;
/** What addresses named once. @type {Record<string, string>} */
const FORMERLY = { "start.own": "choose.own", start: "torque", "hand-over": "handover" };

/** Keeps the part that is seen where it is. */
const kept = new ResizeObserver(() => partAt(store.state.view)?.scrollIntoView({ block: "start" }));

/** An address as it is named now. @param {string} address */
function nowOf(address) {
  const [first, ...part] = (FORMERLY[address] ?? address).split(".");
  return [FORMERLY[first] ?? first, ...part].join(".");
}

/** The view of an address; none where there is none. @param {string} address */
export function viewAt(address) {
  const [name] = nowOf(address).split(".");
  return VIEWS.find((view) => view === name);
}

/** The view that is seen. */
export function current() {
  return viewAt(store.state.view) ?? VIEWS[0];
}

/** Test whether an element stands in the view that is seen, or in none. @param {Element} inside */
export function isSeen(inside) {
  const holder = /** @type {HTMLElement | null} */ (inside.closest("[data-in]"));
  return !holder || isIn(holder, current());
}

/** @param {HTMLElement} holder @param {string} view */
function isIn(holder, view) {
  return (holder.dataset.in ?? "").split(" ").includes(view);
}

/**
 * Go to a view, or to a part of it: it is a step of its own, to which the browser goes back.
 *
 * @param {string} address
 */
export async function go(address) {
  if (address === store.state.view) {
    scrollTo(address);
    return;
  }
  await store.change(
    (state) => {
      state.view = address;
    },
    { of: "view", isLook: true },
  );
}

/**
 * Scroll to the part of a view that an address names, or to its top. What is above it may still grow while it loads: it stays in
 * sight until somebody moves, or for some seconds.
 *
 * @param {string} address
 */
function scrollTo(address) {
  release();
  if (!partAt(address)) {
    window.scrollTo(0, 0);
    return;
  }
  kept.observe(byId("results"));
  for (const moved of ["wheel", "pointerdown", "keydown", "touchmove"]) {
    addEventListener(moved, release, { once: true, passive: true });
  }
  setTimeout(release, KEPT);
}

/** The part of a view that an address names. @param {string} address */
function partAt(address) {
  return document.querySelector(`[data-anchor="${CSS.escape(nowOf(address))}"]`);
}

/** Keep no part in sight any more. */
export function release() {
  kept.disconnect();
}

/** Show the view of the state, and hide the others; the tab that has the focus keeps it. */
export function show() {
  const { view: address } = store.state;
  const { seenAddress: before } = document.body.dataset;
  if (address === before) return; // every key comes here
  document.body.dataset.seenAddress = address;
  const view = current();
  keepFocus(() => byId("views").replaceChildren(...VIEWS.map((name) => tab(name, name === view))));
  for (const holder of /** @type {NodeListOf<HTMLElement>} */ (document.querySelectorAll("[data-in]"))) {
    holder.classList.toggle("elsewhere", !isIn(holder, view));
  }
  document.body.dataset.seenView = view;
  if (before !== undefined || address.includes(".")) scrollTo(address);
}

/** @param {string} name @param {boolean} isCurrent */
function tab(name, isCurrent) {
  const marks = { id: `to-${name}`, "data-view": name, "aria-current": isCurrent ? "page" : undefined };
  return element("button", { type: "button", ...marks, onclick: () => go(name) }, NAMES[name]);
}
