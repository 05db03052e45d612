// Persistent contacts, from the rows of numbers that the engine makes of them.

import { between } from "./bodies.js";

/** Where what stands in a row. */
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

/** The contacts of a table, an object each. */
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
