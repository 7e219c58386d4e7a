// Taking the case to the program: as a file, and as a link that its page opens.

import { byId, saveFile } from "../../web/page/dom.js";
import { keep, kept } from "./words.js";

/** @typedef {import("./case.js").Case} Case */

const ADDRESS_KEPT = "ballscrew-site-address";
const ADDRESS = "http://127.0.0.1:8017/";

export class Taking {
  /** @param {Case} one */
  constructor(one) {
    this.case = one;
    this.address = /** @type {HTMLInputElement} */ (byId("address"));
    this.link = /** @type {HTMLAnchorElement} */ (byId("open-program"));
    this.address.value = kept(ADDRESS_KEPT) ?? ADDRESS;
    this.address.addEventListener("input", () => {
      keep(ADDRESS_KEPT, this.address.value);
      this.write();
    });
    byId("copy").addEventListener("click", () => this.#copy());
    byId("download").addEventListener("click", () => this.#download());
  }

  /** Write the case as it is. */
  write() {
    byId("toml").textContent = this.case.toml();
    this.link.href = `${this.#base()}${this.case.programFragment()}`;
  }

  /** The address of the program; only one of the web leads anywhere. */
  #base() {
    const given = this.address.value.trim();
    const isWeb = /^https?:\/\//.test(given);
    this.address.setAttribute("aria-invalid", String(!isWeb));
    return `${(isWeb ? given : ADDRESS).replace(/\/*$/, "")}/`;
  }

  async #copy() {
    let words = "Copied.";
    try {
      await navigator.clipboard.writeText(this.case.toml());
    } catch {
      // a page of files may not write there: the text is marked for the keys that copy
      getSelection()?.selectAllChildren(byId("toml"));
      words = "Marked: copy it with the keyboard.";
    }
    byId("said").textContent = words;
  }

  #download() {
    saveFile("case.toml", new Blob([this.case.toml()], { type: "application/toml" }));
  }
}
