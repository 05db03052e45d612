// The page on screens of all sizes: resized windows, fine pixels, telephones and fingers.

import assert from "node:assert/strict";
import { after, before, test } from "node:test";

import { difference, read } from "./pixels.js";
import { Desk } from "./viewer.js";

const PHONE = {
  viewport: { width: 390, height: 844 },
  deviceScaleFactor: 1,
  hasTouch: true,
  isMobile: true,
};

const ALL = { left: 0, top: 0, right: 1, bottom: 1 };

/** @type {Desk} */
let desk;

before(async () => {
  desk = await Desk.set("webgl2");
});

after(() => desk?.clear());

/** @param {import("./viewer.js").Viewer} viewer */
const pixels = (viewer) =>
  viewer.page.evaluate(() => {
    const canvas = /** @type {HTMLCanvasElement} */ (document.getElementById("carom"));
    return [canvas.width, canvas.height];
  });

/**
 * Sends touches of these fingers.
 *
 * @param {import("./viewer.js").Viewer} viewer
 */
async function fingers(viewer) {
  const client = await viewer.page.context().newCDPSession(viewer.page);
  const send = async (
    /** @type {"touchStart" | "touchMove" | "touchEnd"} */ type,
    /** @type {[x: number, y: number][]} */ ...places
  ) => {
    const touchPoints = places.map(([x, y], id) => ({ x, y, id }));
    await client.send("Input.dispatchTouchEvent", { type, touchPoints });
    await viewer.redraw();
  };
  return { send };
}

test("the picture fills a window that changes", async () => {
  const viewer = await desk.watch("simtest3", { deviceScaleFactor: 1 });
  for (const [width, height] of [
    [900, 500],
    [1400, 900],
  ]) {
    await viewer.page.setViewportSize({ width, height });
    const isWide = (/** @type {number} */ width) =>
      document.querySelector("canvas")?.width === width;
    await viewer.page.waitForFunction(isWide, width);
    await viewer.redraw();
    assert.deepEqual(await pixels(viewer), [width, height]);
    await viewer.keepPicture(`window-${width}`);
  }
  await viewer.close();
});

test("fine pixels are used", async () => {
  const viewport = { width: 800, height: 500 };
  const viewer = await desk.watch("simtest3", { viewport, deviceScaleFactor: 2 });
  assert.deepEqual(await pixels(viewer), [1600, 1000]);
  await viewer.click("Play");
  await viewer.until(({ watching }) => watching.playing);
  await viewer.keepPicture("fine-pixels");
  await viewer.close();
});

test("on a phone a tap chooses, a finger turns the camera, and two come nearer", async () => {
  const viewer = await desk.open("", PHONE);
  await viewer.keepPicture("phone-first");
  await viewer.tap("All scenes", { role: "Button" });
  await viewer.until(({ choosing }) => choosing);
  await viewer.keepPicture("phone-chooser");
  await viewer.tap("cradle", { role: "Button" });
  await viewer.until((status) => status.watching?.scene === "cradle" && !status.choosing);
  await viewer.redraw();
  const before = read(await viewer.keepPicture("phone-scene"));
  const { send } = await fingers(viewer);
  await send("touchStart", [200, 400]);
  for (const x of [220, 240, 260, 280]) {
    await send("touchMove", [x, 400]);
  }
  await send("touchEnd");
  const turned = read(await viewer.keepPicture("phone-turned"));
  assert.ok(difference(before, turned, ALL) > 0.02);
  await send("touchStart", [180, 400], [220, 400]);
  for (const way of [20, 40, 60]) {
    await send("touchMove", [180 - way, 400], [220 + way, 400]);
  }
  await send("touchEnd");
  await viewer.redraw();
  const nearer = read(await viewer.keepPicture("phone-nearer"));
  assert.ok(difference(turned, nearer, ALL) > 0.02);
  await viewer.close();
});

test("on a phone a finger tilts the maze", async () => {
  const viewer = await desk.open("#scene=maze", { ...PHONE, colorScheme: "dark" });
  const { maze: before } = await viewer.until(({ maze }) => maze);
  // A finger can touch only what has been drawn.
  await viewer.redraw();
  const { send } = await fingers(viewer);
  await send("touchStart", [250, 500]);
  await send("touchMove", [200, 500]);
  await send("touchMove", [100, 500]);
  await viewer.until(({ maze }) => maze.ball[0] < before.ball[0] - 0.5);
  await viewer.keepPicture("phone-maze-dark");
  await send("touchEnd");
  await viewer.close();
});

test("a tilted device tilts the maze", async () => {
  const viewer = await desk.open("#scene=maze", PHONE);
  const { maze: before } = await viewer.until(({ maze }) => maze);
  // A device reports its pose as soon as the page listens. The first pose counts as level.
  const hasReported = viewer.page.evaluate(
    () =>
      new Promise((resolve) => {
        const listen = globalThis.addEventListener;
        globalThis.addEventListener = (/** @type {Parameters<typeof listen>} */ ...its) => {
          listen(...its);
          if (its[0] !== "deviceorientation") return;
          for (const gamma of [0, -15]) {
            const pose = { alpha: 0, beta: 30, gamma };
            dispatchEvent(new DeviceOrientationEvent("deviceorientation", pose));
          }
          resolve(undefined);
        };
      }),
  );
  for (const label of ["Menu", "Tilt the device"]) {
    await viewer.tap(label);
  }
  await hasReported;
  await viewer.until(({ maze }) => maze.ball[0] < before.ball[0] - 0.5);
  assert.deepEqual((await viewer.status()).notices, []);
  await viewer.close();
});
