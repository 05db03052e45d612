// The page works by keyboard and for screen readers.

import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { createRequire } from "node:module";
import { after, before, test } from "node:test";

import { Desk } from "./viewer.js";

const AXE = createRequire(import.meta.url).resolve("axe-core/axe.min.js");

/** @type {Desk} */
let desk;

before(async () => {
  desk = await Desk.set("webgl2");
});

after(() => desk?.clear());

/**
 * Returns the serious faults that an audit finds.
 *
 * @param {import("playwright-core").Page} page
 */
async function faults(page) {
  await page.addScriptTag({ content: await readFile(AXE, "utf8") });
  const { violations } = await page.evaluate(() => /** @type {any} */ (globalThis).axe.run());
  const isGrave = (/** @type {any} */ it) => ["serious", "critical"].includes(it.impact);
  return violations.filter(isGrave).map((/** @type {any} */ it) => `${it.id}: ${it.help}`);
}

/** The audit is a foreign script, which the page's own policy refuses. */
const AUDITED = { bypassCSP: true };

/**
 * Shows a scene and switches the mirror on by keyboard, unless it is on.
 *
 * @param {string} fragment
 */
async function mirrored(fragment) {
  const viewer = await desk.show(fragment, AUDITED);
  await mirror(viewer.page);
  return viewer;
}

/** @param {import("playwright-core").Page} page */
async function mirror(page) {
  if (await page.isVisible("#mirror-switch")) {
    await page.locator("#mirror-switch").focus();
    await page.keyboard.press("Enter");
  } else {
    // The switch moves the focus there, too.
    await page.locator("#mirror").focus();
  }
  await page.waitForSelector("#mirror button");
  // Until then the mirror shows the scene before.
  await page.waitForFunction(() => {
    const elements = [...(document.getElementById("mirror")?.children ?? [])];
    const widgets = /** @type {any} */ (globalThis).carom.widgets();
    const name = (/** @type {Element} */ it) =>
      it.getAttribute("aria-label") ?? it.textContent ?? "";
    const isShown = (/** @type {Element} */ it, /** @type {number} */ i) =>
      name(it).startsWith(widgets[i].label);
    return elements.length === widgets.length && elements.every(isShown);
  });
}

test("an audit finds nothing grave, before the mirror is on and after", async () => {
  const viewer = await desk.show("#scene=simtest1", AUDITED);
  assert.equal(await viewer.page.isVisible("#mirror-switch"), true);
  assert.deepEqual(await faults(viewer.page), []);
  await mirror(viewer.page);
  assert.deepEqual(await faults(viewer.page), []);
  await viewer.close();
});

test("the first Tab leads to the switch, and no old message is left", async () => {
  const viewer = await desk.open("#scene=simtest1");
  const { page } = viewer;
  assert.equal(await page.evaluate(() => document.activeElement?.id), "carom");
  await page.keyboard.press("Tab");
  assert.equal(await page.evaluate(() => document.activeElement?.id), "mirror-switch");
  assert.equal(await page.textContent("#message"), "");
  await viewer.close();
});

test("menus are named by what they set, and numbers by axis and unit", async () => {
  const viewer = await mirrored("#scene=simtest1");
  const { page } = viewer;
  await page.getByRole("button", { name: "Method (rule): discrete", exact: true }).waitFor();
  for (const axis of ["x", "y", "z"]) {
    await page.getByRole("spinbutton", { name: `Force ${axis}, N`, exact: true }).waitFor();
  }
  await viewer.close();
});

test("buttons have their names and states, and do what those of the canvas do", async () => {
  const viewer = await mirrored("#scene=simtest1");
  const { page } = viewer;
  await page.getByRole("button", { name: "Play", exact: true }).press("Enter");
  await viewer.until(({ watching }) => watching.playing);
  const pause = page.getByRole("button", { name: "Pause", exact: true });
  await pause.waitFor();
  await pause.press("Space");
  await viewer.until(({ watching }) => !watching.playing);
  const collide = page.getByRole("checkbox", { name: "balls collide with each other" });
  assert.equal(await collide.getAttribute("aria-checked"), "false");
  await collide.press("Enter");
  await page.waitForSelector("#mirror [role=checkbox][aria-checked=true]");
  await viewer.close();
});

