// How far work is that the server goes on with: a bar, words with the time that has passed, and a button that cancels it.

import { button } from "./controls.js";
import { element } from "./dom.js";

const SECOND = 1000;

/**
 * @param {() => void} cancel
 * @param {{ what?: string, doing?: string }} words what it is, where that is not seen beside it, and what is done
 */
export function progress(cancel, { what = "", doing = "computing …" } = {}) {
  const named = (/** @type {string} */ words) => (what ? `${what}: ${words}` : words);
  const bar = element("progress", { "aria-label": named(doing) });
  const said = element("span", {}, named(doing));
  const stop = button("Cancel", cancel, what ? { "aria-label": `Cancel: ${what}` } : {});
  const start = performance.now();
  /** @type {JobDocument | undefined} */
  let known;
  const clock = setInterval(() => {
    const isWaiting = known && (known.before > 0 || known.state === "waiting");
    const seconds = Math.round((performance.now() - start) / SECOND);
    const count = known?.total ? `, ${known.finished} of ${known.total}` : "";
    said.textContent = named(`${isWaiting ? "waits for other work …" : doing} ${seconds} s${count}`);
  }, SECOND);
  /** Take news of the work. @param {JobDocument} job */
  const told = (job) => {
    known = job;
    if (job.finished < job.total) {
      bar.max = job.total;
      bar.value = job.finished;
    } else bar.removeAttribute("value");
  };
  return { parts: [bar, said, stop], told, end: () => clearInterval(clock) };
}
