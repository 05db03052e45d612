// The server serves static files and nothing outside of its folder.

import assert from "node:assert/strict";
import { mkdir, mkdtemp, rm, writeFile } from "node:fs/promises";
import { request } from "node:http";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { gunzipSync, gzipSync } from "node:zlib";

import { serve } from "../serve.js";

/**
 * @typedef {object} Answer
 * @property {number | undefined} status
 * @property {import("node:http").IncomingHttpHeaders} headers
 * @property {Buffer} body
 */

/** @type {string} */
let folder;
/** @type {Awaited<ReturnType<typeof serve>>} */
let server;

before(async () => {
  folder = await mkdtemp(join(tmpdir(), "carom-serve-"));
  await mkdir(join(folder, "dist"));
  await writeFile(join(folder, "secret.txt"), "secret");
  await writeFile(join(folder, "dist/index.html"), "<!doctype html>");
  await writeFile(join(folder, "dist/a-12345678.wasm"), "module");
  await writeFile(join(folder, "dist/a-12345678.wasm.gz"), gzipSync("module"));
  server = await serve(join(folder, "dist"), 0);
});

after(async () => {
  await server.close();
  await rm(folder, { recursive: true });
});

/**
 * Requests a path without the normalisation of `fetch`.
 *
 * @param {string} path
 * @param {Record<string, string>} [headers]
 * @returns {Promise<Answer>}
 */
function get(path, headers = {}) {
  return new Promise((resolve, reject) => {
    const asked = request(`${server.url}`, { path, headers }, async (response) => {
      const body = Buffer.concat(await response.toArray());
      resolve({ status: response.statusCode, headers: response.headers, body });
    });
    asked.on("error", reject).end();
  });
}

test("the folder itself is its page", async () => {
  const { status, headers } = await get("/?x#y");
  assert.equal(status, 200);
  assert.equal(headers["content-type"], "text/html; charset=utf-8");
  assert.equal(headers["cache-control"], "no-cache");
});

test("the server compresses for clients that accept gzip, and for no others", async () => {
  const compressed = await get("/a-12345678.wasm", { "accept-encoding": "br, gzip" });
  assert.equal(compressed.headers["content-encoding"], "gzip");
  assert.equal(compressed.headers["content-type"], "application/wasm");
  assert.match(compressed.headers["cache-control"] ?? "", /immutable/);
  assert.equal(gunzipSync(compressed.body).toString(), "module");
  const plain = await get("/a-12345678.wasm");
  assert.equal(plain.headers["content-encoding"], undefined);
  assert.equal(plain.body.toString(), "module");
});

test("nothing outside of the folder is served", async () => {
  for (const path of ["/../secret.txt", "/%2e%2e/secret.txt", "/..%2fsecret.txt", "/%00", "/%"]) {
    const { status, body } = await get(path);
    assert.equal(status, 404, path);
    assert.doesNotMatch(body.toString(), /secret/);
  }
});

test("what is not there is not found", async () => {
  assert.equal((await get("/none")).status, 404);
});
