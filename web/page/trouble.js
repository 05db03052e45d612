// Errors with messages for the user.

/** An error whose message is a sentence or two for the user; `cause` may say more. */
export class Trouble extends Error {}

/**
 * Returns the texts for an error: a message for the user, and a detail for experts.
 *
 * @param {unknown} error
 * @returns {[message: string, detail: string | null]}
 */
export function inWords(error) {
  if (error instanceof Trouble) {
    const { cause } = error;
    return [error.message, cause === undefined ? null : String(cause)];
  }
  if (error instanceof WebAssembly.CompileError || error instanceof WebAssembly.LinkError) {
    return ["This browser cannot run Carom's module; a newer one may.", error.message];
  }
  // The module's own messages are for the user.
  return [error instanceof Error ? error.message : String(error), null];
}

/** @type {string[]} */
const noted = [];

/**
 * Notes an error of an action that was reported as done; the interface shows it.
 *
 * @param {string} text for the user
 */
export function noteTrouble(text) {
  noted.push(text);
}

/** Removes and returns the oldest note. */
export function takeTrouble() {
  return noted.shift() ?? null;
}
