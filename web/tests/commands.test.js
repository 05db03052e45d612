// Commands from scripts of the page to the interface.

import assert from "node:assert/strict";
import { after, before, test } from "node:test";

import { Desk } from "./viewer.js";

/** @type {Desk} */
let desk;

before(async () => {
  desk = await Desk.set("webgl2");
});

after(() => desk?.clear());

/** @type {any} The page, in its own scripts. */
let carom;

test("a script plays, pauses, goes elsewhere and follows a ball", async () => {
  const viewer = await desk.show("#scene=simtest1&t=0");
  await viewer.until(({ watching }) => watching?.scene === "simtest1");
  await viewer.page.evaluate(() => carom.play());
  await viewer.until(({ watching }) => watching.playing && watching.time > 0.5);
  await viewer.page.evaluate(() => carom.pause());
  const { watching } = await viewer.until((status) => !status.watching.playing);
  await viewer.page.evaluate(() => carom.seek(2));
  await viewer.until((status) => status.watching.time === 2);
  assert.ok(watching.time !== 2 && watching.picked === null);
  await viewer.page.evaluate(() => carom.pick(0));
  await viewer.until((status) => status.watching.picked === 0);
  await viewer.page.evaluate(() => carom.pick(undefined));
  await viewer.until((status) => status.watching.picked === null);
  await viewer.close();
});

test("a script edits the scene, reads it, and hears what is no edit", async () => {
  const viewer = await desk.show("#scene=simtest1&t=0");
  const before = await viewer.until(({ watching }) => watching?.scene === "simtest1");
  await viewer.page.evaluate(() => carom.edit("change = { all-collider-restitutions = 0.25 }"));
  const after = await viewer.until((status) => status.version !== before.version);
  assert.ok(after.watching.restitutions.every((/** @type {number} */ it) => it === 0.25));
  assert.match(await viewer.page.evaluate(() => carom.scene()), /restitution = 0\.25/);
  const heard = await viewer.page.evaluate(() => {
    try {
      return carom.edit("change = { explode = 1 }");
    } catch (error) {
      return /** @type {Error} */ (error).message;
    }
  });
  assert.match(heard, /explode/);
  // Reading the status changes nothing.
  assert.equal((await viewer.status()).version, after.version);
  await viewer.close();
});
