// Films that the page makes from frames, checked with FFmpeg.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { after, before, test } from "node:test";

import { complaints, keepDownload, newPage } from "./browser.js";
import { StandIn } from "./stood_in.js";

/** @type {StandIn} */
let standIn;

before(async () => {
  standIn = await StandIn.set();
});

after(() => standIn?.clear());

/**
 * Opens a page without the named abilities of the browser.
 *
 * @param {string[]} without
 */
async function open(without = []) {
  const page = await newPage(standIn.browser);
  const heard = complaints(page);
  await page.addInitScript((names) => {
    for (const name of names) {
      Reflect.deleteProperty(globalThis, name);
    }
  }, without);
  await page.goto(standIn.site.url);
  await page.waitForSelector("#loading.done", { state: "attached" });
  return { page, heard };
}

/**
 * Films a square on grey that moves to the right by two pixels a frame.
 *
 * @param {import("playwright-core").Page} page
 * @param {{ width: number, height: number, frames: number }} film
 * @returns {Promise<string>} the path of the file
 */
async function film(page, film) {
  const download = page.waitForEvent("download");
  await page.evaluate(({ width, height, frames }) => {
    const film = /** @type {any} */ (globalThis).carom.services.beginFilm(width, height, 30);
    // One buffer for all frames, as in the module: the page must copy it.
    const pixels = new Uint8Array(width * height * 4);
    for (let frame = 0; frame < frames; frame += 1) {
      pixels.fill(128);
      for (let y = 20; y < 40; y += 1) {
        const left = (y * width + 2 * frame) * 4;
        pixels.fill(255, left, left + 20 * 4);
      }
      film.add(pixels, frame);
    }
    pixels.fill(0);
    film.finish("square-2.5s");
  }, film);
  const file = await download;
  assert.match(file.suggestedFilename(), /^square-2\.5s\.(mp4|webm)$/);
  const trouble = await page.evaluate(() =>
    /** @type {any} */ (globalThis).carom.services.trouble(),
  );
  assert.equal(trouble, null);
  return keepDownload(file, "square");
}

/** @param {string} path */
function probe(path) {
  const asked = "stream=codec_name,width,height:frame=pts_time";
  const args = ["-v", "error", "-show_frames", "-show_entries", asked, "-of", "json", path];
  const { streams, frames } = JSON.parse(execFileSync("ffprobe", args, { encoding: "utf8" }));
  const times = frames.map((/** @type {{ pts_time: string }} */ frame) => Number(frame.pts_time));
  return { ...streams[0], times };
}

/**
 * Returns the brightness of a pixel in the last frame of a film.
 *
 * @param {string} path
 * @param {number} x
 * @param {number} y
 */
function lastBrightness(path, x, y) {
  const filter = `format=gray,crop=1:1:${x}:${y}`;
  const args = ["-v", "error", "-i", path, "-vf", filter, "-f", "rawvideo", "-"];
  return execFileSync("ffmpeg", args).at(-1) ?? NaN;
}

test("every frame is in the film, at its own time, and the last is the last", async () => {
  const { page, heard } = await open();
  const path = await film(page, { width: 640, height: 360, frames: 90 });
  const found = probe(path);
  assert.deepEqual([found.codec_name, found.width, found.height], ["h264", 640, 360]);
  assert.equal(found.times.length, 90);
  found.times.forEach((/** @type {number} */ time, /** @type {number} */ i) =>
    // The file counts time in whole ticks of a ten-thousandth of a second or less.
    assert.ok(Math.abs(time - i / 30) < 1e-4, `frame ${i} at ${time}`),
  );
  assert.ok(lastBrightness(path, 2 * 89 + 10, 30) > 230);
  assert.ok(lastBrightness(path, 2 * 89 - 10, 30) < 150);
  assert.deepEqual(heard, []);
  await page.context().close();
});

test("frames of odd size lose their odd row and column", async () => {
  const { page } = await open();
  const { width, height } = probe(await film(page, { width: 321, height: 201, frames: 3 }));
  assert.deepEqual([width, height], [320, 200]);
  await page.context().close();
});

test("without an encoder of H.264 the film is WebM", async () => {
  const { page } = await open();
  await page.evaluate(() => {
    const isSupported = VideoEncoder.isConfigSupported;
    VideoEncoder.isConfigSupported = async (config) =>
      config.codec.startsWith("avc")
        ? { config, supported: false }
        : isSupported.call(VideoEncoder, config);
  });
  const found = probe(await film(page, { width: 320, height: 200, frames: 10 }));
  assert.deepEqual([found.codec_name, found.times.length], ["vp9", 10]);
  await page.context().close();
});

test("without WebCodecs the film is recorded, and lasts as long", async () => {
  const { page, heard } = await open(["VideoEncoder"]);
  const { times } = probe(await film(page, { width: 320, height: 200, frames: 30 }));
  const length = times[times.length - 1] - times[0];
  // A recorder takes the time of frames from a clock, and may miss one at the end.
  assert.ok(length > 0.85 && length < 1.25, `${length} s in ${times.length} frames`);
  assert.deepEqual(heard, []);
  await page.context().close();
});

test("a browser that cannot make films says so", async () => {
  const { page } = await open(["VideoEncoder", "MediaRecorder"]);
  const said = await page.evaluate(() => {
    try {
      return /** @type {any} */ (globalThis).carom.services.beginFilm(320, 200, 30);
    } catch (error) {
      return /** @type {Error} */ (error).message;
    }
  });
  assert.match(said, /^This browser cannot make films/);
  await page.context().close();
});

test("an encoder that fails is an error when the next frame comes, or the film ends", async () => {
  const { page } = await open();
  const said = await page.evaluate(async () => {
    VideoEncoder.prototype.encode = () => {
      throw new Error("the encoder is on fire");
    };
    const { services } = /** @type {any} */ (globalThis).carom;
    const pixels = new Uint8Array(320 * 200 * 4);
    const pause = () => new Promise((resolve) => setTimeout(resolve, 20));
    const ended = services.beginFilm(320, 200, 30);
    ended.add(pixels, 0);
    ended.finish("ended");
    let noted = null;
    for (; noted === null; noted = services.trouble()) {
      await pause();
    }
    const failing = services.beginFilm(320, 200, 30);
    try {
      for (let frame = 0; ; frame += 1) {
        failing.add(pixels, frame);
        await pause();
      }
    } catch (error) {
      return [noted, /** @type {Error} */ (error).message];
    }
  });
  assert.match(said[0], /^ended\.mp4: The film cannot be made: .*on fire/);
  assert.match(said[1], /^The film cannot be made: .*on fire/);
  await page.context().close();
});

test("frames that come faster than they are encoded end the film before memory does", async () => {
  const { page } = await open();
  const download = page.waitForEvent("download");
  const { said, frames } = await page.evaluate(() => {
    const film = /** @type {any} */ (globalThis).carom.services.beginFilm(1920, 1080, 30);
    const pixels = new Uint8Array(1920 * 1080 * 4);
    // Nothing is encoded while this loop runs.
    for (let frames = 0; ; frames += 1) {
      try {
        film.add(pixels, frames);
      } catch (error) {
        film.finish("early");
        return { said: /** @type {Error} */ (error).message, frames };
      }
    }
  });
  assert.match(said, /^The film ends early/);
  assert.ok(frames < 100, `after ${frames} frames`);
  assert.equal(probe(await keepDownload(await download, "early")).times.length, frames);
  await page.context().close();
});
