// Requests that the server has ended because they took too long: they go on as jobs by themselves, with a line at the
// foot of the page that says how far each is, and cancels it.

import { element } from "./dom.js";
import { digest, forget, keptJob, runJob } from "./jobs.js";
import { progress } from "./progress.js";
import { ask, Problem, sendJson } from "./server.js";

/** Work by its address. @type {Record<string, string>} */
const WORK = {
  band: "Band of the result",
  check: "Checks",
  compare: "Models side by side",
  duty: "Duty cycle",
  log: "Columns of the log",
  open: "Opening the file",
  run: "Result",
  sweep: "Curve",
};

/** The id of the fault that says so. */
const OUT_OF_TIME = "out_of_time";
/** Milliseconds until the line is shown: of what was known already nothing is to be seen. */
const PATIENCE = 300;
/** Milliseconds within which a job has ended that needed none. */
const SOON = 5000;

/** Addresses whose requests took too long: the next ones are jobs at once. @type {Set<string>} */
const slow = new Set();
const list = element("div", { id: "long-work", role: "region", "aria-label": "Work that takes long" });
document.body.append(list);

/** Test whether the server ended a request for its time. @param {unknown} error */
export function isOutOfTime(error) {
  return error instanceof Problem && error.faults.some(({ id }) => id === OUT_OF_TIME);
}

/**
 * The JSON document that answers a body: by a request, and where that takes too long by a job. A job that was begun
 * before the page was loaded again is gone on with.
 *
 * @param {string} address
 * @param {object} body
 * @param {AbortSignal} [signal]
 */
export async function sendPatiently(address, body, signal = new AbortController().signal) {
  const place = `long-${address}-${digest(JSON.stringify(body))}`;
  if (!slow.has(address) && !keptJob(place)) {
    try {
      return await sendJson(address, body, signal);
    } catch (error) {
      if (signal.aborted || !isOutOfTime(error)) throw error;
      slow.add(address);
    }
  }
  return asJob(address, body, place, signal);
}

/**
 * The answer to a body that the server has stopped for its time, by a job.
 *
 * @param {string} address
 * @param {object} body
 * @param {AbortSignal} signal
 */
export function goOn(address, body, signal) {
  slow.add(address);
  return sendPatiently(address, body, signal);
}

/**
 * The answer of an address to a body, which is kept as ``ask`` keeps it.
 *
 * @param {"run" | "check" | "band" | "duty" | "warm-up"} address
 * @param {object} body
 * @param {AbortSignal} signal
 */
export function askPatiently(address, body, signal) {
  return ask(address, body, signal, undefined, sendPatiently);
}

/**
 * @param {string} address
 * @param {object} body
 * @param {string} place whose job it is
 * @param {AbortSignal} signal
 */
async function asJob(address, body, place, signal) {
  const start = performance.now();
  const own = new AbortController();
  const words = { what: WORK[address] ?? address, doing: "goes on in the background …" };
  const { parts, told, end } = progress(() => own.abort(), words);
  const line = element("p", { "data-address": address }, ...parts);
  const leave = () => own.abort();
  if (signal.aborted) leave();
  signal.addEventListener("abort", leave);
  const patience = setTimeout(() => list.append(line), PATIENCE);
  try {
    const found = await (await runJob(address, body, { place, signal: own.signal, told })).json();
    forget(place); // its answer is here
    if (performance.now() - start < SOON) slow.delete(address); // the next one may be waited for again
    return found;
  } catch (error) {
    signal.throwIfAborted();
    if (own.signal.aborted) throw new Problem({ title: "Cancelled." });
    throw error;
  } finally {
    signal.removeEventListener("abort", leave);
    clearTimeout(patience);
    end();
    line.remove();
  }
}
