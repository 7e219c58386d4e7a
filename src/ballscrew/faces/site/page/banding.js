// Asks for bands, of a worker where the page has one: a page of one file and one that is opened from a folder have none,
// as browsers start workers only from where a server sent them. There it goes on in steps while nothing else is to do.

import { bandsOf, calibratedOf, makersIn, uncertainIn } from "./bands.js";

/** @typedef {import("./bands.js").Question} Question */
/** @typedef {import("./bands.js").PointBand} PointBand */
/** @typedef {import("./bands.js").FanBand} FanBand */
/**
 * What is known of the band of the case: nothing while it is computed.
 * @typedef {{
 *   point?: PointBand, fan?: FanBand, inputs?: number, makers?: string[], isMissing?: boolean, isBeside: boolean, milliseconds: number,
 * }} Banded
 */

/** Milliseconds of a step on the page itself. */
const PAGE_STEP = 8;

export class Banding {
  /**
   * @param {import("../../web/page/engine.js").Engine} engine
   * @param {any} contents
   * @param {{ worker: string, moduleOf: (file: string) => Promise<WebAssembly.Module>, heard: (banded: Banded) => void }} options
   */
  constructor(engine, contents, { worker, moduleOf, heard }) {
    this.engine = engine;
    this.contents = contents;
    this.moduleOf = moduleOf;
    this.heard = heard;
    this.id = 0;
    /** @type {Set<string>} */
    this.sent = new Set();
    /** @type {Banded} */
    this.banded = { isBeside: false, milliseconds: 0 };
    /** @type {Worker | undefined} */
    this.worker = undefined;
    this.file = location.protocol === "file:" ? "" : worker;
  }

  /** What is computed now is of an outdated case. */
  drop() {
    this.id += 1;
    this.banded = { isBeside: this.banded.isBeside, milliseconds: 0 };
  }

  /** @param {Question} question */
  async ask(question) {
    this.drop();
    const own = this.id;
    const rows = uncertainIn(this.contents.bands, question);
    if (rows === undefined) {
      this.#hear(own, { isMissing: true });
      return;
    }
    this.banded.inputs = rows.length;
    this.banded.makers = makersIn(this.contents.bands, question);
    try {
      if (this.file) await this.#askWorker(own, question);
      else await this.#askHere(own, question);
    } catch (error) {
      console.warn(error);
      this.#hear(own, { isMissing: true });
    }
  }

  /** @param {number} own @param {Question} question */
  async #askWorker(own, question) {
    const structures = this.#structuresOf(question);
    const files = [...structures.flatMap((name) => this.engine.filesFor(name)), this.contents.bands.file];
    const wanted = files.filter((file, place) => !this.sent.has(file) && files.indexOf(file) === place);
    const modules = await Promise.all(wanted.map(async (file) => [file, await this.moduleOf(file)]));
    if (own !== this.id) return;
    const { oils, solver, bands } = this.contents;
    /** @type {any} */
    const message = { id: own, question, modules };
    if (this.worker === undefined) {
      this.worker = this.#begun();
      message.contents = { structures: this.contents.structures, oils, solver, bands }; // what is judged is of no use there
    }
    this.worker.postMessage(message);
    for (const file of wanted) this.sent.add(file);
  }

  /** What is evaluated. @param {Question} question */
  #structuresOf(question) {
    const { structure } = question;
    return makersIn(this.contents.bands, question).length ? [structure, calibratedOf(question)] : [structure];
  }

  #begun() {
    const worker = new Worker(this.file);
    worker.addEventListener("message", ({ data: { id, band, milliseconds, trouble } }) => {
      if (trouble) console.warn(trouble);
      this.#hear(id, { ...(band ? { [band.kind]: band } : { isMissing: true }), isBeside: true, milliseconds });
    });
    worker.addEventListener("error", () => {
      this.#hear(this.id, { isMissing: true });
    });
    return worker;
  }

  /** @param {number} own @param {Question} question */
  async #askHere(own, question) {
    await this.engine.loadFile(this.contents.bands.file);
    for (const name of this.#structuresOf(question)) await this.engine.load(name);
    const steps = bandsOf(this.engine, this.contents.bands, question, PAGE_STEP);
    let milliseconds = 0;
    const idle =
      globalThis.requestIdleCallback ?? ((/** @type {(idle?: IdleDeadline) => void} */ run) => setTimeout(run, 1));
    const go = (/** @type {IdleDeadline | undefined} */ deadline) => {
      do {
        if (own !== this.id) return;
        const began = performance.now();
        const { value, done } = steps.next();
        milliseconds += performance.now() - began;
        if (done) return;
        if (value) this.#hear(own, { [value.kind]: value, milliseconds });
      } while ((deadline?.timeRemaining() ?? 0) > PAGE_STEP);
      idle(go);
    };
    idle(go);
  }

  /** @param {number} id @param {Partial<Banded>} found */
  #hear(id, found) {
    if (id !== this.id) return;
    this.banded = { ...this.banded, ...found };
    this.heard(this.banded);
  }
}
