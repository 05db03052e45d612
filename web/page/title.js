// The title of the document: tabs, bookmarks and the browser's history bear it.

/** @type {Map<string, string>} */
const titles = new Map(Object.entries(JSON.parse(TITLES)));

/**
 * What a run is called, by the part of the page's address behind `#`.
 *
 * @param {string} fragment
 */
export function titleOf(fragment) {
  const fields = new URLSearchParams(fragment);
  const scene = fields.get("scene");
  // A scene's own title is inside of its file, which a link only holds packed.
  const run = scene === null ? fields.get("name") : (titles.get(scene) ?? scene);
  return run ? `${run} - Carom` : "Carom";
}
