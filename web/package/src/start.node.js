// Reads the engine from the disk.
import { readFileSync } from "node:fs";

import { initSync } from "../engine/carom.js";

initSync({ module: readFileSync(new URL("../engine/carom_bg.wasm", import.meta.url)) });
