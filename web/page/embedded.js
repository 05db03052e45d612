// The interface in a canvas of some other document, like the output of a notebook.

import init, { Page } from "carom-web";

import { watchForTheEnd } from "./end.js";
import { keepKeysFromScrolling } from "./keys.js";
import { checkPixelSize } from "./pixel_size.js";
import { checkBrowser } from "./requirements.js";
import { services } from "./services.js";
import { inWords } from "./trouble.js";

/**
 * @typedef {object} Ears what the document hears of the interface
 * @property {(fragment: string) => void} link gets the part after `#` of a link to what is shown
 * @property {(message: string, detail: string | null) => void} end gets why it cannot go on
 */

/**
 * Starts the interface on a canvas; the module is compiled once for all canvases of a document.
 *
 * @param {HTMLCanvasElement} canvas in the document, with a size
 * @param {WebAssembly.Module} module
 * @param {string} fragment of a link to what is to be shown
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
