// Where the bytes of a module come from: the document itself, a file beside it, or, opened from a folder of files, a
// script that holds them.

/**
 * What the document was given.
 * @typedef {{digest: string, worker: string, embedded: Record<string, string>, contents: any}} Site
 */

/** @returns {Site} */
export function site() {
  return /** @type {any} */ (globalThis).ballscrewSite;
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

/**
 * The compiled module of a file.
 * @param {string} file
 * @returns {Promise<WebAssembly.Module>}
 */
export async function moduleOf(file) {
  const { embedded } = site();
  if (embedded[file] === undefined && location.protocol === "file:") await scriptOf(file);
  if (embedded[file] !== undefined) return WebAssembly.compile(bytesOf(embedded[file]));
  const answer = await fetch(`kernels/${file}`);
  if (!answer.ok) throw new Error(`kernels/${file}: ${answer.status}`);
  return WebAssembly.compile(await answer.arrayBuffer());
}

/** Keep the page for when there is no network; only where a server sent it. */
export function keepOffline() {
  if ("serviceWorker" in navigator && location.protocol.startsWith("http")) {
    // another version takes over: this page would ask for modules that are there no more
    if (navigator.serviceWorker.controller) {
      navigator.serviceWorker.addEventListener("controllerchange", () => location.reload());
    }
    navigator.serviceWorker.register("service_worker.js").catch(() => {});
  }
}
