// The maze of the course, played with keys.

import assert from "node:assert/strict";
import { after, before, test } from "node:test";

import { Desk } from "./viewer.js";

/** A window that is drawn fast, so that keys take effect at once. */
const SMALL = { width: 720, height: 500 };

/** @type {Desk} */
let desk;

before(async () => {
  desk = await Desk.set("webgl2");
});

after(() => desk?.clear());

test("arrow keys take the ball to the first collectible", async () => {
  const viewer = await desk.open("#scene=maze", { viewport: SMALL });
  await viewer.until(({ maze }) => maze?.collected === 0);
  await viewer.keepPicture("maze-start");
  // Each way ends at a wall or in an open area, so slow frames do no harm.
  await viewer.hold("ArrowLeft", ({ maze }) => maze.ball[0] < -0.7);
  await viewer.hold("ArrowDown", ({ maze }) => maze.ball[2] > 2.3);
  await viewer.hold("ArrowLeft", ({ maze }) => maze.ball[0] < -3.9);
  await viewer.hold("ArrowUp", ({ maze }) => maze.ball[2] < 1);
  await viewer.hold("ArrowRight", ({ maze }) => maze.collected === 1);
  const { maze } = await viewer.status();
  assert.ok(maze.elapsed > 1);
  await viewer.keepPicture("maze-collected");
  await viewer.close();
});

test("a game goes on where it was when the page is loaded again", async () => {
  const viewer = await desk.open("#scene=maze", { viewport: SMALL });
  await viewer.until(({ maze }) => maze?.collected === 0);
  await viewer.hold("ArrowLeft", ({ maze }) => maze.ball[0] < -0.7);
  const { maze: before } = await viewer.status();
  await viewer.page.reload();
  await viewer.page.waitForSelector("#loading.done", { state: "attached" });
  await viewer.widget("Here you were", "Label");
  const { maze: after } = await viewer.until(({ maze }) => maze);
  // The game waits, no earlier than where the page was left.
  assert.ok(after.elapsed >= before.elapsed, `${after.elapsed} ${before.elapsed}`);
  assert.ok(after.ball[0] < -0.7);
  await viewer.keepPicture("maze-again");
  await viewer.click("Go on");
  await viewer.until(({ maze }) => maze.elapsed > after.elapsed);
  await viewer.close();
});
