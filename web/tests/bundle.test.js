// The files of the built page.

import assert from "node:assert/strict";
import { mkdtemp, readFile, readdir, rm, stat, writeFile } from "node:fs/promises";
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

/** Builds the page, quickly by default, and reads its files. */
async function bundled({ quick = true } = {}) {
  const out = join(folder, "dist");
  await bundle(folder, out, { quick });
  const names = await readdir(out);
  const read = (/** @type {string} */ name) => readFile(join(out, name), "utf8");
  const compressed = names.filter((name) => /\.(gz|br)$/.test(name));
  const sizes = await Promise.all(
    compressed.map(
      async (name) => /** @type {const} */ ([name, (await stat(join(out, name))).size]),
    ),
  );
  const [html, worker] = [await read("index.html"), await read("worker.js")];
  return { names, html, worker, sizes: new Map(sizes) };
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
  // Only the document, which the worker contains, names it.
  const namings = (/** @type {string} */ text) => text.match(/picture-\w+\.png/g)?.length;
  assert.deepEqual([namings(html), namings(worker)], [1, 1]);
  // The size of the page is counted by these.
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

test("a page made quickly is the same but for how well it is compressed", async () => {
  const [quick, best] = [await bundled(), await bundled({ quick: false })];
  assert.deepEqual(quick.names, best.names);
  assert.deepEqual([quick.html, quick.worker], [best.html, best.worker]);
  const style = best.names.find((name) => /^style-\w{8}\.css$/.test(name));
  for (const ending of [".gz", ".br"]) {
    const [large, small] = [quick, best].map(({ sizes }) => sizes.get(`${style}${ending}`) ?? NaN);
    assert.ok(small < large, `${small} and ${large} bytes in ${ending}`);
  }
});
