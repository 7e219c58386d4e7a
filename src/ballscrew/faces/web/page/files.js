// Files at the door of the page: opened or dropped, and the words on what stays in this browser. The rest is loaded late.

import { byId, element, showNotice } from "./dom.js";
import { keeping } from "./keeping.js";
import { text } from "./texts.js";

/** Deleting everything is asked for twice within this time, in milliseconds. */
const SURE_WITHIN = 6000;

export function setUp() {
  const input = /** @type {HTMLInputElement} */ (byId("open-file"));
  byId("open").addEventListener("click", () => input.click());
  input.addEventListener("change", () => {
    open([...(input.files ?? [])]);
    input.value = ""; // the same file can be opened again
  });
  // a card that takes files itself prevents both
  addEventListener("dragover", (event) => event.preventDefault());
  addEventListener("drop", (event) => {
    if (event.defaultPrevented) return;
    event.preventDefault();
    open([...(event.dataTransfer?.files ?? [])]);
  });
  setUpKeeping();
}

/** @param {File[]} files */
async function open(files) {
  if (!files.length) return;
  const { open: opened } = await import("./opening.js");
  const lines = await opened(files);
  showNotice(...lines.flatMap((line) => [line, element("br")]).slice(0, -1));
}

function setUpKeeping() {
  const button = byId("forget");
  let sure = false;
  const show = () => {
    const count = keeping.kept().length;
    const why = keeping.whyNot();
    button.hidden = !count;
    button.textContent = text(sure ? "keep.sure" : "keep.delete_all", { count });
    byId("kept-words").textContent = text(why ? `keep.${why}` : "keep.short", { count });
    byId("not-kept").hidden = !why;
    byId("not-kept").textContent = why ? text(`keep.${why}`) : "";
  };
  button.addEventListener("click", () => {
    if (sure) keeping.forget(keeping.kept().map(({ id }) => id));
    sure = !sure;
    show();
    setTimeout(() => {
      sure = false;
      show();
    }, SURE_WITHIN);
  });
  keeping.addEventListener("change", show);
  show();
}

/**
 * Say that work of before is shown, and how to begin anew.
 *
 * @param {import("./keeping.js").Work} work
 */
export function sayRestored({ saved }) {
  const when = new Intl.DateTimeFormat("en", { dateStyle: "medium", timeStyle: "short" }).format(saved);
  const afresh = element("button", { type: "button", id: "afresh" }, text("keep.afresh"));
  afresh.addEventListener("click", () => keeping.show("#A=paper"));
  showNotice(`${text("keep.restored", { when })} `, afresh);
}
