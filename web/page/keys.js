// Keys that scroll pages, and here do not.

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
 * Keeps keys that are meant for the interface from scrolling the page, or one that embeds it.
 *
 * @param {...EventTarget} ours elements that hand keys to the interface
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
