// The service worker: keeps the page, so that it opens without a network as well.
//
// Each version of the page has its own, which `bundle.js` gives the document and the names of all
// files of that version. The next version waits until no window shows this one any more, and then
// takes what this one kept away.

/**
 * @typedef {Event & { waitUntil: (done: Promise<unknown>) => void }} Lasting
 * @typedef {Lasting & { request: Request, respondWith: (answer: Promise<Response>) => void }} Asking
 */

/** Where the page lies; a site may have several, and all of them share what is kept. */
const PLACE = new URL("./", location.href).href;

/** How long the server may take for the document [ms]: all is here to be shown meanwhile. */
const PATIENCE = 4_000;

/** What the names of all versions of this page begin with. */
const FAMILY = `carom ${PLACE} `;

/** The names of the files hold hashes of what is in them, so that they name the version. */
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

/** The page has just fetched most of them: the browser has them still, and asks no server again. */
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
 * The server's document, which names the files of the newest version; without a network, or with one
 * that answers nothing, the one that goes with the files kept here.
 *
 * @param {Request} request
 */
async function newestDocument(request) {
  // One that the browser keeps may name files that are gone by now.
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
  // A name stands for one content, whatever headers say of it.
  const found = await caches.match(request, { cacheName: VERSION, ignoreVary: true });
  return found ?? fetch(request);
}
