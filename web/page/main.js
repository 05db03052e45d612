// The page: fetches the module, starts it on the canvas, and hands it what only a page can do.

import init, { Page } from "carom-web";

import { address, onAddressChange } from "./address.js";
import { watchForTheEnd } from "./end.js";
import { fetchModule } from "./fetch_module.js";
import { canDraw } from "./graphics.js";
import { keepKeysFromScrolling } from "./keys.js";
import { offerMirror } from "./mirror.js";
import { loading } from "./loading.js";
import { keepForOffline } from "./offline.js";
import { checkPixelSize } from "./pixel_size.js";
import { services } from "./services.js";
import { Trouble, inWords } from "./trouble.js";

const canvas = /** @type {HTMLCanvasElement} */ (document.getElementById("carom"));

async function start() {
  if (typeof WebAssembly !== "object") {
    throw new Trouble(
      "Carom needs WebAssembly, which this browser does not have or has switched off.",
    );
  }
  if (!(await canDraw())) {
    throw new Trouble(
      "Carom draws with WebGPU or WebGL 2, and this browser offers neither. " +
        "A newer browser, or hardware acceleration switched on in its settings, may help.",
    );
  }
  await init({ module_or_path: await fetchModule(loading.show) });
  await checkPixelSize(canvas);
  keepKeysFromScrolling(canvas);
  const page = await Page.start(canvas, services, address());
  onAddressChange((fragment) => page.openFragment(fragment));
  watchForTheEnd(canvas, loading.fail);
  // For scripts and the curious: `carom.status()` in the console.
  Object.assign(globalThis, { carom: page });
  offerMirror(page);
  canvas.focus({ preventScroll: true });
  loading.finish();
  // Last: what it fetches would hold the interface up.
  keepForOffline();
}

start().catch((error) => {
  console.error(error);
  loading.fail(...inWords(error));
});
