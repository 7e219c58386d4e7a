// Computes bands beside the page, so that nothing waits for them. It is sent modules that are compiled already, and
// asks for nothing.

import { bandsOf, calibratedOf, makersIn } from "./bands.js";
import { Engine } from "./engine.js";

/** Milliseconds of a step: a question that is over is dropped after one. */
const STEP = 40;

const own = /** @type {any} */ (globalThis);
/** What it was sent first: the contents of the page, and the engine of these. @type {{ contents?: any, engine?: Engine }} */
const known = {};
/** @type {Map<string, WebAssembly.Module>} */
const modules = new Map();
/** Questions that are wanted. @type {Set<number>} */
const wanted = new Set();

/** Let messages that have come meanwhile be heard. */
function pause() {
  return new Promise((resolve) => setTimeout(resolve, 0));
}

/** @param {number} id @param {import("./bands.js").Question} question */
async function answer(id, question) {
  const { engine, contents } = known;
  if (engine === undefined) return;
  await engine.load(question.structure);
  if (makersIn(contents.bands, question).length) await engine.load(calibratedOf(question));
  await engine.loadFile(contents.bands.file);
  for (const band of bandsOf(engine, contents.bands, question, STEP)) {
    if (!wanted.has(id)) return;
    if (band) own.postMessage({ id, band });
    else await pause();
  }
  wanted.delete(id);
}

own.addEventListener("message", (/** @type {MessageEvent} */ { data }) => {
  if (data.isOver) {
    wanted.delete(data.id);
    return;
  }
  for (const [file, module] of data.modules) modules.set(file, module);
  if (data.contents) {
    known.contents = data.contents;
    known.engine = new Engine(data.contents, async (file) => /** @type {WebAssembly.Module} */ (modules.get(file)));
  }
  wanted.add(data.id);
  answer(data.id, data.question).catch((error) => own.postMessage({ id: data.id, trouble: String(error) }));
});
