// Fetches the engine. Bundlers know this form of a URL, and take the file along.
import init from "./engine.js";

await init({ module_or_path: new URL("./engine_bg.wasm", import.meta.url) });
