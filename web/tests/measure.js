// Measures the page that `cargo xtask web` built: `node tests/measure.js [MINUTES]`.
//
// Prints its compressed size, the time from the load to the first picture and to the first
// movement, and the memory of the module and of scripts while the first scene plays. Times depend
// on the machine and on what else it does.

import { readFile, readdir } from "node:fs/promises";
import { fileURLToPath } from "node:url";

import { newPage } from "./browser.js";
import { Desk } from "./viewer.js";

const DIST = process.env.CAROM_DIST ?? fileURLToPath(new URL("../dist/", import.meta.url));

/** Fewer pixels than on a screen, because software draws them. */
const SMALL = { viewport: { width: 400, height: 300 }, deviceScaleFactor: 0.5 };

/** @param {string} ending of the names of compressed files */
async function size(ending) {
  const names = (await readdir(DIST)).filter((name) => name.endsWith(ending));
  const files = await Promise.all(names.map((name) => readFile(`${DIST}/${name}`)));
  return files.reduce((sum, file) => sum + file.length, 0);
}

/** Keeps the memory of the module where the test can read it. */
function watchMemory() {
  const page = /** @type {any} */ (globalThis);
  for (const name of /** @type {const} */ (["instantiate", "instantiateStreaming"])) {
    const plain = /** @type {any} */ (WebAssembly[name]);
    /** @type {any} */ (WebAssembly)[name] = async (/** @type {any[]} */ ...given) => {
      const made = await plain.apply(WebAssembly, given);
      page.moduleMemory = (made.instance ?? made).exports.memory;
      return made;
    };
  }
}

/** @param {number} began by `performance.now()` */
const since = (began) => ((performance.now() - began) / 1000).toFixed(1);

const minutes = Number(process.argv[2] ?? 5);
const desk = await Desk.set("webgl2");
try {
  console.log(`${await size(".gz")} bytes by gzip, ${await size(".br")} by Brotli`);
  const page = await newPage(desk.browser, SMALL);
  await page.addInitScript(watchMemory);
  const began = performance.now();
  await page.goto(desk.server.url);
  await page.waitForFunction(() => /** @type {any} */ (globalThis).carom?.status?.()?.pictures > 0);
  console.log(`first picture after ${since(began)} s`);
  await page.waitForFunction(
    () => /** @type {any} */ (globalThis).carom?.status?.()?.watching?.time > 0,
  );
  console.log(`first movement after ${since(began)} s`);
  const client = await page.context().newCDPSession(page);
  await client.send("HeapProfiler.enable");
  for (let minute = 1; minute <= minutes; minute += 1) {
    const left = 60_000 * minute - (performance.now() - began);
    await new Promise((resolve) => setTimeout(resolve, left));
    await client.send("HeapProfiler.collectGarbage");
    const { usedSize } = await client.send("Runtime.getHeapUsage");
    const module = await page.evaluate(
      () => /** @type {any} */ (globalThis).moduleMemory.buffer.byteLength,
    );
    console.log(`after ${minute} min: module ${module} bytes, scripts ${usedSize}`);
  }
} finally {
  await desk.clear();
}
