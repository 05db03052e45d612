// The screen shown before the interface, and if it cannot start.

const element = (/** @type {string} */ id) =>
  /** @type {HTMLElement} */ (document.getElementById(id));

const screen = element("loading");
const message = element("message");
const detail = element("detail");
const bar = /** @type {HTMLProgressElement} */ (element("progress"));
const again = element("again");

again.addEventListener("click", () => location.reload());

export const loading = {
  /**
   * Shows how much of the module has arrived, in bytes.
   *
   * @param {number} arrived
   * @param {number} all
   */
  show(arrived, all) {
    bar.value = arrived / all;
    const megabytes = (/** @type {number} */ bytes) => (bytes / 1e6).toFixed(1);
    message.textContent =
      arrived < all ? `Loading ${megabytes(arrived)} of ${megabytes(all)} MB` : "Starting";
  },

  /** Makes way for the interface. */
  finish() {
    screen.classList.add("done");
    // Hides the screen from screen readers, too.
    screen.setAttribute("aria-hidden", "true");
    message.textContent = "";
  },

  /**
   * Shows why there is no interface (any more).
   *
   * @param {string} text for the user
   * @param {string | null} [more] for experts
   */
  fail(text, more) {
    screen.classList.remove("done");
    screen.removeAttribute("aria-hidden");
    screen.classList.add("trouble");
    message.textContent = text;
    detail.textContent = more ?? "";
    detail.hidden = !more;
    again.hidden = false;
    again.focus();
  },
};
