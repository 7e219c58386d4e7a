// Files at the door of the page: opened or dropped, and the words on what stays in this browser.

import { namedButton } from "./controls.js";
import { byId, element, showNotice } from "./dom.js";
import { keeping, WHEN } from "./keeping.js";
import { NOT_KEPT } from "./names.js";
import { open as opened } from "./opening.js";
import * as views from "./views.js";

/** Names of files that are logs where one is asked for. */
const LOG = /\.(?:csv|txt|tsv|xlsx?|ods|mat)$/i;
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
    const all = [...(event.dataTransfer?.files ?? [])];
    const logs = all.filter(({ name }) => LOG.test(name));
    open(logs.length && fit(logs[0]) ? all.filter((file) => file !== logs[0]) : all);
  });
  setUpKeeping();
}

/**
 * Give a log to the fit, where that is seen; false where it is not. It takes the file as one that was chosen there.
 *
 * @param {File} log
 */
function fit(log) {
  const input = document.getElementById("calibrate-log");
  if (views.current() !== "measure" || !(input instanceof HTMLInputElement)) return false;
  const given = new DataTransfer();
  given.items.add(log);
  input.files = given.files;
  input.dispatchEvent(new Event("change"));
  input.closest("section")?.scrollIntoView();
  return true;
}

/** @param {File[]} files */
async function open(files) {
  if (!files.length) return;
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
    button.textContent = sure
      ? `Really delete all ${count}? It cannot be undone`
      : `Delete everything kept here (${count})`;
    byId("kept-words").textContent = why ? NOT_KEPT[why] : "Your designs stay in this browser until you delete them.";
    byId("not-kept").hidden = !why;
    byId("not-kept").textContent = why ? NOT_KEPT[why] : "";
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
  const afresh = namedButton("afresh", "Start afresh", () => keeping.show("#A=paper"));
  showNotice(`Your work of ${WHEN.format(saved)} is shown, as this browser kept it. `, afresh);
}
