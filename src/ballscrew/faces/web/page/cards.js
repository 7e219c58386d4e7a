// Cards: parts of the page that are loaded when they are first seen, and that answer questions of their own.

import { byId, element } from "./dom.js";
import { jump as jumpInForm } from "./form.js";
import { connection, linesOf } from "./server.js";
import * as views from "./views.js";

/**
 * A card that is loaded: ``follow`` shows what the state of the page is now.
 *
 * @typedef {{ follow: () => void | Promise<void> }} Card
 */

/** Scripts of the cards, by the names of their places. @type {Record<string, string>} */
const SCRIPTS = {
  "over-input": "./cards/over_input.js",
  axis: "./cards/axis.js",
  duty: "./cards/duty.js",
  "warm-up": "./cards/warm_up.js",
  choose: "./cards/choose.js",
  reversal: "./cards/asked_by_button.js",
  ripple: "./cards/asked_by_button.js",
  sensitivity: "./cards/asked_by_button.js",
  calibration: "./cards/calibrate.js",
  service: "./cards/service.js",
  condition: "./cards/condition.js",
  optimise: "./cards/optimise.js",
  "hand-over": "./cards/hand_over.js",
  "own-nut": "./cards/own_nut_card.js",
  files: "./cards/files.js",
};
/** Sections of the case by the cards that have their fields, and the views where these are. @type {Record<string, [string, string]>} */
const HOMES = {
  axis: ["duty", "duty"],
  motion: ["duty", "duty"],
  motor: ["duty", "duty"],
  surroundings: ["warm-up", "heat"],
  bearings: ["axis", "axis.chain"],
  guides: ["axis", "axis.chain"],
};

/** The place of a card, whose script is loaded when it is first seen. */
class Place {
  name;
  #script;
  /** @type {Card | undefined} */
  #card;
  /** @type {Promise<boolean> | undefined} */
  #loading;
  /** How often its script could not be loaded: browsers keep a failure for its address. */
  #failures = 0;
  #isNear = false;

  /** @param {string} name @param {string} script */
  constructor(name, script) {
    this.name = name;
    this.#script = script;
    const near = new IntersectionObserver(
      ([entry]) => {
        this.#isNear = entry.isIntersecting;
        this.follow();
      },
      { rootMargin: "250px" },
    );
    near.observe(this.#holder.closest("section") ?? this.#holder);
  }

  get #holder() {
    return byId(this.name);
  }

  /**
   * Let the card follow the page where it is seen, and say in it why it cannot. One that is not seen follows when it is.
   *
   * @param {boolean} [isWanted] whether it is about to be seen
   */
  async follow(isWanted = this.#isNear) {
    if (!isWanted || !views.isSeen(this.#holder)) return;
    if (!this.#card) {
      this.#loading ??= this.#load().finally(() => {
        this.#loading = undefined;
      });
      if (!(await this.#loading)) return;
    }
    try {
      await this.#card?.follow();
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
      this.#card = make(this.#holder);
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
    this.#holder.querySelector(".card-trouble")?.remove();
    if (words) this.#holder.prepend(element("p", { class: "warning card-trouble", role: "status" }, words));
  }
}

const PLACES = Object.entries(SCRIPTS).map(([name, script]) => new Place(name, script));

/** Let the cards that are seen follow the page; done when they are loaded and have followed. */
export async function follow() {
  await Promise.all(PLACES.map((place) => place.follow()));
}

/**
 * Go to the field at a path, in the form or in the card that has it.
 *
 * @param {string} path
 */
export async function jump(path) {
  const home = HOMES[path.split(".")[0]];
  if (!home) {
    jumpInForm(path);
    return;
  }
  const [name, view] = home;
  const holder = byId(name);
  await views.go(view);
  await PLACES.find((place) => place.name === name)?.follow(true); // its script may not be there yet
  /** @type {NodeListOf<HTMLElement>} */
  const fields = holder.querySelectorAll("[data-path]");
  const field = [...fields].find((one) => one.dataset.path === path);
  views.release(); // the field is where one goes, not its section
  (field ?? holder).scrollIntoView({ block: "center" });
  /** @type {HTMLElement | null | undefined} */ (field?.querySelector("input, select"))?.focus();
}
