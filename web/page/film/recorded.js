// Films recorded in real time, for browsers that have only MediaRecorder.

import { Trouble } from "../trouble.js";

/** @import { Format, Frame, Maker } from "./film.js" */

/** Types, the most widely playable first. */
const TYPES = [
  "video/mp4;codecs=avc1",
  "video/webm;codecs=vp9",
  "video/webm;codecs=vp8",
  "video/webm",
];

/** Enough for spheres at 1280 by 720 without visible blocks [bits per second]. */
const BITS_PER_SECOND = 8e6;

/**
 * Shows each frame on a hidden canvas for its duration and records it. Between frames the recorder
 * pauses, so that late frames do not make the film longer.
 *
 * @implements {Maker}
 */
export class Recorded {
  extension;
  #format;
  #context;
  #track;
  #recorder;
  /** @type {Blob[]} */
  #pieces = [];
  /** How much longer the frames so far were recorded than due [ms]. */
  #excess = 0;

  /** @param {Format} format */
  constructor(format) {
    const mimeType = TYPES.find((type) => MediaRecorder.isTypeSupported(type));
    if (mimeType === undefined) {
      throw new Trouble("This browser cannot make films: it records neither MP4 nor WebM.");
    }
    this.extension = mimeType.startsWith("video/mp4") ? "mp4" : "webm";
    this.#format = format;
    const canvas = document.createElement("canvas");
    canvas.width = format.width;
    canvas.height = format.height;
    const context = canvas.getContext("2d", { alpha: false });
    this.#context = /** @type {CanvasRenderingContext2D} */ (context);
    // Only `requestFrame` captures frames.
    const stream = canvas.captureStream(0);
    this.#track = /** @type {CanvasCaptureMediaStreamTrack} */ (stream.getVideoTracks()[0]);
    this.#recorder = new MediaRecorder(stream, { mimeType, videoBitsPerSecond: BITS_PER_SECOND });
    this.#recorder.addEventListener("dataavailable", ({ data }) => this.#pieces.push(data));
  }

  /** @param {Frame} frame */
  async add({ pixels }) {
    const { rowBytes, height, framesPerSecond } = this.#format;
    const rows = new Uint8ClampedArray(pixels.buffer, 0, rowBytes * height);
    this.#context.putImageData(new ImageData(rows, rowBytes / 4), 0, 0);
    const due = 1000 / framesPerSecond;
    const began = performance.now();
    if (this.#recorder.state === "inactive") {
      this.#recorder.start();
    } else {
      this.#recorder.resume();
    }
    this.#track.requestFrame();
    // Timers of a busy browser are late, so the next frames are recorded for a shorter time. Half of
    // it is enough to record a frame.
    const time = Math.max(0.5 * due, due - this.#excess);
    await new Promise((resolve) => setTimeout(resolve, time));
    this.#recorder.pause();
    this.#excess += performance.now() - began - due;
  }

  async finish() {
    if (this.#recorder.state === "inactive") {
      throw new Trouble("It holds no frames.");
    }
    const stopped = new Promise((resolve) => this.#recorder.addEventListener("stop", resolve));
    this.#recorder.stop();
    await stopped;
    return new Blob(this.#pieces, { type: this.#recorder.mimeType });
  }
}
