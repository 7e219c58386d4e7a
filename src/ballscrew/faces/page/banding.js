// Asks for bands, of a worker where the page has one: a page of one file and one that is opened from a folder have none,
// as browsers start workers only from where a server sent them. There it goes on in steps while nothing else is to do.

import { bandsOf, calibratedOf, makersIn, uncertainIn } from "./bands.js";

/** @typedef {import("./bands.js").Question} Question */
/** @typedef {import("./bands.js").PointBand | import("./bands.js").FanBand} Band */

/** Milliseconds of a step on the page itself. */
const PAGE_STEP = 8;

export class Banding {
  /**
   * @param {import("./engine.js").Engine} engine
   * @param {any} contents
   * @param {{ worker: string, moduleOf: (file: string) => Promise<WebAssembly.Module> }} options
   */
  constructor(engine, contents, { worker, moduleOf }) {
    this.engine = engine;
    this.contents = contents;
    this.moduleOf = moduleOf;
    this.id = 0;
    /** Files that the worker has. @type {Set<string>} */
    this.sent = new Set();
    /** @type {Worker | undefined} */
    this.worker = undefined;
    this.file = location.protocol === "file:" ? "" : worker;
  }

  /**
   * The band of a case; none where the page has none for it, or where it is not wanted any more.
   *
   * @param {Question} question
   * @param {AbortSignal} signal
   * @returns {Promise<Band | undefined>}
   */
  async ask(question, signal) {
    const { bands, structures, oils, solver } = this.contents;
    if (uncertainIn(bands, question) === undefined) return undefined;
    const { structure } = question;
    const names = makersIn(bands, question).length ? [structure, calibratedOf(question)] : [structure];
    if (!this.file) return this.#askHere(question, names, signal);
    const files = [...names.flatMap((name) => this.engine.filesFor(name)), bands.file];
    const wanted = files.filter((file, place) => !this.sent.has(file) && files.indexOf(file) === place);
    const modules = await Promise.all(wanted.map(async (file) => [file, await this.moduleOf(file)]));
    for (const file of wanted) this.sent.add(file);
    const isNew = this.worker === undefined;
    this.worker ??= new Worker(this.file);
    const { worker } = this;
    this.id += 1;
    const { id } = this;
    return new Promise((resolve, reject) => {
      const hear = (/** @type {MessageEvent} */ { data }) => {
        if (data.id !== id) return;
        worker.removeEventListener("message", hear);
        if (data.trouble) reject(new Error(data.trouble));
        else resolve(data.band);
      };
      worker.addEventListener("message", hear);
      signal.addEventListener("abort", () => {
        worker.postMessage({ id, isOver: true });
        worker.removeEventListener("message", hear);
        reject(signal.reason);
      });
      // what is judged is of no use there
      const contents = isNew ? { structures, oils, solver, bands } : undefined;
      worker.postMessage({ id, question, modules, contents });
    });
  }

  /** @param {Question} question @param {string[]} names @param {AbortSignal} signal */
  async #askHere(question, names, signal) {
    await this.engine.loadFile(this.contents.bands.file);
    for (const name of names) await this.engine.load(name);
    const idle = () => new Promise((resolve) => (globalThis.requestIdleCallback ?? setTimeout)(resolve));
    for (const band of bandsOf(this.engine, this.contents.bands, question, PAGE_STEP)) {
      if (band) return band;
      await idle();
      signal.throwIfAborted();
    }
    return undefined;
  }
}
