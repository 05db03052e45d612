// PNG files as pixels, read by FFmpeg.

import { execFileSync } from "node:child_process";

/**
 * @typedef {object} Picture
 * @property {number} width
 * @property {number} height
 * @property {Buffer} rgb three bytes a pixel, rows from above
 */

/**
 * @param {Buffer} png
 * @returns {Picture}
 */
export function read(png) {
  // Width and height stand at the beginning of the first chunk, after signature and chunk header.
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
 * The part of the pixels in a rectangle, in parts of width and height, that differ between two
 * pictures of one size by more than noise.
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

/** What rounding in two drawings of the same may make of a colour. */
const NOISE = 8;
