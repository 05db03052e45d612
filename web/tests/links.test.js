// Links to runs: the same bits in the browser as outside.

import assert from "node:assert/strict";
import { after, before, test } from "node:test";

import { carom, stateHash } from "./native.js";
import { Desk, PATIENCE } from "./viewer.js";

/** @type {Desk} */
let desk;

before(async () => {
  desk = await Desk.set("webgl2");
});

after(() => desk?.clear());

/**
 * The state hash that a page shows of a run that has come to where its link says.
 *
 * @param {import("./viewer.js").Viewer} viewer
 */
async function shownHash(viewer) {
  // On one thread ten seconds of a heap take a minute.
  const { watching } = await viewer.until(
    ({ watching }) => watching && !watching.seeking && watching.stateHash !== null,
    4 * PATIENCE,
  );
  return watching.stateHash;
}

/**
 * The chooser is open, and says what was wrong.
 *
 * @param {import("./viewer.js").Viewer} viewer
 * @param {RegExp} trouble
 */
async function assertChoosing(viewer, trouble) {
  const { choosing, notices } = await viewer.status();
  assert.equal(choosing, true);
  assert.deepEqual(notices, []);
  const texts = (await viewer.widgets()).map(({ label }) => label);
  assert.ok(
    texts.some((text) => trouble.test(text)),
    `${texts}`,
  );
}

const scenes = JSON.parse(carom("scenes", "--json")).map((/** @type {any} */ it) => it.name);

for (const scene of scenes) {
  test(`${scene} has the same bits after ten seconds`, async () => {
    const viewer = await desk.open(`#scene=${scene}&t=10`);
    assert.equal(await shownHash(viewer), stateHash(scene, "--seconds", "10"));
    const { watching } = await viewer.status();
    assert.ok(Math.abs(watching.time - 10) < 1e-9, `${watching.time}`);
    await viewer.close();
  });
}

test("a link from the command line is shown with the hash that it has there", async () => {
  const changes = ["--rule", "exact", "--set", "colliders.0.restitution=0.5", "--seconds", "6"];
  const link = carom("link", "simtest2", ...changes).trim();
  const viewer = await desk.open(new URL(link).hash);
  assert.equal(await shownHash(viewer), stateHash("--link", link));
  assert.equal((await viewer.status()).watching.rule, "exact");
  await viewer.keepPicture("link");
  await viewer.close();
});

test("the camera is where it was after the page is loaded again", async () => {
  const viewer = await desk.open("#scene=tutorial3&t=0");
  const [x, y] = await viewer.point("Scene", { role: "Image" });
  await viewer.page.mouse.move(x, y - 100);
  await viewer.page.mouse.down();
  await viewer.page.mouse.move(x + 80, y - 60, { steps: 5 });
  await viewer.page.mouse.up();
  const camera = () => new URLSearchParams(new URL(viewer.page.url()).hash.slice(1)).get("camera");
  await viewer.page.waitForURL(/&camera=/);
  const before = camera();
  // With the field of view of the scene, which is not the usual one.
  assert.equal(before?.split(",").length, 7);
  await viewer.page.reload();
  await viewer.page.waitForSelector("#loading.done", { state: "attached" });
  await viewer.until(({ watching }) => watching?.scene === "tutorial3");
  assert.equal(camera(), before);
  await viewer.close();
});

test("what was changed by hand goes with the link, and gives the same bits elsewhere", async () => {
  const viewer = await desk.watch("simtest1");
  await viewer.page.keyboard.press("p");
  await viewer.until(({ watching }) => watching.time > 2);
  await viewer.click("Restitution of PlaneCollider", { role: "Slider", part: 0.25 });
  await viewer.until(({ watching }) => watching.restitutions[0] < 0.5);
  await viewer.until(({ watching }) => watching.time > 4);
  await viewer.page.keyboard.press("u");
  const hash = await shownHash(viewer);
  const { watching } = await viewer.status();
  await viewer.keepPicture("link-dialog");
  // The address bar follows within a second or two.
  await viewer.page.waitForFunction(
    (time) => Math.abs(Number(new URLSearchParams(location.hash.slice(1)).get("t")) - time) < 1e-6,
    watching.time,
  );
  const link = viewer.page.url();
  assert.equal(stateHash("--link", link), hash);
  await viewer.close();
  const other = await desk.open(new URL(link).hash);
  assert.equal(await shownHash(other), hash);
  await other.close();
});

test("an address that changes is followed", async () => {
  const viewer = await desk.open("#scene=simtest1&t=1");
  await shownHash(viewer);
  await viewer.page.evaluate(() => void (location.hash = "scene=tutorial3&t=2"));
  await viewer.until(({ watching }) => watching.scene === "tutorial3" && !watching.seeking);
  assert.equal(await shownHash(viewer), stateHash("tutorial3", "--seconds", "2"));
  await viewer.close();
});

test("a way that takes minutes is stopped by Escape, and other keys work on it", async () => {
  const viewer = await desk.open("#scene=tutorial4&t=100000");
  await viewer.until(({ watching }) => watching?.seeking && watching.frame > 10);
  await viewer.page.keyboard.press("Escape");
  const { watching } = await viewer.until(({ watching }) => !watching.seeking);
  assert.ok(watching.time < 90000, `${watching.time}`);
  await viewer.page.keyboard.press("Home");
  await viewer.until(({ watching }) => watching.frame === 0 && !watching.seeking);
  await viewer.close();
});

test("a time that is too far is refused in the chooser", async () => {
  const viewer = await desk.open("#scene=tutorial4&t=1e9");
  await assertChoosing(viewer, /100,000,000 frames/);
  await viewer.close();
});

test("Back leads to the scene before", async () => {
  const viewer = await desk.watch("simtest1");
  await viewer.page.waitForFunction(() => location.hash.includes("simtest1"));
  await viewer.page.keyboard.press("Enter");
  await viewer.until(({ choosing }) => choosing);
  await viewer.page.keyboard.type("masse");
  await viewer.pause(500);
  await viewer.page.keyboard.press("Enter");
  await viewer.until(({ watching }) => watching?.scene === "masse");
  await viewer.page.waitForFunction(() => location.hash.includes("masse"));
  await viewer.page.waitForFunction(() => document.title === "Massé shots - Carom");
  await viewer.page.goBack();
  await viewer.until(({ watching }) => watching?.scene === "simtest1" && !watching.seeking);
  await viewer.page.waitForFunction(() => document.title === "SimTest1 - Carom");
  await viewer.close();
});

test("a link that makes no sense is said to, and the chooser opens", async () => {
  const viewer = await desk.open("#scene=nowhere");
  await assertChoosing(viewer, /nowhere/);
  await viewer.keepPicture("link-broken");
  await viewer.close();
});
