// What the page does for the module, which cannot do it by itself: `Services` in carom-web.

import { showFragment } from "./address.js";
import { save } from "./download.js";
import { beginFilm } from "./film/film.js";
import { openFile } from "./open_file.js";
import { offersTilt, tilt, useTilt } from "./tilt.js";
import { takeTrouble } from "./trouble.js";

/** @type {import("carom-web").Services} */
export const services = {
  save,
  openFile,
  beginFilm,
  tilt,
  offersTilt,
  useTilt,
  showFragment,
  trouble: takeTrouble,
};
