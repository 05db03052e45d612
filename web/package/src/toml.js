// Converts JavaScript values to TOML, the language of scene files.

import { snake } from "./names.js";

/** The largest integer that JavaScript can represent without gaps, as TOML's integers are. */
const LARGEST_INTEGER = Number.MAX_SAFE_INTEGER;

/**
 * Returns a value as TOML writes it after an equals sign. Every iterable becomes an array: lists,
 * typed arrays, vectors and quaternions of three.js. Fields that are `undefined` or `null` are left
 * out.
 */
export function toml(value) {
  switch (typeof value) {
    case "string":
      return JSON.stringify(value);
    case "boolean":
    case "bigint":
      return String(value);
    case "number":
      return number(value);
    case "object":
      if (value === null) break;
      if (Symbol.iterator in value) return `[${Array.from(value, toml).join(", ")}]`;
      return `{ ${fields(value).join(", ")} }`;
  }
  throw new TypeError(`a scene cannot hold ${value === null ? "null" : typeof value}`);
}

/** Returns the tables of a scene file from an object with one field per table. */
export function tables(object) {
  return fields(object).join("\n");
}

/** Returns a changed value of a scene in the form of `carom run --set`: `path=value`. */
export function override([path, value]) {
  return `${path}=${value === null || value === undefined ? "none" : toml(value)}`;
}

function fields(object) {
  return Object.entries(object)
    .filter(([, value]) => value !== undefined && value !== null)
    .map(([name, value]) => `${key(snake(name))} = ${toml(value)}`);
}

function key(name) {
  return /^[\w-]+$/.test(name) ? name : JSON.stringify(name);
}

function number(value) {
  if (Number.isNaN(value)) return "nan";
  if (!Number.isFinite(value)) return value > 0 ? "inf" : "-inf";
  if (Object.is(value, -0)) return "-0.0";
  // Larger whole numbers must not become integers, which TOML limits to 2^63.
  return Math.abs(value) > LARGEST_INTEGER ? value.toExponential() : String(value);
}
