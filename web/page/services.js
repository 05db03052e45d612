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
  maxSpheres,
  save,
  openFile,
  beginFilm,
  tilt,
  offersTilt,
  useTilt,
  trouble: takeTrouble,
};

/**
 * How many spheres the run of a link may have, as the document says, if it does: `<meta
 * name="carom-max-spheres" content="500000">`.
 *
 * @returns {number | null}
 */
function maxSpheres() {
  const meta = document.querySelector("meta[name='carom-max-spheres']");
  const most = Number(meta?.getAttribute("content") ?? NaN);
  return Number.isInteger(most) && most > 0 ? most : null;
}
