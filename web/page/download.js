// Files for downloading.

/** How long a browser may take to begin with a download [ms]. */
const PATIENCE = 60_000;

/**
 * Saves a file as the browser saves downloads.
 *
 * @param {string} name
 * @param {string} type media type
 * @param {Uint8Array | Blob} content
 */
export function save(name, type, content) {
  // Copied: the module's memory is not shared, whatever its type allows.
  const part = /** @type {BlobPart} */ (content);
  const url = URL.createObjectURL(new Blob([part], { type }));
  const link = document.createElement("a");
  link.href = url;
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(url), PATIENCE);
}
