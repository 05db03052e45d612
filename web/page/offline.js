// The page without a network: `worker.js` keeps it.

/** Keeps the page for later, where the browser lets it: over https, or on this machine. */
export function keepForOffline() {
  if (!isSecureContext || !("serviceWorker" in navigator)) {
    return;
  }
  navigator.serviceWorker.register("worker.js").catch((error) => {
    // Browsers refuse it in private windows, for one; all else works.
    console.info(`Carom is not kept for use without a network: ${error.message}`);
  });
}
