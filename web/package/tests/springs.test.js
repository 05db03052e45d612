// Springs are added to a running world, changed and removed.

import assert from "node:assert/strict";
import { test } from "node:test";

import { CaromError, SceneError, World } from "carom";

const BALLS = `name = "springs"
spheres = [{ radius = 0.1 }, { position = [1, 0, 0], radius = 0.1 }, { position = [2.5, 0, 0], radius = 0.1 }]`;
const SPRINGS = `springs = [
  { spheres = [0, 1], rest_length = 0.5, stiffness = 10, damping = 0.25 },
  { sphere = 2, anchor = [4, 0, 0], stiffness = 20, only_pulls = true },
]`;

/** Returns a world with the balls, after adding the springs one by one. */
function joined() {
  const world = World.fromScene(BALLS);
  const pair = { spheres: [0, 1], restLength: 0.5, stiffness: 10, damping: 0.25 };
  assert.equal(world.addSpring(pair), 0);
  const thread = { sphere: 2, anchor: [4, 0, 0], stiffness: 20, onlyPulls: true };
  assert.equal(world.addSpring(thread), 1);
  return world;
}

const step = (world, frames) => {
  for (let frame = 0; frame < frames; frame++) world.step();
  return world;
};

test("springs that are added make the bits of a scene with them", () => {
  const scene = World.fromScene(`${BALLS}\n${SPRINGS}`);
  const world = joined();
  assert.deepEqual(world.springs, scene.springs);
  assert.equal(step(world, 50).stateHash(), step(scene, 50).stateHash());
  assert.notEqual(step(World.fromScene(BALLS), 50).stateHash(), scene.stateHash());
});

test("a world says which springs it has, by ids of spheres", () => {
  const world = joined();
  world.removeSphere(0);
  // The spring of that sphere was removed with it; a spring without a length is at rest when added.
  const thread = { id: 1, sphere: 2, anchor: [4, 0, 0], restLength: 1.5, stiffness: 20 };
  assert.deepEqual(world.springs, [{ ...thread, damping: 0, onlyPulls: true }]);
  const id = world.addSpring({ spheres: world.ids, stiffness: "2 kN/m" });
  assert.deepEqual([id, world.springs[1].spheres, world.springs[1].stiffness], [2, [1, 2], 2000]);
  // In a scene file, spheres are numbered.
  assert.deepEqual(World.fromScene(world.toToml()).springs[1].spheres, [0, 1]);
});

test("a spring that is changed or removed acts so", () => {
  const world = joined();
  world.setSpring(0, { stiffness: 30 });
  // k x² / 2, stretched by 0.5 m.
  assert.equal(world.potentialEnergy(), 0.5 * 30 * 0.25);
  world.setSpring(0, { sphere: 0, anchor: [0, 2.5, 0] });
  assert.equal(world.potentialEnergy(), 0.5 * 30 * 4);
  world.setSpring(0, { anchor: [0, 1.5, 0] });
  assert.equal(world.potentialEnergy(), 0.5 * 30 * 1);
  assert.deepEqual([world.springs[0].damping, world.springs[0].restLength], [0.25, 0.5]);
  world.removeSpring(0);
  assert.deepEqual([world.springs.length, world.potentialEnergy()], [1, 0]);
  assert.throws(() => world.removeSpring(0), /there is no spring 0 in this world/);
  assert.throws(() => world.setSpring(0, { damping: 1 }), /there is no spring 0 in this world/);
});

const REFUSED = {
  "a stiffness of NaN": [
    { spheres: [0, 1], stiffness: NaN },
    SceneError,
    /stiffness: must be zero/,
  ],
  "a negative damping": [
    { spheres: [0, 1], stiffness: 1, damping: -1 },
    SceneError,
    /damping: must/,
  ],
  "a negative length": [
    { spheres: [0, 1], stiffness: 1, restLength: -1 },
    SceneError,
    /restLength:/,
  ],
  "a point that is none": [{ sphere: 0, anchor: [0, NaN, 0], stiffness: 1 }, SceneError, /anchor:/],
  "both ends at one sphere": [{ spheres: [1, 1], stiffness: 1 }, SceneError, /must be two spheres/],
  "one end": [{ sphere: 0, stiffness: 1 }, SceneError, /needs `spheres`/],
  "a chain": [{ chain: [0, 2], stiffness: 1 }, SceneError, /chain: a running world takes/],
  "a sphere that is not there": [{ spheres: [0, 7], stiffness: 1 }, CaromError, /no sphere 7 in/],
  "half an id": [{ spheres: [0, 1.5], stiffness: 1 }, SceneError, /springs\[0\]\.spheres/],
  "no stiffness": [{ spheres: [0, 1] }, SceneError, /stiffness/],
  "a misspelled field": [{ spheres: [0, 1], stifness: 1 }, SceneError, /stifness/],
};

for (const [what, [spring, kind, message]] of Object.entries(REFUSED)) {
  test(`${what} is refused, and the world is as it was`, () => {
    const world = joined();
    const before = world.springs;
    const isSo = (error) => error instanceof kind && message.test(error.message);
    assert.throws(() => world.addSpring(spring), isSo);
    assert.deepEqual(world.springs, before);
    assert.equal(world.addSpring({ spheres: [0, 2], stiffness: 1 }), 2);
  });
}

test("a snapshot brings springs back", () => {
  const world = joined();
  const [before, springs] = [world.snapshot(), world.springs];
  world.removeSpring(1);
  world.setSpring(0, { stiffness: 1 });
  world.restore(before);
  assert.deepEqual(world.springs, springs);
});
