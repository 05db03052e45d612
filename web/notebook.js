// Builds the interface for notebooks: `node notebook.js MODULE_FOLDER OUT_FOLDER`.
//
// MODULE_FOLDER is the output of `wasm-bindgen --target web`. OUT_FOLDER gets `page.js.gz`, a
// JavaScript module without imports that starts the interface on a canvas, and `carom.wasm.gz`, the
// WebAssembly module that it starts. The Python package sends both to the browser.

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
    // Needed only to fetch a module from beside the script; here the module is passed in.
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
