// Colliders that programs move.

import assert from "node:assert/strict";
import { test } from "node:test";

import { CaromError, World } from "carom";

/** Returns a world with a cube of 1 m about the origin, and its id. */
const withCube = (simulation) => {
  const world = new World(simulation);
  return [world, world.addCollider({ shape: { box: { size: [1, 1, 1] } } })];
};

const half = Math.SQRT1_2;

test("a collider is in its next pose after a step of that length", () => {
  const [world, cube] = withCube({ frameTime: 0.5 });
  world.setNextPose(cube, { position: [1, 2, 0] });
  assert.deepEqual(world.colliders[0].velocity, [2, 4, 0]);
  world.step();
  assert.deepEqual(world.colliders[0].position, [1, 2, 0]);
  world.setNextPose(cube, { rotation: [0, half, 0, half] }, 0.25);
  assert.deepEqual(world.colliders[0].velocity, [0, 0, 0], "the position stays");
  // A quarter turn in 0.25 s; rounding of the angle and the quotient.
  assert.ok(Math.abs(world.colliders[0].angularVelocity[1] - 2 * Math.PI) < 4e-15);
  world.step(0.25);
  const { rotation } = world.colliders[0];
  // Rounding of a product of quaternions.
  [0, half, 0, half].forEach((part, i) => assert.ok(Math.abs(rotation[i] - part) < 1e-15));
});

test("a paddle on its way to a pose strikes a ball to twice its speed", () => {
  const [world, cube] = withCube();
  const ball = world.addSphere({ position: [1.5, 0, 0], radius: 0.5, mass: 1 });
  world.setNextPose(cube, { position: [2, 0, 0] }, 1);
  world.step(1);
  const [{ time, between }, ...others] = world.impacts;
  assert.deepEqual([time, between, others], [0.25, { collider: cube, sphere: ball }, []]);
  assert.deepEqual([...world.velocities], [4, 0, 0]);
});

test("a next pose that makes no sense is refused and nothing moves", () => {
  const [world, cube] = withCube();
  const refused = (pose, dt, error) =>
    assert.throws(() => world.setNextPose(cube, pose, dt), error);
  refused({ position: [0, NaN, 0] }, 1, CaromError);
  refused({ rotation: [0, 0, 0, 0] }, 1, CaromError);
  refused({ position: [0, 1, 0] }, 0, CaromError);
  refused({ position: [0, 1] }, 1, /position must be 3 numbers, not 2/);
  refused({ rotation: [0, 1, 0] }, 1, /rotation must be 4 numbers, not 3/);
  refused({ place: [0, 1, 0] }, 1, /a pose has no "place"/);
  assert.throws(() => world.setNextPose(cube + 1, {}), /there is no collider 1/);
  assert.deepEqual(world.colliders[0].velocity, [0, 0, 0]);
  world.setCollider(cube, { motion: { steady: { velocity: [0, 1, 0] } } });
  refused({ position: [0, 1, 0] }, 1, CaromError);
});
