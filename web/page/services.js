// Services of the page for the module: `Services` in carom-web.

import { save } from "./download.js";
import { beginFilm } from "./film/film.js";
import { openFile } from "./open_file.js";
import { offersTilt, tilt, useTilt } from "./tilt.js";
import { takeTrouble } from "./trouble.js";

/**
 * All services that do not depend on where the canvas is.
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
 * Returns the largest number of spheres in the run of a link, if the document sets it: `<meta
 * name="carom-max-spheres" content="500000">`.
 *
 * @returns {number | null}
 */
function maxSpheres() {
  const meta = document.querySelector("meta[name='carom-max-spheres']");
  const most = Number(meta?.getAttribute("content") ?? NaN);
  return Number.isInteger(most) && most > 0 ? most : null;
}
