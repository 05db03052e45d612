// A server that passes requests on to another one, except those that a test takes.

import { createServer } from "node:http";

/**
 * @param {string} site the address of the other server
 * @param {(request: import("node:http").IncomingMessage, response: import("node:http").ServerResponse) => boolean} takes
 *   whether the test handles a request itself, with or without an answer
 */
export async function passOn(site, takes) {
  const server = createServer((request, response) => {
    if (!takes(request, response)) {
      // If the other server aborts an answer, for example because it closes, this one aborts it,
      // too.
      answer(site, request.url ?? "", response).catch(() => response.destroy());
    }
  });
  await new Promise((resolve) => server.listen(0, "127.0.0.1", () => resolve(undefined)));
  const { port } = /** @type {import("node:net").AddressInfo} */ (server.address());
  return {
    url: `http://127.0.0.1:${port}/`,
    close: () => {
      server.close();
      server.closeAllConnections();
    },
  };
}

/**
 * Answers as the other server does.
 *
 * @param {string} site
 * @param {string} path
 * @param {import("node:http").ServerResponse} response
 */
async function answer(site, path, response) {
  const other = await fetch(new URL(path, site));
  const body = Buffer.from(await other.arrayBuffer());
  response.writeHead(other.status, { "Content-Type": other.headers.get("Content-Type") ?? "" });
  response.end(body);
}
