// Computes bands beside the page, so that nothing waits for them. It is sent modules that are compiled already, and
// asks for nothing. A later question takes the place of an earlier one.

import { bandsOf, calibratedOf, makersIn } from "./bands.js";
import { Engine } from "../../web/page/engine.js";

/** Milliseconds of a step: an outdated question is dropped after one. */
const STEP = 40;

const own = /** @type {any} */ (globalThis);
/** @type {Engine | undefined} */
let engine;
/** @type {any} */
let known;
/** @type {Map<string, WebAssembly.Module>} */
const modules = new Map();
let latest = 0;

/** Let messages that have come meanwhile be heard. */
function pause() {
  return new Promise((resolve) => setTimeout(resolve, 0));
}

/** @param {number} id @param {import("./bands.js").Question} question */
async function answer(id, question) {
  if (engine === undefined) return;
  await engine.load(question.structure);
  if (makersIn(known.bands, question).length) await engine.load(calibratedOf(question));
  await engine.loadFile(known.bands.file);
  const began = performance.now();
  for (const band of bandsOf(engine, known.bands, question, STEP)) {
    if (band) own.postMessage({ id, band, milliseconds: performance.now() - began });
    await pause();
    if (id !== latest) return;
  }
}

own.addEventListener("message", (/** @type {MessageEvent} */ { data }) => {
  for (const [file, module] of data.modules) modules.set(file, module);
  if (data.contents) {
    known = data.contents;
    engine = new Engine(known, async (file) => /** @type {WebAssembly.Module} */ (modules.get(file)));
  }
  latest = data.id;
  answer(data.id, data.question).catch((error) => own.postMessage({ id: data.id, trouble: String(error) }));
});
