// Keeps the page for use without a network; `worker.js` does the work.

/** Keeps the page if the browser allows it: over https, or on this machine. */
export function keepForOffline() {
  if (!isSecureContext || !("serviceWorker" in navigator)) {
    return;
  }
  navigator.serviceWorker.register("worker.js").catch((error) => {
    // Browsers refuse it in private windows, for example; everything else works.
    console.info(`Carom is not kept for use without a network: ${error.message}`);
  });
}
