// The command `carom`, which says what a run gives outside of browsers.

import { execFileSync } from "node:child_process";

/** What `cargo xtask web --test` has built; or the one on the path. */
const COMMAND = process.env.CAROM ?? "carom";

/**
 * @param {string[]} args
 * @returns {string} what it prints
 */
export function carom(...args) {
  return execFileSync(COMMAND, args, { encoding: "utf8" });
}

/**
 * Runs a scene or link.
 *
 * @param {string[]} args
 * @returns {string} the hash of the state at the end
 */
export function stateHash(...args) {
  return JSON.parse(carom("run", ...args, "--json")).state_hash;
}
