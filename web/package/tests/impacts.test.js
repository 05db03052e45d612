// The report of a frame.

import assert from "node:assert/strict";
import { test } from "node:test";

import { IMPACT_COLUMNS, World } from "carom";

test("a dropped ball meets the floor when and as hard as the fall says", () => {
  const world = new World({ frameTime: 1 });
  world.addForce({ gravity: { acceleration: [0, -10, 0] } });
  const floor = world.addCollider({ shape: "half-space", restitution: 0.5 });
  const ball = world.addSphere({ position: [3, 1.3, 0], radius: 0.5, mass: 2 });
  world.step();
  const [impact] = world.impacts;
  // It falls 0.8 m: 0.4 s, 4 m/s. Rounding errors only.
  const isNear = (value, expected) => Math.abs(value - expected) < 1e-12;
  assert.ok(isNear(impact.time, 0.4) && isNear(impact.approachSpeed, 4));
  assert.ok(isNear(impact.separationSpeed, 2) && isNear(impact.impulse, 12));
  assert.deepEqual(impact.between, { collider: floor, sphere: ball });
  assert.deepEqual(
    [impact.point, impact.normal],
    [
      [3, 0, 0],
      [0, 1, 0],
    ],
  );
});

test("two spheres are named by their ids, the smaller one first", () => {
  const world = new World({ frameTime: 1 });
  world.addSphere({ position: [0, 9, 0], radius: 0.1 });
  const left = world.addSphere({ position: [-1, 0, 0], velocity: [2, 0, 0], radius: 0.5 });
  const right = world.addSphere({ position: [1, 0, 0], radius: 0.5 });
  world.step();
  const [{ between, normal, time }] = world.impacts;
  assert.deepEqual([between, normal, time], [{ spheres: [left, right] }, [1, 0, 0], 0.5]);
});

test("table and objects tell the same, also when there are many", () => {
  const world = World.fromScene("tutorial4");
  let most = 0;
  for (let frame = 0; frame < 150; frame++) {
    world.step();
    const { impacts, impactTable, impactCount } = world;
    assert.equal(impacts.length, impactCount);
    assert.equal(impactTable.length, IMPACT_COLUMNS.count * impactCount);
    impacts.forEach((impact, i) => {
      const row = impactTable.subarray(i * IMPACT_COLUMNS.count);
      assert.equal(row[IMPACT_COLUMNS.time], impact.time);
      assert.equal(row[IMPACT_COLUMNS.impulse], impact.impulse);
      assert.equal(row[IMPACT_COLUMNS.normal + 1], impact.normal[1]);
      assert.equal(row[IMPACT_COLUMNS.isCollider] === 1, "collider" in impact.between);
    });
    most = Math.max(most, impactCount);
  }
  assert.ok(most > 5, "there were hardly any impacts: this test proves nothing");
});

test("impacts are those of the last frame only", () => {
  const world = new World({ frameTime: 1 });
  world.add({
    spheres: [-1, 1].map((x) => ({ position: [x, 0, 0], velocity: [-2 * x, 0, 0], radius: 0.5 })),
  });
  world.step();
  assert.equal(world.impacts.length, 1);
  world.step();
  assert.deepEqual(world.impacts, []);
});

test("a trigger tells which spheres are in it, and deflects none", () => {
  const world = new World({ frameTime: 1 });
  const gate = world.addCollider({ shape: { box: { size: [1, 1, 1] } }, trigger: true });
  const ball = world.addSphere({ position: [-2, 0, 0], velocity: [1.5, 0, 0], radius: 0.25 });
  world.step();
  assert.deepEqual(world.triggers, [{ collider: gate, sphere: ball }]);
  world.step();
  assert.deepEqual(world.triggers, []);
  assert.deepEqual([...world.velocities], [1.5, 0, 0]);
});

test("in Newton's cradle only the last ball leaves, as fast as the first came", () => {
  const world = new World();
  const ball = (x, speed) => ({ position: [x, 0, 0], velocity: [speed, 0, 0], radius: 0.5 });
  world.add({ spheres: [ball(-1, 1), ...[1, 2, 3, 4].map((x) => ball(x, 0))] });
  for (let frame = 0; frame < 120; frame++) world.step();
  const speeds = [...world.velocities].filter((_, i) => i % 3 === 0);
  assert.deepEqual(speeds, [0, 0, 0, 0, 1]);
  assert.equal(world.kineticEnergy(), 0.5);
  assert.deepEqual(world.momentum(), [1, 0, 0]);
});

test("energy is the sum of its kinds, and stays without loss", () => {
  const world = new World();
  world.addForce({ gravity: { acceleration: [0, -9.81, 0] } });
  world.addCollider({ shape: "half-space" });
  world.addSphere({ position: [0, 2, 0], radius: 0.5, density: 1000 });
  const energy = world.totalEnergy();
  for (let frame = 0; frame < 600; frame++) world.step();
  assert.equal(world.totalEnergy(), world.kineticEnergy() + world.potentialEnergy());
  // A few rounding errors at each of about ten bounces.
  assert.ok(Math.abs(world.totalEnergy() / energy - 1) < 1e-13);
});
