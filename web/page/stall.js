// A download that has come to a stop without an end, as on a train in a tunnel.

import { Trouble } from "./trouble.js";

/**
 * How long nothing may arrive [ms]: slow networks pause for seconds, and people who see no bar move
 * for longer leave.
 */
const PATIENCE = 20_000;

/** Notices when a download stalls. */
export class Stall {
  #abort = new AbortController();
  /** @type {ReturnType<typeof setTimeout> | undefined} */
  #timer;
  #fail = (/** @type {Trouble} */ _) => {};

  /** Begins to wait for a sign of life. */
  constructor() {
    /**
     * Fails when the download stalls, and does nothing else.
     *
     * @type {Promise<never>}
     */
    this.failure = new Promise((_, reject) => (this.#fail = reject));
    this.signOfLife();
  }

  /** Ends the download once it has stalled: what arrives after that would be shown as progress. */
  get signal() {
    return this.#abort.signal;
  }

  /** Something has arrived. */
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

  /** All has arrived, or nothing more will. */
  end() {
    clearTimeout(this.#timer);
  }
}
