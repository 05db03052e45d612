// Requirements of the browser, checked before it fetches megabytes.

import { canDraw } from "./graphics.js";
import { Trouble } from "./trouble.js";

/** Throws an error with a message for the user if the browser cannot run the module or draw. */
export async function checkBrowser() {
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
}
