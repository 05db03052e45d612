// Fetches the engine. Bundlers know this form of a URL, and take the file along.
import init from "../engine/carom.js";

await init({ module_or_path: new URL("../engine/carom_bg.wasm", import.meta.url) });
