// Downloads of files.

/** How long a browser may take to start a download [ms]. */
const PATIENCE = 60_000;

/**
 * Saves a file as a download of the browser.
 *
 * @param {string} name
 * @param {string} type media type
 * @param {Uint8Array | Blob} content
 */
export function save(name, type, content) {
  // The type allows shared memory, but the module's memory is not shared.
  const part = /** @type {BlobPart} */ (content);
  const url = URL.createObjectURL(new Blob([part], { type }));
  const link = document.createElement("a");
  link.href = url;
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(url), PATIENCE);
}
