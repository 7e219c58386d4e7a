// The question of a card: asked as a job once typing has come to rest, with the time that it takes and a button that
// cancels. After the page was loaded again, the job and its answer are found again.

import { jump } from "../cards.js";
import { button } from "../controls.js";
import { element } from "../dom.js";
import { inWords, labelOf } from "../messages.js";
import { answerOfKept, keptJob, runJob } from "../jobs.js";
import { progress } from "../progress.js";
import { ask, Latest, linesOf, Problem } from "../server.js";
import { sheetPlace } from "../sheet.js";
import * as units from "../units.js";

/** Milliseconds after the last key, and until it is said that something is computed. */
const REST = 400;
const PATIENCE = 300;
const NOT_FOUND = 404;
/** In place of a body that is not on the page any more. */
const RESUMED = "job ";

/**
 * A question and where its answer goes: its sheet into a place that is made for it, or all of it into one that is given.
 * ``show`` shows what no sheet has. ``place`` puts faults beside their fields and returns those of no field of the card;
 * nothing where it has shown all of them in a place of its own.
 *
 * @typedef {object} Parts
 * @property {"axis" | "duty" | "warm-up" | "reversal" | "ripple" | "fit" | "service" | "hand-over" | "sensitivity" | "optimise" | "condition" | "select"} address
 * @property {HTMLElement} [result]
 * @property {import("../sheet.js").Beside} [beside] controls beside the rows of its tables
 * @property {(answer: any) => void} [show]
 * @property {(faults: FaultLine[]) => FaultLine[] | undefined} place
 * @property {(body: object) => boolean} [isLarge] tests whether a body is too large to keep answers by it
 * @property {boolean} [isShort] tests whether it takes so short that no job is needed
 * @property {() => any} [about] what its answer is shown with, and is not part of it
 * @property {() => void} [begun] called when it is asked
 * @property {(job: JobDocument) => void} [news] gets news of its job
 * @property {() => string} [doing] what is said while it is computed
 */

/**
 * The line above an answer: what it is the answer to.
 *
 * @param {Parts} parts
 */
