// The page around the module: loading, errors, and services for the module.

import assert from "node:assert/strict";
import { after, before, describe, test } from "node:test";

import { complaints, keepDownload, keepPicture, launch, newPage } from "./browser.js";
import { passOn } from "./passing_on.js";
import { StandIn } from "./stood_in.js";

/** @type {StandIn} */
let standIn;

before(async () => {
  standIn = await StandIn.set();
});

after(() => standIn?.clear());

/**
 * Opens a page with this preparation and waits until it has loaded or failed.
 *
 * @param {string} fragment
 * @param {(page: import("playwright-core").Page) => Promise<unknown>} [prepare]
 * @param {import("playwright-core").BrowserContextOptions} [options]
 */
async function open(fragment, prepare, options) {
  const viewport = { width: 900, height: 600 };
  const page = await newPage(standIn.browser, { viewport, ...options });
  const heard = complaints(page);
  await prepare?.(page);
  await page.goto(`${standIn.site.url}${fragment}`);
  await page.waitForSelector("#loading.done, #loading.trouble", { state: "attached" });
  return { page, heard, close: () => page.context().close() };
}

/** @param {import("playwright-core").Page} page */
const message = (page) => page.textContent("#message");

const isModule = (/** @type {URL} */ url) => url.pathname.endsWith(".wasm");

describe("the page", () => {
  test("shows how much has arrived, then makes way", async (context) => {
    // The second half of the module arrives when the test has seen the first.
    const wasm = await standIn.site.module();
    const half = wasm.length / 2;
    /** @type {() => void} */
    let sendRest = () => assert.fail("the module is not requested");
    const server = await passOn(standIn.site.url, (request, response) => {
      if (!request.url?.endsWith(".wasm")) return false;
      response.writeHead(200, { "Content-Length": wasm.length });
      response.write(wasm.subarray(0, half));
      sendRest = () => void response.end(wasm.subarray(half));
      return true;
    });
    context.after(server.close);
    const page = await newPage(standIn.browser);
    const heard = complaints(page);
    // Half a module does not stall a clock that stands.
    await page.clock.install({ time: 0 });
    await page.clock.pauseAt(1000);
    await page.goto(server.url, { waitUntil: "commit" });
    await page.waitForFunction(() => document.querySelector("progress")?.value === 0.5);
    assert.equal(await message(page), "Loading 2.0 of 4.0 MB");
    await keepPicture(page, "page-loading");
    await page.clock.resume();
    sendRest();
    await page.waitForSelector("#loading.done", { state: "attached" });
    assert.equal(await page.evaluate(() => document.activeElement?.id), "carom");
    assert.deepEqual(heard, []);
    await page.context().close();
  });

  test("requests nothing from other servers", async () => {
    /** @type {string[]} */
    const asked = [];
    const { close } = await open("", async (page) =>
      page.on("request", (it) => asked.push(it.url())),
    );
    const elsewhere = asked.filter((url) => !url.startsWith(standIn.site.url));
    assert.deepEqual(elsewhere, []);
    await close();
  });

  for (const colorScheme of /** @type {const} */ (["light", "dark"])) {
    test(`says on a ${colorScheme} ground that the module is missing`, async () => {
      const { page, close } = await open(
        "",
        (page) => page.route(isModule, (route) => route.fulfill({ status: 404 })),
        { colorScheme },
      );
      assert.match((await message(page)) ?? "", /could not be fetched/);
      assert.match((await page.textContent("#detail")) ?? "", /\.wasm: 404/);
      await keepPicture(page, `page-missing-${colorScheme}`);
      await close();
    });
  }

  test("says that the network is not there, and tries again at a click", async () => {
    const { page, close } = await open("", (page) =>
      page.route(isModule, (route) => route.abort()),
    );
    assert.match((await message(page)) ?? "", /Is the network there\?/);
    await page.unroute(isModule);
    await page.click("#again");
    await page.waitForSelector("#loading.done", { state: "attached" });
    await close();
  });

  test("says that the module did not arrive whole", async () => {
    // Ends inside the module's first section.
    const body = Buffer.from([0, 0x61, 0x73, 0x6d, 1, 0, 0, 0, 0, 100]);
    const { page, close } = await open("", (page) =>
      page.route(isModule, (route) => route.fulfill({ body })),
    );
    assert.equal(await message(page), "Carom did not arrive whole.");
    assert.match((await page.textContent("#detail")) ?? "", /^10 of 4000000 bytes$/);
    await close();
  });

  test("says that WebAssembly is missing", async () => {
    const { page, close } = await open("", (page) =>
      page.addInitScript(() => Reflect.deleteProperty(globalThis, "WebAssembly")),
    );
    assert.match((await message(page)) ?? "", /needs WebAssembly/);
    await close();
  });

  test("says what the module says when it does not start", async () => {
    const { page, close } = await open("#refuse");
    assert.equal(await message(page), "The graphics of this browser are not enough.");
    await close();
  });

  test("says that there is nothing to draw with, before it fetches the module", async () => {
    const blind = await launch("none");
    const page = await newPage(blind, { viewport: { width: 390, height: 844 } });
    await page.goto(standIn.site.url);
    await page.waitForSelector("#loading.trouble");
    assert.match((await message(page)) ?? "", /WebGPU or WebGL 2/);
    await keepPicture(page, "page-no-graphics-phone");
    await blind.close();
  });

  test("says that the module has stopped", async () => {
    const { page, close } = await open("");
    await page.evaluate(() => {
      setTimeout(() => {
        throw new WebAssembly.RuntimeError("unreachable");
      });
    });
    await page.waitForSelector("#loading.trouble");
    assert.match((await message(page)) ?? "", /has stopped/);
    assert.equal(await page.textContent("#detail"), "unreachable");
    await close();
  });

  test("gives all of a phone's window to the canvas, and does not scroll", async () => {
    const phone = { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true };
    const { page, close } = await open("", undefined, { ...phone, deviceScaleFactor: 3 });
    const box = await page.locator("#carom").boundingBox();
    assert.deepEqual(box, { x: 0, y: 0, width: 390, height: 844 });
    const client = await page.context().newCDPSession(page);
    await client.send("Input.synthesizeScrollGesture", { x: 200, y: 400, yDistance: -300 });
    assert.equal(await page.evaluate(() => scrollY + (visualViewport?.offsetTop ?? 0)), 0);
    await close();
  });

  test("keeps Space and arrows from the browser, but not Ctrl + F5 and the like", async () => {
    const { page, close } = await open("");
    const isPrevented = (/** @type {{ key: string, ctrlKey?: boolean }} */ init) =>
      page.evaluate((init) => {
        const event = new KeyboardEvent("keydown", { ...init, bubbles: true, cancelable: true });
        return !(document.getElementById("carom")?.dispatchEvent(event) ?? true);
      }, init);
    assert.equal(await isPrevented({ key: " " }), true);
    assert.equal(await isPrevented({ key: "ArrowDown" }), true);
    assert.equal(await isPrevented({ key: "End", ctrlKey: true }), false);
    assert.equal(await isPrevented({ key: "F5" }), false);
    await close();
  });
});

