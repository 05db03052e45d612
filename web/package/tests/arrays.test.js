// Arrays are the engine's own memory, even after the memory has moved.

import assert from "node:assert/strict";
import { test } from "node:test";

import { World } from "carom";

/** More spheres than the initial memory of a module can hold. */
const CROWD = {
  lattice: {
    counts: [60, 60, 60],
    start: [0, 0, 0],
    spacing: [1, 1, 1],
    sphere: { radius: 0.4 },
  },
};

function falling() {
  const world = new World({ rule: "discrete", frameTime: 0.1 });
  world.addForce({ gravity: { acceleration: [0, -10, 0] } });
  world.addSphere({ position: [1, 2, 3], radius: 0.5, mass: 4 });
  return world;
}

test("a view taken before a step shows what the step did: nothing is copied", () => {
  const world = falling();
  const { positions, velocities } = world;
  world.step();
  assert.deepEqual([...velocities], [0, -1, 0]);
  assert.deepEqual([...positions], [1, 1.9, 3]);
  assert.equal(world.positions, positions);
});

test("all arrays of all worlds lie in one buffer", () => {
  const [a, b] = [falling(), World.fromScene("tutorial3")];
  const buffers = [a, b].flatMap((world) => [
    world.positions.buffer,
    world.velocities.buffer,
    world.radii.buffer,
    world.masses.buffer,
    world.ids.buffer,
    world.colors.buffer,
    world.impactTable.buffer,
  ]);
  assert.equal(new Set(buffers).size, 1);
});

test("when the memory grows, old views are gone, and new ones show the same numbers", () => {
  const world = falling();
  const old = world.positions;
  const crowd = new World();
  crowd.add({ generators: [CROWD] });
  assert.equal(old.length, 0, "the memory has not grown: this test proves nothing");
  assert.notEqual(world.positions.buffer, old.buffer);
  assert.deepEqual([...world.positions], [1, 2, 3]);
  assert.deepEqual([...world.masses], [4]);
  world.step();
  assert.deepEqual([...world.positions], [1, 1.9, 3]);
  assert.equal(crowd.positions.length, 3 * 60 ** 3);
  assert.deepEqual([...crowd.positions.slice(-3)], [59, 59, 59]);
});

test("arrays grow with what emitters bring, and shrink with what they take", () => {
  const world = World.fromScene("simtest1", { "emitters.0.max_spheres": 3 });
  let [emitted, retired] = [0, 0];
  for (let frame = 0; frame < 500; frame++) {
    world.step();
    emitted += world.emitted.length;
    retired += world.retired.length;
    assert.equal(world.count, emitted - retired);
    for (const { length } of [world.positions, world.velocities, world.colors]) {
      assert.equal(length, 3 * world.count);
    }
    assert.equal(world.ids.length, world.count);
    assert.equal(world.ids.at(-1), emitted - 1, "ids count up, and the newest is there");
  }
  assert.ok(retired > 0);
});

test("a removed sphere leaves every array, and its id is not given again", () => {
  const world = new World();
  const color = (red) => [red, 0, 0];
  const place = (x) => ({ position: [x, 0, 0], radius: 0.1 * (x + 1), color: color(x / 4) });
  const ids = world.add({ spheres: [0, 1, 2].map(place) }).spheres;
  world.removeSphere(ids[1]);
  const last = world.addSphere(place(3));
  assert.deepEqual([...world.ids], [ids[0], ids[2], last]);
  assert.ok(!ids.includes(last));
  assert.deepEqual([...world.positions], [0, 0, 0, 2, 0, 0, 3, 0, 0]);
  assert.deepEqual([...world.colors], [0, 0, 0, 0.5, 0, 0, 0.75, 0, 0]);
});

test("spheres have the colours of their densities in the scene", () => {
  const world = World.fromScene("tutorial4");
  const { densities } = world.scene.colors;
  const { masses, radii, colors } = world;
  masses.forEach((mass, i) => {
    const density = mass / ((4 / 3) * Math.PI * radii[i] ** 3);
    const { color } = densities.find((listed) => Math.abs(listed.density / density - 1) < 1e-9);
    assert.deepEqual([...colors.subarray(3 * i, 3 * i + 3)], color.map(Math.fround));
  });
  const id = world.addSphere({ radius: 0.1, density: 2000 });
  assert.deepEqual(world.sphere(id).color, densities[1].color, "added ones, too");
});

test("matrices turn the unit sphere as spheres are turned", () => {
  const world = new World();
  // A third of a turn about (1, 1, 1) maps x to y, y to z, z to x.
  world.addSphere({ position: [7, 8, 9], radius: 2, orientation: [0.5, 0.5, 0.5, 0.5] });
  const matrix = new Float64Array(16).fill(NaN);
  world.writeMatrices(matrix);
  assert.deepEqual([...matrix], [0, 2, 0, 0, 0, 0, 2, 0, 2, 0, 0, 0, 7, 8, 9, 1]);
});

test("matrices take the unit sphere to each sphere", () => {
  const world = World.fromScene("tutorial3");
  const matrices = new Float32Array(16 * world.count).fill(7);
  world.writeMatrices(matrices);
  const { positions, radii, count } = world;
  for (let i = 0; i < count; i++) {
    const [x, y, z] = positions.subarray(3 * i, 3 * i + 3);
    const r = radii[i];
    const expected = [r, 0, 0, 0, 0, r, 0, 0, 0, 0, r, 0, x, y, z, 1].map(Math.fround);
    assert.deepEqual([...matrices.subarray(16 * i, 16 * i + 16)], expected);
  }
  assert.throws(() => world.writeMatrices(new Float32Array(16)), RangeError);
});
