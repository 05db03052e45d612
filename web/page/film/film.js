// Films of the view: frames go in, and a download comes out.

import { save } from "../download.js";
import { Trouble, inWords, noteTrouble } from "../trouble.js";
import { Encoded } from "./encoded.js";
import { Recorded } from "./recorded.js";

/** Largest memory for waiting frames [bytes]; browsers end pages at about 2 GB. */
const ROOM = 768e6;

/**
 * @typedef {object} Frame
 * @property {Uint8Array<ArrayBuffer>} pixels rows of RGBA, of the film's original width
 * @property {number} number from 0
 *
 * @typedef {object} Maker makes a file from frames
 * @property {string | null} extension of the file's name; null while unknown
 * @property {(frame: Frame) => Promise<void>} add takes a frame; resolves when the next may come
 * @property {() => Promise<Blob>} finish
 *
 * @typedef {object} Format of the added frames, and of the film
 * @property {number} rowBytes
 * @property {number} width even [pixels]
 * @property {number} height even [pixels]
 * @property {number} framesPerSecond
 */

/**
 * Starts a film of pictures of this size in pixels. Throws an error with a message for the user if
 * this browser cannot make films.
 *
 * @param {number} width
 * @param {number} height
 * @param {number} framesPerSecond
 */
export function beginFilm(width, height, framesPerSecond) {
  // Films store colours at half the resolution, so their size is even: an odd row is cut off.
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

/** Queues frames until their maker is ready for them. */
class Film {
  #frameBytes;
  #maker;
  /** Number of waiting frames. */
  #waiting = 0;
  /** The present work; tasks run one after another. */
  #work = Promise.resolve();
  /**
   * The reason why the film cannot be made.
   *
   * @type {string | null}
   */
  #failure = null;

  /**
   * @param {number} frameBytes
   * @param {Maker} maker
   */
  constructor(frameBytes, maker) {
    this.#frameBytes = frameBytes;
    this.#maker = maker;
  }

  /**
   * Adds a frame, a copy of these rows of RGBA from the top. Throws an error with a message for the
   * user if it cannot be added. If frames only came too fast, the film can still be finished.
   *
   * @param {Uint8Array} pixels
   * @param {number} number from 0
   */
  add(pixels, number) {
    this.#check();
    if (pixels.byteLength !== this.#frameBytes) {
      throw new RangeError(`a frame of ${pixels.byteLength} bytes, not ${this.#frameBytes}`);
    }
    if ((this.#waiting + 1) * this.#frameBytes > ROOM) {
      throw new Trouble("The film ends early: this browser encodes more slowly than it draws.");
    }
    const frame = { pixels: pixels.slice(), number };
    this.#waiting += 1;
    this.#next(async () => {
      await this.#maker.add(frame);
      this.#waiting -= 1;
    });
  }

  /**
   * Encodes the waiting frames, then saves the film. Throws an error with a message for the user if
   * it cannot be made; a later error is noted.
   *
   * @param {string} name
   * @returns {string} the file's name
   */
  finish(name) {
    this.#check();
    const named = () => [name, this.#maker.extension].filter(Boolean).join(".");
    this.#next(async () => {
      const content = await this.#maker.finish();
      save(named(), content.type, content);
    });
    this.#work.then(() => this.#failure && noteTrouble(`${named()}: ${this.#failure}`));
    return named();
  }

  #check() {
    if (this.#failure !== null) {
      throw new Trouble(this.#failure);
    }
  }

  /** @param {() => Promise<void>} step */
  #next(step) {
    this.#work = this.#work.then(async () => {
      if (this.#failure !== null) {
        return;
      }
      try {
        await step();
      } catch (error) {
        this.#failure = `The film cannot be made: ${inWords(error).filter(Boolean).join(" ")}`;
      }
    });
  }
}
