// The number of pixels of the canvas.

/**
 * Corrects browsers that report a wrong number of pixels.
 *
 * Chromium reports the size of an element in device pixels, but uses the real screen even if its
 * developer tools simulate another, such as that of a telephone. If the number is wrong it is
 * removed; the interface then multiplies lengths with `devicePixelRatio`.
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
  // Rounding at both edges may change a whole pixel.
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
