// Scenes are watched in the page.

import assert from "node:assert/strict";
import { readFile, readdir } from "node:fs/promises";
import { fileURLToPath } from "node:url";
import { after, before, test } from "node:test";

import { keepDownload } from "./browser.js";
import { difference, read } from "./pixels.js";
import { Desk } from "./viewer.js";

const SCENES = fileURLToPath(new URL("../../crates/carom-scene/scenes/", import.meta.url));

/** The middle of the page, where scenes are. */
const MIDDLE = { left: 0.3, top: 0.1, right: 0.7, bottom: 0.9 };

/** @type {Desk} */
let desk;

before(async () => {
  desk = await Desk.set("webgl2");
});

after(() => desk?.clear());

test("the chooser lists every scene", async () => {
  const viewer = await desk.open();
  await viewer.openChooser();
  const files = await readdir(SCENES);
  const names = files.filter((file) => file.endsWith(".toml")).map((file) => file.slice(0, -5));
  const { choosing, scenes } = await viewer.status();
  assert.equal(choosing, true);
  assert.deepEqual([...scenes].sort(), names.sort());
  const buttons = (await viewer.widgets()).filter((it) => it.role === "Button");
  const offered = buttons.map((it) => it.label);
  assert.deepEqual(
    names.filter((name) => !offered.includes(name)),
    [],
  );
  await viewer.keepPicture("chooser");
  await viewer.close();
});

test("at the first visit a scene plays, with the others below it", async () => {
  const viewer = await desk.open();
  const { choosing } = await viewer.until(
    ({ watching }) => watching?.playing && watching.time > 0.3,
  );
  assert.equal(choosing, false);
  await viewer.widget("Drag to look. Click a ball. Ctrl-click throws one.");
  await viewer.keepPicture("first-visit");
  await viewer.click("Pour", { role: "Button" });
  await viewer.until(({ watching }) => watching?.scene === "pour" && watching.playing);
  await viewer.close();
});

test("nothing moves by itself where the system asks for little motion", async () => {
  const viewer = await desk.open("", { reducedMotion: "reduce" });
  await viewer.widget("Close the list of scenes");
  const { watching } = await viewer.status();
  assert.deepEqual([watching.playing, watching.frame], [false, 0]);
  await viewer.close();
});

test("a scene that is clicked on is watched, and its balls move", async () => {
  const viewer = await desk.show();
  await viewer.click("cradle", { role: "Button" });
  await viewer.until((status) => status.watching?.scene === "cradle" && !status.choosing);
  await viewer.until(({ watching }) => watching.playing && watching.time > 0.5);
  const early = await viewer.keepPicture("cradle-early");
  const { watching: then } = await viewer.until(({ watching }) => watching.time > 2);
  const late = await viewer.keepPicture("cradle-late");
  assert.ok(difference(read(early), read(late), MIDDLE) > 0.002);
  assert.ok(then.impacts > 10 && then.spheres > 4, JSON.stringify(then));
  await viewer.close();
});

test("it pauses, goes a frame on and one back, and begins anew", async () => {
  const viewer = await desk.watch("simtest1");
  await viewer.click("Play");
  await viewer.until(({ watching }) => watching.frame > 30);
  await viewer.click("Pause");
  const { watching: paused } = await viewer.until(({ watching }) => !watching.playing);
  await viewer.pause(500);
  assert.equal((await viewer.status()).watching.frame, paused.frame);
  await viewer.page.keyboard.press("Period");
  await viewer.until(({ watching }) => watching.frame === paused.frame + 1);
  await viewer.page.keyboard.press("Comma");
  await viewer.until(({ watching }) => watching.frame === paused.frame);
  await viewer.page.keyboard.press("Home");
  await viewer.until(({ watching }) => watching.frame === 0 && watching.time === 0);
  await viewer.close();
});

test("a picture is saved as a PNG with the time on it", async () => {
  const viewer = await desk.open("#scene=simtest1", { deviceScaleFactor: 1 });
  await viewer.until(({ watching }) => watching?.scene === "simtest1");
  const pictures = [];
  for (const frame of [1, 2]) {
    await viewer.page.keyboard.press("Period");
    await viewer.until(({ watching }) => watching.frame === frame);
    const file = await viewer.download(() => viewer.page.keyboard.press("Space"));
    assert.match(file.suggestedFilename(), /^simtest1.*\.png$/);
    pictures.push(read(await readFile(await keepDownload(file, `saved-${frame}.png`))));
  }
  const [first, second] = pictures;
  for (const { width, height } of pictures) {
    assert.deepEqual([width, height], [1280, 800]);
  }
  // Two frames without a ball differ only in the time at the lower left.
  const stamp = { left: 0, top: 0.85, right: 0.5, bottom: 1 };
  const rest = { left: 0.5, top: 0.85, right: 1, bottom: 1 };
  assert.ok(difference(first, second, stamp) > 0);
  assert.equal(difference(first, second, rest), 0);
  await viewer.close();
});

test("a restitution that is changed while the scene runs stays changed", async () => {
  const viewer = await desk.watch("simtest1");
  await viewer.page.keyboard.press("p");
  const { watching: before } = await viewer.until(({ watching }) => watching.frame > 5);
  await viewer.click("Bounciness (restitution) of PlaneCollider", { role: "Slider", part: 0.1 });
  const { watching: changed } = await viewer.until(
    ({ watching }) => watching.restitutions[0] < 0.5 && watching.playing,
  );
  assert.notDeepEqual(changed.restitutions, before.restitutions);
  assert.equal(changed.restitutions[1], before.restitutions[1]);
  await viewer.until(({ watching }) => watching.frame > changed.frame + 10);
  await viewer.keepPicture("restitution");
  await viewer.close();
});

test("plots, impacts and velocities are shown, in light and dark", async () => {
  const viewer = await desk.open("#scene=simtest3&t=3.5");
  await viewer.until(({ watching }) => watching?.scene === "simtest3" && !watching.seeking);
  for (const key of ["p", "g", "l", "v"]) {
    await viewer.page.keyboard.press(key);
  }
  await viewer.until(({ watching }) => watching.time > 4);
  const light = await viewer.keepPicture("panels-light");
  await viewer.page.keyboard.press("t");
  await viewer.redraw();
  const dark = await viewer.keepPicture("panels-dark");
  const edges = { left: 0, top: 0, right: 1, bottom: 1 };
  assert.ok(difference(read(light), read(dark), edges) > 0.5);
  await viewer.close();
});

test("two rules are shown side by side", async () => {
  const viewer = await desk.watch("tutorial3");
  await viewer.page.keyboard.press("x");
  await viewer.page.keyboard.press("p");
  await viewer.until(({ watching }) => watching.comparing && watching.time > 2);
  await viewer.keepPicture("two-rules");
  await viewer.close();
});

test("the camera turns and comes nearer by mouse", async () => {
  const viewer = await desk.watch("simtest3");
  const { mouse } = viewer.page;
  const before = read(await viewer.keepPicture("camera-before"));
  await mouse.move(500, 400);
  await mouse.down();
  await mouse.move(650, 430, { steps: 5 });
  await mouse.up();
  await viewer.redraw();
  const turned = await viewer.keepChanged("camera-turned", before, MIDDLE, 0.05);
  await mouse.wheel(0, -600);
  await viewer.keepChanged("camera-nearer", turned, MIDDLE, 0.05);
  await viewer.close();
});
