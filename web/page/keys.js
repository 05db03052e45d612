// Keys that scroll pages, but not this one.

const SCROLLING = new Set([
  " ",
  "ArrowUp",
  "ArrowDown",
  "ArrowLeft",
  "ArrowRight",
  "PageUp",
  "PageDown",
  "Home",
  "End",
]);

/**
 * Prevents keys for the interface from scrolling the page, or a page that embeds it.
 *
 * @param {...EventTarget} ours elements that pass keys to the interface
 */
export function keepKeysFromScrolling(...ours) {
  addEventListener("keydown", (event) => {
    const isPlain = !event.ctrlKey && !event.metaKey && !event.altKey;
    const isOurs = event.target !== null && ours.includes(event.target);
    if (isPlain && isOurs && SCROLLING.has(event.key)) {
      event.preventDefault();
    }
  });
}
