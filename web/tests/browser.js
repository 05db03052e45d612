// Chromium for tests, as Debian has it, with graphics in software.

import { mkdir } from "node:fs/promises";
import { fileURLToPath } from "node:url";

import { chromium } from "playwright-core";

/** Pictures and films that tests leave, to be looked at after a change of the page. */
const RESULTS = fileURLToPath(new URL("../test-results/", import.meta.url));

/** A name of this machine that browsers do not take for it. */
export const STRANGE_NAME = "carom.test";

/** For the address of a browser that several files of tests share. */
const SHARED = "CAROM_BROWSER";

/** What keeps a browser from requests to the network of its own. */
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

/** Sets of switches with which Chromium draws, and shows what it drew, without a graphics card. */
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

/** Of the browser that is shared: what most tests draw with. */
const SHARED_GRAPHICS = "webgl2";

/**
 * Returns a browser: the one that is shared, where there is one with these graphics, or a new one.
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

/** Starts a browser that this process and those that it starts share until it is closed. */
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
    // A busy machine takes its time.
    timeout: 120_000,
    // Without it Chromium starts for root under no circumstances.
    chromiumSandbox: process.getuid?.() !== 0,
  };
}

/**
 * Keeps a file that a page gives; a browser that is shared tells no place of its own.
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
 * Collects what a page complains of, in its console or by errors that were not caught.
 *
 * @param {import("playwright-core").Page} page
 * @returns {string[]} grows as the page complains
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
 * Keeps a picture of the page as it is shown.
 *
 * @param {import("playwright-core").Page} page
 * @param {string} name
 */
export async function keepPicture(page, name) {
  await mkdir(RESULTS, { recursive: true });
  return page.screenshot({ path: `${RESULTS}${name}.png` });
}
