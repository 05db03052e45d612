// The command `carom`, for results outside of browsers.

import { execFile, execFileSync } from "node:child_process";
import { promisify } from "node:util";

/** The program that `cargo xtask web --test` has built, or the one on the path. */
const COMMAND = process.env.CAROM ?? "carom";

/**
 * @param {string[]} args
 * @returns {string} its output
 */
export function carom(...args) {
  return execFileSync(COMMAND, args, { encoding: "utf8" });
}

/**
 * Runs a scene or link while the browser works.
 *
 * @param {string[]} args
 * @returns {Promise<string>} the hash of the state at the end
 */
export async function stateHash(...args) {
  const { stdout } = await promisify(execFile)(COMMAND, ["run", ...args, "--json"]);
  return JSON.parse(stdout).state_hash;
}
