// Carom in a page, controlled and read by tests.

import assert from "node:assert/strict";
import { fileURLToPath } from "node:url";

import { serve } from "../serve.js";
import { PATIENCE, complaints, keepPicture, launch, newPage } from "./browser.js";
import { difference, read } from "./pixels.js";

/** The page built by `cargo xtask web`. */
const DIST = process.env.CAROM_DIST ?? fileURLToPath(new URL("../dist/", import.meta.url));

/**
 * Canvas pixels per CSS pixel: few, because software draws them. With $CAROM_FINE, pictures from
 * tests are as fine as on a screen.
 */
export const COARSE = process.env.CAROM_FINE ? 1 : 0.5;

/**
 * @typedef {object} Widget in CSS pixels
 * @property {string} role
 * @property {string} label
 * @property {string | null} value
 * @property {number} x
 * @property {number} y
 * @property {number} width
 * @property {number} height
 */

/** A browser and a server for the tests of one file. */
export class Desk {
  /**
   * @param {import("playwright-core").Browser} browser
   * @param {Awaited<ReturnType<typeof serve>>} server
   */
  constructor(browser, server) {
    this.browser = browser;
    this.server = server;
    /** The page that [`show`] opened last. @type {Viewer | null} */
    this.shared = null;
    /** The options of that page, as text. */
    this.sharedOptions = "";
  }

  /** @param {Parameters<typeof launch>[0]} graphics */
  static async set(graphics) {
    return new Desk(await launch(graphics), await serve(DIST, 0));
  }

  async clear() {
    await this.browser.close();
    await this.server.close();
  }

  /**
   * Opens a new page and waits for the interface.
   *
   * @param {string} [fragment] of the address, with `#`
   * @param {import("playwright-core").BrowserContextOptions} [options]
   */
  async open(fragment = "", options = {}) {
    // Other pages would continue to draw: the shared one, and that of a failed test.
    this.shared = null;
    await Promise.all(this.browser.contexts().map((context) => context.close()));
    const viewport = { width: 1280, height: 800 };
    const coarse = { viewport, deviceScaleFactor: COARSE };
    const page = await newPage(this.browser, { ...coarse, ...options });
    const viewer = new Viewer(page);
    await page.goto(`${this.server.url}${fragment}`);
    await page.waitForSelector("#loading.done, #loading.trouble", { state: "attached" });
    assert.equal(await page.isVisible("#loading.trouble"), false, await page.innerText("#loading"));
    await viewer.until((status) => status.pictures > 1);
    return viewer;
  }

  /**
   * Shows the scene of a link, or the chooser without one, in a page that tests share one after
   * another; for tests that do not depend on how a page starts. Panels, and dialogs except the
   * chooser, stay as they were left.
   *
   * @param {string} [fragment] of the address, with `#`
   * @param {import("playwright-core").BrowserContextOptions} [options]
   */
  async show(fragment = "", options = {}) {
    const asked = JSON.stringify(options);
    if (this.shared?.isLeft && this.sharedOptions === asked) {
      await this.shared.goOn(fragment);
      return this.shared;
    }
    const viewer = await this.open(fragment, options);
    if (fragment === "") {
      await viewer.openChooser();
    }
    viewer.isShared = true;
    [this.shared, this.sharedOptions] = [viewer, asked];
    return viewer;
  }

  /**
   * Opens a scene at its start in the shared page.
   *
   * @param {string} scene
   * @param {import("playwright-core").BrowserContextOptions} [options]
   */
  async watch(scene, options) {
    const viewer = await this.show(`#scene=${scene}`, options);
    await viewer.until((status) => status.watching?.scene === scene);
    await viewer.redraw();
    return viewer;
  }

  /**
   * Chooses a scene as a user does, in the shared page.
   *
   * @param {string} scene
   */
  async choose(scene) {
    const viewer = await this.show();
    await viewer.type(scene);
    await viewer.page.keyboard.press("Enter");
    await viewer.until(({ watching, choosing }) => watching?.scene === scene && !choosing);
    // Keys go to the chooser's text until the next frame.
    await viewer.page.waitForFunction(() => document.activeElement?.id === "carom");
    return viewer;
  }
}

/** The interface in a page. */
export class Viewer {
  /** @param {import("playwright-core").Page} page */
  constructor(page) {
    this.page = page;
    this.complaints = complaints(page);
    /** Whether other tests use the page afterwards. */
    this.isShared = false;
    /** Whether a test has left the page to others. */
    this.isLeft = false;
  }

  /** Leaves the page, and closes it unless it is shared; fails if the page reported errors. */
  async close() {
    assert.deepEqual(this.complaints, []);
    if (this.isShared) {
      await this.page.evaluate(() => /** @type {any} */ (globalThis).carom.pause());
      this.isLeft = true;
    } else {
      await this.page.context().close();
    }
  }

  /**
   * Continues with the page where another test has left it.
   *
   * @param {string} fragment of the address, with `#`; empty for the chooser
   */
  async goOn(fragment) {
    this.isLeft = false;
    if (fragment === "") {
      // Another scene removes messages and an open chooser.
      await this.goOn("#scene=simtest1");
      return this.openChooser();
    }
    // Directly, because the same address would change nothing.
    await this.page.evaluate((fragment) => {
      history.replaceState(null, "", fragment);
      /** @type {any} */ (globalThis).carom.openFragment(fragment.slice(1));
    }, fragment);
    // Until it has been drawn, the controls are those of the scene before.
    await this.redraw();
  }

  /** Opens the chooser by its key. */
  async openChooser() {
    await this.page.keyboard.press("Enter");
    await this.until(({ choosing }) => choosing);
    await this.redraw();
  }

