// The state in the address, and in the history of the browser: Back undoes an edit, Forward makes it again.

import { byId } from "./dom.js";

/** Browsers stop a page that writes its address at each key. */
const ADDRESS_DELAY = 300;

/** @param {string} id */
function button(id) {
  return /** @type {HTMLButtonElement} */ (byId(id));
}

/** The entries of the page in the history of the browser. */
class Entries {
  /** The place of this entry among those of the page, and that of the last one. */
  #place = 0;
  #last = 0;
  /** The field that this entry is an edit of. @type {string | undefined} */
  #edited;
  /** True while several fields are edited at once; then whether their entry is there. @type {"" | "begun" | "there"} */
  #together = "";
  /** The address to be written. @type {string | undefined} */
  #pending;
  /** @type {ReturnType<typeof setTimeout> | undefined} */
  #timer;
  /** Places of entries that are another view of what was there: to undo an edit passes over them. @type {Set<number>} */
  #looks = new Set();
  /** Addresses that were left before they were written, by place. @type {Map<number, string>} */
  #late = new Map();

  /** Follow the buttons of the page and of the browser. */
  begin() {
    this.#place = history.state?.place ?? 0;
    this.#looks = new Set(history.state?.looks);
    this.#last = this.#place;
    history.replaceState(this.#kept(), "", location.href);
    button("undo").addEventListener("click", () => {
      this.write();
      history.go(this.#edit(-1) - 1 - this.#place);
    });
    button("redo").addEventListener("click", () => {
      this.write();
      history.go(this.#edit(1) - this.#place);
    });
    addEventListener("pagehide", () => this.write());
    // a field that is left or a slider that is let go ends its edit: the next one is another step
    addEventListener("change", () => {
      this.#edited = undefined;
    });
    addEventListener("popstate", ({ state }) => this.#arrive(state?.place));
    this.#showButtons();
  }

  /**
   * An entry for a choice, such as another start.
   *
   * @param {string} fragment
   */
  choose(fragment) {
    this.#edited = undefined;
    this.#push(fragment);
  }

  /**
   * An entry for another view of the same state.
   *
   * @param {string} fragment
   */
  look(fragment) {
    this.#edited = undefined;
    if (!this.#push(fragment)) return;
    this.#looks.add(this.#place);
    history.replaceState(this.#kept(), "", fragment);
    this.#showButtons();
  }

  /**
   * An entry for an edit: all keys in one field, or all movements of one slider, until it is let go.
   *
   * @param {string} fragment
   * @param {string} path
   */
  edit(fragment, path) {
    if (this.#together === "there" || (path === this.#edited && !this.#together)) {
      this.replace(fragment);
      return;
    }
    if (!this.#push(fragment)) return;
    this.#edited = path;
    if (this.#together) this.#together = "there";
  }

  /**
   * One entry for edits of several fields, such as a point that was dragged.
   *
   * @param {() => void} edits
   */
  asOne(edits) {
    this.#together = "begun";
    edits();
    this.#together = "";
    this.#edited = undefined;
  }

  /**
   * The same entry with another address.
   *
   * @param {string} fragment
   */
  replace(fragment) {
    this.#pending = fragment;
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => this.write(), ADDRESS_DELAY);
  }

  /** Write the pending address. */
  write() {
    clearTimeout(this.#timer);
    const address = this.#pending;
    if (address !== undefined && address !== location.hash) history.replaceState(this.#kept(), "", address);
    this.#pending = undefined;
  }

  /**
   * A new entry, to which Back leads from the next one; none for the address that is there already.
   *
   * @param {string} fragment
   * @returns {boolean} true where there is a new one
   */
  #push(fragment) {
    this.write();
    if (fragment === location.hash) return false;
    this.#place += 1;
    this.#last = this.#place;
    this.#late.clear();
    this.#forgetLooks(this.#place);
    history.pushState(this.#kept(), "", fragment);
    this.#showButtons();
    return true;
  }

  /** @param {number | undefined} place of the entry that the browser went to */
  #arrive(place) {
    clearTimeout(this.#timer);
    if (this.#pending !== undefined) this.#late.set(this.#place, this.#pending);
    this.#pending = undefined;
    this.#edited = undefined;
    // a link within the page has no place yet: it is the next one
    if (place === undefined) {
      this.#last = this.#place + 1;
      this.#forgetLooks(this.#last);
    }
    this.#place = place ?? this.#last;
    history.replaceState(this.#kept(), "", this.#late.get(this.#place) ?? location.href);
    this.#late.delete(this.#place);
    this.#showButtons();
  }

  /**
   * The place of the edit that is undone or made again next: 0, or one after the last, where there is none.
   *
   * @param {-1 | 1} direction
   */
  #edit(direction) {
    let place = direction > 0 ? this.#place + 1 : this.#place;
    while (this.#looks.has(place)) place += direction;
    return place;
  }

  /** Entries from a place on are others now. @param {number} first */
  #forgetLooks(first) {
    for (const place of this.#looks) if (place >= first) this.#looks.delete(place);
  }

  /** What an entry has beside its address, which is there again after the page was loaded again. */
  #kept() {
    return { place: this.#place, looks: [...this.#looks] };
  }

  #showButtons() {
    button("undo").disabled = this.#edit(-1) <= 0;
    button("redo").disabled = this.#edit(1) > this.#last;
  }
}

export const entries = new Entries();
