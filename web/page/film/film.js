// Films of what is shown: frames in, a download out.

import { save } from "../download.js";
import { Trouble, inWords, noteTrouble } from "../trouble.js";
import { Encoded } from "./encoded.js";
import { Recorded } from "./recorded.js";

/** Frames that wait take no more memory than this [bytes]; browsers end pages at about 2 GB. */
const ROOM = 768e6;

/**
 * @typedef {object} Frame
 * @property {Uint8Array<ArrayBuffer>} pixels rows of RGBA, as wide as the film was begun
 * @property {number} number from 0 on
 *
 * @typedef {object} Maker makes a file of frames
 * @property {string | null} extension of the file's name; null while it is not known
 * @property {(frame: Frame) => Promise<void>} add takes a frame; done when the next may come
 * @property {() => Promise<Blob>} finish
 *
 * @typedef {object} Format of the frames that are added, and of the film
 * @property {number} rowBytes
 * @property {number} width even [pixels]
 * @property {number} height even [pixels]
 * @property {number} framesPerSecond
 */

/**
 * Begins a film of pictures of this size in pixels; throws an error in words for people if this
 * browser cannot make films.
 *
 * @param {number} width
 * @param {number} height
 * @param {number} framesPerSecond
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
  #frameBytes;
  #maker;
  /** Frames that wait. */
  #waiting = 0;
  /** What is being done, one thing after another. */
  #work = Promise.resolve();
  /**
   * Why it cannot be made.
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
   * Adds a frame, a copy of these rows of RGBA from above. Throws an error in words for people if
   * it cannot be added; the film can still be finished if frames only came too fast.
   *
   * @param {Uint8Array} pixels
   * @param {number} number from 0 on
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
   * Encodes the frames that wait, then saves the film. Throws an error in words for people if it
   * cannot be made; what goes wrong later is noted.
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
