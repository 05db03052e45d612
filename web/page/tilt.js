// Measures the tilt of the device.

import { noteTrouble } from "./trouble.js";

/** Sine of the angle of a full tilt: 20 degrees, which is easy for a hand. */
const FULL = Math.sin((20 * Math.PI) / 180);

/** Longest time until a device with sensors reports [ms]. */
const PATIENCE = 1000;

/**
 * @typedef {[right: number, down: number]} Slope the direction in which a ball would roll on the
 * screen
 */

let isUsed = false;

/**
 * The present slope, as sines of its angles; null while unknown.
 *
 * @type {Slope | null}
 */
let slope = null;

/**
 * The slope when tilting began; it counts as level, because a telephone is never held level.
 *
 * @type {Slope | null}
 */
let level = null;

/** Returns whether this may be a hand-held device with sensors. */
export function offersTilt() {
  return "DeviceOrientationEvent" in globalThis && navigator.maxTouchPoints > 0;
}

/**
 * Starts or ends the measurement; the pose at the start counts as level.
 *
 * @param {boolean} on
 */
export function useTilt(on) {
  isUsed = on;
  slope = null;
  level = null;
  removeEventListener("deviceorientation", feel);
  if (on) {
    askForLeave().then(
      () => begin(),
      () => refused("The browser does not let Carom feel how this device is held."),
    );
  }
}

/**
 * Returns the tilt relative to the level pose, to the right and to the lower edge of the screen,
 * each in [-1, 1]; null if the device does not report it.
 *
 * @returns {Slope | null}
 */
export function tilt() {
  if (slope === null || level === null) {
    return null;
  }
  const [right, down] = [slope[0] - level[0], slope[1] - level[1]];
  const part = (/** @type {number} */ way) => Math.max(-1, Math.min(1, way / FULL));
  return [part(right), part(down)];
}

/** Asks for permission. Some browsers require it, and ask the user only after a touch. */
async function askForLeave() {
  const { requestPermission } = /** @type {{ requestPermission?: () => Promise<string> }} */ (
    /** @type {unknown} */ (DeviceOrientationEvent)
  );
  if (requestPermission === undefined) {
    return;
  }
  const ask = async () => {
    if ((await requestPermission()) !== "granted") {
      throw new Error("denied");
    }
  };
  await ask().catch(async () => {
    // The interface reacts to a touch one frame later, which may be too late; then the next touch
    // asks.
    await new Promise((resolve) => addEventListener("touchend", resolve, { once: true }));
    await ask();
  });
}

async function begin() {
  if (!isUsed) {
    return;
  }
  addEventListener("deviceorientation", feel);
  await new Promise((resolve) => setTimeout(resolve, PATIENCE));
  if (isUsed && slope === null) {
    refused("This device does not tell how it is held.");
  }
}

/** @param {string} text */
function refused(text) {
  removeEventListener("deviceorientation", feel);
  noteTrouble(text);
}

/** @param {DeviceOrientationEvent} event */
function feel({ beta, gamma }) {
  // A desktop sends one event without numbers.
  if (beta === null || gamma === null) {
    return;
  }
  slope = onScreen(inDevice(beta, gamma), screen.orientation?.angle ?? 0);
  level ??= slope;
}

/**
 * Returns the direction of gravity along the device's x, to its right, and against its y,
 * downwards.
 *
 * It is the world's down, (0, 0, -1), after the rotations by beta about x and gamma about y, in the
 * order of W3C's "Device Orientation"; alpha, about the vertical, has no effect.
 *
 * @param {number} beta [degrees]
 * @param {number} gamma [degrees]
 * @returns {Slope}
 */
export function inDevice(beta, gamma) {
  const [b, g] = [beta, gamma].map((degrees) => (degrees * Math.PI) / 180);
  return [Math.cos(b) * Math.sin(g), Math.sin(b)];
}

/**
 * Converts from the device's axes to those of the screen, which turns in steps of 90 degrees
 * against the device.
 *
 * @param {Slope} slope
 * @param {number} angle of the screen [degrees]; 90 with the device's right edge up
 * @returns {Slope}
 */
export function onScreen([right, down], angle) {
  const a = (angle * Math.PI) / 180;
  const [cos, sin] = [Math.cos(a), Math.sin(a)];
  return [right * cos + down * sin, down * cos - right * sin];
}
