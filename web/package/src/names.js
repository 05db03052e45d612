// Converts names: snake_case in scene files, camelCase in JavaScript.

/** Names that scene files write with a hyphen. */
const HYPHENATED = new Map([
  ["closePacking", "close-packing"],
  ["staggeredRows", "staggered-rows"],
  ["denseFluid", "dense-fluid"],
  ["viscousDrag", "viscous-drag"],
  ["pointAttractor", "point-attractor"],
  ["mutualGravity", "mutual-gravity"],
  ["quadraticDrag", "quadratic-drag"],
  ["powerLaw", "power-law"],
  ["whiteNoise", "white-noise"],
  ["squareWell", "square-well"],
]);
const UNHYPHENATED = new Map([...HYPHENATED].map(([camel, kebab]) => [kebab, camel]));

/** Returns a name such as `angularVelocity` in the spelling of scene files. */
export function snake(name) {
  return HYPHENATED.get(name) ?? name.replace(/[A-Z]/g, (letter) => `_${letter.toLowerCase()}`);
}

/** Returns a name such as `angular_velocity` in the spelling of JavaScript. */
export function camel(name) {
  return (
    UNHYPHENATED.get(name) ?? name.replace(/_([a-z0-9])/g, (_, letter) => letter.toUpperCase())
  );
}

/** Returns a text with every `word_with_underscores` in the spelling of JavaScript. */
export function camelWords(text) {
  return text.replace(
    /\b[a-z]+(?:_[a-z0-9]+)+\b|\b(?:close-packing|staggered-rows|dense-fluid|viscous-drag|point-attractor|mutual-gravity|quadratic-drag|power-law|white-noise|square-well)\b/g,
    camel,
  );
}

/** Parses JSON of the engine, with names in the spelling of JavaScript. */
export function parse(json) {
  // JSON has no infinity: the engine writes null for it, and for nothing else.
  return JSON.parse(json, (_, value) => (value === null ? Infinity : respelled(value)));
}

function respelled(value) {
  if (typeof value !== "object" || Array.isArray(value)) return value;
  return Object.fromEntries(Object.entries(value).map(([name, it]) => [camel(name), it]));
}
