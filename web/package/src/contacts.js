// Converts persistent contacts from the engine's rows of numbers.

import { between } from "./bodies.js";

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
  return Array.from({ length: table.length / COLUMNS }, (_, i) =>
    contact(table.subarray(i * COLUMNS, (i + 1) * COLUMNS)),
  );
}

function contact(row) {
  const vector = (start) => Array.from(row.subarray(start, start + 3));
  return {
    between: between(row[AT.isCollider], row[AT.first], row[AT.second]),
    point: vector(AT.point),
    normal: vector(AT.normal),
    gap: row[AT.gap],
    normalForce: row[AT.normalForce],
    tangentialForce: vector(AT.tangentialForce),
    isSliding: row[AT.isSliding] === 1,
  };
}