describe("the page, for the module,", () => {
  test("gives the module what stands behind # and what is put there later", async () => {
    const { page, close } = await open("#scene=simtest1");
    await page.evaluate(() => void (location.hash = "scene=simtest2"));
    await page.waitForFunction(() => /** @type {any} */ (globalThis).carom.fragments.length === 2);
    const fragments = await page.evaluate(() => /** @type {any} */ (globalThis).carom.fragments);
    assert.deepEqual(fragments, ["scene=simtest1", "scene=simtest2"]);
    await close();
  });

  test("shows fragments at a pace that browsers bear, and the last one for good", async () => {
    const { page, heard, close } = await open("");
    const [steps, hash] = await page.evaluate(async () => {
      const { services } = /** @type {any} */ (globalThis).carom;
      const before = history.length;
      for (let i = 0; i < 1000; i += 1) {
        services.showFragment(`t=${i}`);
      }
      const pause = (/** @type {number} */ time) =>
        new Promise((resolve) => setTimeout(resolve, time));
      while (location.hash !== "#t=999") {
        await pause(20);
      }
      // Longer than between two that are shown.
      await pause(900);
      return [history.length - before, location.hash];
    });
    assert.equal(steps, 0);
    assert.equal(hash, "#t=999");
    assert.deepEqual(heard, []);
    await close();
  });

  test("bears the title of what is shown", async () => {
    const { page, close } = await open("");
    assert.equal(await page.title(), "Carom");
    const show = async (/** @type {string} */ fragment, /** @type {string} */ title) => {
      await page.evaluate(
        (fragment) => /** @type {any} */ (globalThis).carom.services.showFragment(fragment),
        fragment,
      );
      await page.waitForFunction((title) => document.title === title, title);
    };
    await show("scene=tutorial3", "Newton's cradle - Carom");
    await show("scene=masse&t=2", "Massé shots - Carom");
    await show("file=AAAA&name=my%20scene", "my scene - Carom");
    await show("", "Carom");
    await close();
  });

  test("saves files under their names", async () => {
    const { page, close } = await open("");
    const waiting = page.waitForEvent("download");
    await page.evaluate(() => {
      const bytes = new TextEncoder().encode('name = "mine"\n');
      /** @type {any} */ (globalThis).carom.services.save("mine.toml", "text/plain", bytes);
    });
    const download = await waiting;
    assert.equal(download.suggestedFilename(), "mine.toml");
    const { readFile } = await import("node:fs/promises");
    assert.equal(
      await readFile(await keepDownload(download, "mine.toml"), "utf8"),
      'name = "mine"\n',
    );
    await close();
  });

  test("feels how the device is held against how it was when tilting began", async () => {
    const { page, close } = await open("");
    const tilts = await page.evaluate(async () => {
      const { services } = /** @type {any} */ (globalThis).carom;
      const hold = (/** @type {number} */ beta, /** @type {number} */ gamma) =>
        dispatchEvent(new DeviceOrientationEvent("deviceorientation", { alpha: 0, beta, gamma }));
      const before = services.tilt();
      services.useTilt(true);
      // It listens as soon as the browser has agreed.
      while (services.tilt() === null) {
        await new Promise((resolve) => setTimeout(resolve, 20));
        hold(30, 0);
      }
      const level = services.tilt();
      hold(30, 90);
      const right = services.tilt();
      hold(45, 0);
      const down = services.tilt();
      services.useTilt(false);
      return { before, level, right, down, after: services.tilt() };
    });
    assert.equal(tilts.before, null);
    assert.deepEqual(tilts.level, [0, 0]);
    assert.equal(tilts.right[0], 1);
    assert.ok(tilts.down[1] > 0.5 && tilts.down[1] < 0.7, `${tilts.down}`);
    assert.equal(tilts.after, null);
    await close();
  });

  test("says that a desk does not tilt", async () => {
    const { page, close } = await open("");
    const said = await page.evaluate(async () => {
      const { services } = /** @type {any} */ (globalThis).carom;
      services.useTilt(true);
      let trouble = null;
      while (trouble === null) {
        await new Promise((resolve) => setTimeout(resolve, 20));
        trouble = services.trouble();
      }
      return [services.offersTilt(), trouble, services.trouble()];
    });
    assert.deepEqual(said, [false, "This device does not tell how it is held.", null]);
    await close();
  });
});
