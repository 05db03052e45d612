// Serves a folder of static files on this machine: `node serve.js FOLDER PORT`.

import { createReadStream } from "node:fs";
import { stat } from "node:fs/promises";
import { createServer } from "node:http";
import { extname, join, normalize, sep } from "node:path";
import { fileURLToPath } from "node:url";

/** Media types by file extension. */
const TYPES = new Map([
  [".css", "text/css; charset=utf-8"],
  [".html", "text/html; charset=utf-8"],
  [".js", "text/javascript; charset=utf-8"],
  [".png", "image/png"],
  [".svg", "image/svg+xml"],
  [".toml", "text/plain; charset=utf-8"],
  [".txt", "text/plain; charset=utf-8"],
  [".wasm", "application/wasm"],
  [".webmanifest", "application/manifest+json"],
]);

/** Compressed forms that may be beside a file, the smallest first, with their extensions. */
const ENCODINGS = [
  ["br", ".br"],
  ["gzip", ".gz"],
];

/** Names made by `bundle.js`: the content of these files never changes. */
const HASHED = /-[0-9A-Za-z]{8}\.\w+$/;

/**
 * Serves a folder to this machine only.
 *
 * @param {string} folder
 * @param {number} port 0 for any free one
 * @returns {Promise<{ url: string, close: () => Promise<void> }>}
 */
export async function serve(folder, port) {
  const server = createServer((request, response) => {
    answer(folder, request, response).catch((error) => {
      console.error(error);
      response.destroy();
    });
  });
  await new Promise((resolve, reject) => {
    server.once("error", reject);
    server.listen(port, "127.0.0.1", () => resolve(undefined));
  });
  const { port: bound } = /** @type {import("node:net").AddressInfo} */ (server.address());
  const close = () =>
    new Promise((/** @type {(_: void) => void} */ resolve) => {
      server.close(() => resolve());
      server.closeAllConnections();
    });
  return { url: `http://127.0.0.1:${bound}/`, close };
}

/**
 * @param {string} folder
 * @param {import("node:http").IncomingMessage} request
 * @param {import("node:http").ServerResponse} response
 */
async function answer(folder, request, response) {
  if (request.method !== "GET" && request.method !== "HEAD") {
    return refuse(response, 405, "Method Not Allowed");
  }
  const path = fileOf(folder, request.url ?? "/");
  if (path === null || (await sizeOf(path)) === null) {
    return refuse(response, 404, "Not Found");
  }
  const { ending, encoding, size } = await bestForm(path, request.headers["accept-encoding"]);
  response.writeHead(200, {
    "Content-Type": TYPES.get(extname(path)) ?? "application/octet-stream",
    "Content-Length": String(size),
    "Cache-Control": HASHED.test(path) ? "public, max-age=31536000, immutable" : "no-cache",
    "X-Content-Type-Options": "nosniff",
    Vary: "Accept-Encoding",
    ...(encoding ? { "Content-Encoding": encoding } : {}),
  });
  if (request.method === "HEAD") {
    return void response.end();
  }
  createReadStream(path + ending).pipe(response);
}

/**
 * Returns the smallest existing form of a file that the client accepts.
 *
 * @param {string} path
 * @param {string | string[] | undefined} accepted
 * @returns {Promise<{ ending: string, encoding: string, size: number | null }>}
 */
async function bestForm(path, accepted) {
  for (const [encoding, ending] of ENCODINGS) {
    const size = await sizeOf(path + ending);
    if (size !== null && new RegExp(`\\b${encoding}\\b`).test(String(accepted ?? ""))) {
      return { ending, encoding, size };
    }
  }
  return { ending: "", encoding: "", size: await sizeOf(path) };
}

/**
 * Returns the file for an address, or null if it is not inside the folder.
 *
 * @param {string} folder
 * @param {string} url
 */
function fileOf(folder, url) {
  try {
    const path = decodeURIComponent(new URL(url, "http://localhost").pathname);
    const file = join(folder, normalize(path.endsWith("/") ? `${path}index.html` : path));
    const isInside = file.startsWith(normalize(folder + sep)) && !file.includes("\0");
    return isInside ? file : null;
  } catch {
    return null;
  }
}

/**
 * @param {string} path
 * @returns {Promise<number | null>} size of a file in bytes, or null if there is none
 */
async function sizeOf(path) {
  try {
    const found = await stat(path);
    return found.isFile() ? found.size : null;
  } catch {
    return null;
  }
}

/**
 * @param {import("node:http").ServerResponse} response
 * @param {number} code
 * @param {string} text
 */
function refuse(response, code, text) {
  response.writeHead(code, { "Content-Type": "text/plain; charset=utf-8" }).end(`${text}\n`);
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const [folder, port] = process.argv.slice(2);
  try {
    const { url } = await serve(folder, Number(port));
    console.log(`Carom is at ${url} (Ctrl + C ends it)`);
  } catch (error) {
    console.error(`serve: ${error instanceof Error ? error.message : error}`);
    process.exitCode = 1;
  }
}
