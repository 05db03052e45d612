// Friction and rotation pass between the engine and JavaScript in both directions.

import assert from "node:assert/strict";
import { test } from "node:test";

import { IMPACT_COLUMNS, World } from "carom";

const isNear = (value, expected, tolerance) =>
  Math.abs(value - expected) <= tolerance * Math.abs(expected);

/** Returns a world with a ball that slides on a floor, under the rule `contact`. */
function slidingBall() {
  const world = new World({ rule: "contact" });
  world.addForce({ gravity: { acceleration: [0, -9.81, 0] } });
  world.addCollider({ shape: "half-space", restitution: 0, friction: 0.3 });
  world.addSphere({ position: [0, 0.1, 0], velocity: [1, 0, 0], radius: 0.1 });
  return world;
}

const step = (world, frames) => {
  for (let frame = 0; frame < frames; frame++) world.step();
  return world;
};

test("an impact tells its impulse of friction", () => {
  for (const rule of ["exact", "contact"]) {
    const world = new World({ rule, frameTime: 0.5 });
    world.addCollider({ shape: "half-space", restitution: 0.5, friction: 0.25 });
    world.addSphere({ position: [0, 0.8, 0], velocity: [4, -2, 0], radius: 0.1, mass: 2 });
    world.step();
    const [{ impulse, tangentialImpulse }] = world.impacts;
    // It slides throughout: friction takes 0.25 of m (1 + e) v.
    assert.ok(isNear(impulse, 6, 1e-12));
    assert.ok(isNear(tangentialImpulse[0], -1.5, 1e-12));
    assert.equal(world.impactTable[IMPACT_COLUMNS.tangentialImpulse], tangentialImpulse[0]);
  }
});

test("a ball that slides comes to roll", () => {
  const world = step(slidingBall(), 60);
  // A solid ball that slid at 1 m/s rolls at 5/7 of that; sub-steps find that time to within their
  // length.
  assert.ok(isNear(world.velocities[0], 5 / 7, 0.01));
  assert.ok(isNear(world.angularVelocities[2], -50 / 7, 0.01));
  assert.ok(isNear(Math.hypot(...world.orientations), 1, 1e-12));
  assert.notEqual(world.orientations[3], 1);
  const energy = 0.2 * 0.01 * world.angularVelocities[2] ** 2;
  assert.ok(isNear(world.rotationalEnergy(), energy, 1e-12));
  assert.ok(world.kineticEnergy() > world.rotationalEnergy());
});

test("a ball on a belt comes to roll at two sevenths of its speed", () => {
  const world = new World({ rule: "exact" });
  world.addForce({ gravity: { acceleration: [0, -9.81, 0] } });
  world.addCollider({ shape: "half-space", friction: 0.3, surfaceVelocity: [0.7, 0, 0] });
  world.addSphere({ position: [0, 0.1, 0], radius: 0.1, restitution: 0 });
  assert.ok(isNear(step(world, 60).velocities[0], 0.2, 1e-12));
});

test("a law gives the restitution at the speed of an impact", () => {
  const world = new World({ rule: "exact", frameTime: 0.5 });
  const restitutionLaw = { powerLaw: { speed: 0.25 } };
  world.addCollider({ shape: "half-space", restitutionLaw });
  world.addSphere({ position: [0, 1.1, 0], velocity: [0, -4, 0], radius: 0.1 });
  world.step();
  // 4 m/s is 16 times the speed, and 16 to the power of -1/4 is 1/2.
  assert.ok(isNear(world.velocities[1], 2, 1e-12));
});

test("contacts and the account tell of friction", () => {
  const world = step(slidingBall(), 1);
  const [contact] = world.contacts;
  assert.equal(contact.isSliding, true);
  const [along, up, across] = contact.tangentialForce;
  assert.ok(isNear(along, -0.3 * contact.normalForce, 1e-12));
  assert.ok(Math.abs(up) < 1e-12 && Math.abs(across) < 1e-12);
  const energies = world.energyAccount;
  assert.ok(energies.contacts < 0);
  assert.deepEqual(
    { ...energies, contacts: 0 },
    {
      contacts: 0,
      colliders: 0,
      kicks: 0,
      growth: 0,
      shear: 0,
      thermostat: 0,
      forces: 0,
      applied: 0,
      correction: 0,
      emission: 0,
      integration: 0,
    },
  );
  const account = world.contactAccount;
  assert.equal(account.asleep, 0);
  const { searches, sweeps, contacts } = world.work;
  assert.ok(searches > 0 && sweeps >= 8 && contacts === 1);
  assert.deepEqual(Object.keys(account), [
    "limitedSubSteps",
    "residual",
    "largestOverlap",
    "asleep",
    "squeezed",
  ]);
});

test("a ball that lies still falls asleep, and the account counts it", () => {
  const world = slidingBall();
  world.setSphere(0, { velocity: [0, 0, 0] });
  // Half a second at rest, and some frames until it is at rest.
  assert.equal(step(world, 60).contactAccount.asleep, 1);
});

test("by `exact` friction acts and takes energy, by `discrete` there is none", () => {
  const world = slidingBall();
  world.setSimulation({ rule: "exact" });
  step(world, 2);
  assert.ok(Object.values(world.contactAccount).every((value) => value === 0));
  assert.ok(world.energyAccount.contacts < 0);
  const { tangentialForce, normalForce, isSliding } = world.contacts[0];
  assert.ok(isSliding);
  assert.ok(isNear(tangentialForce[0], -0.3 * normalForce, 1e-9));
  world.setSimulation({ rule: "discrete" });
  step(world, 2);
  assert.deepEqual(world.contacts, []);
});

