// A module whose download stops: the page says so, and fetches it again at a click.

import assert from "node:assert/strict";
import { after, before, test } from "node:test";

import { complaints, keepPicture, newPage } from "./browser.js";
import { passOn } from "./passing_on.js";
import { StandIn } from "./stood_in.js";

/** @type {StandIn} */
let standIn;

before(async () => {
  standIn = await StandIn.set();
});

after(() => standIn?.clear());

/**
 * Serves the site of the stand-in, but only a part of its module until the network is mended.
 *
 * @param {number} part of the module; 0 for no answer
 */
async function serveStalling(part) {
  const wasm = await standIn.site.module();
  let isMended = false;
  const server = await passOn(standIn.site.url, (request, response) => {
    const isHeld = Boolean(request.url?.endsWith(".wasm")) && !isMended;
    if (isHeld && part > 0) {
      response.writeHead(200, { "Content-Length": wasm.length });
      response.write(wasm.subarray(0, part * wasm.length));
    }
    return isHeld;
  });
  return { ...server, mend: () => void (isMended = true) };
}

for (const [part, what] of /** @type {const} */ ([
  [0, "does not begin to arrive"],
  [0.5, "stops half way"],
])) {
  test(`the page says that its module ${what}, and fetches it again at a click`, async (context) => {
    const site = await serveStalling(part);
    context.after(site.close);
    const page = await newPage(standIn.browser);
    const heard = complaints(page);
    // A simulated clock that stands, so that the test neither waits nor depends on how long the
    // page takes.
    await page.clock.install({ time: 0 });
    await page.clock.pauseAt(1000);
    // The scripts have run by then; the module delays the browser's load event.
    await page.goto(site.url, { waitUntil: "domcontentloaded" });
    await page.waitForFunction(
      (part) => (document.querySelector("progress")?.value || 0) >= 0.9 * part,
      part,
    );
    await page.clock.runFor(19_000);
    assert.equal(await page.isVisible("#loading.trouble"), false);
    await page.clock.runFor(10_000);
    await page.waitForSelector("#loading.trouble");
    assert.match((await page.textContent("#message")) ?? "", /nothing came for 20 seconds/);
    await keepPicture(page, `page-stalled-${part}`);
    assert.equal(heard.length, 1, `${heard}`);
    site.mend();
    await page.clock.resume();
    await page.click("#again");
    await page.waitForSelector("#loading.done", { state: "attached" });
    await page.context().close();
  });
}
