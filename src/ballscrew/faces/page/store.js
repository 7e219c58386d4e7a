// The state of the page in one object: one way to change it, and one way to be told of a change.

import { initial } from "./state.js";

/** @typedef {import("./state.js").State} State */
/**
 * What a change is of. ``path`` is the field that was edited: all keys in one field are one step of the button Back.
 * ``isStep`` makes it a step by itself. ``rebuild`` has the form made anew. ``of`` says what follows: the ``view`` alone,
 * what only ``cards`` ask about, or, where it is left out, the answer. ``isLook`` is another view of the same state: a step of
 * the browser, which is not undone.
 *
 * @typedef {{ path?: string, isStep?: boolean, rebuild?: boolean, of?: "view" | "cards", isLook?: boolean }} About
 */

/** A change of the state, as a listener is told of it. It is done when all is that has to be waited for. */
export class StateChange extends Event {
  /** @type {Promise<unknown>[]} */
  #work = [];

  /** @param {About} about */
  constructor(about) {
    super("change");
    this.about = about;
  }

  /** @param {Promise<unknown>} work */
  waitUntil(work) {
    this.#work.push(work);
  }

  async done() {
    await Promise.all(this.#work);
  }
}

class Store extends EventTarget {
  #state = initial();

  /** The state as it is now, which is another object after Back. @returns {import("./state.js").FrozenState} */
  get state() {
    return this.#state;
  }

  /**
   * Change the state, and tell those who listen to ``change``.
   *
   * @param {(state: State) => void} edit
   * @param {About} [about]
   * @returns {Promise<void>} until the page has followed
   */
  change(edit, about = {}) {
    edit(this.#state);
    return this.#tell(about);
  }

  /**
   * Put another state in the place of this one, but for what is not in an address, and tell of it as of a change.
   *
   * @param {State} found
   * @param {About} about
   */
  use(found, about) {
    this.#state = { ...found, table: this.#state.table };
    return this.#tell(about);
  }

  /** @param {About} about */
  #tell(about) {
    const event = new StateChange(about);
    this.dispatchEvent(event);
    return event.done();
  }
}

/** The state of the page. */
export const store = new Store();
