// Snapshots, scene files, changes.

import assert from "node:assert/strict";
import { test } from "node:test";

import { CaromError, Snapshot, World } from "carom";

const step = (world, frames) => {
  for (let frame = 0; frame < frames; frame++) world.step();
  return world;
};

for (const name of ["tutorial3", "tutorial4", "simtest1", "simtest4"]) {
  for (const rule of ["exact", "bisect", "discrete"]) {
    test(`${name} goes from a snapshot as it went before, by ${rule}`, () => {
      const world = step(World.fromScene(name, { "simulation.rule": rule }), 40);
      const before = world.snapshot();
      const hashes = () => Array.from({ length: 60 }, () => step(world, 1).stateHash());
      const first = hashes();
      const colors = [...world.colors];
      world.restore(before);
      assert.deepEqual(hashes(), first);
      assert.deepEqual([...world.colors], colors);
    });
  }
}

test("a snapshot brings back what was added, changed and removed since", () => {
  const world = step(World.fromScene("tutorial4"), 5);
  const [before, text] = [world.snapshot(), world.toToml()];
  const ids = [...world.ids];
  world.removeSphere(ids[0]);
  world.addSphere({ position: [0, 50, 0], radius: 1, color: [1, 0, 0] });
  world.addForce({ viscousDrag: { coefficient: 2 } });
  world.setCollider(world.colliders[0].id, { restitution: 0.1 });
  world.setSimulation({ rule: "discrete", frameTime: 0.5 });
  world.restore(before);
  assert.deepEqual([...world.ids], ids);
  assert.equal(world.toToml(), text);
});

test("a snapshot into the memory of another brings back the later state", () => {
  const world = step(World.fromScene("tutorial4"), 5);
  const before = world.snapshot();
  step(world, 20);
  world.snapshotInto(before);
  const [hash, colors] = [world.stateHash(), [...world.colors]];
  step(world, 20);
  world.restore(before);
  assert.equal(world.stateHash(), hash);
  assert.deepEqual([...world.colors], colors);
});

test("a pair that flies into its well reports a capture at the time and place of the edge", () => {
  const potential = { squareWell: { depth: 1, rangeRatio: 1.5 } };
  const world = new World({ pairPotential: potential });
  world.addSphere({ radius: 0.5, mass: 1 });
  world.addSphere({ radius: 0.5, mass: 1, position: [2, 0, 0], velocity: [-1, 0, 0] });
  world.step(0.625);
  const [event, ...others] = world.wellEvents;
  assert.deepEqual(others, []);
  assert.ok(event.impulse < 0);
  const { impulse: _, ...rest } = event;
  const edge = { time: 0.5, distance: 1.5, normal: [1, 0, 0] };
  assert.deepEqual(rest, { ...edge, kind: "capture", spheres: [0, 1] });
});

test("a snapshot can be restored into another world", () => {
  const world = step(World.fromScene("tutorial4"), 30);
  const other = new World();
  other.restore(world.snapshot());
  assert.equal(step(other, 30).stateHash(), step(world, 30).stateHash());
});

test("a snapshot goes through bytes with every bit and every colour", () => {
  for (const name of ["tutorial4", "simtest3", "spring-chain"]) {
    const world = step(World.fromScene(name), 30);
    world.setSphere(world.ids[0], { color: [0.25, 0.5, 1] });
    const bytes = world.snapshot().toBytes();
    const read = Snapshot.fromBytes(bytes);
    assert.equal(read.time, world.time);
    assert.deepEqual(read.toBytes(), bytes);
    const other = new World();
    other.restore(read);
    assert.deepEqual(other.colors, world.colors.slice());
    assert.equal(other.toToml(), world.toToml());
    assert.equal(step(other, 30).stateHash(), step(world, 30).stateHash());
  }
});

test("bytes that are no snapshot are refused", () => {
  const bytes = step(World.fromScene("tutorial1"), 3).snapshot().toBytes();
  const refused = (given, message) =>
    assert.throws(() => Snapshot.fromBytes(given), { name: "CaromError", message });
  refused(new Uint8Array(9), /no snapshot of Carom/);
  refused(bytes.subarray(0, bytes.length - 1), /damaged/);
  bytes[bytes.length >> 1] ^= 1;
  refused(bytes, /damaged/);
  const snapshot = new World().snapshot();
  snapshot.free();
  assert.throws(() => new World().restore(snapshot), CaromError);
});

test("a world written down at its start runs on alike", () => {
  for (const name of [
    "simtest1",
    "simtest3",
    "tutorial1",
    "tutorial4",
    "spring-chain",
    "planets",
  ]) {
    const world = World.fromScene(name);
    const again = World.fromScene(world.toToml());
    assert.equal(again.stateHash(), world.stateHash());
    assert.equal(step(again, 100).stateHash(), step(world, 100).stateHash());
  }
});

