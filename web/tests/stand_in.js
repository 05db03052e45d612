// Stands in for the module, so that the page is tested without it; records its arguments.

/** @param {{ module_or_path: WebAssembly.Module }} module */
export default async function init({ module_or_path }) {
  await WebAssembly.instantiate(module_or_path);
}

export class Page {
  /**
   * @param {HTMLCanvasElement} canvas
   * @param {import("carom-web").Services} services
   * @param {string} fragment
   */
  constructor(canvas, services, fragment) {
    this.canvas = canvas;
    this.services = services;
    this.fragments = [fragment];
  }

  /**
   * @param {HTMLCanvasElement} canvas
   * @param {import("carom-web").Services} services
   * @param {string} fragment
   */
  static async start(canvas, services, fragment) {
    if (fragment === "refuse") {
      throw new Error("The graphics of this browser are not enough.");
    }
    return new Page(canvas, services, fragment);
  }

  /** @param {string} fragment */
  openFragment(fragment) {
    this.fragments.push(fragment);
  }
}
