// Puts the interface together for notebooks: `node notebook.js MODULE_FOLDER OUT_FOLDER`.
//
// MODULE_FOLDER is what `wasm-bindgen --target web` made. OUT_FOLDER gets `page.js.gz`, a module of
// JavaScript without imports that starts the interface on a canvas, and `carom.wasm.gz`, the module
// that it starts: the Python package hands both to the browser.

import { mkdir, readFile, rm, writeFile } from "node:fs/promises";
import { join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { constants, gzipSync } from "node:zlib";

import { build } from "esbuild";

import { BROWSERS } from "./bundle.js";

const PAGE = fileURLToPath(new URL("page/", import.meta.url));

/**
 * @param {string} moduleFolder
 * @param {string} out
 */
async function bundleForNotebooks(moduleFolder, out) {
  const { outputFiles } = await build({
    entryPoints: [join(PAGE, "embedded.js")],
    bundle: true,
    minify: true,
    write: false,
    format: "esm",
    target: BROWSERS,
    alias: { "carom-web": join(resolve(moduleFolder), "carom_web.js") },
    // Only for modules that are fetched from beside the script; this one is handed over.
    define: { "import.meta.url": '"blob:"' },
    legalComments: "eof",
    logLevel: "warning",
  });
  await rm(out, { recursive: true, force: true });
  await mkdir(out, { recursive: true });
  const wasm = await readFile(join(moduleFolder, "carom_web_bg.wasm"));
  await writeCompressed(join(out, "page.js.gz"), outputFiles[0].contents);
  await writeCompressed(join(out, "carom.wasm.gz"), wasm);
}

/**
 * @param {string} path
 * @param {Uint8Array} content
 */
async function writeCompressed(path, content) {
  await writeFile(path, gzipSync(content, { level: constants.Z_BEST_COMPRESSION }));
}

await bundleForNotebooks(process.argv[2], process.argv[3]);
