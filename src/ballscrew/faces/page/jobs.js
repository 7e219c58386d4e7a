// Long work: a job of the server, which is asked how far it is, cancelled, and found again after the page was loaded again.

import { keeping } from "./keeping.js";
import { answerAt, get, Problem, sendJson } from "./server.js";

const PREFIX = "ballscrew.job.";
/** Seconds that the server may wait for news before it answers. */
const WAIT = 1;
const NOT_FOUND = 404;

/**
 * What the browser keeps of the job of a place: its name, whose it is, of what it is, and what its answer is shown with.
 *
 * @typedef {{ id: string, tab: string, key: string, about?: any }} Kept
 */
/**
 * @typedef {object} Options
 * @property {AbortSignal} signal kills the job
 * @property {string} place whose job it is: a new one takes the place of the one before
 * @property {any} [about] kept with it
 * @property {(job: JobDocument) => void} [told] gets news: how far it is, and the rows that are new
 */

/**
 * The job of a place in this tab. A tab that was duplicated has a copy of the job of the other one, who may need it.
 *
 * @param {string} place
 * @returns {Kept | undefined}
 */
export function keptJob(place) {
  try {
    /** @type {Kept | null} */
    const job = JSON.parse(sessionStorage.getItem(PREFIX + place) ?? "null");
    // without HTTPS no tab has a name that stays
    return job && (!navigator.locks || job.tab === keeping.own()) ? job : undefined;
  } catch {
    return undefined; // storage is forbidden: jobs are found until the page is loaded again
  }
}

/** @param {string} place @param {Kept | undefined} job */
function keep(place, job) {
  try {
    if (job) sessionStorage.setItem(PREFIX + place, JSON.stringify(job));
    else sessionStorage.removeItem(PREFIX + place);
  } catch {
    // the same
  }
}

/**
 * The answer to a body, computed as a job. A job of the same body that was begun before is gone on with.
 *
 * @param {string} address
 * @param {object} body
 * @param {Options} options
 * @returns {Promise<Response>}
 */
export async function runJob(address, body, options) {
  const { place, signal, about } = options;
  const key = digest(`${address} ${JSON.stringify(body)}`);
  const before = keptJob(place);
  if (before?.key === key) {
    try {
      return await answerOf(before, options);
    } catch (error) {
      if (signal.aborted || !(error instanceof Problem && error.status === NOT_FOUND)) throw error;
    }
  } else if (before) cancel(before);
  const job = { id: await begun(address, body, signal), tab: keeping.own(), key, about };
  keep(place, job);
  return answerOf(job, options);
}

/**
 * The name of a new job. The request is not broken off, or the job would be there without a name to cancel it by.
 *
 * @param {string} address
 * @param {object} body
 * @param {AbortSignal} signal
 * @returns {Promise<string>}
 */
function begun(address, body, signal) {
  return new Promise((resolve, reject) => {
    const abort = () => reject(signal.reason);
    if (signal.aborted) {
      abort();
      return;
    }
    signal.addEventListener("abort", abort);
    sendJson(`jobs/${address}`, body)
      .then((job) => {
        if (signal.aborted) cancel(job);
        else resolve(job.id);
      }, reject)
      .finally(() => signal.removeEventListener("abort", abort));
  });
}

/**
 * The answer of the job that a place has kept.
 *
 * @param {Options} options
 * @returns {Promise<Response> | undefined} nothing where there is none
 */
export function answerOfKept(options) {
  const job = keptJob(options.place);
  return job && answerOf(job, options);
}

/** Cancel and forget the job of a place. @param {string} place */
export function drop(place) {
  const job = keptJob(place);
  if (!job) return;
  cancel(job);
  forget(place);
}

/** Forget the job of a place, whose answer somebody else may still read. @param {string} place */
export function forget(place) {
  keep(place, undefined);
}

/**
 * @param {Kept} job
 * @param {Options} options
 */
async function answerOf(job, { place, signal, told }) {
  const abort = () => {
    cancel(job);
    if (keptJob(place)?.id === job.id) keep(place, undefined);
  };
  if (signal.aborted) abort();
  signal.addEventListener("abort", abort);
  try {
    let known = 0;
    for (let wait = 0; ; wait = WAIT) {
      /** @type {JobDocument} */
      const found = await get(`jobs/${job.id}?wait=${wait}&rows=${known}`, signal);
      known += found.rows.length;
      told?.(found);
      if (!["waiting", "running"].includes(found.state)) break;
    }
    return await answerAt(`jobs/${job.id}/answer`, { signal });
  } catch (error) {
    if (error instanceof Problem && keptJob(place)?.id === job.id) keep(place, undefined); // a refusal is no answer
    throw error;
  } finally {
    signal.removeEventListener("abort", abort);
  }
}

/** @param {{ id: string }} job */
function cancel({ id }) {
  answerAt(`jobs/${id}`, { method: "DELETE", keepalive: true }).catch(() => {}); // it ends by itself where nobody asks
}

/**
 * A short text that another one hardly has, too; the browser has a better one only with HTTPS.
 *
 * @param {string} text
 */
export function digest(text) {
  let [one, other] = [0xdeadbeef, 0x41c6ce57];
  for (let place = 0; place < text.length; place += 1) {
    const letter = text.charCodeAt(place);
    one = Math.imul(one ^ letter, 0x9e3779b1);
    other = Math.imul(other ^ letter, 0x5f356495);
  }
  return `${text.length}-${(one >>> 0).toString(36)}-${(other >>> 0).toString(36)}`;
}
