// A film encoded frame by frame with WebCodecs: every frame at its exact time.

import { Trouble } from "../trouble.js";

/** @import { Format, Frame, Maker } from "./film.js" */

/**
 * Compressions from the most widely played on; what is H.264 becomes an MP4, the others WebM.
 *
 * @type {["avc", "vp9", "vp8"]}
 */
const CODECS = ["avc", "vp9", "vp8"];

/** @implements {Maker} */
export class Encoded {
  #format;
  #output;

  /** @param {Format} format */
  constructor(format) {
    this.#format = format;
    this.#output = begin(format);
    // What went wrong is told to whoever adds the first frame.
    this.#output.catch(() => {});
  }

  /** @param {Frame} frame */
  async add({ pixels, time }) {
    const { source, VideoSample } = await this.#output;
    const { rowBytes, width, height, framesPerSecond } = this.#format;
    const sample = new VideoSample(pixels, {
      // Opacity does not count: what is behind a film?
      format: "RGBX",
      codedWidth: width,
      codedHeight: height,
      layout: [{ offset: 0, stride: rowBytes }],
      timestamp: time,
      duration: 1 / framesPerSecond,
    });
    // Waits while the encoder has enough to do.
    await source.add(sample);
    sample.close();
  }

  async finish() {
    const { output, target, extension, type } = await this.#output;
    await output.finalize();
    if (target.buffer === null) {
      throw new Trouble("It holds no frames.");
    }
    return { content: new Blob([target.buffer], { type }), extension };
  }
}

/** @param {Format} format */
async function begin({ width, height, framesPerSecond }) {
  // Only films need it: it is fetched with the first.
  const media = await import("mediabunny");
  const quality = new media.Quality("high");
  const codec = await media.getFirstEncodableVideoCodec(CODECS, { width, height, quality });
  if (codec === null) {
    throw new Trouble(`This browser has no encoder for ${width} by ${height} pixels.`);
  }
  const isMp4 = codec === "avc";
  const target = new media.BufferTarget();
  const format = isMp4
    ? new media.Mp4OutputFormat({ fastStart: "in-memory" })
    : new media.WebMOutputFormat();
  const output = new media.Output({ format, target });
  const source = new media.VideoSampleSource({ codec, quality });
  output.addVideoTrack(source, { frameRate: framesPerSecond });
  await output.start();
  return {
    output,
    source,
    target,
    VideoSample: media.VideoSample,
    extension: isMp4 ? "mp4" : "webm",
    type: isMp4 ? "video/mp4" : "video/webm",
  };
}
