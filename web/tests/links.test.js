// Links to runs give the same bits in the browser as outside.

import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { deflateSync } from "node:zlib";

import { PATIENCE, newPage } from "./browser.js";
import { carom, stateHash } from "./native.js";
import { COARSE, Desk, Viewer } from "./viewer.js";

/** @type {Desk} */
let desk;

before(async () => {
  desk = await Desk.set("webgl2");
});

after(() => desk?.clear());

/** A window with almost nothing to draw: states do not depend on pictures, but wait for them. */
const TINY = { viewport: { width: 160, height: 120 } };

/**
 * Returns the state hash that a page shows when a run has reached the time of its link.
 *
 * @param {import("./viewer.js").Viewer} viewer
 */
async function shownHash(viewer) {
  // On one thread, ten seconds of a heap take a minute.
  const { watching } = await viewer.until(
    ({ watching }) => watching && !watching.seeking && watching.stateHash !== null,
    4 * PATIENCE,
  );
  return watching.stateHash;
}

/**
 * Checks that the chooser is open and shows the error.
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
    const viewer = await desk.show(`#scene=${scene}&t=10`, TINY);
    const [shown, native] = await Promise.all([
      shownHash(viewer),
      stateHash(scene, "--seconds", "10"),
    ]);
    assert.equal(shown, native);
    const { watching } = await viewer.status();
    assert.equal(watching.scene, scene);
    assert.ok(Math.abs(watching.time - 10) < 1e-9, `${watching.time}`);
    await viewer.close();
  });
}

test("a link from the command line is shown with the hash that it has there", async () => {
  const changes = ["--rule", "exact", "--set", "colliders.0.restitution=0.5", "--seconds", "6"];
  const link = carom("link", "simtest2", ...changes).trim();
  const viewer = await desk.open(new URL(link).hash);
  assert.equal(await shownHash(viewer), await stateHash("--link", link));
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
  // With the field of view of the scene, which is not the default.
  assert.equal(before?.split(",").length, 7);
  await viewer.page.reload();
  await viewer.page.waitForSelector("#loading.done", { state: "attached" });
  await viewer.until(({ watching }) => watching?.scene === "tutorial3");
  assert.equal(camera(), before);
  await viewer.close();
});

test("what was changed by hand goes with the link, and gives the same bits elsewhere", async () => {
  const viewer = await desk.choose("simtest1");
  await viewer.until(({ watching }) => watching.time > 0.5);
  await viewer.click("Bounciness (restitution) of PlaneCollider", { role: "Slider", part: 0.1 });
  await viewer.until(({ watching }) => watching.restitutions[0] < 0.5);
  await viewer.until(({ watching }) => watching.time > 1);
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
  assert.equal(await stateHash("--link", link), hash);
  // The dialog would stay open and take keys.
  await viewer.page.keyboard.press("Escape");
  await viewer.redraw();
  await viewer.close();
  const other = await desk.open(new URL(link).hash);
  assert.equal(await shownHash(other), hash);
  await other.close();
});

test("an address that changes is followed", async () => {
  const viewer = await desk.show("#scene=simtest1&t=1");
  await shownHash(viewer);
  await viewer.page.evaluate(() => void (location.hash = "scene=tutorial3&t=2"));
  await viewer.until(({ watching }) => watching.scene === "tutorial3" && !watching.seeking);
  assert.equal(await shownHash(viewer), await stateHash("tutorial3", "--seconds", "2"));
  await viewer.close();
});

test("an address that changes is followed where the page has just written its own", async () => {
  const viewer = await desk.watch("simtest1");
  await viewer.page.evaluate(() => {
    const own = location.href;
    location.hash = "scene=tutorial3";
    history.replaceState(null, "", own);
  });
  await viewer.until(({ watching }) => watching.scene === "tutorial3");
  await viewer.close();
});

test("a way that takes minutes is stopped by Escape, and other keys work on it", async () => {
  const viewer = await desk.show("#scene=tutorial4&t=100000");
  await viewer.until(({ watching }) => watching?.seeking && watching.frame > 10);
  await viewer.page.keyboard.press("Escape");
  const { watching } = await viewer.until(({ watching }) => !watching.seeking);
  assert.ok(watching.time < 90000, `${watching.time}`);
  await viewer.page.keyboard.press("Home");
  await viewer.until(({ watching }) => watching.frame === 0 && !watching.seeking);
  await viewer.close();
});

test("a time that is too far is refused in the chooser", async () => {
  const viewer = await desk.show();
  await viewer.goOn("#scene=tutorial4&t=1e9");
  await assertChoosing(viewer, /100,000,000 frames/);
  await viewer.close();
});

test("Back leads to the scene before", async () => {
  const viewer = await desk.watch("simtest1");
  await viewer.page.waitForFunction(() => location.hash.includes("simtest1"));
  await viewer.page.keyboard.press("Enter");
  await viewer.until(({ choosing }) => choosing);
  await viewer.type("masse");
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

/**
 * Returns the part of an address that contains a scene file.
 *
 * @param {string} text
 */
function fileLink(text) {
  return `#file=${deflateSync(text).toString("base64url")}`;
}

/** @param {number} count of spheres in a row */
function row(count) {
  const row = `count = ${count}, start = [0, 0, 0], step = [3, 0, 0], sphere = { radius = 1 }`;
  return `[[generators]]\nrow = { ${row} }\n`;
}

const lattice =
  "[[generators]]\nlattice = { counts = [100, 100, 100], spacing = 3, sphere = { radius = 1 } }\n";

/** @type {[string, string, RegExp][]} */
const HOSTILE = [
  ["a thousand lattices of a million spheres", fileLink(lattice.repeat(1000)), /generators\[0\]/],
  ["more spheres than a link may have", fileLink(row(200_001)), /200001.*200000/],
  ["a file that unpacks to a hundred megabytes", fileLink("\n".repeat(1e8)), /8 MiB/],
  ["millions of lines that are no scene", fileLink("a\n".repeat(4e6)), /:1: key with no value/],
  ["marks that would steer a terminal", "#scene=%1B%5B2Jnowhere", /nowhere/],
];

for (const [what, link, trouble] of HOSTILE) {
  test(`a link to ${what} is refused, and the page goes on`, async () => {
    const viewer = await desk.show();
    await viewer.goOn(link);
    await assertChoosing(viewer, trouble);
    await viewer.page.evaluate(() => (location.hash = "#scene=tutorial3"));
    await viewer.until(({ watching }) => watching?.scene === "tutorial3");
    await viewer.close();
  });
}

test("a run of a link that takes for ever can be left for another", async () => {
  const viewer = await desk.show("#scene=gas&t=1000000");
  await viewer.until(({ watching }) => Boolean(watching?.seeking));
  await viewer.page.evaluate(() => (location.hash = "#scene=tutorial3"));
  await viewer.until(({ watching }) => watching?.scene === "tutorial3" && !watching.seeking);
  await viewer.close();
});

test("the page that serves Carom says how many spheres a link may have", async () => {
  const page = await newPage(desk.browser, { deviceScaleFactor: COARSE });
  const meta = '<meta name="carom-max-spheres" content="100" />';
  await page.route(desk.server.url, async (route) => {
    const response = await route.fetch();
    const body = (await response.text()).replace("<head>", `<head>${meta}`);
    await route.fulfill({ response, body });
  });
  await page.goto(`${desk.server.url}${fileLink(row(200))}`);
  await page.waitForSelector("#loading.done", { state: "attached" });
  const viewer = new Viewer(page);
  await viewer.until((status) => status.choosing);
  await assertChoosing(viewer, /200.*100/);
  await viewer.close();
});
