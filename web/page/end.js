// Detects when the interface cannot continue.

/**
 * Calls `tell` when the module has stopped or the browser has taken the graphics away.
 *
 * @param {HTMLCanvasElement} canvas
 * @param {(message: string, detail: string | null) => void} tell
 */
export function watchForTheEnd(canvas, tell) {
  const ended = (/** @type {unknown} */ error) => {
    // Only a trap of the module ends it; other errors are those of the page, which continues.
    if (error instanceof WebAssembly.RuntimeError) {
      tell(
        "Carom has stopped because of an error of its own. What was not saved is lost.",
        error.message,
      );
    }
  };
  addEventListener("error", (event) => ended(event.error));
  addEventListener("unhandledrejection", (event) => ended(event.reason));
  canvas.addEventListener("webglcontextlost", () => {
    tell("The browser has taken the graphics away. What was not saved is lost.", null);
  });
}
