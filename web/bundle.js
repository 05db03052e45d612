// Puts the page together: `node bundle.js MODULE_FOLDER OUT_FOLDER [--quick]`.
//
// `--quick` compresses in a moment, and less: for tests, which ask for what the page does.
//
// MODULE_FOLDER is what `wasm-bindgen --target web` made. In OUT_FOLDER every file but index.html
// and worker.js bears a hash of its content in its name, so that browsers may keep it and never mix
// two versions; beside each lie what gzip and Brotli make of it, for servers that give that.
//
// $CAROM_PAGE is the address that the page will have, where it is known: other sites show the page's
// picture only by a whole address.

import { createHash } from "node:crypto";
import { mkdir, readFile, readdir, rm, writeFile } from "node:fs/promises";
import { extname, join, relative, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { brotliCompressSync, constants, gzipSync } from "node:zlib";

import { build } from "esbuild";

const PAGE = fileURLToPath(new URL("page/", import.meta.url));

/** The scenes that come with Carom. */
const SCENES = fileURLToPath(new URL("../crates/carom-scene/scenes/", import.meta.url));

/** What other sites show beside a link to the page. */
const PICTURE = fileURLToPath(new URL("../docs/pictures/tutorial4.png", import.meta.url));

/** The oldest with all that module and page use: reference types, TransformStream, box sizes. */
export const BROWSERS = ["chrome96", "firefox102", "safari15.4"];

/**
 * How well files are compressed.
 *
 * @typedef {object} Levels
 * @property {number} gzip
 * @property {number} brotli
 */

/** For the page that is published. @type {Levels} */
const BEST = { gzip: constants.Z_BEST_COMPRESSION, brotli: constants.BROTLI_MAX_QUALITY };

/** For tests. @type {Levels} */
const QUICK = { gzip: constants.Z_BEST_SPEED, brotli: constants.BROTLI_MIN_QUALITY };

/**
 * Puts the page together.
 *
 * @param {string} moduleFolder
 * @param {string} out
 * @param {{ quick?: boolean }} [options] whether to compress in a moment, and less
 */
export async function bundle(moduleFolder, out, { quick = false } = {}) {
  await rm(out, { recursive: true, force: true });
  await mkdir(out, { recursive: true });
  const names = await bundleScripts(resolve(moduleFolder), out);
  for (const name of ["style.css", "icon.svg"]) {
    names.set(name, await writeHashed(out, name, await readFile(join(PAGE, name))));
  }
  const manifest = await readFile(join(PAGE, "manifest.webmanifest"), "utf8");
  const named = manifest.replace('"icon.svg"', JSON.stringify(names.get("icon.svg")));
  names.set(
    "manifest.webmanifest",
    await writeHashed(out, "manifest.webmanifest", Buffer.from(named)),
  );
  const wasm = await readFile(join(moduleFolder, "carom_web_bg.wasm"));
  const wasmName = await writeHashed(out, "carom.wasm", wasm);
  const size = `data-bytes="${wasm.length}"`;
  const preload = `rel="preload" as="fetch" crossorigin href="${wasmName}"`;
  let html = await readFile(join(PAGE, "index.html"), "utf8");
  for (const [name, hashed] of names) {
    html = html.replaceAll(`"${name}"`, `"${hashed}"`);
  }
  html = html.replace("  </head>", `    <link id="module" ${preload} ${size} />\n  </head>`);
  const files = await readdir(out);
  // After the list: only other sites ask for it.
  const picture = await writeHashed(out, "picture.png", await readFile(PICTURE));
  html = html.replace('"picture.png"', JSON.stringify(whole(picture)));
  await writeFile(join(out, "index.html"), html);
  await bundleWorker(files, html, out);
  await compressAll(out, quick ? QUICK : BEST);
}

/**
 * The address of a file of the page, as whole as it can be known.
 *
 * @param {string} name
 */
function whole(name) {
  if (!process.env.CAROM_PAGE) {
    return name;
  }
  const page = new URL(process.env.CAROM_PAGE);
  // A folder, with or without its slash, or a document in it.
  if (!/\/$|\.html$/.test(page.pathname)) {
    page.pathname += "/";
  }
  return new URL(name, page).href;
}

/**
 * Makes one script of all that the page needs at once, and others of what comes later.
 *
 * @param {string} moduleFolder
 * @param {string} out
 * @returns {Promise<Map<string, string>>} the names that index.html knows to those that they got
 */
async function bundleScripts(moduleFolder, out) {
  const { metafile } = await build({
    entryPoints: [join(PAGE, "main.js")],
    outdir: out,
    bundle: true,
    minify: true,
    splitting: true,
    format: "esm",
    target: BROWSERS,
    entryNames: "[name]-[hash]",
    chunkNames: "[name]-[hash]",
    alias: { "carom-web": join(moduleFolder, "carom_web.js") },
    // A string twice: an object would become a script of its own, fetched after the first.
    define: { TITLES: JSON.stringify(JSON.stringify(await sceneTitles())) },
    legalComments: "eof",
    metafile: true,
    logLevel: "warning",
  });
  const [main] = Object.entries(metafile.outputs).filter(([, output]) => output.entryPoint);
  return new Map([["main.js", relative(out, resolve(main[0]))]]);
}

/**
 * Makes the worker that keeps this version of the page: its name stays, and its content is another
 * for every version, by which browsers know that there is a new one.
 *
 * @param {string[]} files
 * @param {string} html
 * @param {string} out
 */
async function bundleWorker(files, html, out) {
  await build({
    entryPoints: [join(PAGE, "worker.js")],
    outdir: out,
    bundle: true,
    minify: true,
    format: "iife",
    target: BROWSERS,
    define: { FILES: JSON.stringify(files), INDEX: JSON.stringify(html) },
    logLevel: "warning",
  });
}

/** @returns {Promise<Record<string, string>>} by the names of the scenes */
async function sceneTitles() {
  /** @type {Record<string, string>} */
  const titles = {};
  for (const file of await readdir(SCENES)) {
    // Before the first table, as in all that `carom` writes, and a string that JSON reads as well.
    const title = /^title = (".*")$/m.exec(await readFile(join(SCENES, file), "utf8"));
    if (title !== null) {
      titles[file.replace(/\.toml$/, "")] = JSON.parse(title[1]);
    }
  }
  return titles;
}

/**
 * @param {string} out
 * @param {string} name
 * @param {Buffer} content
 * @returns {Promise<string>} the name under which it was written
 */
async function writeHashed(out, name, content) {
  const hash = createHash("sha256").update(content).digest("hex").slice(0, 8);
  const extension = extname(name);
  const hashed = `${name.slice(0, -extension.length)}-${hash}${extension}`;
  await writeFile(join(out, hashed), content);
  return hashed;
}

/**
 * Puts what gzip and Brotli make of each file beside it.
 *
 * @param {string} out
 * @param {Levels} levels
 */
async function compressAll(out, { gzip, brotli }) {
  // A picture is compressed already.
  const names = (await readdir(out)).filter((name) => extname(name) !== ".png");
  for (const name of names) {
    const path = join(out, name);
    const content = await readFile(path);
    await writeFile(`${path}.gz`, gzipSync(content, { level: gzip }));
    const params = { [constants.BROTLI_PARAM_QUALITY]: brotli };
    await writeFile(`${path}.br`, brotliCompressSync(content, { params }));
  }
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const [moduleFolder, out, option] = process.argv.slice(2);
  await bundle(moduleFolder, out, { quick: option === "--quick" });
}
