// WebAssembly gives the same bits as the native engine. Not tested: scenes that are not built in,
// and longer runs. Fails if a compiler fuses, reorders or replaces arithmetic.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";

import { scenes, World } from "carom";

const native = JSON.parse(readFileSync(new URL("native_hashes.json", import.meta.url), "utf8"));

/**
 * Returns the number of frames of a run of this duration [s]; a billionth of a frame is rounding.
 */
function frames(seconds, frameTime) {
  return Math.ceil(seconds / frameTime - 1e-9);
}

test("every built-in scene is listed, under the name by which it is found", () => {
  const listed = scenes().map(({ name }) => name);
  assert.deepEqual(listed.sort(), Object.keys(native).sort());
  for (const { name, title } of scenes()) {
    assert.equal(World.fromScene(name).scene.name, name);
    if (title !== "") assert.equal(World.fromScene(title).scene.name, name);
  }
});

for (const [name, hash] of Object.entries(native)) {
  test(`${name} has the state hash of the native engine after 10 s`, () => {
    const world = World.fromScene(name);
    for (let i = frames(10, world.frameTime); i > 0; i--) world.step();
    assert.equal(world.stateHash(), hash);
  });
}
