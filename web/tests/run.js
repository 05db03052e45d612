// Tests the page: `node tests/run.js [FILE...]`, by default all files of tests beside this one.
//
// All of them share one browser, and the tests that took longest are listed at the end.

import { setMaxListeners } from "node:events";
import { readdir } from "node:fs/promises";
import { join, resolve } from "node:path";
import { run } from "node:test";
import { spec, tap } from "node:test/reporters";
import { fileURLToPath } from "node:url";

import { share } from "./browser.js";
import { withSlowest } from "./slowest.js";

const FOLDER = fileURLToPath(new URL(".", import.meta.url));

/** The files that hold tests, by name. */
async function allFiles() {
  const names = (await readdir(FOLDER)).filter((name) => name.endsWith(".test.js"));
  return names.sort().map((name) => join(FOLDER, name));
}

/**
 * Runs files one after another: frame times are measured, and a browser uses all there is.
 *
 * @param {string[]} files
 * @param {AbortSignal} signal ends the run early
 */
async function test(files, signal) {
  const events = run({ files, concurrency: 1, signal });
  events.on("test:fail", () => void (process.exitCode = 1));
  // What Node.js itself would choose.
  const reporter = process.stdout.isTTY ? new spec() : tap;
  for await (const text of events.compose(withSlowest).compose(reporter)) {
    process.stdout.write(text);
  }
}

const asked = process.argv.slice(2).map((file) => resolve(file));
const browser = await share();
// With the browser, as on a signal, the tests end.
const ending = new AbortController();
// Each file listens to it.
setMaxListeners(0, ending.signal);
browser.on("close", () => ending.abort());
try {
  await test(asked.length > 0 ? asked : await allFiles(), ending.signal);
} finally {
  await browser.close();
}