  /** @param {number} time [ms] */
  pause(time) {
    return new Promise((resolve) => setTimeout(resolve, time));
  }

  /** @returns {Promise<any>} the status of the interface */
  async status() {
    for (;;) {
      const status = await this.page.evaluate(() => /** @type {any} */ (globalThis).carom.status());
      // There is none while a frame is being drawn.
      if (status !== undefined) {
        return status;
      }
    }
  }

  /**
   * Waits until the status fulfils a condition.
   *
   * @param {(status: any) => unknown} isShown
   * @param {number} patience longest time [ms]
   * @returns {Promise<any>} the status
   */
  async until(isShown, patience = PATIENCE) {
    const end = performance.now() + patience;
    for (;;) {
      const status = await this.status();
      if (isShown(status)) {
        return status;
      }
      const shown = JSON.stringify({ ...status, scenes: undefined });
      assert.ok(performance.now() < end, `waited for ${isShown} in ${shown}`);
      await this.pause(30);
    }
  }

  /** Waits for two more frames, after which an action has been drawn. */
  async redraw() {
    const { pictures } = await this.status();
    await this.page.evaluate(() => /** @type {any} */ (globalThis).carom.widgets());
    await this.until((status) => status.pictures > pictures + 1);
  }

  /** @returns {Promise<Widget[]>} the present controls */
  async widgets() {
    const end = performance.now() + PATIENCE;
    for (;;) {
      await this.redraw();
      const widgets = await this.page.evaluate(() =>
        /** @type {any} */ (globalThis).carom.widgets(),
      );
      // There are none until a frame after the first call.
      if (widgets.length > 0 || performance.now() > end) {
        return widgets;
      }
    }
  }

  /**
   * @param {string} label
   * @param {string} [role]
   * @returns {Promise<Widget>}
   */
  async widget(label, role) {
    const end = performance.now() + PATIENCE;
    for (;;) {
      const widgets = await this.widgets();
      const found = widgets.find((it) => it.label === label && (role ?? it.role) === it.role);
      if (found !== undefined) {
        return found;
      }
      const labels = widgets.map((it) => `${it.role} ${it.label}`).join(", ");
      assert.ok(performance.now() < end, `there is no ${role ?? ""} ${label} in ${labels}`);
    }
  }

  /**
   * Returns a visible point on a control, by default its middle.
   *
   * @param {string} label
   * @param {{ role?: string, part?: number }} where part of its width
   * @returns {Promise<[x: number, y: number]>}
   */
  async point(label, { role, part = 0.5 }) {
    const { x, y, width, height } = await this.widget(label, role);
    const [left, top] = [x + part * width, y + 0.5 * height];
    const window = this.page.viewportSize();
    const isSeen = window && left > 0 && left < window.width && top > 0 && top < window.height;
    assert.ok(isSeen, `${label} lies at (${left}, ${top}), outside of the window`);
    return [left, top];
  }

  /**
   * Types the name of a scene into the chooser until Enter would choose it.
   *
   * @param {string} scene
   */
  async type(scene) {
    await this.page.keyboard.type(scene);
    while ((await this.widget(scene, "Button")).value !== "true") {
      // The selection changes one frame after the letters.
    }
  }

  /**
   * Clicks on a control.
   *
   * @param {string} label
   * @param {{ role?: string, part?: number }} [where] part of its width
   */
  async click(label, where = {}) {
    await this.page.mouse.click(...(await this.point(label, where)));
  }

  /**
   * Taps on a control.
   *
   * @param {string} label
   * @param {{ role?: string, part?: number }} [where] part of its width
   */
  async tap(label, where = {}) {
    await this.page.touchscreen.tap(...(await this.point(label, where)));
  }

  /**
   * Holds a key until the status fulfils a condition.
   *
   * @param {string} key
   * @param {(status: any) => unknown} isShown
   */
  async hold(key, isShown) {
    await this.page.keyboard.down(key);
    await this.until(isShown);
    await this.page.keyboard.up(key);
  }

  /**
   * Drops a file on the page.
   *
   * @param {string} name
   * @param {string} text
   */
  async drop(name, text) {
    await this.page.evaluate(
      ({ name, text }) => {
        const dataTransfer = new DataTransfer();
        dataTransfer.items.add(new File([text], name));
        const canvas = /** @type {HTMLCanvasElement} */ (document.getElementById("carom"));
        for (const type of ["dragenter", "dragover", "drop"]) {
          const init = {
            bubbles: true,
            cancelable: true,
            dataTransfer,
            clientX: 600,
            clientY: 400,
          };
          canvas.dispatchEvent(new DragEvent(type, init));
        }
      },
      { name, text },
    );
  }

  /**
   * Performs an action and waits for its download.
   *
   * @param {() => Promise<unknown>} act
   */
  async download(act) {
    const waiting = this.page.waitForEvent("download");
    await act();
    return waiting;
  }

  /** Keeps a picture of the page as a user sees it. */
  async keepPicture(/** @type {string} */ name) {
    return keepPicture(this.page, name);
  }

  /**
   * Keeps a picture of the page once it differs from an earlier one.
   *
   * @param {string} name
   * @param {import("./pixels.js").Picture} before
   * @param {Parameters<typeof difference>[2]} rectangle
   * @param {number} least part of the rectangle's pixels that must differ
   */
  async keepChanged(name, before, rectangle, least) {
    const end = performance.now() + PATIENCE;
    for (;;) {
      const picture = read(await this.keepPicture(name));
      const part = difference(before, picture, rectangle);
      if (part > least) {
        return picture;
      }
      assert.ok(performance.now() < end, `${part} of the pixels of ${name} differ`);
    }
  }
}
