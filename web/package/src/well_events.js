// Converts events of pairs of spheres at the edges of wells from the engine's rows of numbers.

import { rowsOf, vectorAt } from "./rows.js";

/** Positions of the values in a row. */
const AT = { time: 0, first: 1, second: 2, kind: 3, normal: 4, distance: 7, impulse: 8 };
const COLUMNS = 9;
const KINDS = ["capture", "dissociation", "bounce"];

/** Returns the events of a table as objects. */
export function wellEvents(table) {
  return rowsOf(table, COLUMNS).map((row) => ({
    time: row[AT.time],
    spheres: [row[AT.first], row[AT.second]],
    kind: KINDS[row[AT.kind]],
    normal: vectorAt(row, AT.normal),
    distance: row[AT.distance],
    impulse: row[AT.impulse],
  }));
}
