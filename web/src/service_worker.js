/**
 * Keeps the player in the browser, so that the next visit loads nothing of it. For pages without a bundler, whose service
 * worker has
 *
 *     importScripts("fbs-player/src/service_worker.js");
 *     keepFbsPlayer("fbs-player/src/");
 *
 * All files of a version come into a cache of its own, and are given from there. A new version comes beside it, and takes its
 * place once no page has the old one: never are two mixed.
 */
{
  // What build.sh has put into the package.
  const VERSION = "@VERSION@", FILES = "@FILES@".split(" ");
  const VECTOR_PROBE = Uint8Array.from("@PROBE@".split(","), Number);

  const worker = /** @type {any} */ (self);

  /** @param {string} folder  the package's `src`, from where the service worker is */
  worker.keepFbsPlayer = (folder) => {
    const base = new URL(folder, worker.location.href).href;
    const ours = `fbs-player ${worker.registration.scope} `, name = ours + VERSION;
    const other = WebAssembly.validate(VECTOR_PROBE) ? "fbs.wasm" : "fbs-simd.wasm";

    async function install() {
      const cache = await caches.open(name);
      const files = FILES.filter((file) => file !== other);
      await cache.addAll(files.map((file) => new Request(base + file, { cache: "no-cache" })));
    }

    async function removeOthers() {
      const names = await caches.keys();
      await Promise.all(names.filter((each) => each.startsWith(ours) && each !== name).map((each) => caches.delete(each)));
    }

    /** @param {Request} request */
    async function answer(request) {
      const kept = await caches.open(name).then((cache) => cache.match(request.url));
      return kept ?? fetch(request);
    }

    worker.addEventListener("install", (/** @type {any} */ event) => event.waitUntil(install()));
    worker.addEventListener("activate", (/** @type {any} */ event) => event.waitUntil(removeOthers()));
    worker.addEventListener("fetch", (/** @type {any} */ event) => {
      if (event.request.url.startsWith(base)) event.respondWith(answer(event.request));
    });
  };
}
