// Text for other programs.

/**
 * Puts text on the clipboard.
 *
 * @param {string} text
 */
export function copy(text) {
  // Browsers lend the clipboard only to pages that came encrypted or from this machine.
  const written = navigator.clipboard?.writeText(text) ?? Promise.reject(new Error("no clipboard"));
  written.catch((error) => console.warn(`The browser does not copy: ${error.message}`));
}
