// What users do; the time of each task from the load of the page on is reported.

import assert from "node:assert/strict";
import { after, before, test } from "node:test";

import { difference, read } from "./pixels.js";
import { Desk } from "./viewer.js";

/** The middle of the page, where scenes are. */
const MIDDLE = { left: 0.3, top: 0.1, right: 0.7, bottom: 0.9 };

/** Largest distance of edges that are aligned, in CSS pixels. */
const ALIGNED = 1;

/** @type {Desk} */
let desk;

before(async () => {
  desk = await Desk.set("webgl2");
});

after(() => desk?.clear());

/**
 * Reports how long a task took. That depends on how busy the machine is, so it is no test.
 *
 * @param {import("node:test").TestContext} context
 * @param {number} began by `performance.now()`
 */
function report(context, began) {
  context.diagnostic(`${((performance.now() - began) / 1000).toFixed(1)} s from the load`);
}

test("a first visit moves without a click", async (context) => {
  const began = performance.now();
  const viewer = await desk.open();
  await viewer.until(({ watching }) => watching?.time > 0);
  report(context, began);
  await viewer.close();
});

test("another bounciness changes how the scene goes on", async (context) => {
  const pictures = [];
  for (const part of [0.9, 0.1]) {
    const began = performance.now();
    const viewer = await desk.open("#scene=simtest1");
    await viewer.click("Bounciness (restitution) of PlaneCollider", { role: "Slider", part });
    await viewer.until(({ watching }) => watching.restitutions[0] > 0.5 === part > 0.5);
    await viewer.click("Play");
    await viewer.until(({ watching }) => watching.time > 2.5);
    report(context, began);
    // The scene at one time, under both values.
    await viewer.page.evaluate(() => /** @type {any} */ (globalThis).carom.pause());
    await viewer.page.evaluate(() => /** @type {any} */ (globalThis).carom.seek(2.4));
    await viewer.until(({ watching }) => Math.abs(watching.time - 2.4) < 0.02 && !watching.seeking);
    await viewer.redraw();
    pictures.push(read(await viewer.keepPicture(`bounciness-${part}`)));
    await viewer.close();
  }
  const [high, low] = pictures;
  assert.ok(difference(high, low, MIDDLE) > 0.002);
});

test("a link of an edited scene shows the edit to others", async (context) => {
  const began = performance.now();
  const viewer = await desk.open("#scene=simtest1");
  await viewer.click("Bounciness (restitution) of PlaneCollider", { role: "Slider", part: 0.1 });
  const { watching } = await viewer.until(({ watching }) => watching.restitutions[0] < 0.5);
  // The address bar follows within a second or two.
  await viewer.page.waitForFunction(() => location.hash.length > "#scene=simtest1".length + 8);
  const link = new URL(viewer.page.url()).hash;
  report(context, began);
  await viewer.close();
  const other = await desk.open(link);
  await other.until((status) => status.watching?.restitutions[0] === watching.restitutions[0]);
  await other.close();
});

test("controls that stand in a row or a column are aligned", async () => {
  const viewer = await desk.watch("simtest1");
  const widgets = await viewer.widgets();
  const named = (/** @type {string[]} */ names) =>
    names.map((name) => {
      const found = widgets.find((it) => it.role === "Button" && it.label === name);
      assert.ok(found, `no ${name} in ${widgets.map((it) => `${it.role} ${it.label}`)}`);
      return found;
    });
  const spread = (/** @type {number[]} */ places) => Math.max(...places) - Math.min(...places);
  for (const row of [
    ["Scenes", "View", "Measure", "Share", "Settings"],
    ["Play", "Restart", "Step back", "Step", "Undo", "Redo"],
  ]) {
    const middles = named(row).map((it) => it.y + 0.5 * it.height);
    assert.ok(spread(middles) <= ALIGNED, `${row} at ${middles}`);
  }
  const sliders = widgets.filter(
    (it) => it.role === "Slider" && it.label.startsWith("Bounciness (restitution) of"),
  );
  assert.ok(sliders.length > 1);
  for (const edge of [
    sliders.map((it) => it.x),
    sliders.map((it) => it.x + it.width),
    sliders.map((it) => it.height),
  ]) {
    assert.ok(spread(edge) <= ALIGNED, `${edge}`);
  }
  await viewer.close();
});

test("a ball is thrown and its speed is read by keyboard alone", async (context) => {
  const began = performance.now();
  const viewer = await desk.open("#scene=bounce");
  const { page } = viewer;
  const { watching } = await viewer.status();
  await page.keyboard.press("b");
  await page.keyboard.press("Period");
  await viewer.until((status) => status.watching.spheres === watching.spheres + 1);
  // The switch for screen readers is the first control.
  await page.keyboard.press("Tab");
  await page.keyboard.press("Enter");
  const isRead = () => {
    const picture = document.querySelector("#mirror [role=img]");
    return /^Scene: ball \d+, [\d.e-]+ m\/s$/.test(picture?.getAttribute("aria-label") ?? "");
  };
  await page.waitForFunction(isRead);
  report(context, began);
  await viewer.close();
});
