// Arrays of the engine, looked at where they lie in its memory.

import { engineMemory } from "./engine.js";

/**
 * The views of one world. A view is made anew only where the array has moved, has another length, or
 * where the memory has grown, which takes all views of it away.
 */
export class Views {
  #views = new Map();
  #repeated = new Map();

  /** The view of this name: `length` numbers of a `Type` of array from `place` on. */
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
   * An array of this name that the engine has not made: the same numbers for each of `count` spheres.
   * It lies outside of the memory of the engine, which so need not grow when it is read.
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
