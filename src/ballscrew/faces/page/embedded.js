// What the document was given beside its scripts, and where the bytes of a module come from: the document itself, a file
// beside it, or, opened from a folder of files, a script that holds them; else the server.

import { answerAt } from "./server.js";

/**
 * What the document was given: nothing but its digest where a server answers.
 *
 * @typedef {{ digest: string, worker?: string, embedded?: Record<string, string>, contents?: any }} Site
 */

/** @returns {Site} */
export function site() {
  return /** @type {any} */ (globalThis).ballscrewSite;
}

/** Compiled modules by their files. @type {Map<string, Promise<WebAssembly.Module>>} */
const compiled = new Map();

/** The compiled module of a file: asked for again where it could not be had. @param {string} file */
export function moduleOf(file) {
  const known = compiled.get(file);
  if (known) return known;
  const made = site().embedded
    ? compiledHere(file)
    : answerAt(`modules/${file}`, {}).then((answer) => WebAssembly.compileStreaming(answer));
  compiled.set(file, made);
  made.catch(() => compiled.delete(file));
  return made;
}

/** @param {string} file */
async function compiledHere(file) {
  const { embedded = {} } = site();
  if (embedded[file] === undefined && location.protocol === "file:") await scriptOf(file);
  if (embedded[file] !== undefined) return WebAssembly.compile(bytesOf(embedded[file]));
  const answer = await fetch(`kernels/${file}`);
  if (!answer.ok) throw new Error(`kernels/${file}: ${answer.status}`);
  return WebAssembly.compile(await answer.arrayBuffer());
}

/** @param {string} text */
function bytesOf(text) {
  return Uint8Array.from(atob(text), (character) => character.charCodeAt(0));
}

/** @param {string} file */
function scriptOf(file) {
  return new Promise((resolve, reject) => {
    const script = document.createElement("script");
    script.src = `kernels/${file}.js`;
    script.onload = resolve;
    script.onerror = () => reject(new Error(`${script.src} cannot be read`));
    document.head.append(script);
  });
}

/** Keep the page for when there is no network; only where it came over one, without a server that answers. */
export function keepOffline() {
  if (!site().contents || !("serviceWorker" in navigator) || !location.protocol.startsWith("http")) return;
  // another version takes over: this page would ask for modules that are there no more
  if (navigator.serviceWorker.controller) {
    navigator.serviceWorker.addEventListener("controllerchange", () => location.reload());
  }
  navigator.serviceWorker.register("service_worker.js").catch(() => {});
}
