// Keeps the site on this machine, so that it works without a network. `FILES` and `VERSION` are written by
// `cargo xtask site`: another version is fetched as a whole before it replaces the one that is kept.

const scope = /** @type {ServiceWorkerGlobalScope} */ (/** @type {unknown} */ (self));
const VERSION = "%VERSION%";
const FILES = ["%FILES%"];

scope.addEventListener("install", (event) => {
  const keep = async () => (await caches.open(VERSION)).addAll(FILES.map((file) => new Request(file, { cache: "reload" })));
  event.waitUntil(keep());
});

scope.addEventListener("activate", (event) => {
  const clean = async () => {
    const others = (await caches.keys()).filter((name) => name.startsWith("taxel-") && name !== VERSION);
    await Promise.all(others.map((name) => caches.delete(name)));
  };
  event.waitUntil(clean());
});

scope.addEventListener("fetch", (event) => {
  const answer = async () => {
    const kept = await caches.open(VERSION);
    return (await kept.match(event.request, { ignoreSearch: true })) ?? fetch(event.request);
  };
  event.respondWith(answer());
});
