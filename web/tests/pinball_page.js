// Plays the page of `examples/pinball-web` in a browser: `node tests/pinball_page.js FOLDER`, where FOLDER holds
// `pinball-web` with its packages, and `pinball`.

import assert from "node:assert/strict";

import { serve } from "../serve.js";
import { complaints, keepPicture, launch, newPage } from "./browser.js";

const [folder] = process.argv.slice(2);
const server = await serve(folder, 0);
const browser = await launch("webgl2");
try {
  const page = await newPage(browser, { viewport: { width: 700, height: 700 } });
  const heard = complaints(page);
  await page.goto(`${server.url}pinball-web/`);
  const message = page.locator("#message");
  await page.waitForFunction(() =>
    document.querySelector("#message")?.textContent?.includes("Hold"),
  );
  await page.keyboard.down("Space");
  // The message goes as soon as the plunger is drawn, and stays away while the ball flies.
  await page.waitForFunction(() => document.querySelector("#message")?.textContent === "");
  await page.waitForTimeout(1000);
  await page.keyboard.up("Space");
  await page.keyboard.down("ArrowLeft");
  await page.waitForTimeout(500);
  await keepPicture(page, "pinball-example");
  assert.equal(await message.textContent(), "");
  assert.match((await page.textContent("#score")) ?? "", /^[\d,]+$/);
  assert.deepEqual(heard, []);
} finally {
  await browser.close();
  await server.close();
}