test("a world written down later has its spheres where they are", () => {
  const world = step(World.fromScene("tutorial4"), 60);
  const again = World.fromScene(world.toToml());
  assert.deepEqual(again.positions, world.positions.slice());
  assert.deepEqual(again.velocities, world.velocities.slice());
  assert.deepEqual(again.colors, world.colors.slice());
});

test("a world gives back what code describes", () => {
  const world = new World({ frameTime: 0.01, exact: { contactDuration: 1e-9 } });
  assert.equal(world.simulation.exact.contactDuration, 1e-9);
  const shape = { rectangle: { sizeX: 2, sizeZ: 3 } };
  const id = world.addCollider({ shape, angularVelocity: [0, 1, 0], color: [0, 0.5, 1] });
  const [collider] = world.colliders;
  assert.deepEqual(collider, {
    id,
    name: "",
    shape,
    position: [0, 0, 0],
    rotation: [0, 0, 0, 1],
    velocity: [0, 0, 0],
    angularVelocity: [0, 1, 0],
    restitution: 1,
    trigger: false,
    visible: true,
    color: [0, 0.5, 1],
  });
  const drag = world.addForce({ viscousDrag: { coefficient: 2 } });
  assert.deepEqual(world.forces, [{ id: drag, viscousDrag: { coefficient: 2 } }]);
  world.setSimulation({ boundary: { periodic: { size: [10, 20, Infinity] } } });
  assert.deepEqual(world.simulation.boundary, { periodic: { size: [10, 20, Infinity] } });
  world.setSimulation({ exact: { maxImpacts: 7 } });
  const exact = { impactLaw: "reflection", contactDuration: 1e-9, maxImpacts: 7 };
  assert.deepEqual(world.simulation.exact, exact);
  world.setSimulation({ discrete: { integrator: "velocity-verlet" } });
  assert.deepEqual(world.simulation.discrete, { integrator: "velocity-verlet" });
  assert.deepEqual(world.simulation.exact, exact, "what was not named stays");
  assert.equal(world.frameTime, 0.01, "what was not named stays");
});

test("a world says where a collider that moves is", () => {
  const world = new World({ frameTime: 0.5 });
  world.addCollider({ shape: { sphere: { radius: 1 } }, velocity: [2, 0, 0] });
  step(world, 2);
  assert.deepEqual(world.colliders[0].position, [2, 0, 0]);
});

test("of a sphere only what is named is changed", () => {
  const world = new World();
  const id = world.addSphere({ position: [1, 2, 3], radius: 0.5, mass: 3, restitution: 0.9 });
  const before = world.sphere(id);
  world.setSphere(id, { velocity: [0, 1, 0] });
  assert.deepEqual(world.sphere(id), { ...before, velocity: [0, 1, 0] });
  world.setSphere(id, { diameter: 2, density: 1 });
  const volume = (4 / 3) * Math.PI;
  assert.deepEqual(world.sphere(id).radius, 1);
  // One rounding error of the constant, one of the product.
  assert.ok(Math.abs(world.sphere(id).mass / volume - 1) < 1e-15);
});

test("forces are changed and removed by their ids", () => {
  const world = new World({ rule: "discrete", frameTime: 1 });
  world.addSphere({ radius: 1 });
  const [wind, weight] = world.add({
    forces: [{ constant: { force: [1, 0, 0] } }, { gravity: { acceleration: [0, -1, 0] } }],
  }).forces;
  step(world, 1);
  assert.deepEqual([...world.velocities], [1, -1, 0]);
  world.setForce(weight, { gravity: { acceleration: [0, 1, 0] } });
  world.removeForce(wind);
  step(world, 1);
  assert.deepEqual([...world.velocities], [1, 0, 0]);
});

test("vectors may be whatever yields three numbers", () => {
  class Vector3 {
    *[Symbol.iterator]() {
      yield* [1, 2, 3];
    }
  }
  const world = new World();
  for (const position of [[1, 2, 3], new Float32Array([1, 2, 3]), new Vector3()]) {
    const id = world.addSphere({ position, radius: 0.5 });
    assert.deepEqual(world.sphere(id).position, [1, 2, 3]);
  }
});

test("numbers reach the engine to the bit", () => {
  const world = new World();
  const numbers = [0.1, 1e-300, 2 ** 53 + 2, 1e22, -0, 123456789.123456789, 5e-324, 1 / 3, 1e15];
  for (const x of numbers) {
    const id = world.addSphere({ position: [x, 0, 0], radius: 1 });
    const [first] = world.positions.subarray(3 * world.ids.indexOf(id));
    assert.ok(Object.is(first, x), `${x} became ${first}`);
  }
});

test("names hold what they like, but for control characters", () => {
  const world = new World();
  const name = 'a "floor" \\ ü 🎱 = 1';
  world.addCollider({ name, shape: "half-space" });
  assert.equal(world.colliders[0].name, name);
  assert.equal(World.fromScene(world.toToml()).colliders[0].name, name);
  const steering = () => world.addCollider({ name: "a\u001b[2J", shape: "half-space" });
  assert.throws(steering, /colliders\[0\]\.name: must have no control characters/);
});