export function question({
  address,
  result: own,
  beside,
  show,
  place,
  isLarge = () => false,
  isShort = false,
  about,
  begun,
  news,
  doing,
}) {
  const sheet = own ? undefined : sheetPlace(address, beside);
  const head = element("div", { hidden: true }, sheet?.head);
  const result = own ?? element("div", { class: "card-result", hidden: true }, sheet?.place);
  /** @type {any} */
  let answer;
  let system = "";
  const line = element("div", { class: "card-line" });
  const requests = new Latest();
  /** @type {ReturnType<typeof setTimeout> | undefined} */
  let timer;
  /** Ends what says how far it is. */
  let end = () => {};
  /** Tells news of the job. @type {(job: JobDocument) => void} */
  let told = () => {};
  /** Bodies that are answered, and that are asked about, as text. */
  let answered = "";
  let asked = "";

  /** Show an answer in the units of the page. @param {any} found */
  function shown(found) {
    answer = found;
    system = units.currentSystem();
    sheet?.show(found.sheet);
    if (own) show?.(found);
  }

  /** Show the answer again where the units of the page have changed; one that is hidden stays so. */
  function showAgain() {
    if (answer && system !== units.currentSystem()) shown(answer);
  }

  function stop() {
    clearTimeout(timer);
    end();
    requests.cancel();
    asked = "";
  }

  /** Ask no more, and say nothing. */
  function cancel() {
    stop();
    mark(false, true);
    line.replaceChildren();
  }

  /** @param {boolean} isBusy @param {boolean} isEarlier */
  function mark(isBusy, isEarlier) {
    result.setAttribute("aria-busy", String(isBusy));
    for (const place of [head, result]) place.classList.toggle("earlier", isEarlier && answered !== "");
  }

  /** @param {object | undefined} body nothing of one that is not on the page any more */
  function sayProgress(body) {
    const giveUp = () => {
      cancel();
      line.replaceChildren(element("p", {}, "Cancelled. ", earlier()));
      if (!body) return;
      const again = () => follow(body, 0);
      const retry = button("Compute", again);
      line.firstElementChild?.append(retry);
      retry.focus();
    };
    const shown = progress(giveUp, doing ? { doing: doing() } : {});
    end = shown.end;
    told = shown.told;
    line.replaceChildren(...shown.parts, element("span", { class: "small" }, earlier()));
  }

  /** That what stands below is not of the input as it is; nothing where nothing stands there. */
  function earlier() {
    return answered && !result.hidden ? "The results below are those of the previous input. " : "";
  }

  /** @param {FaultLine[]} faults @param {string[]} lines */
  function sayFaults(faults, lines) {
    const buttons = faults.map((fault) => {
      const go = () => jump(fault.where);
      const words = `${labelOf(fault.where)}: ${inWords(fault)}`;
      return element("p", { class: "fault" }, button(words, go));
    });
    mark(false, true);
    line.replaceChildren(
      element("p", { class: "warning" }, `Not computed. ${lines.join("; ")} ${earlier()}`),
      ...buttons,
    );
  }

  /**
   * Ask about a body, unless it is answered or asked about already; true where its answer stands there.
   *
   * @param {object} body
   * @param {number} rest milliseconds to wait for more keys
   */
  function follow(body, rest = REST) {
    showAgain();
    const key = JSON.stringify(body);
    if (key === asked) return false;
    stop();
    if (key === answered) {
      place([]);
      line.replaceChildren();
      mark(false, false);
      return true;
    }
    const { options } = begin(key, body, rest);
    timer = setTimeout(async () => {
      const compute = async () => (await runJob(address, body, { ...options, about: about?.() })).json();
      await conclude(
        key,
        isLarge(body)
          ? compute()
          : ask(/** @type {any} */ (address), body, options.signal, isShort ? undefined : compute),
        options.signal,
      );
    }, rest);
    return false;
  }

  /** @param {string} key @param {object | undefined} body @param {number} rest */
  function begin(key, body, rest) {
    begun?.();
    asked = key;
    told = () => {};
    mark(true, true);
    const signal = requests.begin();
    const patience = setTimeout(() => signal.aborted || sayProgress(body), rest + PATIENCE);
    signal.addEventListener("abort", () => clearTimeout(patience));
    const hear = (/** @type {JobDocument} */ job) => {
      told(job);
      if (signal.aborted || !news) return;
      if (job.rows.length) answered = ""; // they stand in the place of the answer before
      news(job);
    };
    return { options: { place: address, signal, told: hear } };
  }

  /**
   * Show the answer that comes, or why there is none.
   *
   * @param {string} key
   * @param {Promise<any>} coming
   * @param {AbortSignal} signal
   */
  async function conclude(key, coming, signal) {
    try {
      const found = await coming;
      if (signal.aborted) return;
      stop();
      place([]);
      answered = key;
      shown(found);
      if (sheet) show?.(found);
      result.hidden = head.hidden = false;
      line.replaceChildren();
      mark(false, false);
    } catch (error) {
      if (!signal.aborted) refuse(error);
    }
  }

  /** Say why there is no answer. @param {unknown} error */
  function refuse(error) {
    stop();
    const faults = error instanceof Problem ? error.faults : [];
    const others = place(faults);
    const lines = others && others.length < faults.length ? ["Correct the marked field above."] : [];
    sayFaults(others ?? [], faults.length ? lines : linesOf(error));
  }

  /**
   * Go on with the job that was begun before the page was loaded again, or show its answer.
   *
   * @param {(about: any) => void} [takeUp] gets what the answer is shown with
   */
  async function resume(takeUp) {
    const kept = keptJob(address);
    if (!kept || asked || answered) return;
    takeUp?.(kept.about);
    const key = RESUMED + kept.id;
    const { options } = begin(key, undefined, 0);
    const coming = Promise.resolve(answerOfKept(options)).then((found) => found?.json());
    try {
      await coming;
    } catch (error) {
      if (error instanceof Problem && error.status === NOT_FOUND) {
        stop(); // the server has forgotten it, or is another one: nobody has asked yet
        mark(false, false);
        line.replaceChildren();
        return;
      }
    }
    await conclude(key, coming, options.signal);
    if (answered === key)
      line.replaceChildren(element("p", {}, "The answer to what was asked before the page was reloaded."));
  }

  /**
   * Say whether the answer is of this body, where it is asked for by a button only.
   *
   * @param {object} body
   */
  function compare(body) {
    showAgain();
    if (!answered || asked || answered.startsWith(RESUMED)) return;
    const isEarlier = JSON.stringify(body) !== answered;
    for (const place of [head, result]) place.classList.toggle("earlier", isEarlier);
    line.replaceChildren(...(isEarlier ? [element("p", {}, earlier())] : []));
  }

  return { head, line, result, follow, compare, resume, refuse, cancel, showAgain };
}
