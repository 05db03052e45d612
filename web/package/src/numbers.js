// Reads numbers that calls take: vectors, rotations.

/** Returns the numbers of a vector. */
export function vector(name, values) {
  return vectors(name, values, 1);
}

/** Returns the numbers of vectors, `count` of them if it is given. */
export function vectors(name, values, count) {
  return rows(name, values, { width: 3, count });
}

/** Returns the numbers x, y, z, w of a rotation. */
export function quaternion(name, values) {
  return rows(name, values, { width: 4, count: 1 });
}

/** Returns the numbers of rows, `count` of them if it is given. */
function rows(name, values, { width, count }) {
  if (typeof values?.[Symbol.iterator] !== "function" || typeof values === "string") {
    throw new TypeError(`${name} must be numbers`);
  }
  const numbers = Float64Array.from(values);
  const wanted = width * (count ?? Math.ceil(numbers.length / width));
  if (numbers.length === wanted) return numbers;
  throw new TypeError(`${name} must be ${wanted} numbers, not ${numbers.length}`);
}
