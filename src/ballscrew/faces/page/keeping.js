// Work that stays in this browser until it is deleted: one record for each tab, so that no tab writes over another one.

const PREFIX = "ballscrew.work.";
const OWN = "ballscrew.tab";
/** Milliseconds after the last key until it is kept. */
const DELAY = 300;
/** Keys of an address that say how the work is looked at. */
const VIEWS = ["band", "show", "unit", "units", "view"];

/** When work was saved, in words. */
export const WHEN = new Intl.DateTimeFormat("en", { dateStyle: "medium", timeStyle: "short" });

/** What is kept: the state as the fragment of an address, words for a list, and when. */
/** @typedef {{ id: string, fragment: string, title: string, saved: number }} Work */
/** Why nothing is kept. @typedef {"" | "forbidden" | "full"} Trouble */

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

function readOwn() {
  try {
    return sessionStorage.getItem(OWN) ?? "";
  } catch {
    return "";
  }
}

/** A state without what is only looked at: the view, the design that is shown, units. @param {string} fragment */
function edited(fragment) {
  const parameters = new URLSearchParams(fragment.replace(/^#/, ""));
  for (const key of [...parameters.keys()]) if (VIEWS.includes(key.split(".")[0])) parameters.delete(key);
  return String(parameters);
}

/** The work that is kept; those who listen to ``change`` are told what is kept and what is not, also by other tabs. */
class Keeping extends EventTarget {
  #id = "";
  /** The state that this tab began with, which is no work yet. @type {string | undefined} */
  #first;
  /** @type {{ fragment: string, title: string } | undefined} */
  #pending;
  /** @type {ReturnType<typeof setTimeout> | undefined} */
  #timer;
  /** @type {Trouble} */
  #trouble = "";

  /**
   * Find the entry of this tab: that of before it was loaded again, the last one that no tab has open, or a new one.
   *
   * @returns {Promise<Work | undefined>} the last work, where the address says nothing else
   */
  async begin() {
    addEventListener("storage", () => this.#tell());
    addEventListener("pagehide", () => this.#write());
    const [latest] = location.hash ? [] : this.kept();
    const before = latest ? latest.id : readOwn();
    if (await claim(before)) this.#beOwn(before);
    else await claim(this.#beNew());
    return latest;
  }

  /** The entry of this tab. */
  own() {
    return this.#id;
  }

  /** Why nothing is kept; empty where all is. */
  whyNot() {
    return this.#trouble;
  }

  /** All that is kept, the newest first. */
  kept() {
    return Object.keys(this.#storage() ?? {})
      .filter((key) => key.startsWith(PREFIX))
      .flatMap((key) => this.#found(key.slice(PREFIX.length)) ?? [])
      .sort((one, other) => other.saved - one.saved);
  }

  /**
   * Keep the state of this tab once typing rests.
   *
   * @param {string} fragment
   * @param {string} title
   */
  keep(fragment, title) {
    this.#first ??= fragment;
    if (fragment === this.#first && !this.#pending && !this.#found(this.#id)) return;
    this.#pending = { fragment, title };
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => this.#write(), DELAY);
  }

  /**
   * Show other work in this tab. What it has kept stays, and so does what is shown: a change begins an entry of its own.
   *
   * @param {string} fragment
   */
  show(fragment) {
    this.#write();
    this.#first = fragment;
    claim(this.#beNew());
    this.#tell();
    location.hash = fragment;
  }

  /**
   * Delete entries; what is on the page stays until the tab is closed, and the next change keeps it again.
   *
   * @param {string[]} ids
   */
  forget(ids) {
    clearTimeout(this.#timer);
    this.#pending = undefined;
    for (const one of ids) this.#storage()?.removeItem(PREFIX + one);
    if (this.#trouble === "full") this.#trouble = "";
    this.#first = ""; // no state is that: the next change is work
    this.#tell();
  }

  #tell() {
    this.dispatchEvent(new Event("change"));
  }

  /** The storage of the browser, or none where it is forbidden. */
  #storage() {
    try {
      return localStorage;
    } catch {
      this.#trouble = "forbidden";
      return undefined;
    }
  }

  /** @param {string} one the entry of this tab from now on */
  #beOwn(one) {
    this.#id = one;
    try {
      sessionStorage.setItem(OWN, one);
    } catch {
      this.#trouble ||= "forbidden";
    }
  }

  #beNew() {
    this.#beOwn(crypto.getRandomValues(new Uint32Array(2)).join("-"));
    return this.#id;
  }

  #write() {
    clearTimeout(this.#timer);
    if (!this.#pending || !this.#id) return;
    const kept = this.#found(this.#id);
    // to load a page again or to open a card is no edit: a new tab begins with what was edited last
    const saved = kept && edited(kept.fragment) === edited(this.#pending.fragment) ? kept.saved : Date.now();
    const work = { ...this.#pending, id: this.#id, saved };
    this.#pending = undefined;
    const before = this.#trouble;
    try {
      this.#storage()?.setItem(PREFIX + this.#id, JSON.stringify(work));
      if (this.#trouble === "full") this.#trouble = "";
    } catch {
      this.#trouble = "full";
    }
    if (before !== this.#trouble || this.#trouble === "") this.#tell();
  }

  /**
   * @param {string} wanted
   * @returns {Work | undefined}
   */
  #found(wanted) {
    try {
      const work = JSON.parse(this.#storage()?.getItem(PREFIX + wanted) ?? "");
      return typeof work.fragment === "string" ? { title: "", saved: 0, ...work, id: wanted } : undefined;
    } catch {
      return undefined;
    }
  }
}

export const keeping = new Keeping();
