// Scene files are dropped on the page, and films are saved.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFile } from "node:fs/promises";
import { fileURLToPath } from "node:url";
import { after, before, test } from "node:test";

import { keepDownload } from "./browser.js";
import { Desk } from "./viewer.js";

const SCENE = fileURLToPath(
  new URL("../../crates/carom-scene/scenes/simtest3.toml", import.meta.url),
);

/** @type {Desk} */
let desk;

before(async () => {
  desk = await Desk.set("webgl2");
});

after(() => desk?.clear());

test("a scene file that is dropped is opened", async () => {
  const viewer = await desk.show();
  const text = await readFile(SCENE, "utf8");
  await viewer.drop("mine.toml", text.replace('name = "simtest3"', 'name = "mine"'));
  const { watching, choosing } = await viewer.until(({ watching }) => watching?.scene === "mine");
  assert.equal(choosing, false);
  assert.match(watching.source, /mine\.toml/);
  await viewer.page.keyboard.press("p");
  await viewer.until(({ watching }) => watching.spheres > 0);
  await viewer.close();
});

test("a broken scene file is refused with its line, and the page goes on", async () => {
  const viewer = await desk.watch("simtest1");
  const text = await readFile(SCENE, "utf8");
  const lines = text.split("\n");
  const line = lines.findIndex((it) => it.startsWith("frame_time")) + 1;
  lines[line - 1] = "frame_time = -0.02";
  await viewer.drop("broken.toml", lines.join("\n"));
  const { notices, watching } = await viewer.until((status) => status.notices.length > 0);
  assert.match(notices.join(), new RegExp(`broken\\.toml.*\\b${line}\\b`, "s"));
  assert.equal(watching.scene, "simtest1");
  await viewer.keepPicture("broken-scene");
  await viewer.page.keyboard.press("p");
  await viewer.until(({ watching }) => watching.time > 1);
  await viewer.close();
});

test("a scene file that is chosen is opened", async () => {
  const viewer = await desk.show();
  const text = await readFile(SCENE, "utf8");
  const asked = viewer.page.waitForEvent("filechooser");
  await viewer.click("Open a file...");
  const buffer = Buffer.from(text.replace('name = "simtest3"', ""));
  await (await asked).setFiles({ name: "chosen.toml", mimeType: "application/toml", buffer });
  // The file contains no name.
  await viewer.until(({ watching }) => watching?.scene === "chosen");
  await viewer.close();
});

test("panels stay open when the page is loaded again", async () => {
  const viewer = await desk.choose("simtest1");
  await viewer.page.keyboard.press("l");
  await viewer.widget("Approach, m/s", "Label");
  const isKept = () => Object.values(localStorage).some((it) => it.includes('"impacts":true'));
  await viewer.page.waitForFunction(isKept);
  await viewer.page.reload();
  await viewer.page.waitForSelector("#loading.done", { state: "attached" });
  await viewer.until(({ watching }) => watching?.scene === "simtest1");
  await viewer.widget("Approach, m/s", "Label");
  await viewer.page.keyboard.press("l");
  await viewer.close();
});

test("numbers of a figure are downloaded", async () => {
  const viewer = await desk.watch("tutorial1");
  await viewer.page.keyboard.press("g");
  const download = viewer.page.waitForEvent("download");
  await viewer.click("Save the numbers of Energy");
  const table = await readFile(await keepDownload(await download, "numbers.csv"), "utf8");
  assert.ok(table.startsWith('"time, s","kinetic, J","potential, J","total, J"\n0,'), table);
  await viewer.page.keyboard.press("g");
  await viewer.close();
});

test("a maze that is dropped is played", async () => {
  const viewer = await desk.show();
  await viewer.drop("short.txt", "#######\n#S o E#\n#######\n");
  await viewer.until(({ maze }) => maze?.collectibles === 1);
  await viewer.hold("ArrowRight", ({ maze }) => maze.won);
  await viewer.keepPicture("maze-won");
  await viewer.close();
});

test("a film is saved, and plays", async () => {
  const viewer = await desk.watch("simtest1");
  await viewer.page.keyboard.press("p");
  const { watching: before } = await viewer.until(({ watching }) => watching.time > 0.2);
  await viewer.page.keyboard.press("r");
  const { watching: begun } = await viewer.until((status) => status.recording);
  await viewer.until(({ watching }) => watching.time > begun.time + 1);
  const file = await viewer.download(() => viewer.page.keyboard.press("r"));
  assert.match(file.suggestedFilename(), /^simtest1.*\.(mp4|webm)$/);
  const path = await keepDownload(file, "film");
  const asked = "stream=width,height,nb_read_frames,duration";
  const args = ["-v", "error", "-count_frames", "-show_entries", asked, "-of", "json", path];
  const [stream] = JSON.parse(execFileSync("ffprobe", args, { encoding: "utf8" })).streams;
  assert.deepEqual([stream.width, stream.height], [1280, 720]);
  // Thirty frames per second of simulated time, and one at the start. It began and ended between
  // the two times that are read around it.
  const { watching: ended } = await viewer.status();
  const frames = Number(stream.nb_read_frames);
  const most = (ended.time - before.time) * 30 + 2;
  assert.ok(frames >= 30 && frames <= most, `${frames} frames, at most ${most}`);
  assert.ok(Math.abs(Number(stream.duration) - frames / 30) < 0.05, `${stream.duration} s`);
  await viewer.close();
});
