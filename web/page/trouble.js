// What goes wrong, in words for people.

/** Its message is a sentence or two for people; `cause` may say more. */
export class Trouble extends Error {}

/**
 * What to tell people of an error: a sentence, and what only experts understand.
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
  // The module's own words, which are for people.
  return [error instanceof Error ? error.message : String(error), null];
}

/** @type {string[]} */
const noted = [];

/**
 * Notes what went wrong after it was said to be done, for the interface to tell.
 *
 * @param {string} text for people
 */
export function noteTrouble(text) {
  noted.push(text);
}

/** What was noted first, and is not taken yet. */
export function takeTrouble() {
  return noted.shift() ?? null;
}
