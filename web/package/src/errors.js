// What goes wrong, as JavaScript throws it.

import { Failure } from "./engine.js";
import { camelWords } from "./names.js";

/** Something that the engine refused. What it was refused for is as it was before. */
export class CaromError extends Error {
  name = "CaromError";
}

/** A scene, or a description of a part of one, that makes no sense. */
export class SceneError extends CaromError {
  name = "SceneError";

  /** @param {{ field?: string, line?: number }} place where it is wrong */
  constructor(message, { field = "", line } = {}) {
    super(message);
    this.field = field;
    this.line = line;
  }
}

/** Calls the engine. What it refuses becomes an error with its message. */
export function attempt(call) {
  try {
    return call();
  } catch (thrown) {
    throw thrown instanceof Failure ? error(thrown, (text) => text) : thrown;
  }
}

/** An error about something described in JavaScript: the message spells names as it does. */
export function attemptPart(call) {
  try {
    return call();
  } catch (thrown) {
    throw thrown instanceof Failure ? error(thrown, camelWords) : thrown;
  }
}

function error(failure, spelled) {
  const { message, isInScene, field, line } = failure;
  failure.free();
  return isInScene
    ? new SceneError(spelled(message), { field: spelled(field), line })
    : new CaromError(message);
}
