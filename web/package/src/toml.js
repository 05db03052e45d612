// From JavaScript's values to TOML, the language of scene files.

import { snake } from "./names.js";

/** The largest whole number up to which JavaScript counts without gaps, as TOML's integers do. */
const LARGEST_INTEGER = Number.MAX_SAFE_INTEGER;

/**
 * A value as TOML writes it behind an equals sign. Whatever can be iterated is an array: lists,
 * typed arrays, the vectors and quaternions of three.js. Fields that are `undefined` or `null` are
 * left out.
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

/** The tables of a scene file, from an object that has them as its fields. */
export function tables(object) {
  return fields(object).join("\n");
}

/** A changed value of a scene, as `carom run --set` takes it: `path=value`. */
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
  // Whole numbers beyond those must not be taken for integers, which TOML bounds at 2^63.
  return Math.abs(value) > LARGEST_INTEGER ? value.toExponential() : String(value);
}
