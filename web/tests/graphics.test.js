// The page draws with each kind of graphics; measures the frame times.

import assert from "node:assert/strict";
import { test } from "node:test";

import { read } from "./pixels.js";
import { Desk } from "./viewer.js";

/** The middle of the page, where scenes are. */
const MIDDLE = { left: 0.3, top: 0.1, right: 0.7, bottom: 0.9 };

/** Scenes with a dozen spheres and with many, and the time from which frames are counted [s]. */
const LOADS = /** @type {const} */ ([
  ["simtest3", 4],
  ["tutorial4", 0.5],
]);

/** How long frames are counted [ms]. */
const COUNTED = 1500;

/** Size for the measurement: few pixels, so that software draws more than a few frames. */
const SIZE = { width: 640, height: 400 };

/** @param {import("./viewer.js").Viewer} viewer */
async function measure(viewer) {
  const [pictures, time] = [(await viewer.status()).pictures, performance.now()];
  await viewer.pause(COUNTED);
  const { pictures: now, cpuSeconds, watching } = await viewer.status();
  return {
    picturesPerSecond: ((now - pictures) / (performance.now() - time)) * 1000,
    milliseconds: cpuSeconds * 1000,
    spheres: watching.spheres,
  };
}

for (const [graphics, name] of /** @type {const} */ ([
  ["webgl2", "WebGL2"],
  ["webgpu", "WebGPU"],
])) {
  test(`it draws with ${name}`, async (context) => {
    const desk = await Desk.set(graphics);
    context.after(() => desk.clear());
    for (const [scene, from] of LOADS) {
      const viewer = await desk.show(`#scene=${scene}&t=${from}`, {
        viewport: SIZE,
        deviceScaleFactor: 1,
      });
      const { graphics: used } = await viewer.until(
        ({ watching }) => watching?.scene === scene && !watching.seeking,
      );
      if (used !== name) {
        context.skip(`this browser offers no ${name} in software`);
        return;
      }
      await viewer.redraw();
      const start = read(await viewer.keepPicture(`${graphics}-${scene}-start`));
      await viewer.page.keyboard.press("p");
      await viewer.until(({ watching }) => watching.playing);
      const { picturesPerSecond, milliseconds, spheres } = await measure(viewer);
      await viewer.keepChanged(`${graphics}-${scene}`, start, MIDDLE, 0.002);
      const rate = picturesPerSecond.toFixed(1);
      context.diagnostic(
        `${name} in software, ${scene}, ${spheres} spheres, ${SIZE.width} x ${SIZE.height}: ${rate} pictures/s, ` +
          `${milliseconds.toFixed(1)} ms of the interface's own for the last one`,
      );
      await viewer.close();
    }
  });
}
