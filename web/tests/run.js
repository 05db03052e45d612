// Tests the page: `node tests/run.js [FILE...]`, by default all test files in this folder.
//
// All files share one browser; the slowest tests are listed at the end.

import { setMaxListeners } from "node:events";
import { readdir } from "node:fs/promises";
import { join, resolve } from "node:path";
import { run } from "node:test";
import { spec, tap } from "node:test/reporters";
import { fileURLToPath } from "node:url";

import { share } from "./browser.js";
import { withSlowest } from "./slowest.js";

const FOLDER = fileURLToPath(new URL(".", import.meta.url));

/** Returns the test files in order of name. */
async function allFiles() {
  const names = (await readdir(FOLDER)).filter((name) => name.endsWith(".test.js"));
  return names.sort().map((name) => join(FOLDER, name));
}

/**
 * Runs files one after another, because frame times are measured and a browser uses the whole
 * machine.
 *
 * @param {string[]} files
 * @param {AbortSignal} signal ends the run early
 */
async function test(files, signal) {
  const events = run({ files, concurrency: 1, signal });
  events.on("test:fail", () => void (process.exitCode = 1));
  // The default of Node.js.
  const reporter = process.stdout.isTTY ? new spec() : tap;
  for await (const text of events.compose(withSlowest).compose(reporter)) {
    process.stdout.write(text);
  }
}

const asked = process.argv.slice(2).map((file) => resolve(file));
const browser = await share();
// The tests end when the browser does, as after a signal.
const ending = new AbortController();
// Each file adds a listener.
setMaxListeners(0, ending.signal);
browser.on("close", () => ending.abort());
try {
  await test(asked.length > 0 ? asked : await allFiles(), ending.signal);
} finally {
  await browser.close();
}
