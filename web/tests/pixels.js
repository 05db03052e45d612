// Pixels of PNG files, read by FFmpeg.

import { execFileSync } from "node:child_process";

/**
 * @typedef {object} Picture
 * @property {number} width
 * @property {number} height
 * @property {Buffer} rgb three bytes per pixel, rows from the top
 */

/**
 * @param {Buffer} png
 * @returns {Picture}
 */
export function read(png) {
  // Width and height are at the start of the first chunk, after signature and chunk header.
  const [width, height] = [png.readUInt32BE(16), png.readUInt32BE(20)];
  const args = [
    "-v",
    "error",
    "-f",
    "png_pipe",
    "-i",
    "-",
    "-f",
    "rawvideo",
    "-pix_fmt",
    "rgb24",
    "-",
  ];
  const rgb = execFileSync("ffmpeg", args, { input: png, maxBuffer: 1e9 });
  return { width, height, rgb };
}

/**
 * Returns the part of the pixels in a rectangle, given in parts of width and height, that differ by
 * more than noise between two pictures of one size.
 *
 * @param {Picture} a
 * @param {Picture} b
 * @param {{ left: number, top: number, right: number, bottom: number }} rectangle
 */
export function difference(a, b, { left, top, right, bottom }) {
  const { width, height } = a;
  let [different, all] = [0, 0];
  for (let y = Math.floor(top * height); y < bottom * height; y += 1) {
    for (let x = Math.floor(left * width); x < right * width; x += 1) {
      const i = 3 * (y * width + x);
      const way = [0, 1, 2].map((c) => Math.abs(a.rgb[i + c] - b.rgb[i + c]));
      different += Math.max(...way) > NOISE ? 1 : 0;
      all += 1;
    }
  }
  return different / all;
}

/** Largest difference of a colour by rounding between two drawings of the same picture. */
const NOISE = 8;
