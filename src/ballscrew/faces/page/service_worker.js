// Keeps the files of one version of the page, named by its digest, so that it opens without a network. What is kept of
// an earlier version at the same address goes when this one takes over, and pages that are open are loaded again.
const scope = /** @type {any} */ (globalThis);
const HERE = `ballscrew ${scope.registration.scope} `;
const NAME = `${HERE}${"DIGEST"}`;
const KEPT = ["FILES"];

scope.addEventListener("install", (/** @type {any} */ event) => {
  const kept = caches
    .open(NAME)
    .then((cache) => cache.addAll(KEPT.map((file) => new Request(file, { cache: "reload" }))));
  event.waitUntil(kept.then(() => scope.skipWaiting()));
});

scope.addEventListener("activate", (/** @type {any} */ event) => {
  const old = caches.keys().then((names) => names.filter((name) => name.startsWith(HERE) && name !== NAME));
  const gone = old.then((names) => Promise.all(names.map((name) => caches.delete(name))));
  event.waitUntil(gone.then(() => scope.clients.claim()));
});

scope.addEventListener("fetch", (/** @type {any} */ event) => {
  if (event.request.method !== "GET") return;
  const known = caches.open(NAME).then((cache) => cache.match(event.request, { ignoreSearch: true }));
  event.respondWith(known.then((answer) => answer ?? fetch(event.request)));
});
