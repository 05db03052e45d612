// What the page does for the module, which cannot do it by itself: `Services` in carom-web.

import { save } from "./download.js";
import { beginFilm } from "./film/film.js";
import { openFile } from "./open_file.js";
import { offersTilt, tilt, useTilt } from "./tilt.js";
import { takeTrouble } from "./trouble.js";

/**
 * All but what depends on where the canvas is.
 *
 * @type {Omit<import("carom-web").Services, "showFragment" | "isEmbedded">}
 */
export const services = {
  save,
  openFile,
  beginFilm,
  tilt,
  offersTilt,
  useTilt,
  trouble: takeTrouble,
};
