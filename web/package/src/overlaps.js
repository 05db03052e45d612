// Converts overlaps from the engine's rows of numbers.

import { between } from "./bodies.js";
import { rowsOf } from "./rows.js";

const COLUMNS = 4;

/** Returns the overlaps of a table as objects. */
export function overlaps(table) {
  return rowsOf(table, COLUMNS).map(([isCollider, first, second, depth]) => ({
    between: between(isCollider, first, second),
    depth,
  }));
}
