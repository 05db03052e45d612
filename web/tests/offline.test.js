// The page without a network, and its versions in the browser.

import assert from "node:assert/strict";
import { after, before, test } from "node:test";

import { PATIENCE, STRANGE_NAME, complaints, newPage } from "./browser.js";
import { passOn } from "./passing_on.js";
import { StandIn } from "./stood_in.js";
import { Desk } from "./viewer.js";

/** @type {StandIn} */
let standIn;

before(async () => {
  standIn = await StandIn.set();
});

after(() => standIn?.clear());

/** @param {import("playwright-core").Page} page */
const isKept = (page) => page.evaluate(async () => void (await navigator.serviceWorker.ready));

/** @param {import("playwright-core").Page} page */
const cacheNames = (page) => page.evaluate(() => caches.keys());

/** @param {import("playwright-core").Page} page */
const moduleName = (page) => page.getAttribute("#module", "href");

/** @param {import("playwright-core").Page} page */
const isShown = (page) => page.waitForSelector("#loading.done", { state: "attached" });

/** @param {() => Promise<boolean>} isSo */
async function until(isSo) {
  const end = performance.now() + PATIENCE;
  while (!(await isSo())) {
    assert.ok(performance.now() < end, `waited for ${isSo}`);
    await new Promise((resolve) => setTimeout(resolve, 50));
  }
}

test("a scene runs without a network once the page has been there", async (context) => {
  const desk = await Desk.set("webgl2");
  context.after(() => desk.clear());
  const viewer = await desk.open("#scene=tutorial3");
  await isKept(viewer.page);
  await desk.server.close();
  await viewer.page.reload();
  await isShown(viewer.page);
  await viewer.until(({ watching }) => watching?.scene === "tutorial3");
  await viewer.page.keyboard.press("p");
  await viewer.until(({ watching }) => watching.time > 0.1);
  await viewer.keepPicture("page-offline");
  await viewer.close();
});

test("a new version is shown at the next load, and the old one forgotten", async (context) => {
  const page = await newPage(standIn.browser);
  context.after(() => page.context().close());
  const heard = complaints(page);
  await page.goto(standIn.site.url);
  await isShown(page);
  await isKept(page);
  const [old, names] = [await moduleName(page), await cacheNames(page)];
  assert.equal(names.length, 1);

  await standIn.site.renew();
  await page.reload();
  await isShown(page);
  const renewed = await moduleName(page);
  assert.notEqual(renewed, old);
  // The next worker waits until the page is left.
  await until(() =>
    page.evaluate(async () => (await navigator.serviceWorker.ready).waiting !== null),
  );
  await page.goto("about:blank");
  await page.goto(standIn.site.url);
  await isShown(page);
  await until(async () => (await cacheNames(page)).length === 1);
  assert.notDeepEqual(await cacheNames(page), names);

  await page.context().setOffline(true);
  await page.reload();
  await isShown(page);
  assert.equal(await moduleName(page), renewed);
  assert.deepEqual(heard, []);
});

test("a network that answers nothing for seconds does not hold up what is kept", async (context) => {
  const page = await newPage(standIn.browser);
  context.after(() => page.context().close());
  let isStuck = false;
  const server = await passOn(standIn.site.url, () => isStuck);
  context.after(server.close);
  await page.goto(server.url);
  await isShown(page);
  await isKept(page);
  isStuck = true;
  const began = performance.now();
  await page.reload();
  await isShown(page);
  const seconds = (performance.now() - began) / 1000;
  assert.ok(seconds > 3.5, `the answer came after ${seconds} s, though there was none`);
});

test("what another page of the same site keeps stays", async (context) => {
  const page = await newPage(standIn.browser);
  context.after(() => page.context().close());
  await page.goto(`${standIn.site.url}none`);
  await page.evaluate(() => caches.open(`carom ${location.origin}/elsewhere/ 1`));
  await page.goto(standIn.site.url);
  await isShown(page);
  await isKept(page);
  const names = await cacheNames(page);
  assert.equal(names.length, 2);
  assert.match(names[0], /elsewhere/);
});

test("where a browser keeps no pages, the page does without", async (context) => {
  const page = await newPage(standIn.browser);
  context.after(() => page.context().close());
  const heard = complaints(page);
  // This address is neither https nor recognised as this machine.
  await page.goto(standIn.site.url.replace("127.0.0.1", STRANGE_NAME));
  await isShown(page);
  assert.equal(await page.evaluate(() => isSecureContext), false);
  assert.deepEqual(heard, []);
});
