// Persistent contacts, steps to the next impact, and the work of a frame. The engine's own tests
// check forces and times; these tests check that they reach JavaScript unchanged.

import assert from "node:assert/strict";
import { test } from "node:test";

import { CaromError, World } from "carom";

const isNear = (value, expected) => Math.abs(value - expected) <= 1e-12 * Math.max(1, expected);

/**
 * Returns a world with an elastic ball of radius 1 m whose lowest point is 1 m above an elastic
 * floor.
 */
function ballAboveFloor(rule) {
  const world = new World({ rule });
  world.addForce({ gravity: { acceleration: [0, -8, 0] } });
  world.addCollider({ shape: "half-space" });
  world.addSphere({ position: [0, 2, 0], radius: 1 });
  return world;
}

test("each contact of a column carries the weight above it", () => {
  const world = new World({ frameTime: 0.5 });
  world.addForce({ gravity: { acceleration: [0, -9.81, 0] } });
  const floor = world.addCollider({ shape: "half-space", restitution: 0 });
  const ball = (mass, i) => ({ position: [0, 1 + 2 * i, 0], radius: 1, mass, restitution: 0 });
  const [low, middle, high] = world.add({ spheres: [1, 2, 4].map(ball) }).spheres;
  assert.deepEqual(world.contacts, []);
  world.step();
  const { contacts } = world;
  assert.deepEqual(
    contacts.map(({ between }) => between),
    [{ spheres: [low, middle] }, { spheres: [middle, high] }, { collider: floor, sphere: low }],
  );
  [6, 4, 7].forEach((mass, i) => assert.ok(isNear(contacts[i].normalForce, 9.81 * mass)));
  [2, 4, 0].forEach((height, i) => assert.ok(isNear(contacts[i].point[1], height)));
  contacts.forEach(({ normal, gap }) => assert.ok(isNear(normal[1], 1) && isNear(gap, 0)));
});

test("a bouncing ball meets the floor at odd multiples of the time of its fall", () => {
  const world = ballAboveFloor("exact");
  for (const time of [0.5, 1.5, 2.5, 3.5]) {
    assert.ok(isNear(world.nextEventTime(10), time));
    world.stepToNextEvent(10);
    assert.ok(isNear(world.time, time));
    assert.equal(world.impactCount, 1);
    assert.ok(world.velocities[1] > 0);
  }
  assert.equal(world.nextEventTime(0.25), undefined);
});

test("rules by frames refuse to go to the next impact", () => {
  const world = ballAboveFloor("bisect");
  const hash = world.stateHash();
  assert.throws(() => world.stepToNextEvent(1), CaromError);
  assert.throws(() => world.nextEventTime(1), CaromError);
  assert.equal(world.stateHash(), hash);
});

test("the work of a frame follows from the world alone", () => {
  const [world, other] = [ballAboveFloor("exact"), ballAboveFloor("exact")];
  assert.ok(Object.values(world.work).every((count) => count === 0));
  world.step(1);
  other.step(1);
  assert.deepEqual(world.work, other.work);
  assert.ok(world.work.predictions >= 2 && world.work.events >= 1);
  assert.equal(world.work.pairTests, 0);
});

test("a heap that takes too much work is stepped, and says so", () => {
  const heap = (exact) => {
    const world = new World({ exact });
    world.addForce({ gravity: { acceleration: [0, -9.81, 0] } });
    world.addCollider({
      shape: { container: { size: [3.2, 8, 3.2], open: ["top"] } },
      position: [0, 4, 0],
    });
    for (let number = 0; number < 45; number += 1) {
      const [layer, x, z] = [Math.floor(number / 9), number % 3, Math.floor(number / 3) % 3];
      const position = [1.04 * (x - 1), 0.7 + 1.05 * layer, 1.04 * (z - 1)];
      world.addSphere({ position, radius: 0.5, restitution: 0.3 });
    }
    let most = 0;
    for (let frame = 0; frame < 60; frame += 1) {
      world.step(1 / 60);
      most = Math.max(most, world.zoneAccount.spheres);
    }
    return { world, most };
  };
  const { world, most } = heap({ zoneBudget: 2000 });
  assert.ok(most > 20 && world.wasStepped);
  assert.ok(world.contactAccount.largestOverlap < 0.1);
  assert.deepEqual(Object.keys(world.zoneAccount), [
    "spheres",
    "sphereSeconds",
    "ticks",
    "joined",
    "left",
  ]);
  assert.equal(heap({ zones: "never" }).most, 0);
});
