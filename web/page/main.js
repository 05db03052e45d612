// The page: fetches the module, starts it on the canvas, and provides services that only a page
// has.

import init, { Page } from "carom-web";

import { address, onAddressChange, showFragment } from "./address.js";
import { watchForTheEnd } from "./end.js";
import { fetchModule } from "./fetch_module.js";
import { keepKeysFromScrolling } from "./keys.js";
import { offerMirror } from "./mirror.js";
import { loading } from "./loading.js";
import { keepForOffline } from "./offline.js";
import { checkPixelSize } from "./pixel_size.js";
import { checkBrowser } from "./requirements.js";
import { services } from "./services.js";
import { inWords } from "./trouble.js";

const canvas = /** @type {HTMLCanvasElement} */ (document.getElementById("carom"));

async function start() {
  await checkBrowser();
  await init({ module_or_path: await fetchModule(loading.show) });
  await checkPixelSize(canvas);
  keepKeysFromScrolling(canvas, document.body);
  const own = { ...services, showFragment, isEmbedded: () => false };
  const page = await Page.start(canvas, own, address());
  onAddressChange((fragment) => page.openFragment(fragment));
  watchForTheEnd(canvas, loading.fail);
  // For scripts and for experiments: `carom.status()` in the console.
  Object.assign(globalThis, { carom: page });
  offerMirror(page);
  canvas.focus({ preventScroll: true });
  loading.finish();
  // Last, because its downloads would delay the interface.
  keepForOffline();
}

start().catch((error) => {
  console.error(error);
  loading.fail(...inWords(error));
});
