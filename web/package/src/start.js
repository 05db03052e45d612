// Fetches the engine. Bundlers recognise this form of a URL and include the file.
import init from "./engine.js";

await init({ module_or_path: new URL("./engine_bg.wasm", import.meta.url) });
