// Fetches the module.

import { Stall } from "./stall.js";
import { Trouble } from "./trouble.js";

/**
 * Fetches the module and compiles it while it arrives.
 *
 * Its address and size are in the page's head, where `bundle.js` wrote them: a server that
 * compresses does not tell the uncompressed size.
 *
 * @param {(arrived: number, all: number) => void} progress gets the number of bytes that have
 * arrived
 * @returns {Promise<WebAssembly.Module>}
 */
export async function fetchModule(progress) {
  const stall = new Stall();
  try {
    return await Promise.race([download(progress, stall), stall.failure]);
  } finally {
    stall.end();
  }
}

/**
 * @param {(arrived: number, all: number) => void} progress
 * @param {Stall} stall
 * @returns {Promise<WebAssembly.Module>}
 */
async function download(progress, stall) {
  const link = /** @type {HTMLLinkElement} */ (document.getElementById("module"));
  const all = Number(link.dataset.bytes);
  const response = await ask(link.href, stall.signal);
  stall.signOfLife();
  let arrived = 0;
  const counted = response.pipeThrough(
    new TransformStream({
      transform(piece, controller) {
        stall.signOfLife();
        arrived += piece.byteLength;
        progress(arrived, all);
        controller.enqueue(piece);
      },
      // The compiler may need more time after the download.
      flush: () => stall.end(),
    }),
    { signal: stall.signal },
  );
  // Compilers require this type, whatever the server sends.
  const headers = { "Content-Type": "application/wasm" };
  try {
    return await WebAssembly.compileStreaming(new Response(counted, { headers }));
  } catch (error) {
    if (arrived !== all) {
      throw new Trouble("Carom did not arrive whole.", { cause: `${arrived} of ${all} bytes` });
    }
    throw error;
  }
}

/**
 * @param {string} url
 * @param {AbortSignal} signal
 * @returns {Promise<ReadableStream<Uint8Array>>}
 */
async function ask(url, signal) {
  const response = await fetch(url, { signal }).catch((error) => {
    throw new Trouble("Carom could not be fetched. Is the network there?", { cause: error });
  });
  if (!response.ok || response.body === null) {
    const cause = `${url}: ${response.status} ${response.statusText}`;
    throw new Trouble("Carom could not be fetched: the server does not give its module.", {
      cause,
    });
  }
  return response.body;
}
