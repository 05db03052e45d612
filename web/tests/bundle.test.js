// The files that the page is put together of.

import assert from "node:assert/strict";
import { mkdtemp, readFile, readdir, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, beforeEach, test } from "node:test";

import { bundle } from "../bundle.js";

/** @type {string} */
let folder;

before(async () => {
  folder = await mkdtemp(join(tmpdir(), "carom-bundle-"));
  await writeFile(join(folder, "carom_web.js"), "export default 0; export class Page {}");
  await writeFile(join(folder, "carom_web_bg.wasm"), "module");
});

after(() => rm(folder, { recursive: true }));

beforeEach(() => void delete process.env.CAROM_PAGE);

/** Puts the page together, and reads what there is. */
async function bundled() {
  const out = join(folder, "dist");
  await bundle(folder, out);
  const names = await readdir(out);
  const read = (/** @type {string} */ name) => readFile(join(out, name), "utf8");
  return { names, html: await read("index.html"), worker: await read("worker.js") };
}

test("the picture for other sites has a whole address where one is known", async () => {
  const { names, html } = await bundled();
  const picture = names.find((name) => name.endsWith(".png")) ?? "";
  assert.match(picture, /^picture-\w{8}\.png$/);
  assert.ok(html.includes(`property="og:image" content="${picture}"`));
  const address = `https://example.org/carom/${picture}`;
  for (const end of ["", "/", "/index.html"]) {
    process.env.CAROM_PAGE = `https://example.org/carom${end}`;
    const known = await bundled();
    assert.ok(known.html.includes(`property="og:image" content="${address}"`), end);
  }
});

test("the picture for other sites costs those who open the page nothing", async () => {
  const { names, html, worker } = await bundled();
  // Only the document, which the worker holds, names it.
  const namings = (/** @type {string} */ text) => text.match(/picture-\w+\.png/g)?.length;
  assert.deepEqual([namings(html), namings(worker)], [1, 1]);
  // What the size of the page is counted by.
  const compressed = names.filter((name) => /\.png\.(gz|br)$/.test(name));
  assert.deepEqual(compressed, []);
});

test("the worker keeps every file but itself and the picture", async () => {
  const { names, worker } = await bundled();
  const isOther = (/** @type {string} */ name) => /\.(br|gz|png|html)$|^worker\.js$/.test(name);
  const files = names.filter((name) => !isOther(name));
  assert.ok(files.length > 4, `${files}`);
  for (const name of files) {
    assert.ok(worker.includes(`"${name}"`), name);
  }
});
