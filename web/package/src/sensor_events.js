// Converts entries into triggers and exits from the engine's rows of numbers.

import { rowsOf, vectorAt } from "./rows.js";

/** Positions of the values in a row. */
const AT = { time: 0, collider: 1, sphere: 2, enters: 3, point: 4, normal: 7, speed: 10 };
const COLUMNS = 11;

/** Returns the events of a table as objects. */
export function sensorEvents(table) {
  return rowsOf(table, COLUMNS).map((row) => ({
    time: row[AT.time],
    collider: row[AT.collider],
    sphere: row[AT.sphere],
    enters: row[AT.enters] === 1,
    point: vectorAt(row, AT.point),
    normal: vectorAt(row, AT.normal),
    speed: row[AT.speed],
  }));
}
