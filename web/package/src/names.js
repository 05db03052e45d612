// How names are spelled: snake_case in scene files, camelCase in JavaScript.

/** Of all names with two words, scene files write these with a hyphen. */
const HYPHENATED = new Map([
  ["closePacking", "close-packing"],
  ["staggeredRows", "staggered-rows"],
  ["viscousDrag", "viscous-drag"],
  ["pointAttractor", "point-attractor"],
  ["mutualGravity", "mutual-gravity"],
  ["quadraticDrag", "quadratic-drag"],
]);
const UNHYPHENATED = new Map([...HYPHENATED].map(([camel, kebab]) => [kebab, camel]));

/** `angularVelocity` as scene files spell it. */
export function snake(name) {
  return HYPHENATED.get(name) ?? name.replace(/[A-Z]/g, (letter) => `_${letter.toLowerCase()}`);
}

/** `angular_velocity` as JavaScript spells it. */
export function camel(name) {
  return (
    UNHYPHENATED.get(name) ?? name.replace(/_([a-z0-9])/g, (_, letter) => letter.toUpperCase())
  );
}

/** A text in which every `word_with_underscores` is spelled as JavaScript does. */
export function camelWords(text) {
  return text.replace(
    /\b[a-z]+(?:_[a-z0-9]+)+\b|\b(?:close-packing|staggered-rows|viscous-drag|point-attractor|mutual-gravity|quadratic-drag)\b/g,
    camel,
  );
}

/** What the engine tells as JSON, with JavaScript's spelling of names. */
export function parse(json) {
  // JSON has no infinity: it writes null for one, and for nothing else.
  return JSON.parse(json, (_, value) => (value === null ? Infinity : respelled(value)));
}

function respelled(value) {
  if (typeof value !== "object" || Array.isArray(value)) return value;
  return Object.fromEntries(Object.entries(value).map(([name, it]) => [camel(name), it]));
}
