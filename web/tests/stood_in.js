// The page with a stand-in for the real module.

import { randomFillSync } from "node:crypto";
import { copyFile, mkdtemp, readFile, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";

import { bundle } from "../bundle.js";
import { serve } from "../serve.js";
import { launch } from "./browser.js";

/** Size of the stand-in's module [bytes]: enough to arrive in several pieces. */
const SIZE = 4_000_000;

/** A browser and the page for the tests of one file. */
export class StandIn {
  /**
   * @param {import("playwright-core").Browser} browser
   * @param {Awaited<ReturnType<typeof serveStandIn>>} site
   */
  constructor(browser, site) {
    this.browser = browser;
    this.site = site;
  }

  static async set() {
    const [browser, site] = await Promise.all([launch("webgl2"), serveStandIn()]);
    return new StandIn(browser, site);
  }

  async clear() {
    await this.browser.close();
    await this.site.close();
  }
}

/** Serves the page; `close` removes everything. */
async function serveStandIn() {
  const folder = await mkdtemp(join(tmpdir(), "carom-page-"));
  await copyFile(
    fileURLToPath(new URL("stand_in.js", import.meta.url)),
    join(folder, "carom_web.js"),
  );
  const dist = join(folder, "dist");
  // Makes another version of the page every time: no two modules are the same.
  const renew = async () => {
    await writeFile(join(folder, "carom_web_bg.wasm"), emptyModule(SIZE));
    await bundle(folder, dist, { quick: true });
  };
  await renew();
  const server = await serve(dist, 0);
  const close = async () => {
    await server.close();
    await rm(folder, { recursive: true });
  };
  const module = () => readFile(join(folder, "carom_web_bg.wasm"));
  return { url: server.url, module, renew, close };
}

/**
 * Returns a WebAssembly module with one custom section of random bytes, which gzip cannot compress.
 *
 * @param {number} size [bytes]
 */
function emptyModule(size) {
  const header = [0, 0x61, 0x73, 0x6d, 1, 0, 0, 0];
  // The section's number, its size in five bytes of LEB128, and its name, "-".
  const content = size - header.length - 6;
  const leb = [0, 7, 14, 21].map((shift) => ((content >> shift) & 0x7f) | 0x80);
  const bytes = randomFillSync(Buffer.alloc(size));
  Buffer.from([...header, 0, ...leb, content >> 28, 1, 0x2d]).copy(bytes);
  return bytes;
}
