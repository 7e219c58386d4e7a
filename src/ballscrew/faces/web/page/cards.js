// Cards: parts of the page that are loaded when they are first opened, and that answer questions of their own.

import * as designs from "./designs.js";
import { byId, element } from "./dom.js";
import { linesOf, waitForServer } from "./server.js";
import { text } from "./texts.js";

/**
 * What a card gets from the page: ``keep`` writes the state into the address and tells all cards.
 *
 * @typedef {object} Page
 * @property {Vocabulary} vocabulary
 * @property {(path: string, unit: string) => void} setUnit chooses the unit of a field
 * @property {(path: string) => void} jump goes to a field of the form
 * @property {() => void} keep
 */
/**
 * A card that is open: ``follow`` shows what the state of the page is now.
 *
 * @typedef {{ follow: () => void | Promise<void>, stop: () => void }} Card
 */

/** Scripts of the cards, by the names of their places. @type {Record<string, string>} */
const SCRIPTS = {
  "over-input": "./cards/over_input.js",
  duty: "./cards/duty.js",
  "warm-up": "./cards/warm_up.js",
  choose: "./cards/choose.js",
  calibration: "./cards/calibrate.js",
  service: "./cards/service.js",
  "hand-over": "./cards/hand_over.js",
  files: "./cards/files.js",
};
/** Scripts that could not be loaded, by name, and how often: browsers keep a failure for its address. @type {Map<string, number>} */
const failures = new Map();

/** @type {Page} */
let page;
/** Goes to a field of the form. @type {(path: string) => void} */
let goToForm = () => {};
/** Cards that have been opened once. @type {Map<string, Card>} */
const opened = new Map();

/** Sections of the case by the cards that have their fields. @type {Record<string, string>} */
const HOMES = { axis: "duty", motion: "duty", motor: "duty", surroundings: "warm-up" };

/** @param {Page} found */
export function setUp(found) {
  page = { ...found, jump };
  goToForm = found.jump;
  for (const name of Object.keys(SCRIPTS)) {
    byId(`${name}-open`).addEventListener("click", () => {
      const { cards } = designs.all();
      if (cards.includes(name)) cards.splice(cards.indexOf(name), 1);
      else cards.push(name);
      page.keep();
      openAll();
    });
  }
  for (const button of document.querySelectorAll("[data-card]")) {
    button.addEventListener("click", () => goTo(/** @type {HTMLElement} */ (button).dataset.card ?? ""));
  }
}

/**
 * Open a card, and go there.
 *
 * @param {string} name
 */
async function goTo(name) {
  const { cards } = designs.all();
  if (!cards.includes(name)) {
    cards.push(name);
    page.keep();
  }
  await openAll();
  byId(`${name}-title`).scrollIntoView({ block: "start" });
  byId(`${name}-open`).focus({ preventScroll: true });
}

/** Open the cards of the state, and close the others. */
export async function openAll() {
  const { cards } = designs.all();
  for (const name of Object.keys(SCRIPTS)) {
    const isOpen = cards.includes(name);
    const button = byId(`${name}-open`);
    button.setAttribute("aria-expanded", String(isOpen));
    button.textContent = text(isOpen ? "card.close" : "card.open");
    byId(name).hidden = !isOpen;
    const card = opened.get(name);
    if (!isOpen) card?.stop();
    else if (card) await followed(name, card);
    else {
      const made = await set(name);
      if (made) await followed(name, made);
    }
  }
}

/**
 * A card that was set up; none, and the reason in its place, where its script could not be loaded.
 *
 * @param {string} name
 */
async function set(name) {
  const times = failures.get(name) ?? 0;
  try {
    /** @type {{ setUp: (holder: HTMLElement, page: Page) => Card }} */
    const { setUp: make } = await import(times ? `${SCRIPTS[name]}?${times}` : SCRIPTS[name]);
    opened.set(name, opened.get(name) ?? make(byId(name), page));
    return opened.get(name);
  } catch (error) {
    failures.set(name, times + 1);
    waitForServer();
    say(name, linesOf(error).join("; "));
    return undefined;
  }
}

/**
 * Let a card follow the page, and say in it why it cannot.
 *
 * @param {string} name
 * @param {Card} card
 */
async function followed(name, card) {
  try {
    await card.follow();
    say(name, "");
  } catch (error) {
    say(name, linesOf(error).join("; "));
  }
}

/** Say in the place of a card why it does not follow. @param {string} name @param {string} words */
function say(name, words) {
  byId(name).querySelector(".card-trouble")?.remove();
  if (words) byId(name).prepend(element("p", { class: "warning card-trouble", role: "status" }, words));
}

/**
 * Go to the field at a path, in the form or in a card, which is opened.
 *
 * @param {string} path
 */
async function jump(path) {
  const home = HOMES[path.split(".")[0]];
  if (!home) {
    goToForm(path);
    return;
  }
  const { cards } = designs.all();
  if (!cards.includes(home)) {
    cards.push(home);
    page.keep();
    await openAll();
  }
  /** @type {NodeListOf<HTMLElement>} */
  const fields = byId(home).querySelectorAll("[data-path]");
  const field = [...fields].find((one) => one.dataset.path === path);
  (field ?? byId(home)).scrollIntoView({ block: "center" });
  /** @type {HTMLElement | null | undefined} */ (field?.querySelector("input, select"))?.focus();
}

/** Tell the open cards of a change. */
export function follow() {
  const { cards } = designs.all();
  for (const [name, card] of opened) if (cards.includes(name)) followed(name, card);
}
