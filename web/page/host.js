// What the module asks of the page. `interface.d.ts` says it in types.

import { show } from "./address.js";
import { copy } from "./clipboard.js";
import { save } from "./download.js";
import { beginFilm } from "./film/film.js";
import { askForTilt, tilt } from "./tilt.js";

/** @type {import("./interface").Host} */
export const host = { save, tilt, askForTilt, showFragment: show, copy, beginFilm };
