// A server that passes requests on to another one, but for those that a test takes.

import { createServer } from "node:http";

/**
 * @param {string} site the address of the other server
 * @param {(request: import("node:http").IncomingMessage, response: import("node:http").ServerResponse) => boolean} takes
 *   whether the test answers a request itself, or leaves it without an answer
 */
export async function passOn(site, takes) {
  const server = createServer(async (request, response) => {
    if (takes(request, response)) {
      return;
    }
    const answer = await fetch(new URL(request.url ?? "", site));
    response.writeHead(answer.status, { "Content-Type": answer.headers.get("Content-Type") ?? "" });
    response.end(Buffer.from(await answer.arrayBuffer()));
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
