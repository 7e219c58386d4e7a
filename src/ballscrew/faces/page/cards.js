// Cards: parts of the page that are set up when they are first seen, and that answer questions of their own.

import { byId, element, fieldIn } from "./dom.js";
import { jump as jumpInForm } from "./form.js";
import { needsProgram, setUp as askProgram } from "./needs_program.js";
import { alone, linesOf } from "./server.js";
import * as views from "./views.js";

/**
 * A card: ``follow`` shows what the state of the page is now.
 *
 * @typedef {{ follow: () => void | Promise<void> }} Card
 */

/** Sections of the case by the cards that have their fields, and the views where these are. @type {Record<string, [string, string]>} */
const HOMES = {
  axis: ["duty", "duty"],
  motion: ["duty", "duty"],
  motor: ["duty", "duty"],
  surroundings: ["warm-up", "heat"],
  bearings: ["axis", "axis.chain"],
  guides: ["axis", "axis.chain"],
};

/** The place of a card, which is set up when it is first seen. */
class Place {
  name;
  #setUp;
  /** @type {Card | undefined} */
  #card;
  #isNear = false;

  /** @param {string} name @param {(holder: HTMLElement) => Card} setUp */
  constructor(name, setUp) {
    this.name = name;
    this.#setUp = setUp;
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
    this.#card ??= this.#setUp(this.#holder);
    try {
      await this.#card.follow();
      this.#say("");
    } catch (error) {
      this.#say(linesOf(error).join("; "));
    }
  }

  /** Say in its place why it does not follow. @param {string} words */
  #say(words) {
    this.#holder.querySelector(".card-trouble")?.remove();
    if (words) this.#holder.prepend(element("p", { class: "warning card-trouble", role: "status" }, words));
  }
}

/** @type {Place[]} */
const places = [];

/** Have the cards of the page. @param {Record<string, (holder: HTMLElement) => Card>} setUps by the names of their places */
export function begin(setUps) {
  for (const [name, setUp] of Object.entries(setUps)) {
    places.push(new Place(name, alone.answers && needsProgram(name) ? askProgram : setUp));
  }
}

/** Let the cards that are seen follow the page; done when they have followed. */
export async function follow() {
  await Promise.all(places.map((place) => place.follow()));
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
  await places.find((place) => place.name === name)?.follow(true); // it may not be set up yet
  const field = fieldIn(holder, path);
  views.release(); // the field is where one goes, not its section
  (field ?? holder).scrollIntoView({ block: "center" });
  /** @type {HTMLElement | null | undefined} */ (field?.querySelector("input, select"))?.focus();
}
