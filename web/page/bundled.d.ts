// What `bundle.js` puts into the scripts in place of these names.

/** Titles of the scenes that come with Carom, by their names: an object, as JSON. */
declare const TITLES: string;

/** The page's document, as it stands in `index.html`. */
declare const INDEX: string;

/** Names of the files that the document and its scripts ask for. */
declare const FILES: string[];
