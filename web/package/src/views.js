// Views of arrays in the engine's memory.

import { engineMemory } from "./engine.js";

/**
 * The views of one world. A view is made again only if its array has moved or has another length,
 * or if the memory has grown, which invalidates all views.
 */
export class Views {
  #views = new Map();
  #repeated = new Map();

  /**
   * Returns the view of this name: `length` numbers of the array type `Type` at the address
   * `place`.
   */
  at(name, Type, place, length) {
    const { buffer } = engineMemory();
    let view = this.#views.get(name);
    if (view?.buffer !== buffer || view.byteOffset !== place || view.length !== length) {
      view = new Type(buffer, place, length);
      this.#views.set(name, view);
    }
    return view;
  }
  /**
   * Returns an array of this name that the engine does not store: the same numbers for each of
   * `count` spheres. It is outside the engine's memory, which therefore need not grow.
   */
  repeated(name, numbers, count) {
    const length = numbers.length * count;
    let array = this.#repeated.get(name);
    if (array?.length !== length) {
      array = Float64Array.from({ length }, (_, i) => numbers[i % numbers.length]);
      this.#repeated.set(name, array);
    }
    return array;
  }
}
