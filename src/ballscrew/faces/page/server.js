// Requests to the server. A refusal comes as a problem with its faults.

/** Milliseconds between questions whether a server that fell silent is there again, and what is asked of it. */
const AGAIN = 2000;
const SMALL = "/icon.svg";
const TOO_MANY = 429;

/**
 * What answers where the page has no server, in the form in which one does.
 *
 * @typedef {{
 *   answer: (address: string, body: any, signal?: AbortSignal) => Promise<Response>,
 *   lines: (body: any) => AsyncGenerator<any>,
 * }} Answers
 */
/** @type {{ answers?: Answers }} */
export const alone = {};

export class Problem extends Error {
  /** @param {{ title: string, status?: number, lines?: string[], faults?: FaultLine[] }} document */
  constructor(document) {
    super(document.title);
    this.isBusy = document.status === TOO_MANY;
    this.status = document.status ?? 0;
    this.faults = document.faults ?? [];
    this.lines = document.lines?.length ? document.lines : [document.title];
  }
}

/**
 * The lines to show for whatever went wrong with a request.
 *
 * @param {unknown} error
 * @returns {string[]}
 */
export function linesOf(error) {
  if (error instanceof Problem) return error.lines;
  const reason = error instanceof Error ? error.message : String(error);
  if (alone.answers) return [`This part of the page could not be computed: ${reason}`];
  return [`The server does not answer (${reason}). Is it running? The page goes on by itself once it answers.`];
}

/** The connection to the server; those who listen to ``return`` are told when one that fell silent answers again. */
class Connection extends EventTarget {
  /** Asks whether the server is there again, while it is not. @type {ReturnType<typeof setInterval> | undefined} */
  #asking;

  /** True from a request that did not reach the server until it answers again. */
  get isSilent() {
    return this.#asking !== undefined;
  }

  /** Ask until the server answers again. */
  wait() {
    this.#asking ??= setInterval(() => this.#ask(), AGAIN);
  }

  async #ask() {
    try {
      await fetch(SMALL, { cache: "no-store" });
    } catch {
      return; // it is still silent
    }
    clearInterval(this.#asking);
    this.#asking = undefined;
    this.dispatchEvent(new Event("return"));
  }
}

export const connection = new Connection();

/**
 * The response of the server; where it does not answer, it is asked until it does.
 *
 * @param {string} address
 * @param {RequestInit} [options]
 */
async function reached(address, options) {
  try {
    return await fetch(address, options);
  } catch (error) {
    if (!options?.signal?.aborted) connection.wait();
    throw error;
  }
}

/** @param {Response} response */
async function checked(response) {
  if (response.ok) return response;
  let document = { title: `The server answered ${response.status}` };
  try {
    document = await response.json();
  } catch {
    // no JSON: the status says it
  }
  throw new Problem(document);
}

/**
 * The JSON document at an address.
 *
 * @param {string} address
 * @param {AbortSignal} [signal]
 */
export async function get(address, signal) {
  return (await answerAt(address, { signal })).json();
}

/**
 * The answer at an address.
 *
 * @param {string} address
 * @param {RequestInit} options
 */
export async function answerAt(address, options) {
  if (alone.answers) {
    const { body, signal } = options;
    return alone.answers.answer(address, body ? JSON.parse(String(body)) : undefined, signal ?? undefined);
  }
  return checked(await reached(`/api/v1/${address}`, options));
}

/**
 * The answer to a body.
 *
 * @param {string} address
 * @param {object} body
 * @param {AbortSignal} [signal]
 */
export async function send(address, body, signal) {
  return answerAt(address, {
    method: "POST",
    headers: { "Content-Type": "application/json" },
    body: JSON.stringify(body),
    signal,
  });
}

/**
 * The JSON document that answers a body.
 *
 * @param {string} address
 * @param {object} body
 * @param {AbortSignal} [signal]
 */
export async function sendJson(address, body, signal) {
  return (await send(address, body, signal)).json();
}

/**
 * The lines of JSON that answer a body, each as it comes.
 *
 * @param {string} address
 * @param {object} body
 * @param {AbortSignal} signal
 * @returns {AsyncGenerator<AnswerLine>}
 */
