// Splits tables of the engine into rows, and rows into vectors.

/** Returns the rows of a table. */
export function rowsOf(table, columns) {
  return Array.from({ length: table.length / columns }, (_, i) =>
    table.subarray(i * columns, (i + 1) * columns),
  );
}

/** Returns the vector in a row from a column on. */
export function vectorAt(row, column) {
  return Array.from(row.subarray(column, column + 3));
}