test("a world has spin where something turns, or friction can turn it", () => {
  const world = new World();
  assert.equal(world.hasSpin, false);
  const id = world.addSphere({ radius: 1, angularVelocity: [0, 1, 0] });
  assert.equal(world.hasSpin, true);
  world.removeSphere(id);
  world.addSphere({ radius: 1, friction: 0.5 });
  world.setSimulation({ rule: "discrete" });
  assert.equal(world.hasSpin, false, "by `discrete` friction does not act");
  world.setSimulation({ rule: "contact" });
  assert.equal(world.hasSpin, true);
});

test("usual spheres are not turned, solid, and say nothing of friction", () => {
  const world = new World();
  world.add({ spheres: [{ radius: 1 }, { radius: 1, position: [3, 0, 0] }] });
  assert.deepEqual([...world.orientations], [0, 0, 0, 1, 0, 0, 0, 1]);
  assert.deepEqual([...world.angularVelocities], [0, 0, 0, 0, 0, 0]);
  assert.deepEqual([...world.inertiaFactors], [0.4, 0.4]);
  for (const name of FRICTIONS) assert.deepEqual([...world[name]], [NaN, NaN]);
  assert.equal(world.orientations, world.orientations);
});

const FRICTIONS = ["frictions", "rollingFrictions", "spinningFrictions", "tangentialRestitutions"];

/** Returns the friction of all spheres of a world. */
const said = (world) =>
  Array.from({ length: world.count }, (_, i) => FRICTIONS.map((name) => world[name][i]));

test("arrays of friction follow what is added, changed, removed, and restored", () => {
  const world = new World();
  const silent = [NaN, NaN, NaN, NaN];
  const place = (x) => ({ position: [x, 0, 0], radius: 0.5 });
  const [first, second] = world.add({ spheres: [place(0), place(2)] }).spheres;
  const all = { rollingFriction: 0.01, spinningFriction: 0.02, tangentialRestitution: 0.5 };
  world.addSphere({ ...place(4), friction: 0.3, ...all });
  const rough = [0.3, 0.01, 0.02, 0.5];
  assert.deepEqual(said(world), [silent, silent, rough]);
  const before = world.snapshot();
  world.setSphere(second, { friction: 0.2 });
  assert.deepEqual(said(world), [silent, [0.2, NaN, NaN, NaN], rough]);
  world.removeSphere(first);
  assert.deepEqual(said(world), [[0.2, NaN, NaN, NaN], rough]);
  world.addSphere(place(6));
  assert.deepEqual(said(world), [[0.2, NaN, NaN, NaN], rough, silent]);
  world.restore(before);
  assert.deepEqual(said(world), [silent, silent, rough]);
});

test("arrays of friction and rotation follow emitters", () => {
  const spin = { friction: 0.25, angular_velocity: [0, 3, 0], inertia_factor: 0.5 };
  const changes = Object.entries(spin).map(([name, it]) => [`emitters.0.sphere.${name}`, it]);
  const world = World.fromScene("simtest1", {
    "emitters.0.max_spheres": 3,
    ...Object.fromEntries(changes),
  });
  step(world, 500);
  assert.equal(world.count, 3);
  assert.deepEqual([...world.frictions], [0.25, 0.25, 0.25]);
  assert.deepEqual([...world.inertiaFactors], [0.5, 0.5, 0.5]);
  assert.deepEqual([...world.angularVelocities], [0, 3, 0, 0, 3, 0, 0, 3, 0]);
  assert.equal(world.orientations.length, 12);
});

test("an emitter that needs room leaves spheres out, and says which", () => {
  const world = World.fromScene(`
    name = "full"
    [[emitters]]
    period = 0.5
    needs_room = true
    sphere = { radius = 0.1 }
  `);
  world.step(1.2);
  assert.deepEqual([...world.emitted], [0]);
  assert.deepEqual(world.leftOut, [1, 2]);
  assert.deepEqual([...world.ids], [0]);
});

test("a sphere gives back what it was added with", () => {
  const spun = {
    friction: 0.3,
    rollingFriction: 0.01,
    spinningFriction: 0.02,
    tangentialRestitution: 0.5,
    orientation: [0, 1, 0, 0],
    angularVelocity: [1, 2, 3],
    inertiaFactor: 0.5,
  };
  const world = new World();
  const id = world.addSphere({ radius: 0.5, ...spun });
  const kept = world.sphere(id);
  for (const [name, value] of Object.entries(spun)) assert.deepEqual(kept[name], value);
  assert.deepEqual([...world.orientations], spun.orientation);
  assert.deepEqual([...world.angularVelocities], spun.angularVelocity);
  assert.deepEqual([...world.inertiaFactors], [0.5]);
  world.setSphere(id, { friction: null });
  assert.equal(world.sphere(id).friction, undefined);
  assert.equal(world.sphere(id).rollingFriction, 0.01);
});

test("to read what no sphere has moves no other array", () => {
  const world = new World();
  const counts = [60, 60, 60];
  const generator = { counts, start: [0, 0, 0], spacing: [1, 1, 1], sphere: { radius: 0.4 } };
  world.add({ generators: [{ lattice: generator }] });
  const { positions } = world;
  for (const name of ["orientations", "angularVelocities", "inertiaFactors", ...FRICTIONS]) {
    assert.ok(world[name].length >= 60 ** 3);
  }
  assert.equal(world.positions, positions);
  assert.equal(positions.length, 3 * 60 ** 3);
});