export async function* sendLines(address, body, signal) {
  if (alone.answers) {
    yield* alone.answers.lines(body);
    return;
  }
  const response = await send(address, body, signal);
  let rest = "";
  for await (const part of parts(response, signal)) {
    const lines = `${rest}${part}`.split("\n");
    rest = lines.pop() ?? "";
    for (const line of lines) yield JSON.parse(line);
  }
}

/**
 * The parts of a text as they come; where they break off, the server is asked until it answers again.
 *
 * @param {Response} response
 * @param {AbortSignal} signal
 */
async function* parts(response, signal) {
  const reader = response.body?.pipeThrough(new TextDecoderStream()).getReader();
  try {
    for (let part = await reader?.read(); part && !part.done; part = await reader?.read()) yield part.value;
  } catch (error) {
    if (!signal.aborted) connection.wait();
    throw error;
  }
}

/** Requests of one kind, of which a new one cancels that before. */
export class Latest {
  #controller = new AbortController();

  /** Cancel the one before. @returns {AbortSignal} that of a new one */
  begin() {
    this.cancel();
    this.#controller = new AbortController();
    return this.#controller.signal;
  }

  cancel() {
    this.#controller.abort();
  }
}

/** Most answers that are kept, and most characters of JSON of all of them together. */
const MOST_KEPT = 50;
const MOST_CHARACTERS = 20e6;

/** Answers by their addresses and bodies, of which the oldest give way. */
class Kept {
  /** Each with its characters of JSON. @type {Map<string, [any, number]>} */
  #answers = new Map();
  #characters = 0;

  /** @param {string} key */
  get(key) {
    return this.#answers.get(key)?.[0];
  }

  /** @param {string} key @param {any} answer */
  add(key, answer) {
    const size = JSON.stringify(answer).length;
    if (size > MOST_CHARACTERS || this.#answers.has(key)) return;
    this.#answers.set(key, [answer, size]);
    this.#characters += size;
    for (const [oldest, [, its]] of this.#answers) {
      if (this.#answers.size <= MOST_KEPT && this.#characters <= MOST_CHARACTERS) break;
      this.#answers.delete(oldest);
      this.#characters -= its;
    }
  }
}

const kept = new Kept();

/** Answers of requests that are under way, by their addresses and bodies. @type {Map<string, Promise<any>>} */
const awaited = new Map();

/**
 * The answer of an address to a body; of the same body again it is not asked again while it is kept, or on its way.
 *
 * @param {"run" | "check" | "band" | "duty" | "warm-up"} address
 * @param {object} body
 * @param {AbortSignal} signal
 * @param {() => Promise<any>} [compute] how it is asked, where not by a request that is waited for
 * @param {typeof sendJson} [how] how such a request is sent
 */
export async function ask(address, body, signal, compute, how = sendJson) {
  const before = known(address, body);
  if (before) return before;
  const found = await (compute ? compute() : requested(address, body, signal, how));
  keep(address, body, found);
  return found;
}

/** @param {string} address @param {object} body @param {AbortSignal} signal @param {typeof sendJson} how */
async function requested(address, body, signal, how) {
  const key = keyOf(address, body);
  try {
    const other = awaited.get(key);
    if (other) return await other;
  } catch (error) {
    signal.throwIfAborted();
    if (error instanceof Problem) throw error; // refused or cancelled: for this one as well
    // whoever asked before has left: this one asks on its own
  }
  const own = how(address, body, signal);
  awaited.set(key, own);
  try {
    return await own;
  } finally {
    if (awaited.get(key) === own) awaited.delete(key);
  }
}

/** @param {string} address @param {object} body */
function keyOf(address, body) {
  return `${address} ${JSON.stringify(body)}`;
}

/**
 * The answer of an address to a body, if it is kept.
 *
 * @param {string} address
 * @param {object} body
 */
export function known(address, body) {
  return kept.get(keyOf(address, body));
}

/**
 * Keep an answer in place of the oldest ones; one that is larger than all of them may be is not kept.
 *
 * @param {string} address
 * @param {object} body
 * @param {any} answer
 */
export function keep(address, body, answer) {
  kept.add(keyOf(address, body), answer);
}
