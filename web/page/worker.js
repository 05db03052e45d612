// The service worker: keeps the page, so that it opens without a network as well.
//
// Each version of the page has its own worker, into which `bundle.js` writes the document and the
// names of all files of that version. The worker of the next version waits until no window shows
// this one, then removes the files of this one.

/**
 * @typedef {Event & { waitUntil: (done: Promise<unknown>) => void }} Lasting
 * @typedef {Lasting & { request: Request, respondWith: (answer: Promise<Response>) => void }} Asking
 */

/** The folder of the page; a site may have several pages, which share the caches. */
const PLACE = new URL("./", location.href).href;

/** How long the server may take for the document [ms]; after that the kept one is shown. */
const PATIENCE = 4_000;

/** Common start of the cache names of all versions of this page. */
const FAMILY = `carom ${PLACE} `;

/** File names contain hashes of their content, so together they identify the version. */
const VERSION = FAMILY + [...FILES].sort().join(" ");

const kept = new Set(FILES.map((name) => PLACE + name));

addEventListener("install", (event) => {
  /** @type {Lasting} */ (event).waitUntil(keepFiles());
});

addEventListener("activate", (event) => {
  /** @type {Lasting} */ (event).waitUntil(forgetOtherVersions());
});

addEventListener("fetch", (event) => {
  const asking = /** @type {Asking} */ (event);
  const { request } = asking;
  if (isDocument(request)) {
    asking.respondWith(newestDocument(request));
  } else if (kept.has(request.url)) {
    asking.respondWith(keptFile(request));
  }
});

/**
 * Keeps all files. The page has just fetched most of them, so they come from the browser's cache.
 */
async function keepFiles() {
  const cache = await caches.open(VERSION);
  await cache.addAll(kept);
}

async function forgetOtherVersions() {
  const names = await caches.keys();
  const others = names.filter((name) => name.startsWith(FAMILY) && name !== VERSION);
  await Promise.all(others.map((name) => caches.delete(name)));
}

/** @param {Request} request */
function isDocument({ mode, url }) {
  const [place] = url.split(/[?#]/);
  return mode === "navigate" && (place === PLACE || place === `${PLACE}index.html`);
}

/**
 * Returns the server's document, which names the files of the newest version; without a network, or
 * if the server does not answer, the document of the files kept here.
 *
 * @param {Request} request
 */
async function newestDocument(request) {
  // A document from the browser's cache may name files that no longer exist.
  const asked = fetch(request, { cache: "no-cache" });
  const inTime = new Promise((resolve) => setTimeout(resolve, PATIENCE));
  const answer = await Promise.race([asked, inTime]).catch(() => undefined);
  if (answer instanceof Response && answer.status < 500) {
    return answer;
  }
  return new Response(INDEX, { headers: { "Content-Type": "text/html; charset=utf-8" } });
}

/** @param {Request} request */
async function keptFile(request) {
  // A name stands for one content, whatever the headers say.
  const found = await caches.match(request, { cacheName: VERSION, ignoreVary: true });
  return found ?? fetch(request);
}
