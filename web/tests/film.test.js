// Films that the page makes of frames: what FFmpeg finds in the files.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { after, before, test } from "node:test";

import { complaints, launch } from "./browser.js";
import { serveStandIn } from "./stood_in.js";

/** @type {import("playwright-core").Browser} */
let browser;
/** @type {Awaited<ReturnType<typeof serveStandIn>>} */
let site;

before(async () => {
  [browser, site] = await Promise.all([launch("webgl2"), serveStandIn()]);
});

after(async () => {
  await browser?.close();
  await site?.close();
});

/**
 * A page, without those of the browser's abilities that are named.
 *
 * @param {string[]} without
 */
async function open(without = []) {
  const page = await browser.newPage();
  const heard = complaints(page);
  await page.addInitScript((names) => {
    for (const name of names) {
      Reflect.deleteProperty(globalThis, name);
    }
  }, without);
  await page.goto(site.url);
  await page.waitForSelector("#loading.done", { state: "attached" });
  return { page, heard };
}

/**
 * Films a square that moves to the right by two pixels a frame, on grey.
 *
 * @param {import("playwright-core").Page} page
 * @param {{ width: number, height: number, times: number[] }} film times of the frames [s]
 * @returns {Promise<string>} the path of the file
 */
async function film(page, { width, height, times }) {
  const download = page.waitForEvent("download");
  await page.evaluate(
    ({ width, height, times }) => {
      const film = /** @type {any} */ (globalThis).carom.host.beginFilm(width, height, 30);
      Object.assign(globalThis, { film });
      // One buffer for all frames, as the module has it: the page must have copied it.
      const pixels = new Uint8Array(width * height * 4);
      times.forEach((time, frame) => {
        pixels.fill(128);
        for (let y = 20; y < 40; y += 1) {
          const left = (y * width + 2 * frame) * 4;
          pixels.fill(255, left, left + 20 * 4);
        }
        film.add(pixels, time);
      });
      pixels.fill(0);
      film.finish("square.mp4");
    },
    { width, height, times },
  );
  const file = await download;
  const name = await page.evaluate(() => {
    const { saved, error, waiting } = /** @type {any} */ (globalThis).film;
    return waiting === 0 && error === null ? saved : error;
  });
  assert.equal(name, file.suggestedFilename());
  return file.path();
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
 * Brightness of a pixel in the last frame of a film.
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

const steps = (/** @type {number} */ frames) => Array.from({ length: frames }, (_, i) => i / 30);

test("every frame is in the film, at its own time, and the last is the last", async () => {
  const { page, heard } = await open();
  const times = steps(90);
  const path = await film(page, { width: 640, height: 360, times: times.map((time) => 7.5 + time) });
  const found = probe(path);
  assert.deepEqual([found.codec_name, found.width, found.height], ["h264", 640, 360]);
  assert.equal(found.times.length, 90);
  // Films count time in ticks of 1/57600 s or finer.
  found.times.forEach((/** @type {number} */ time, /** @type {number} */ i) =>
    assert.ok(Math.abs(time - times[i]) < 1e-4, `frame ${i} at ${time}`),
  );
  assert.ok(lastBrightness(path, 2 * 89 + 10, 30) > 230);
  assert.ok(lastBrightness(path, 2 * 89 - 10, 30) < 150);
  assert.deepEqual(heard, []);
  await page.close();
});

test("frames of odd size lose their odd row and column", async () => {
  const { page } = await open();
  const { width, height } = probe(await film(page, { width: 321, height: 201, times: steps(3) }));
  assert.deepEqual([width, height], [320, 200]);
  await page.close();
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
  const found = probe(await film(page, { width: 320, height: 200, times: steps(10) }));
  assert.deepEqual([found.codec_name, found.times.length], ["vp9", 10]);
  await page.close();
});

test("without WebCodecs the film is recorded, and lasts as long", async () => {
  const { page, heard } = await open(["VideoEncoder"]);
  const { times } = probe(await film(page, { width: 320, height: 200, times: steps(30) }));
  const length = times[times.length - 1] - times[0];
  // A recorder takes the time of frames from a clock, and may miss one at the end.
  assert.ok(length > 0.8 && length < 1.5, `${length} s in ${times.length} frames`);
  assert.deepEqual(heard, []);
  await page.close();
});

test("a browser that cannot make films says so", async () => {
  const { page } = await open(["VideoEncoder", "MediaRecorder"]);
  const said = await page.evaluate(() => {
    try {
      return /** @type {any} */ (globalThis).carom.host.beginFilm(320, 200, 30);
    } catch (error) {
      return /** @type {Error} */ (error).message;
    }
  });
  assert.match(said, /^This browser cannot make films/);
  await page.close();
});

test("an encoder that fails is told of, and nothing is saved", async () => {
  const { page } = await open();
  const { error, saved } = await page.evaluate(async () => {
    VideoEncoder.prototype.encode = () => {
      throw new Error("the encoder is on fire");
    };
    const film = /** @type {any} */ (globalThis).carom.host.beginFilm(320, 200, 30);
    film.add(new Uint8Array(320 * 200 * 4), 0);
    film.finish("square.mp4");
    while (film.error === null) {
      await new Promise((resolve) => setTimeout(resolve, 10));
    }
    return film;
  });
  assert.match(error, /^The film cannot be made: .*on fire/);
  assert.equal(saved, null);
  await page.close();
});

test("frames that come faster than they are encoded ask for a pause, and end the film in time", async () => {
  const { page } = await open();
  const { busyAt, error, endedAt } = await page.evaluate(() => {
    const film = /** @type {any} */ (globalThis).carom.host.beginFilm(1920, 1080, 30);
    const pixels = new Uint8Array(1920 * 1080 * 4);
    let busyAt = NaN;
    let frame = 0;
    // Nothing is encoded while this runs.
    for (; film.error === null && frame < 1000; frame += 1) {
      film.add(pixels, frame / 30);
      if (film.busy && Number.isNaN(busyAt)) {
        busyAt = frame;
      }
    }
    return { busyAt, error: film.error, endedAt: frame };
  });
  assert.ok(busyAt > 0 && busyAt < 20, `busy at ${busyAt}`);
  assert.ok(endedAt < 100, `ended at ${endedAt}`);
  assert.match(error, /^The film ends early/);
  await page.close();
});
