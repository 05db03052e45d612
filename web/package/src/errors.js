// Errors that the package throws.

import { Failure } from "./engine.js";
import { camelWords } from "./names.js";

/** A call that the engine refused. The world is unchanged. */
export class CaromError extends Error {
  name = "CaromError";
}

/** An invalid scene or part of a scene. */
export class SceneError extends CaromError {
  name = "SceneError";

  /** @param {{ field?: string, line?: number }} place where the error is */
  constructor(message, { field = "", line } = {}) {
    super(message);
    this.field = field;
    this.line = line;
  }
}

/** Calls the engine and converts its failures into errors. */
export function attempt(call) {
  try {
    return call();
  } catch (thrown) {
    throw thrown instanceof Failure ? error(thrown, (text) => text) : thrown;
  }
}

/**
 * Calls the engine with something described in JavaScript; messages spell names as JavaScript does.
 */
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
