// Views: the tasks of the page, each with its panes, of which one is seen. Which section stands where says the page
// itself: ``data-pane="torque.map"``, or several of them, of which a card that is long divides its parts (``inPanes``).

import { byId, element, keepFocus } from "./dom.js";
import { store } from "./store.js";
import { textOr } from "./texts.js";

/** The view that stands in place of the form. */
const WITHOUT_FORM = "start";

/**
 * The pane of an element by its address, ``torque.map``; a view of one pane has no second part.
 *
 * @param {Element} holder
 */
function panesOf(holder) {
  return (holder.getAttribute("data-pane") ?? "").split(" ");
}

/** All elements that stand in a pane. */
function places() {
  return [.../** @type {NodeListOf<HTMLElement>} */ (document.querySelectorAll("[data-pane]"))];
}

/** Addresses of all panes, in the order of the tabs: that of the sections. */
function panes() {
  return [
    ...new Set(
      places()
        .filter((one) => one.matches("section") || one.id === "have")
        .flatMap(panesOf),
    ),
  ];
}

/** The view of a pane. @param {string} pane */
function viewOf(pane) {
  return pane.split(".")[0];
}

/**
 * The pane of an address: a view stands for its first pane, as does a pane that it had once; nothing where there is none.
 *
 * @param {string} address
 */
export function paneAt(address) {
  return panes().find((one) => one === address) ?? panes().find((one) => viewOf(one) === viewOf(address));
}

/** Test whether the form is on the page. */
export function hasForm() {
  return viewOf(current()) !== WITHOUT_FORM;
}

/** The pane that is seen. */
export function current() {
  return paneAt(store.state.view) ?? panes()[0];
}

/** Test whether an element stands in the pane that is seen, or in none. @param {Element} inside */
export function isSeen(inside) {
  const holder = inside.closest("[data-pane]");
  return !holder || panesOf(holder).includes(current());
}

/**
 * Go to a pane: it is a step of its own, to which the browser goes back.
 *
 * @param {string} address
 */
export function go(address) {
  if (paneAt(address) === current()) return Promise.resolve();
  return store.change(
    (state) => {
      state.view = address;
    },
    { of: "view", isLook: true },
  );
}

/**
 * A part of a card that is seen in some panes of its view alone.
 *
 * @template {HTMLElement} Part
 * @param {Part} part
 * @param {string[]} panes
 */
export function inPanes(part, ...panes) {
  part.dataset.pane = panes.join(" ");
  part.classList.toggle("elsewhere", !panes.includes(current()));
  return part;
}

/** The tabs of the views, and below them those of the panes of this view. */
function showTabs() {
  const pane = current();
  const all = panes();
  byId("views").replaceChildren(
    ...[...new Set(all.map(viewOf))].map((view) => tab(view, view === viewOf(pane), textOr(`view.${view}`, view))),
  );
  const beside = all.filter((one) => viewOf(one) === viewOf(pane));
  byId("panes").hidden = beside.length < 2;
  const tabs = beside.map((one) => tab(one, one === pane, textOr(`view.${one}`, one)));
  byId("panes").replaceChildren(...(beside.length < 2 ? [] : tabs));
}

/**
 * @param {string} address
 * @param {boolean} isCurrent
 * @param {string} words
 */
function tab(address, isCurrent, words) {
  const chosen = isCurrent ? "page" : undefined;
  return element("button", { type: "button", id: `to-${address}`, "data-to": address, "aria-current": chosen }, words);
}

/** Show the pane of the state, and hide the others; the tab that has the focus keeps it. */
export function show() {
  const pane = current();
  if (document.body.dataset.seenPane === pane) return; // every key comes here
  keepFocus(showTabs);
  for (const one of places()) one.classList.toggle("elsewhere", !panesOf(one).includes(pane));
  document.body.dataset.seenView = viewOf(pane);
  document.body.dataset.seenPane = pane;
}

export function setUp() {
  for (const id of ["views", "panes"]) {
    byId(id).addEventListener("click", ({ target }) => {
      const address = /** @type {Element} */ (target).closest("[data-to]")?.getAttribute("data-to");
      if (address) go(address);
    });
  }
}
