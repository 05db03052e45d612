// Films encoded frame by frame with WebCodecs, with exact times.

import { Trouble } from "../trouble.js";

/** @import { Format, Frame, Maker } from "./film.js" */

/**
 * Codecs, the most widely playable first. H.264 is written as MP4, the others as WebM.
 *
 * @type {["avc", "vp9", "vp8"]}
 */
const CODECS = ["avc", "vp9", "vp8"];

/** @implements {Maker} */
export class Encoded {
  /** @type {string | null} */
  extension = null;
  #format;
  #begun;

  /** @param {Format} format */
  constructor(format) {
    this.#format = format;
    this.#begun = this.#begin();
    // The next added frame reports the error.
    this.#begun.catch(() => {});
  }

  /** @param {Frame} frame */
  async add({ pixels, number }) {
    const { source, media } = await this.#begun;
    const { rowBytes, width, height, framesPerSecond } = this.#format;
    const sample = new media.VideoSample(pixels, {
      // Opacity is ignored: a film has nothing behind it.
      format: "RGBX",
      codedWidth: width,
      codedHeight: height,
      layout: [{ offset: 0, stride: rowBytes }],
      timestamp: number / framesPerSecond,
      duration: 1 / framesPerSecond,
    });
    // Waits while the encoder is busy.
    await source.add(sample);
    sample.close();
  }

  async finish() {
    const { output, target } = await this.#begun;
    await output.finalize();
    if (target.buffer === null) {
      throw new Trouble("It holds no frames.");
    }
    return new Blob([target.buffer], { type: `video/${this.extension}` });
  }

  async #begin() {
    const media = await import("./media.js");
    const { width, height, framesPerSecond } = this.#format;
    const quality = new media.Quality("high");
    const codec = await media.getFirstEncodableVideoCodec(CODECS, { width, height, quality });
    if (codec === null) {
      throw new Trouble(`This browser has no encoder for ${width} by ${height} pixels.`);
    }
    const isMp4 = codec === "avc";
    this.extension = isMp4 ? "mp4" : "webm";
    const target = new media.BufferTarget();
    const format = isMp4
      ? new media.Mp4OutputFormat({ fastStart: "in-memory" })
      : new media.WebMOutputFormat();
    const output = new media.Output({ format, target });
    const source = new media.VideoSampleSource({ codec, quality });
    output.addVideoTrack(source, { frameRate: framesPerSecond });
    await output.start();
    return { media, output, source, target };
  }
}
