// The direction in which a ball would roll on the screen of a tilted device.

import assert from "node:assert/strict";
import { test } from "node:test";

import { inDevice, onScreen } from "../page/tilt.js";

/**
 * @param {number[]} found
 * @param {number[]} expected
 */
function assertNear(found, expected) {
  const isNear = found.every((value, i) => Math.abs(value - expected[i]) < 1e-12);
  assert.ok(isNear, `${found}, not ${expected}`);
}

test("upright, a ball rolls to the lower edge", () => {
  assertNear(inDevice(90, 0), [0, 1]);
});

test("on its right edge, a ball rolls to the right", () => {
  assertNear(inDevice(0, 90), [1, 0]);
});

test("with its right edge up, a ball rolls to the lower edge of the turned screen", () => {
  assertNear(onScreen(inDevice(0, -90), 90), [0, 1]);
});

test("with its left edge up, a ball rolls to the lower edge of the turned screen", () => {
  assertNear(onScreen(inDevice(0, 90), 270), [0, 1]);
});

test("upside down, a ball rolls to the lower edge of the turned screen", () => {
  assertNear(onScreen(inDevice(-90, 0), 180), [0, 1]);
});
