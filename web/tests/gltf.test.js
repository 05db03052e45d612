// Runs exported as glTF animations are valid for the validator of Khronos, and in three.js each
// ball is at its position in the run at every frame.

import assert from "node:assert/strict";
import { mkdtemp, readFile, rm } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { after, before, test } from "node:test";

import { build } from "esbuild";
// @ts-expect-error: it has no types.
import { validateBytes } from "gltf-validator";
import { AnimationMixer, LoopOnce, Vector3 } from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";

import { complaints, keepPicture, launch, newPage } from "./browser.js";
import { carom } from "./native.js";

/** @type {string} */
let folder;

/** The .glb file of tutorial4. @type {Buffer} */
let tutorial4;

before(async () => {
  folder = await mkdtemp(join(tmpdir(), "carom-gltf-"));
  tutorial4 = await recorded("tutorial4");
});

after(() => rm(folder, { recursive: true }));

/**
 * @param {string} scene
 * @param {string[]} more of the command line
 */
async function recorded(scene, ...more) {
  const file = join(folder, `${scene}.glb`);
  carom("run", scene, ...more, "--out", file, "--force");
  return readFile(file);
}

/**
 * Returns the position of each ball after each frame from a table.
 *
 * @param {string} scene
 * @param {string[]} more of the command line
 */
async function table(scene, ...more) {
  const file = join(folder, `${scene}.csv`);
  carom("run", scene, ...more, "--out", file, "--force");
  const [, ...lines] = (await readFile(file, "utf8")).trim().split("\n");
  return lines.map((line) => {
    const [time, ball, x, y, z] = line.split(",").map(Number);
    return { time, ball, position: new Vector3(x, y, z) };
  });
}

/** @param {Buffer} bytes */
function opened(bytes) {
  const whole = bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength);
  return new GLTFLoader().parseAsync(/** @type {ArrayBuffer} */ (whole), "");
}

/**
 * Plays an animation, which stops at its end.
 *
 * @param {import("three").Object3D} scene
 * @param {import("three").AnimationClip[]} animations
 */
function playing(scene, animations) {
  const mixer = new AnimationMixer(scene);
  const action = mixer.clipAction(animations[0]);
  action.setLoop(LoopOnce, 1);
  action.clampWhenFinished = true;
  action.play();
  return mixer;
}

/** Half of the last of 24 bits, relative to the number. */
const ROUNDING = 2 ** -24;

/**
 * Plays a file and compares the positions of the balls with a table.
 *
 * @param {Buffer} bytes
 * @param {Awaited<ReturnType<typeof table>>} rows
 */
async function compare(bytes, rows) {
  const { scene, animations } = await opened(bytes);
  assert.equal(animations.length, 1);
  const mixer = playing(scene, animations);
  const starts = new Map();
  scene.traverse((node) => starts.set(node.name, node.position.clone()));
  let moved = 0;
  let last = NaN;
  for (const { time, ball, position } of rows) {
    if (time !== last) {
      mixer.setTime(Math.fround(time));
      last = time;
    }
    const node = scene.getObjectByName(`ball_${ball}`);
    assert.ok(node, `ball ${ball}`);
    assert.ok(node.scale.x > 0, `ball ${ball} has no size at ${time} s`);
    for (const axis of /** @type {const} */ (["x", "y", "z"])) {
      const expected = position[axis];
      // Keys are rounded once, and the time is exactly that of the key.
      const near = ROUNDING * Math.abs(expected) + 1e-12;
      const away = Math.abs(node.position[axis] - expected);
      assert.ok(away <= near, `ball ${ball}.${axis} is ${away} m away at ${time} s`);
    }
    moved += Number(node.position.distanceTo(starts.get(node.name)) > 0.01);
  }
  return { scene, moved };
}

test("tutorial4 moves in three.js as the run does, to the rounding of 32 bits", async () => {
  const rows = await table("tutorial4");
  const { moved } = await compare(tutorial4, rows);
  assert.ok(moved > rows.length / 2, `${moved} of ${rows.length} places`);
});

test("balls that are emitted later have no size before", async () => {
  const seconds = ["--seconds", "3"];
  const bytes = await recorded("simtest1", ...seconds);
  const { scene } = await compare(bytes, await table("simtest1", ...seconds));
  const { animations } = await opened(bytes);
  const mixer = playing(scene, animations);
  mixer.setTime(0);
  const sizes = () =>
    scene.children.filter((it) => it.name.startsWith("ball")).map((it) => it.scale.x);
  assert.ok(sizes().length > 1);
  assert.ok(sizes().every((size) => size === 0));
  mixer.setTime(2.99);
  assert.ok(sizes().every((size) => size > 0));
});

test("files are valid, with camera, light, colliders, and balls that turn", async () => {
  for (const scene of ["simtest1", "tutorial4", "billiards", "galton", "hourglass", "maze"]) {
    const bytes = await recorded(scene, "--seconds", "0.5");
    const { issues } = await validateBytes(new Uint8Array(bytes));
    const { numErrors, numWarnings, messages } = issues;
    assert.equal(numErrors + numWarnings, 0, `${scene}: ${JSON.stringify(messages)}`);
  }
});

test("a browser with three.js draws tutorial4, and the picture moves", async () => {
  const script = await build({
    stdin: { contents: PLAYER, resolveDir: fileURLToPath(new URL("..", import.meta.url)) },
    bundle: true,
    write: false,
    format: "iife",
  });
  const browser = await launch("webgl2");
  try {
    const page = await newPage(browser, { viewport: { width: 640, height: 400 } });
    const heard = complaints(page);
    await page.setContent('<body style="margin:0"></body>');
    await page.addScriptTag({ content: script.outputFiles[0].text });
    const at = async (/** @type {number} */ time) => {
      const bytes = tutorial4.toString("base64");
      const given = /** @type {const} */ ([bytes, time]);
      await page.evaluate(([bytes, time]) => /** @type {any} */ (window).show(bytes, time), given);
      return keepPicture(page, `gltf-tutorial4-${time}`);
    };
    const [first, later] = [await at(0), await at(2)];
    assert.deepEqual(heard, []);
    assert.notDeepEqual(first, later);
    assert.deepEqual(await at(0), first);
  } finally {
    await browser.close();
  }
});

/** Draws a file as it is at a time, through its own camera and in its own light. */
const PLAYER = `
  import * as three from "three";
  import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";

  const renderer = new three.WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
  renderer.setSize(innerWidth, innerHeight);
  document.body.append(renderer.domElement);

  window.show = async (text, time) => {
    const bytes = Uint8Array.from(atob(text), (it) => it.charCodeAt(0));
    const { scene, animations, cameras } = await new GLTFLoader().parseAsync(bytes.buffer, "");
    const mixer = new three.AnimationMixer(scene);
    mixer.clipAction(animations[0]).play();
    mixer.setTime(time);
    const stage = new three.Scene();
    stage.background = new three.Color(0xbcd4e6);
    stage.add(scene, new three.HemisphereLight(0xffffff, 0x888888, 1));
    const camera = cameras[0];
    camera.aspect = innerWidth / innerHeight;
    camera.updateProjectionMatrix();
    renderer.render(stage, camera);
  };
`;