test("a slider is set by its number", async () => {
  const viewer = await mirrored("#scene=simtest1");
  const slider = viewer.page.getByRole("slider", {
    name: "Bounciness (restitution) of PlaneCollider",
  });
  await slider.first().evaluate((element) => {
    /** @type {HTMLInputElement} */ (element).value = "0.25";
    element.dispatchEvent(new Event("input"));
  });
  await viewer.until(({ watching }) => watching.restitutions[0] === 0.25);
  await viewer.close();
});

test("a field takes text", async () => {
  const viewer = await mirrored("#scene=simtest1");
  const { page } = viewer;
  await page.getByRole("button", { name: "Scenes" }).press("Enter");
  const filter = page.getByRole("textbox", { name: "type to filter" });
  await filter.fill("billiards");
  // Cards are buttons with the names of their scenes.
  await page.getByRole("button", { name: "billiards", exact: true }).waitFor();
  await page.getByRole("button", { name: "simtest2", exact: true }).waitFor({ state: "detached" });
  assert.equal(await filter.inputValue(), "billiards");
  await page.keyboard.press("Escape");
  await viewer.close();
});

test("the focus stays in the list where the control that has it goes away", async () => {
  const viewer = await mirrored("#scene=simtest1");
  const { page } = viewer;
  await page.getByRole("button", { name: "Scenes" }).press("Enter");
  const card = page.getByRole("button", { name: "billiards", exact: true });
  await card.press("Enter");
  await viewer.until(({ watching, choosing }) => watching?.scene === "billiards" && !choosing);
  await card.waitFor({ state: "detached" });
  const focus = await page.evaluate(() => document.activeElement?.closest("#mirror")?.id);
  assert.equal(focus, "mirror");
  await viewer.close();
});

test("what hits what is announced while a scene plays, one sentence at a time", async () => {
  const viewer = await mirrored("#scene=cradle");
  const { page } = viewer;
  assert.equal(await page.getAttribute("#impacts", "role"), "log");
  // Sentences, and when each was announced [ms]. The page may still show one of another scene.
  const announced = page.evaluate(
    () =>
      /** @type {Promise<[string, number][]>} */ (
        new Promise((resolve) => {
          const impacts = /** @type {HTMLElement} */ (document.getElementById("impacts"));
          const sentences = /** @type {[string, number][]} */ ([]);
          const note = () => {
            sentences.push([impacts.innerText, performance.now()]);
            if (sentences.length > 2) resolve(sentences);
          };
          new MutationObserver(note).observe(impacts, { childList: true });
        })
      ),
  );
  await page.getByRole("button", { name: "Play", exact: true }).press("Enter");
  const sentences = await announced;
  for (const [sentence] of sentences) {
    assert.match(sentence, /^ball \d+ hit (ball \d+|\w+ stop), \d+\.\d\d m\/s$/);
  }
  // Each is read to its end, which takes three seconds.
  const pauses = sentences.slice(1).map(([, time], i) => time - sentences[i][1]);
  assert.ok(Math.min(...pauses) > 2500, `${pauses} ms`);
  await viewer.close();
});

test("Tab leaves the page after the last control, and messages are heard", async () => {
  // The controls are counted, so the scene of the test before must be gone.
  const viewer = await desk.watch("tutorial1", AUDITED);
  const { page } = viewer;
  await mirror(page);
  const controls = await page.locator("#mirror button, #mirror input").count();
  let places = 0;
  const isInside = () =>
    page.evaluate(() => document.getElementById("mirror")?.contains(document.activeElement));
  do {
    await page.keyboard.press("Tab");
    places += 1;
  } while ((await isInside()) && places < 2 * controls + 10);
  assert.ok(places > 10 && places <= controls + 5, `${places} of ${controls}`);
  await page.evaluate(() => (location.hash = "#scene=nowhere"));
  await viewer.until(({ notices }) => notices.length > 0);
  await page.waitForFunction(() => document.getElementById("news")?.textContent !== "");
  await viewer.close();
});
