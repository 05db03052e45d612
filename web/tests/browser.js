// Chromium for tests, as Debian installs it, with software graphics.

import { mkdir } from "node:fs/promises";
import { fileURLToPath } from "node:url";

import { chromium } from "playwright-core";

/** Pictures and films from tests, for inspection after a change of the page. */
const RESULTS = fileURLToPath(new URL("../test-results/", import.meta.url));

/** Longest time for an action on the slowest machine [ms], which draws in software. */
export const PATIENCE = 120_000;

/** A name of this machine that browsers do not recognise as local. */
export const STRANGE_NAME = "carom.test";

/** Environment variable with the address of a browser that several test files share. */
const SHARED = "CAROM_BROWSER";

/** Switches that keep a browser from its own network requests. */
const QUIET = [
  "--disable-background-networking",
  "--disable-component-update",
  "--disable-default-apps",
  "--disable-domain-reliability",
  "--disable-sync",
  "--metrics-recording-only",
  "--no-first-run",
  "--no-pings",
];

/** Switches with which Chromium draws and shows pictures without a graphics card. */
export const GRAPHICS = {
  webgl2: ["--use-angle=gl-egl", "--ignore-gpu-blocklist"],
  webgpu: [
    "--use-angle=gl-egl",
    "--ignore-gpu-blocklist",
    "--enable-unsafe-webgpu",
    "--enable-features=Vulkan",
  ],
  none: ["--disable-gpu", "--disable-software-rasterizer", "--disable-3d-apis"],
};

/** Graphics of the shared browser, which most tests use. */
const SHARED_GRAPHICS = "webgl2";

/**
 * Returns the shared browser, if it exists and has these graphics, or a new one.
 *
 * @param {keyof typeof GRAPHICS} graphics
 */
export function launch(graphics) {
  const shared = process.env[SHARED];
  if (graphics === SHARED_GRAPHICS && shared) {
    return chromium.connect(shared);
  }
  return chromium.launch(options(graphics));
}

/** Starts a browser that this process and its children share until it is closed. */
export async function share() {
  const server = await chromium.launchServer(options(SHARED_GRAPHICS));
  process.env[SHARED] = server.wsEndpoint();
  return server;
}

/** @param {keyof typeof GRAPHICS} graphics */
function options(graphics) {
  return {
    executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
    args: [...QUIET, ...GRAPHICS[graphics], `--host-resolver-rules=MAP ${STRANGE_NAME} 127.0.0.1`],
    timeout: PATIENCE,
    // As root, Chromium does not start with its sandbox.
    chromiumSandbox: process.getuid?.() !== 0,
  };
}

/**
 * Opens a new page in a context of its own, whose actions may take as long as on a busy machine.
 *
 * @param {import("playwright-core").Browser} browser
 * @param {import("playwright-core").BrowserContextOptions} [options]
 */
export async function newPage(browser, options) {
  const context = await browser.newContext(options);
  context.setDefaultTimeout(PATIENCE);
  return context.newPage();
}

/**
 * Keeps a file that a page saves; a shared browser does not tell its own path.
 *
 * @param {import("playwright-core").Download} download
 * @param {string} name
 * @returns {Promise<string>} the path
 */
export async function keepDownload(download, name) {
  const path = `${RESULTS}${name}`;
  await download.saveAs(path);
  return path;
}

/**
 * Collects errors of a page: from its console, and uncaught ones.
 *
 * @param {import("playwright-core").Page} page
 * @returns {string[]} grows with every error
 */
export function complaints(page) {
  /** @type {string[]} */
  const heard = [];
  page.on("console", (message) => {
    if (message.type() === "error") {
      heard.push(message.text());
    }
  });
  page.on("pageerror", (error) => heard.push(String(error)));
  return heard;
}

/**
 * Keeps a picture of the page.
 *
 * @param {import("playwright-core").Page} page
 * @param {string} name
 */
export async function keepPicture(page, name) {
  await mkdir(RESULTS, { recursive: true });
  return page.screenshot({ path: `${RESULTS}${name}.png` });
}
