// The part of the page's address behind `#`: what is shown, so that a link shows it to others.

/** Least time between two changes [ms]: browsers refuse more than a hundred in half a minute. */
const PAUSE = 400;

/** @type {string | null} */
let waiting = null;
let last = -Infinity;

/** What stands behind `#` now. */
export function address() {
  return location.hash.replace(/^#/, "");
}

/**
 * Puts this behind `#`, soon, without a step in the browser's history.
 *
 * @param {string} fragment
 */
export function showFragment(fragment) {
  const isOnItsWay = waiting !== null;
  waiting = fragment;
  if (!isOnItsWay) {
    setTimeout(write, Math.max(0, last + PAUSE - performance.now()));
  }
}

function write() {
  const { pathname, search } = location;
  const url = waiting ? `#${waiting}` : pathname + search;
  waiting = null;
  last = performance.now();
  history.replaceState(null, "", url);
}

/**
 * Tells when something else changes it: a link, or typing into the address bar.
 *
 * @param {(fragment: string) => void} tell
 */
export function onAddressChange(tell) {
  addEventListener("hashchange", () => tell(address()));
}
