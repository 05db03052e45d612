// Converts persistent contacts from the engine's rows of numbers.

import { between } from "./bodies.js";
import { rowsOf, vectorAt } from "./rows.js";

/** Positions of the values in a row. */
const AT = {
  isCollider: 0,
  first: 1,
  second: 2,
  point: 3,
  normal: 6,
  gap: 9,
  normalForce: 10,
  tangentialForce: 11,
  isSliding: 14,
};
const COLUMNS = 15;

/** Returns the contacts of a table as objects. */
export function contacts(table) {
  return rowsOf(table, COLUMNS).map(contact);
}

function contact(row) {
  return {
    between: between(row[AT.isCollider], row[AT.first], row[AT.second]),
    point: vectorAt(row, AT.point),
    normal: vectorAt(row, AT.normal),
    gap: row[AT.gap],
    normalForce: row[AT.normalForce],
    tangentialForce: vectorAt(row, AT.tangentialForce),
    isSliding: row[AT.isSliding] === 1,
  };
}
