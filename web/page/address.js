// The part of the page's address behind `#`: what is shown, so that a link shows it to others.

import { titleOf } from "./title.js";

/** Least time between two changes [ms]: browsers refuse more than a hundred in half a minute. */
const PAUSE = 400;

/** What is to be written next, and the timer that will do so; none while nothing waits. */
let waiting = "";
/** @type {ReturnType<typeof setTimeout> | null} */
let timer = null;
let last = -Infinity;

/** What stands behind `#` now. */
export function address() {
  return fragmentOf(location);
}

/** @param {{ hash: string }} url */
function fragmentOf({ hash }) {
  return hash.replace(/^#/, "");
}

/**
 * Puts this behind `#`, soon: a step in the browser's history where it leads to another scene than
 * what stands there.
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
  // Last: the entry of the history that is left keeps its own.
  document.title = title;
}

/**
 * What a fragment says of the scene: its name, or the whole file.
 *
 * @param {string} fragment
 */
function sceneOf(fragment) {
  const fields = new URLSearchParams(fragment);
  return fields.get("scene") ?? fields.get("file");
}

/**
 * Tells when something else changes it: a link, or typing into the address bar.
 *
 * @param {(fragment: string) => void} tell
 */
export function onAddressChange(tell) {
  addEventListener("hashchange", ({ newURL }) => {
    // What was shown until now must not be written over the new address.
    clearTimeout(timer ?? undefined);
    timer = null;
    // The event comes later than the change, and the page may have written its own in between.
    tell(fragmentOf(new URL(newURL)));
  });
}
