// The title of the document, which tabs, bookmarks and the browser's history show.

/** @type {Map<string, string>} */
const titles = new Map(Object.entries(JSON.parse(TITLES)));

/**
 * Returns the title of a run from the part of the page's address behind `#`.
 *
 * @param {string} fragment
 */
export function titleOf(fragment) {
  const fields = new URLSearchParams(fragment);
  const scene = fields.get("scene");
  // A scene's own title is inside its file, which a link holds only in compressed form.
  const run = scene === null ? fields.get("name") : (titles.get(scene) ?? scene);
  return run ? `${run} - Carom` : "Carom";
}
