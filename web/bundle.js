// Builds the page: `node bundle.js MODULE_FOLDER OUT_FOLDER [--quick]`.
//
// `--quick` compresses fast and less well, for tests of the page's behaviour.
//
// MODULE_FOLDER is the output of `wasm-bindgen --target web`. In OUT_FOLDER every file but
// index.html and worker.js has a hash of its content in its name, so that browsers can cache it and
// never mix two versions. Beside each file are its forms compressed by gzip and Brotli, for servers
// that offer them.
//
// $CAROM_PAGE is the address of the published page, if it is known: other sites show the page's
// picture only by an absolute address.

import { createHash } from "node:crypto";
import { mkdir, readFile, readdir, rm, writeFile } from "node:fs/promises";
import { extname, join, relative, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { brotliCompressSync, constants, gzipSync } from "node:zlib";

import { build } from "esbuild";

const PAGE = fileURLToPath(new URL("page/", import.meta.url));

/** The scenes that come with Carom. */
const SCENES = fileURLToPath(new URL("../crates/carom-scene/scenes/", import.meta.url));

/** The picture that other sites show beside a link to the page. */
const PICTURE = fileURLToPath(new URL("../docs/pictures/tutorial4.png", import.meta.url));

/**
 * The oldest browsers with everything that module and page use: reference types, TransformStream,
 * box sizes.
 */
export const BROWSERS = ["chrome96", "firefox102", "safari15.4"];

/**
 * Levels of compression.
 *
 * @typedef {object} Levels
 * @property {number} gzip
 * @property {number} brotli
 */

/** For the published page. @type {Levels} */
const BEST = { gzip: constants.Z_BEST_COMPRESSION, brotli: constants.BROTLI_MAX_QUALITY };

/** For tests. @type {Levels} */
const QUICK = { gzip: constants.Z_BEST_SPEED, brotli: constants.BROTLI_MIN_QUALITY };

/**
 * Builds the page.
 *
 * @param {string} moduleFolder
 * @param {string} out
 * @param {{ quick?: boolean }} [options] whether to compress fast and less well
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
  // After the list, because only other sites fetch it.
  const picture = await writeHashed(out, "picture.png", await readFile(PICTURE));
  html = html.replace('"picture.png"', JSON.stringify(whole(picture)));
  await writeFile(join(out, "index.html"), html);
  await bundleWorker(files, html, out);
  await compressAll(out, quick ? QUICK : BEST);
}

/**
 * Returns the address of a file of the page, absolute if the page's address is known.
 *
 * @param {string} name
 */
function whole(name) {
  if (!process.env.CAROM_PAGE) {
    return name;
  }
  const page = new URL(process.env.CAROM_PAGE);
  // The page is a folder, with or without a slash at the end, or a document in one.
  if (!/\/$|\.html$/.test(page.pathname)) {
    page.pathname += "/";
  }
  return new URL(name, page).href;
}

/**
 * Makes one script of everything that the page needs at its start, and others of the rest.
 *
 * @param {string} moduleFolder
 * @param {string} out
 * @returns {Promise<Map<string, string>>} the names in index.html, with those of the written files
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
    // Encoded twice: an object would become a separate script, fetched after the first.
    define: { TITLES: JSON.stringify(JSON.stringify(await sceneTitles())) },
    legalComments: "eof",
    metafile: true,
    logLevel: "warning",
  });
  const [main] = Object.entries(metafile.outputs).filter(([, output]) => output.entryPoint);
  return new Map([["main.js", relative(out, resolve(main[0]))]]);
}

/**
 * Makes the service worker of this version of the page. Its name stays the same, but its content
 * differs for every version, which shows browsers that there is a new one.
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

/** @returns {Promise<Record<string, string>>} titles by the names of the scenes */
async function sceneTitles() {
  /** @type {Record<string, string>} */
  const titles = {};
  for (const file of await readdir(SCENES)) {
    // The title comes before the first table, as `carom` writes it, and its string is valid JSON,
    // too.
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
 * @returns {Promise<string>} the name of the written file
 */
async function writeHashed(out, name, content) {
  const hash = createHash("sha256").update(content).digest("hex").slice(0, 8);
  const extension = extname(name);
  const hashed = `${name.slice(0, -extension.length)}-${hash}${extension}`;
  await writeFile(join(out, hashed), content);
  return hashed;
}

/**
 * Writes the forms compressed by gzip and Brotli beside each file.
 *
 * @param {string} out
 * @param {Levels} levels
 */
async function compressAll(out, { gzip, brotli }) {
  // A picture is already compressed.
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
