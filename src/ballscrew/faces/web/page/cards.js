// Cards: parts of the page that are loaded when they are first opened, and that answer questions of their own.

import { byId, element } from "./dom.js";
import { jump as jumpInForm } from "./form.js";
import { connection, linesOf } from "./server.js";
import { store } from "./store.js";
import { text } from "./texts.js";

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
  reversal: "./cards/reversal.js",
  ripple: "./cards/ripple.js",
  calibration: "./cards/calibrate.js",
  service: "./cards/service.js",
  "hand-over": "./cards/hand_over.js",
  "own-nut": "./cards/own_nut_card.js",
  files: "./cards/files.js",
};
/** Sections of the case by the cards that have their fields. @type {Record<string, string>} */
const HOMES = { axis: "duty", motion: "duty", motor: "duty", surroundings: "warm-up" };

/** The place of a card, whose script is loaded when it is first opened. */
class Place {
  #name;
  #script;
  /** @type {Card | undefined} */
  #card;
  /** How often its script could not be loaded: browsers keep a failure for its address. */
  #failures = 0;

  /** @param {string} name @param {string} script */
  constructor(name, script) {
    this.#name = name;
    this.#script = script;
  }

  /** True where the state has it open. */
  get #isOpen() {
    return store.state.cards.includes(this.#name);
  }

  setUp() {
    byId(`${this.#name}-open`).addEventListener("click", () => {
      store.change(({ cards }) => {
        if (this.#isOpen) cards.splice(cards.indexOf(this.#name), 1);
        else cards.push(this.#name);
      }, OF_CARDS);
      openAll();
    });
  }

  /** Open it or close it, as the state has it. */
  async show() {
    const button = byId(`${this.#name}-open`);
    button.setAttribute("aria-expanded", String(this.#isOpen));
    button.textContent = text(this.#isOpen ? "card.close" : "card.open");
    byId(this.#name).hidden = !this.#isOpen;
    if (!this.#isOpen) this.#card?.stop();
    else if (this.#card || (await this.#load())) await this.follow();
  }

  /** Let the card follow the page where it is open, and say in it why it cannot. */
  async follow() {
    if (!this.#isOpen || !this.#card) return;
    try {
      await this.#card.follow();
      this.#say("");
    } catch (error) {
      this.#say(linesOf(error).join("; "));
    }
  }

  /** Set the card up; false, and the reason in its place, where its script could not be loaded. */
  async #load() {
    try {
      /** @type {{ setUp: (holder: HTMLElement) => Card }} */
      const { setUp: make } = await import(this.#failures ? `${this.#script}?${this.#failures}` : this.#script);
      this.#card ??= make(byId(this.#name));
      return true;
    } catch (error) {
      this.#failures += 1;
      connection.wait();
      this.#say(linesOf(error).join("; "));
      return false;
    }
  }

  /** Say in its place why it does not follow. @param {string} words */
  #say(words) {
    const holder = byId(this.#name);
    holder.querySelector(".card-trouble")?.remove();
    if (words) holder.prepend(element("p", { class: "warning card-trouble", role: "status" }, words));
  }
}

const PLACES = Object.entries(SCRIPTS).map(([name, script]) => new Place(name, script));
/** What follows where a card is opened or closed. */
const OF_CARDS = /** @type {const} */ ({ of: "cards" });

export function setUp() {
  for (const place of PLACES) place.setUp();
  for (const button of document.querySelectorAll("[data-card]")) {
    button.addEventListener("click", () => goTo(/** @type {HTMLElement} */ (button).dataset.card ?? ""));
  }
}

/** Open the cards of the state, and close the others. */
export async function openAll() {
  for (const place of PLACES) await place.show();
}

/** Tell the open cards of a change. */
export function follow() {
  for (const place of PLACES) place.follow();
}

/** Have a card among those that are open. @param {string} name */
function haveOpen(name) {
  if (!store.state.cards.includes(name)) store.change(({ cards }) => cards.push(name), OF_CARDS);
}

/**
 * Open a card, and go there.
 *
 * @param {string} name
 */
async function goTo(name) {
  haveOpen(name);
  await openAll();
  byId(`${name}-title`).scrollIntoView({ block: "start" });
  byId(`${name}-open`).focus({ preventScroll: true });
}

/**
 * Go to the field at a path, in the form or in a card, which is opened.
 *
 * @param {string} path
 */
export async function jump(path) {
  const home = HOMES[path.split(".")[0]];
  if (!home) {
    jumpInForm(path);
    return;
  }
  if (!store.state.cards.includes(home)) {
    haveOpen(home);
    await openAll();
  }
  /** @type {NodeListOf<HTMLElement>} */
  const fields = byId(home).querySelectorAll("[data-path]");
  const field = [...fields].find((one) => one.dataset.path === path);
  (field ?? byId(home)).scrollIntoView({ block: "center" });
  /** @type {HTMLElement | null | undefined} */ (field?.querySelector("input, select"))?.focus();
}
