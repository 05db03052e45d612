import * as engine from "./engine.js";
import { attempt } from "./errors.js";
import { parse } from "./names.js";

/** Returns the list of built-in scenes. */
export function scenes() {
  return parse(attempt(() => engine.scenes()));
}
