// Films of what is shown: frames in, a download out.

import { save } from "../download.js";
import { Trouble, inWords } from "../trouble.js";
import { Encoded } from "./encoded.js";
import { Recorded } from "./recorded.js";

/** Frames that wait take no more memory than this [bytes]; browsers end pages at about 2 GB. */
const ROOM = 768e6;

/** From here on, more frames should wait where they come from [bytes]. */
const COMFORT = 128e6;

/**
 * @typedef {object} Frame
 * @property {Uint8Array<ArrayBuffer>} pixels rows of RGBA, as wide as the film was begun
 * @property {number} time since the first frame [s]
 *
 * @typedef {object} Maker makes a file of frames
 * @property {(frame: Frame) => Promise<void>} add takes a frame; done when the next may come
 * @property {() => Promise<{ content: Blob, extension: string }>} finish
 *
 * @typedef {object} Format of the frames that are added, and of the film
 * @property {number} rowBytes
 * @property {number} width even [pixels]
 * @property {number} height even [pixels]
 * @property {number} framesPerSecond
 */

/**
 * Begins a film; see `Host` in `interface.d.ts`.
 *
 * @param {number} width
 * @param {number} height
 * @param {number} framesPerSecond
 * @returns {import("../interface").Film}
 */
export function beginFilm(width, height, framesPerSecond) {
  // Films store colours at half the resolution, and so are of even size: an odd row is left out.
  const format = { rowBytes: width * 4, width: width & ~1, height: height & ~1, framesPerSecond };
  if (format.width === 0 || format.height === 0) {
    throw new Trouble(`A film of ${width} by ${height} pixels cannot be made.`);
  }
  return new Film(width * height * 4, makerOf(format));
}

/**
 * @param {Format} format
 * @returns {Maker}
 */
function makerOf(format) {
  if ("VideoEncoder" in globalThis) {
    return new Encoded(format);
  }
  if ("MediaRecorder" in globalThis && "captureStream" in HTMLCanvasElement.prototype) {
    return new Recorded(format);
  }
  throw new Trouble("This browser cannot make films: it has neither WebCodecs nor MediaRecorder.");
}

/** Lets frames wait until their maker has time for them. */
class Film {
  waiting = 0;
  /** @type {string | null} */
  saved = null;
  /** @type {string | null} */
  error = null;

  #frameBytes;
  #maker;
  /** What is being done, one thing after another. */
  #work = Promise.resolve();
  #isBroken = false;
  /** Time of the first frame [s]. */
  #start = NaN;

  /**
   * @param {number} frameBytes
   * @param {Maker} maker
   */
  constructor(frameBytes, maker) {
    this.#frameBytes = frameBytes;
    this.#maker = maker;
  }

  get busy() {
    return (this.waiting + 1) * this.#frameBytes > COMFORT;
  }

  /**
   * @param {Uint8Array} pixels
   * @param {number} seconds
   */
  add(pixels, seconds) {
    if (pixels.byteLength !== this.#frameBytes) {
      throw new RangeError(`a frame of ${pixels.byteLength} bytes, not ${this.#frameBytes}`);
    }
    if (this.error !== null) {
      return;
    }
    if ((this.waiting + 1) * this.#frameBytes > ROOM) {
      this.error = "The film ends early: this browser encodes more slowly than it draws.";
      return;
    }
    if (Number.isNaN(this.#start)) {
      this.#start = seconds;
    }
    const frame = { pixels: pixels.slice(), time: seconds - this.#start };
    this.waiting += 1;
    this.#next(async () => {
      await this.#maker.add(frame);
      this.waiting -= 1;
    });
  }

  /** @param {string} name */
  finish(name) {
    this.#next(async () => {
      const { content, extension } = await this.#maker.finish();
      const file = `${name.replace(/\.[^.]*$/, "")}.${extension}`;
      save(file, content.type, content);
      this.saved = file;
    });
  }

  /** @param {() => Promise<void>} step */
  #next(step) {
    this.#work = this.#work.then(async () => {
      if (this.#isBroken) {
        return;
      }
      try {
        await step();
      } catch (error) {
        this.#isBroken = true;
        this.waiting = 0;
        this.error = `The film cannot be made: ${inWords(error).filter(Boolean).join(" ")}`;
      }
    });
  }
}
