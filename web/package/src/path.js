// The path of a sphere as the engine predicts it.

import { impacts } from "./impacts.js";
import { rowsOf, vectorAt } from "./rows.js";

/** Positions of the values in a row of the table of legs. */
const AT = {
  start: 0,
  end: 1,
  flightStart: 2,
  position: 3,
  velocity: 6,
  acceleration: 9,
  dragRate: 12,
};
const COLUMNS = 13;

export class PredictedPath {
  /** The path of the engine, which garbage collection frees. */
  #path;

  constructor(path) {
    this.#path = path;
  }

  get impacts() {
    return impacts(this.#path.impacts);
  }

  get legs() {
    return rowsOf(this.#path.legs, COLUMNS).map((row) => ({
      start: row[AT.start],
      end: row[AT.end],
      flightStart: row[AT.flightStart],
      position: vectorAt(row, AT.position),
      velocity: vectorAt(row, AT.velocity),
      acceleration: vectorAt(row, AT.acceleration),
      dragRate: row[AT.dragRate],
    }));
  }

  get end() {
    return this.#path.end;
  }

  get endTime() {
    return this.#path.endTime;
  }

  positionAt(time) {
    return vector(this.#path.positionAt(time));
  }

  velocityAt(time) {
    return vector(this.#path.velocityAt(time));
  }
}

function vector(numbers) {
  return numbers === undefined ? undefined : Array.from(numbers);
}
