// The question of a card: asked once typing has come to rest, with the time that it takes and a button that cancels.

import { element } from "../dom.js";
import { inWords, labelOf } from "../faults.js";
import { ask, linesOf, Problem } from "../server.js";
import { text } from "../texts.js";

/** Milliseconds after the last key, and until it is said that something is computed. */
const REST = 400;
const PATIENCE = 300;
const SECOND = 1000;

/**
 * A question and where its answer goes. ``show`` shows an answer, ``place`` puts faults beside their fields and returns
 * those of no field of the card.
 *
 * @typedef {object} Parts
 * @property {"duty" | "warm-up" | "fit" | "service" | "hand-over"} address
 * @property {HTMLElement} result
 * @property {(answer: any) => void} show
 * @property {(faults: FaultLine[]) => FaultLine[]} place
 * @property {(path: string) => void} jump goes to a field of the form
 * @property {(address: any, body: object, signal: AbortSignal) => Promise<any>} [send] of a body that is too large to keep
 */

/**
 * The line above an answer: what it is the answer to.
 *
 * @param {Parts} parts
 */
export function question({ address, result, show, place, jump, send = ask }) {
  const line = element("div", { class: "card-line" });
  let request = new AbortController();
  /** @type {ReturnType<typeof setTimeout> | undefined} */
  let timer;
  /** @type {ReturnType<typeof setInterval> | undefined} */
  let clock;
  /** Bodies that are answered, and that are asked about, as text. */
  let answered = "";
  let asked = "";

  function stop() {
    clearTimeout(timer);
    clearInterval(clock);
    request.abort();
    asked = "";
  }

  /** @param {boolean} isBusy @param {boolean} isEarlier */
  function mark(isBusy, isEarlier) {
    result.setAttribute("aria-busy", String(isBusy));
    result.classList.toggle("earlier", isEarlier && answered !== "");
  }

  /** @param {object} body @param {number} start */
  function sayProgress(body, start) {
    const seconds = element("span", {}, text("card.computing"));
    const cancel = () => {
      stop();
      const again = () => follow(body, 0);
      const button = element("button", { type: "button", onclick: again }, text("card.again"));
      mark(false, true);
      line.replaceChildren(element("p", {}, `${text("card.cancelled")} `, earlier(), button));
      button.focus();
    };
    line.replaceChildren(
      element("progress", { "aria-label": text("card.computing") }),
      seconds,
      element("button", { type: "button", onclick: cancel }, text("card.cancel")),
      element("span", { class: "small" }, earlier()),
    );
    clock = setInterval(() => {
      const passed = Math.round((performance.now() - start) / SECOND);
      seconds.textContent = text("card.computing_for", { seconds: passed });
    }, SECOND);
  }

  /** That what stands below is not of the input as it is; nothing where nothing stands there. */
  function earlier() {
    return answered && !result.hidden ? `${text("card.earlier")} ` : "";
  }

  /** @param {FaultLine[]} faults @param {string[]} lines */
  function fail(faults, lines) {
    const buttons = faults.map((fault) => {
      const go = () => jump(fault.where);
      const words = `${labelOf(fault.where)}: ${inWords(fault)}`;
      return element("p", { class: "fault" }, element("button", { type: "button", onclick: go }, words));
    });
    mark(false, true);
    line.replaceChildren(
      element("p", { class: "warning" }, `${text("card.not_computed")} ${lines.join("; ")} ${earlier()}`),
      ...buttons,
    );
  }

  /**
   * Ask about a body, unless it is answered or asked about already.
   *
   * @param {object} body
   * @param {number} rest milliseconds to wait for more keys
   */
  function follow(body, rest = REST) {
    const key = JSON.stringify(body);
    if (key === asked) return;
    stop();
    if (key === answered) {
      place([]);
      line.replaceChildren();
      mark(false, false);
      return;
    }
    asked = key;
    mark(true, true);
    request = new AbortController();
    const { signal } = request;
    const patience = setTimeout(() => signal.aborted || sayProgress(body, performance.now()), rest + PATIENCE);
    signal.addEventListener("abort", () => clearTimeout(patience));
    timer = setTimeout(async () => {
      try {
        const found = await send(address, body, signal);
        if (signal.aborted) return;
        stop();
        place([]);
        answered = key;
        show(found);
        line.replaceChildren();
        mark(false, false);
      } catch (error) {
        if (signal.aborted) return;
        stop();
        const faults = error instanceof Problem ? error.faults : [];
        const others = place(faults);
        const lines = others.length < faults.length ? [text("card.marked")] : [];
        fail(others, faults.length ? lines : linesOf(error));
      }
    }, rest);
  }

  /**
   * Say whether the answer is of this body, where it is asked for by a button only.
   *
   * @param {object} body
   */
  function compare(body) {
    if (!answered || asked) return;
    const isEarlier = JSON.stringify(body) !== answered;
    result.classList.toggle("earlier", isEarlier);
    line.replaceChildren(...(isEarlier ? [element("p", {}, earlier())] : []));
  }

  return { line, follow, compare, stop };
}
