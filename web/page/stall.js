// Detects a download that stops without an end, as on a train in a tunnel.

import { Trouble } from "./trouble.js";

/**
 * Longest time without data [ms]: slow networks pause for seconds, but users do not wait longer for
 * a bar that stands still.
 */
const PATIENCE = 20_000;

/** Detects when a download stalls. */
export class Stall {
  #abort = new AbortController();
  /** @type {ReturnType<typeof setTimeout> | undefined} */
  #timer;
  #fail = (/** @type {Trouble} */ _) => {};

  /** Starts to wait for data. */
  constructor() {
    /**
     * Rejects when the download stalls; never resolves.
     *
     * @type {Promise<never>}
     */
    this.failure = new Promise((_, reject) => (this.#fail = reject));
    this.signOfLife();
  }

  /** Returns a signal that ends a stalled download: later data would look like progress. */
  get signal() {
    return this.#abort.signal;
  }

  /** Reports that data has arrived. */
  signOfLife() {
    this.end();
    this.#timer = setTimeout(() => {
      const seconds = PATIENCE / 1000;
      this.#fail(
        new Trouble(
          `Carom has stopped arriving: nothing came for ${seconds} seconds. Is the network there?`,
        ),
      );
      this.#abort.abort();
    }, PATIENCE);
  }

  /** Stops waiting: the download is complete or has failed. */
  end() {
    clearTimeout(this.#timer);
  }
}
