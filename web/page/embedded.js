// The interface in a canvas of another document, for example the output of a notebook.

import init, { Page } from "carom-web";

import { watchForTheEnd } from "./end.js";
import { keepKeysFromScrolling } from "./keys.js";
import { checkPixelSize } from "./pixel_size.js";
import { checkBrowser } from "./requirements.js";
import { services } from "./services.js";
import { inWords } from "./trouble.js";

/**
 * @typedef {object} Ears callbacks of the document
 * @property {(fragment: string) => void} link gets the part after `#` of a link to the present view
 * @property {(message: string, detail: string | null) => void} end gets the reason if it cannot continue
 */

/**
 * Starts the interface on a canvas. The module is compiled once for all canvases of a document.
 *
 * @param {HTMLCanvasElement} canvas in the document, with a size
 * @param {WebAssembly.Module} module
 * @param {string} fragment of the link to open
 * @param {Ears} ears
 * @returns {Promise<Page>}
 */
export async function start(canvas, module, fragment, ears) {
  await checkBrowser();
  await init({ module_or_path: module });
  await checkPixelSize(canvas);
  keepKeysFromScrolling(canvas);
  const own = { ...services, showFragment: ears.link, isEmbedded: () => true };
  const page = await Page.start(canvas, own, fragment);
  watchForTheEnd(canvas, ears.end);
  return page;
}

export { inWords };
