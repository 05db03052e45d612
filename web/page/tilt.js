// How the device is held.

/** The sine of an angle that tilts fully: 20 degrees, which a hand does without effort. */
const FULL = Math.sin((20 * Math.PI) / 180);

/** How long a device with sensors takes at most until it tells of them [ms]. */
const PATIENCE = 1000;

/** @typedef {[right: number, up: number]} Slope */

/**
 * Where a ball would roll on the screen, as sines of the angles of the slope; null until known.
 *
 * @type {Slope | null}
 */
let slope = null;

/**
 * The slope when tilting began: nobody holds a telephone level.
 *
 * @type {Slope | null}
 */
let neutral = null;

/**
 * Asks for leave to feel how the device is held, and begins to; the present pose is level.
 *
 * Some browsers ask whoever watches, and allow that only in answer to a click or touch.
 *
 * @returns {Promise<boolean>} whether the device tells
 */
export async function askForTilt() {
  if (!("DeviceOrientationEvent" in globalThis) || !(await isAllowed())) {
    return false;
  }
  addEventListener("deviceorientation", feel);
  neutral = null;
  slope = null;
  const isFelt = await isFeltWithin(PATIENCE);
  if (!isFelt) {
    removeEventListener("deviceorientation", feel);
  }
  return isFelt;
}

/**
 * How far the device is tilted from where it was level, to the right and to the upper edge of the
 * screen, each in [-1, 1]; null if it does not tell.
 *
 * @returns {Slope | null}
 */
export function tilt() {
  if (slope === null || neutral === null) {
    return null;
  }
  const part = (/** @type {0 | 1} */ i) => {
    const way = /** @type {Slope} */ (slope)[i] - /** @type {Slope} */ (neutral)[i];
    return Math.max(-1, Math.min(1, way / FULL));
  };
  return [part(0), part(1)];
}

/** @param {DeviceOrientationEvent} event */
function feel({ beta, gamma }) {
  // A desktop sends one event without numbers.
  if (beta === null || gamma === null) {
    return;
  }
  slope = onScreen(inDevice(beta, gamma), screen.orientation?.angle ?? 0);
  neutral ??= slope;
}

/**
 * The direction of gravity along the device's own x and y.
 *
 * Of the world's down, (0, 0, -1), after the rotations by beta about x and gamma about y, as
 * W3C's "Device Orientation" orders them; alpha, about the vertical, does not change it.
 *
 * @param {number} beta [degrees]
 * @param {number} gamma [degrees]
 * @returns {Slope}
 */
export function inDevice(beta, gamma) {
  const [b, g] = [beta, gamma].map((degrees) => (degrees * Math.PI) / 180);
  return [Math.cos(b) * Math.sin(g), -Math.sin(b)];
}

/**
 * Turned from the device's axes to those of the screen, which browsers turn in steps of 90 degrees.
 *
 * @param {Slope} slope
 * @param {number} angle [degrees]
 * @returns {Slope}
 */
export function onScreen([x, y], angle) {
  const a = (angle * Math.PI) / 180;
  return [x * Math.cos(a) - y * Math.sin(a), x * Math.sin(a) + y * Math.cos(a)];
}

async function isAllowed() {
  const { requestPermission } =
    /** @type {{ requestPermission?: () => Promise<string> }} */ (
      /** @type {unknown} */ (DeviceOrientationEvent)
    );
  if (requestPermission === undefined) {
    return true;
  }
  try {
    return (await requestPermission()) === "granted";
  } catch {
    // Not asked from a click or touch.
    return false;
  }
}

/** @param {number} time [ms] */
async function isFeltWithin(time) {
  const end = performance.now() + time;
  while (slope === null && performance.now() < end) {
    await new Promise((resolve) => setTimeout(resolve, 20));
  }
  return slope !== null;
}
