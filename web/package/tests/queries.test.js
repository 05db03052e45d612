// Queries agree with closed forms, predicted paths with what then happens; triggers report all.

import assert from "node:assert/strict";
import { test } from "node:test";

import { CaromError, World } from "carom";

/** Two balls in a row before a wall, and a trigger. */
function row() {
  const world = new World({ frameTime: 0.25 });
  const shape = { box: { size: [1, 1, 1] } };
  const trigger = world.addCollider({ shape, position: [1, 0, 0], trigger: true });
  const near = world.addSphere({ position: [3, 0, 0], radius: 0.5 });
  const far = world.addSphere({ position: [6, 0, 0], radius: 0.5, groups: 2 });
  const wall = world.addCollider({ shape, position: [9, 0, 0] });
  return { world, trigger, near, far, wall };
}

test("a ray meets the front of a ball, and nothing beside it", () => {
  const { world, near } = row();
  const hit = world.castRay([-1, 0, 0], [16, 0, 0]);
  // The ball begins 3.5 m ahead of a way of 16 m; all is dyadic.
  const expected = { body: { sphere: near }, point: [2.5, 0, 0], normal: [-1, 0, 0] };
  assert.deepEqual(hit, { ...expected, fraction: 3.5 / 16 });
  assert.equal(world.castRay([-1, 2, 0], [16, 0, 0]), undefined);
  assert.equal(new World().castRay([0, 0, 0], [1, 0, 0]), undefined);
});

test("many rays in one call have the bits of single ones", () => {
  const world = World.fromScene("tutorial4");
  const ends = Array.from({ length: 60 }, (_, i) => 20 * Math.sin(i + 1));
  const rays = Array.from({ length: 20 }, (_, i) => ends.slice(3 * i, 3 * i + 3));
  const origins = rays.flatMap(() => [0, 30, 0]);
  const single = rays.map((way) => world.castRay([0, 30, 0], way));
  assert.deepEqual(world.castRays(origins, ends), single);
  assert.deepEqual(world.castRays([], []), []);
});

test("a sphere on its way stops its radius before what it meets", () => {
  const { world, near } = row();
  const hit = world.castSphere([-1, 0, 0], 0.25, [16, 0, 0]);
  assert.deepEqual([hit.body, hit.fraction], [{ sphere: near }, 3.25 / 16]);
});

test("the nearest and the overlapping bodies are those with the smallest distances", () => {
  const { world, near, far, wall } = row();
  assert.deepEqual(world.nearest([4, 0, 0]).body, { sphere: near });
  assert.equal(world.nearest([4, 0, 0]).distance, 0.5);
  assert.equal(world.nearest([4, 50, 0], 1), undefined);
  const found = world.overlapping([6, 0, 0], 3);
  assert.deepEqual(
    found.map(({ body }) => body),
    [{ sphere: near }, { sphere: far }, { collider: wall }],
  );
});

test("a filter leaves out what its options say", () => {
  const { world, trigger, near, far, wall } = row();
  const first = (filter) => world.castRay([-1, 0, 0], [16, 0, 0], filter)?.body;
  assert.deepEqual(first({ triggers: true }), { collider: trigger });
  assert.deepEqual(first({ withoutSphere: near }), { sphere: far });
  assert.deepEqual(first({ collidesWith: 2 }), { sphere: far });
  assert.deepEqual(first({ spheres: false }), { collider: wall });
  assert.deepEqual(first({ spheres: false, colliders: false }), undefined);
  assert.throws(() => first({ sphere: false }), { name: "TypeError", message: /no "sphere"/ });
  assert.throws(() => first({ groups: 2 ** 32 }), { name: "TypeError", message: /2\^32/ });
});

