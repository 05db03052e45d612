// Values that `bundle.js` inserts into the scripts for these names.

/** Titles of the built-in scenes by their names: an object, as JSON. */
declare const TITLES: string;

/** The page's document `index.html`. */
declare const INDEX: string;

/** Names of the files that the document and its scripts fetch. */
declare const FILES: string[];
