// How many pixels the canvas has.

/**
 * Makes browsers tell the truth about pixels.
 *
 * Chromium counts the pixels of an element for itself, but as those of the screen it is on when it
 * feigns another, as its tools for developers do to show a page as on a telephone. Where the count
 * is wrong it is taken away; the interface then multiplies lengths with `devicePixelRatio`.
 *
 * @param {HTMLCanvasElement} canvas
 */
export async function checkPixelSize(canvas) {
  const { prototype } = ResizeObserverEntry;
  if (!("devicePixelContentBoxSize" in prototype)) {
    return;
  }
  const { contentBoxSize, devicePixelContentBoxSize } = await measured(canvas);
  const told = devicePixelContentBoxSize[0].inlineSize;
  const due = contentBoxSize[0].inlineSize * devicePixelRatio;
  // A whole pixel is what rounding may do at both edges.
  if (Math.abs(told - due) > 1) {
    Reflect.deleteProperty(prototype, "devicePixelContentBoxSize");
  }
}

/**
 * @param {Element} element
 * @returns {Promise<ResizeObserverEntry>}
 */
function measured(element) {
  return new Promise((resolve) => {
    const observer = new ResizeObserver(([entry]) => {
      observer.disconnect();
      resolve(entry);
    });
    observer.observe(element, { box: "device-pixel-content-box" });
  });
}