test("a predicted path is what then happens, to the bit", () => {
  const world = new World({ frameTime: 1 / 64 });
  world.addForce({ gravity: { acceleration: [0, -9.81, 0] } });
  const floor = world.addCollider({ shape: "half-space", restitution: 0.8 });
  const ball = world.addSphere({ position: [0, 2, 0], velocity: [1, 1, 0], radius: 0.25 });
  world.step();
  const now = world.time;
  const path = world.predict(ball, 3);
  assert.deepEqual([path.end, path.endTime], ["horizon", now + 3]);
  const impacts = [];
  while (world.time < path.endTime) {
    world.step();
    assert.deepEqual(path.positionAt(world.time), Array.from(world.positions));
    assert.deepEqual(path.velocityAt(world.time), Array.from(world.velocities));
    impacts.push(...world.impacts);
  }
  assert.ok(impacts.length > 2);
  const told = ({ between, point, impulse }) => ({ between, point, impulse });
  assert.deepEqual(path.impacts.map(told), impacts.map(told));
  assert.deepEqual(path.impacts[0].between, { collider: floor, sphere: ball });
  assert.equal(path.legs[1].start, path.legs[0].end);
  assert.equal(path.positionAt(path.endTime + 1), undefined);
  assert.deepEqual(world.predict(ball, 9, 1).end, "impacts");
});

test("a sensor of a centimetre sees a ball at 1000 m/s enter and leave", () => {
  const world = new World({ frameTime: 1 });
  const shape = { box: { size: [0.01, 1, 1] } };
  const gate = world.addCollider({ shape, trigger: true });
  const ball = world.addSphere({ position: [-2, 0, 0], velocity: [1000, 0, 0], radius: 0.002 });
  world.step();
  const events = world.sensorEvents;
  assert.deepEqual(
    events.map(({ collider, sphere, enters, speed }) => [collider, sphere, enters, speed]),
    [
      [gate, ball, true, 1000],
      [gate, ball, false, 1000],
    ],
  );
  // 2 m less and more 5 mm and the radius, at 1000 m/s; to rounding.
  assert.ok(Math.abs(events[0].time - 1.993e-3) < 1e-15);
  assert.ok(Math.abs(events[1].time - 2.007e-3) < 1e-15);
  assert.deepEqual(world.triggers, []);
});

test("an impulse beside the centre turns a ball", () => {
  const world = new World();
  const ball = world.addSphere({ position: [1, 0, 0], radius: 0.5, mass: 2 });
  world.applyImpulse(ball, [0, 4, 0]);
  world.applyImpulseAt(ball, [1, 0, 0], [1, 0.5, 0]);
  assert.deepEqual(Array.from(world.velocities), [0.5, 2, 0]);
  // r x J over 2/5 m r^2 = 0.2 kg m^2, to rounding of 0.4.
  assert.ok(Math.abs(world.angularVelocities[2] + 2.5) < 1e-14);
  world.setVelocity(ball, [1, 2, 3]);
  world.setAngularVelocity(ball, new Float32Array([4, 5, 6]));
  assert.deepEqual(Array.from(world.velocities), [1, 2, 3]);
  assert.deepEqual(Array.from(world.angularVelocities), [4, 5, 6]);
});

test("what makes no sense is refused, and the world stays", () => {
  const { world, near } = row();
  const before = world.stateHash();
  const refused = [
    () => world.castRay([0, NaN, 0], [1, 0, 0]),
    () => world.castSphere([0, 0, 0], 0, [1, 0, 0]),
    () => world.nearest([0, 0, 0], -1),
    () => world.overlapping([0, 0, 0], -1),
    () => world.predict(near, 0),
    () => world.predict(99, 1),
    () => world.applyImpulse(99, [0, 0, 0]),
    () => world.setVelocity(near, [Infinity, 0, 0]),
  ];
  for (const call of refused) assert.throws(call, CaromError);
  const wrong = [
    () => world.castRay([0, 0], [1, 0, 0]),
    () => world.castRay("top", [1, 0, 0]),
    () => world.castRays([0, 0, 0], [1, 0, 0, 0, 0, 0]),
    () => world.applyImpulse(near, 3),
  ];
  for (const call of wrong) assert.throws(call, TypeError);
  assert.equal(world.stateHash(), before);
});
