// Chromium for tests, as Debian has it, with graphics in software.

import { mkdir } from "node:fs/promises";
import { fileURLToPath } from "node:url";

import { chromium } from "playwright-core";

/** Pictures that tests leave, to be looked at after a change of the page. */
const RESULTS = fileURLToPath(new URL("../test-results/", import.meta.url));

/** What a browser would request from the network by itself. */
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

/**
 * @param {keyof typeof GRAPHICS} graphics
 * @param {string[]} [more] switches
 */
export function launch(graphics, more = []) {
  return chromium.launch({
    executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
    args: [...QUIET, ...GRAPHICS[graphics], ...more],
    // A busy machine takes its time.
    timeout: 120_000,
    // Without it Chromium starts for root under no circumstances.
    chromiumSandbox: process.getuid?.() !== 0,
  });
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
