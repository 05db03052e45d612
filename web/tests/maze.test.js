// The maze of the course, played with keys.

import assert from "node:assert/strict";
import { after, before, test } from "node:test";

import { Desk } from "./viewer.js";

/** @type {Desk} */
let desk;

before(async () => {
  desk = await Desk.set("webgl2");
});

after(() => desk?.clear());

test("arrow keys take the ball to the first collectible", async () => {
  const viewer = await desk.open("#scene=maze");
  await viewer.until(({ maze }) => maze?.collected === 0);
  await viewer.keepPicture("maze-start");
  // Each way ends at a wall or in an open place: slow pictures do no harm.
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
