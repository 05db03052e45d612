// The part of the page's address behind `#`: what the page shows, so that the address is a link to
// it.

import { titleOf } from "./title.js";

/** Shortest time between two changes [ms]: browsers refuse more than a hundred in half a minute. */
const PAUSE = 400;

/** The next text to write, and the timer that will write it, or null. */
let waiting = "";
/** @type {ReturnType<typeof setTimeout> | null} */
let timer = null;
let last = -Infinity;

/** Returns the present text behind `#`. */
export function address() {
  return fragmentOf(location);
}

/** @param {{ hash: string }} url */
function fragmentOf({ hash }) {
  return hash.replace(/^#/, "");
}

/**
 * Writes this text behind `#` soon. If it shows another scene than the present text, the browser's
 * history gets a new entry.
 *
 * @param {string} fragment
 */
export function showFragment(fragment) {
  waiting = fragment;
  timer ??= setTimeout(write, Math.max(0, last + PAUSE - performance.now()));
}

function write() {
  const { pathname, search } = location;
  const url = waiting ? `#${waiting}` : pathname + search;
  const isAnotherScene = address() !== "" && sceneOf(waiting) !== sceneOf(address());
  const title = titleOf(waiting);
  timer = null;
  last = performance.now();
  if (isAnotherScene) {
    history.pushState(null, "", url);
  } else {
    history.replaceState(null, "", url);
  }
  // Last, because the history entry that is left keeps its own title.
  document.title = title;
}

/**
 * Returns the scene in a fragment: its name, or the whole file.
 *
 * @param {string} fragment
 */
function sceneOf(fragment) {
  const fields = new URLSearchParams(fragment);
  return fields.get("scene") ?? fields.get("file");
}

/**
 * Calls `tell` when something else changes the address: a link, or typing into the address bar.
 *
 * @param {(fragment: string) => void} tell
 */
export function onAddressChange(tell) {
  addEventListener("hashchange", ({ newURL }) => {
    // The last view must not overwrite the new address.
    clearTimeout(timer ?? undefined);
    timer = null;
    // The event comes after the change; the page may have written its own text in between.
    tell(fragmentOf(new URL(newURL)));
  });
}
