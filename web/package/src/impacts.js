// Converts impacts from the engine's rows of numbers.

import { between } from "./bodies.js";
import { rowsOf, vectorAt } from "./rows.js";

/** Positions of the values in a row of the table of impacts. */
export const IMPACT_COLUMNS = Object.freeze({
  time: 0,
  isCollider: 1,
  first: 2,
  second: 3,
  point: 4,
  normal: 7,
  approachSpeed: 10,
  separationSpeed: 11,
  impulse: 12,
  tangentialImpulse: 13,
  count: 16,
});

/** Returns the impacts of a table as objects. */
export function impacts(table) {
  return rowsOf(table, IMPACT_COLUMNS.count).map(impact);
}

function impact(row) {
  const at = IMPACT_COLUMNS;
  const [first, second] = [row[at.first], row[at.second]];
  return {
    time: row[at.time],
    between: between(row[at.isCollider], first, second),
    point: vectorAt(row, at.point),
    normal: vectorAt(row, at.normal),
    approachSpeed: row[at.approachSpeed],
    separationSpeed: row[at.separationSpeed],
    impulse: row[at.impulse],
    tangentialImpulse: vectorAt(row, at.tangentialImpulse),
  };
}
