// Changes of running worlds: strikes, applied forces, emitters, pairs of materials.

import assert from "node:assert/strict";
import { test } from "node:test";

import { CaromError, SceneError, World } from "carom";

const near = (value, expected, tolerance) =>
  assert.ok(Math.abs(value - expected) <= tolerance, `${value} is not ${expected}`);

test("a strike above the centre gives the speed and the spin of a free cue", () => {
  const world = new World();
  const ball = world.addSphere({ radius: 1, mass: 1 });
  assert.equal(world.hasSpin, false);
  world.strike(ball, { speed: 3, cueMass: 1, azimuthDegrees: 90, offset: [0, 0.5] });
  // 2 v / (1 + m / M + 5/2 b²) along -z, and 5/2 b / r of it about -x, up to rounding.
  const speed = (2 * 3) / (2 + 2.5 * 0.25);
  near(world.velocities[2], -speed, 1e-14);
  near(world.angularVelocities[0], -1.25 * speed, 1e-14);
  assert.equal(world.hasSpin, true);
});

test("a strike that makes no sense is refused and nothing moves", () => {
  const world = new World();
  const ball = world.addSphere({ radius: 1, mass: 1 });
  const refused = (strike, field) =>
    assert.throws(() => world.strike(ball, strike), { name: "SceneError", field });
  refused({ speed: -1 }, "spheres[0].strike.speed");
  refused({ speed: 1, offset: [0, 1] }, "spheres[0].strike.offset");
  refused({ speed: 1, cueMas: 1 }, "spheres[0].strike.cueMas");
  assert.throws(() => world.strike(ball), CaromError);
  assert.throws(() => world.strike(ball + 1, { speed: 1 }), /there is no sphere 1/);
  assert.deepEqual([...world.velocities], [0, 0, 0]);
});

test("an applied force accelerates its sphere only, until it is removed", () => {
  const world = new World();
  world.addSphere({ radius: 1, mass: 2 });
  world.addSphere({ position: [9, 0, 0], radius: 1, mass: 2 });
  assert.deepEqual([...world.appliedForces], [0, 0, 0, 0, 0, 0]);
  world.setAppliedForces([0, 4, 0, 0, 0, 0]);
  assert.deepEqual([...world.appliedForces], [0, 4, 0, 0, 0, 0]);
  world.step(0.5);
  assert.deepEqual([...world.velocities], [0, 1, 0, 0, 0, 0]);
  assert.equal(world.energyAccount.applied, 1);
  assert.throws(() => world.setAppliedForces([0, 1, 0]), CaromError);
  assert.throws(() => world.setAppliedForces([0, NaN, 0, 0, 0, 0]), CaromError);
  assert.throws(() => world.setAppliedForces([0, 1]), /forces must be 3 numbers, not 2/);
  world.setAppliedForces([]);
  world.step(0.5);
  assert.deepEqual([...world.velocities], [0, 1, 0, 0, 0, 0]);
});

test("an emitter is added, changed and removed by its id", () => {
  const world = new World();
  const sphere = { radius: 0.125, mass: 1, velocity: [1, 0, 0], color: [1, 0, 0] };
  const source = world.addEmitter({ position: [0, 9, 0], period: 0.5, maxSpheres: 2, sphere });
  world.step(1.25);
  assert.deepEqual([world.emitted, world.retired], [[0, 1, 2], [0]]);
  // The second starts at 0.5 s and the third at 1 s.
  assert.deepEqual([...world.positions], [0.75, 9, 0, 0.25, 9, 0]);
  assert.deepEqual([...world.colors.subarray(0, 3)], [1, 0, 0]);
  world.setEmitter(source, { sphere: { ...sphere, radius: 0.25 } });
  const [now] = world.emitters;
  assert.deepEqual([now.id, now.period, now.maxSpheres, now.sphere.radius], [source, 0.5, 2, 0.25]);
  world.step(0.5);
  assert.deepEqual([...world.radii], [0.125, 0.25]);
  assert.throws(() => world.addEmitter({ period: 0, sphere }), SceneError);
  assert.throws(() => world.setEmitter(source + 1, now), CaromError);
  world.removeEmitter(source);
  world.step(2);
  assert.deepEqual([world.emitters, world.count], [[], 2]);
  assert.throws(() => world.removeEmitter(source), /there is no emitter/);
});

const CUP = `
name = "cup"
materials = { ivory = {}, slate = {} }
colliders = [{ shape = "half-space", material = "slate" }]
spheres = [{ radius = 1, position = [0, 2, 0], velocity = [0, -4, 0], material = "ivory" }]
`;

test("a pair of materials has its own restitution", () => {
  const world = World.fromScene(CUP);
  assert.deepEqual(world.materialPairs, []);
  const given = { restitution: 0.25, rollingFriction: 0.5, nonAdditivity: 0 };
  const pairs = [{ materials: ["slate", "ivory"], ...given }];
  world.setMaterialPairs(pairs);
  assert.deepEqual(world.materialPairs, pairs);
  assert.deepEqual(World.fromScene(world.toToml()).materialPairs, pairs);
  world.step(0.5);
  assert.deepEqual([...world.velocities], [0, 1, 0]);
  const [group, ...others] = world.impactGroups;
  assert.deepEqual([group.first, group.count, others], [0, 1, []]);
  // A sixteenth of the energy stays, as the restitution demands.
  assert.equal(group.energyAfter, group.energyBefore / 16);
  assert.equal(group.energyDemanded, group.energyAfter - group.energyBefore);
  assert.deepEqual([group.momentumBefore[1], group.momentumAfter[1]], [-4, -4]);
  const unknown = () => world.setMaterialPairs([{ materials: ["ivory", "cork"] }]);
  assert.throws(unknown, { name: "SceneError", field: "materialPairs[0].materials" });
  assert.deepEqual(world.materialPairs, pairs);
  world.setMaterialPairs([]);
  assert.deepEqual(world.materialPairs, []);
});

test("overlaps have the bodies and the depth", () => {
  const world = new World({ rule: "discrete" });
  const floor = world.addCollider({ shape: "half-space" });
  world.addSphere({ position: [0, 0.75, 0], radius: 1 });
  world.addSphere({ position: [1.5, 5, 0], radius: 1 });
  world.addSphere({ position: [1.5, 6.5, 0], radius: 1 });
  assert.deepEqual(world.overlaps(), [
    { between: { spheres: [1, 2] }, depth: 0.5 },
    { between: { collider: floor, sphere: 0 }, depth: 0.25 },
  ]);
  assert.equal(world.overlaps(0.25).length, 1);
  assert.throws(() => world.overlaps(-1), CaromError);
});

test("the longest stable frame is two over the frequency of a spring", () => {
  const world = new World({ rule: "discrete" });
  assert.equal(world.longestStableFrame, Infinity);
  const ball = world.addSphere({ radius: 0.5, mass: 4, restitution: 0.5 });
  world.addSpring({ sphere: ball, anchor: [0, 1, 0], stiffness: 16 });
  assert.equal(world.longestStableFrame, 1);
  assert.deepEqual([[...world.restitutions], world.unfinishedIslands], [[0.5], 0]);
});
