// What programs hold of the engine.

import { CaromError } from "./errors.js";

/** The key of the engine's object in a handle. */
export const ENGINE = Symbol("engine");

/** An object of the engine, until it is freed. */
export class Handle {
  /** Empty after `free`. */
  #engine;
  #kind;

  /** @param {string} kind what errors call it */
  constructor(engine, kind) {
    this.#engine = engine;
    this.#kind = kind;
  }

  get [ENGINE]() {
    if (this.#engine !== undefined) return this.#engine;
    throw new CaromError(`this ${this.#kind} has been freed`);
  }

  free() {
    this.#engine?.free();
    this.#engine = undefined;
  }
}

// `using world = ...`, if the language supports it.
if (Symbol.dispose) Handle.prototype[Symbol.dispose] = Handle.prototype.free;
