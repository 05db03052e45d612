// Invalid calls are refused with clear messages and change nothing.

import assert from "node:assert/strict";
import { test } from "node:test";

import { CaromError, SceneError, World } from "carom";

/** Returns the error that a call throws. */
function thrown(call) {
  try {
    call();
  } catch (error) {
    return error;
  }
  throw new Error("nothing was thrown");
}

function world() {
  const world = new World();
  world.addForce({ gravity: { acceleration: [0, -9.81, 0] } });
  world.addCollider({ shape: "half-space", restitution: 0.7 });
  world.addSphere({ position: [0, 2, 0], radius: 0.5 });
  for (let frame = 0; frame < 30; frame++) world.step();
  return world;
}

test("the error of a wrong scene names its field and line, and what was probably meant", () => {
  const text = 'name = "mine"\n\n[[spheres]]\nradus = 0.5\n';
  const error = thrown(() => World.fromScene(text));
  assert.ok(error instanceof SceneError && error instanceof CaromError && error instanceof Error);
  assert.deepEqual([error.name, error.line], ["SceneError", 4]);
  assert.match(error.message, /scene:4: .*`radus`.*did you mean "radius"\?/);
});

test("the error of a name that is nearly that of a scene names that scene", () => {
  assert.match(thrown(() => World.fromScene("simtst1")).message, /did you mean "simtest1"\?/);
});

test("an override is to blame for what it breaks", () => {
  const error = thrown(() => World.fromScene("simtest1", { "simulation.frame_time": -1 }));
  assert.ok(error instanceof SceneError);
  assert.equal(error.field, "simulation.frame_time");
  assert.match(error.message, /simulation\.frame_time=-1: .*must be positive and finite/);
});

test("an override changes numbers, words, lists, and takes fields out", () => {
  const changes = {
    "simulation.rule": "exact",
    "simulation.frame_time": 0.5,
    "colliders.0.position": new Float64Array([1, 2, 3]),
    "emitters.0.max_spheres": null,
  };
  const world = World.fromScene("simtest1", changes);
  assert.deepEqual([world.simulation.rule, world.frameTime], ["exact", 0.5]);
  assert.deepEqual(world.colliders[0].position, [1, 2, 3]);
  assert.ok(!("maxSpheres" in world.scene.emitters[0]));
});

const REFUSED = {
  "a misspelled field": [
    (w) => w.addSphere({ radius: 1, velocty: [0, 0, 0] }),
    /velocty.*"velocity"/,
  ],
  "a name of two words": [
    (w) => w.addCollider({ shape: "half-space", angularVelocit: [0, 0, 0] }),
    /"angularVelocity"/,
  ],
  "a negative radius": [
    (w) => w.addSphere({ radius: -1 }),
    /spheres\[0\]\.radius: must be positive/,
  ],
  "no size": [(w) => w.addSphere({}), /needs `radius` or `diameter`/],
  "two numbers for a place": [(w) => w.addSphere({ position: [1, 2], radius: 1 }), /position/],
  "a place that is no number": [
    (w) => w.addSphere({ position: [NaN, 0, 0], radius: 1 }),
    /position: must be finite, not \[NaN, 0, 0\]/,
  ],
  "an infinite speed": [
    (w) => w.addSphere({ velocity: [0, Infinity, 0], radius: 1 }),
    /must be finite/,
  ],
  "one wrong of several": [
    (w) => w.add({ spheres: [{ radius: 1 }, { radius: 0 }] }),
    /spheres\[1\]\.radius/,
  ],
  "a wrong collider after good spheres": [
    (w) => w.add({ spheres: [{ radius: 1 }], colliders: [{ shape: "pyramid" }] }),
    /`pyramid`/,
  ],
  "an unknown force": [(w) => w.addForce({ viscousDragg: { coefficient: 1 } }), /"viscousDrag"/],
  "a drag that drives": [
    (w) => w.addForce({ viscousDrag: { coefficient: -1 } }),
    /viscousDrag\.coefficient/,
  ],
  "a restitution above 1": [(w) => w.setCollider(0, { restitution: 1.5 }), /restitution/],
  "a sphere that is not there": [
    (w) => w.setSphere(7, { mass: 2 }),
    /there is no sphere 7 in this world/,
  ],
  "half an id": [(w) => w.removeSphere(0.5), /there is no sphere 0\.5/],
  "a force that is not there": [(w) => w.removeForce(1), /there is no force 1/],
  "a collider that is not there": [(w) => w.removeCollider(1), /there is no collider 1/],
  "an unknown rule": [(w) => w.setSimulation({ rule: "exakt" }), /`exakt`/],
  "a frame without end": [(w) => w.setSimulation({ frameTime: Infinity }), /simulation\.frameTime/],
  "a step back": [(w) => w.step(-0.01), /`dt` must be positive and finite, not -0\.01/],
  "a step of NaN": [(w) => w.step(NaN), /`dt` must be positive and finite, not NaN/],
};

for (const [what, [call, message]] of Object.entries(REFUSED)) {
  test(`${what} is refused, and the world is as it was`, () => {
    const [refusing, other] = [world(), world()];
    const error = thrown(() => call(refusing));
    assert.ok(error instanceof CaromError, `${error}`);
    assert.match(error.message, message);
    assert.equal(refusing.stateHash(), other.stateHash());
    assert.equal(refusing.toToml(), other.toToml());
    assert.deepEqual([refusing.ids, refusing.colors], [other.ids, other.colors]);
  });
}

test("a step that ends in infinite speed is refused, and the state before it is kept", () => {
  const fast = new World();
  fast.addForce({ constant: { force: [1e308, 0, 0] } });
  fast.addSphere({ radius: 1, mass: 1e-3 });
  const hash = fast.stateHash();
  assert.match(thrown(() => fast.step(1)).message, /the state before the step was kept/);
  assert.equal(fast.stateHash(), hash);
});

test("emitters come with a scene only, and that is said", () => {
  assert.throws(() => world().add({ emitters: [] }), TypeError);
});

test("a freed world says so, and may be freed again", () => {
  const gone = world();
  gone.free();
  gone.free();
  for (const call of [() => gone.positions, () => gone.step(), () => gone.stateHash()]) {
    assert.match(thrown(call).message, /has been freed/);
  }
});

test("`using` frees a world at the end of its block", { skip: !Symbol.dispose }, () => {
  const gone = world();
  gone[Symbol.dispose]();
  assert.throws(() => gone.count, CaromError);
});

test("freed memory is used again: a thousand worlds need no more of it than ten", () => {
  const make = (count) => {
    for (let i = 0; i < count; i++) {
      const world = World.fromScene("tutorial4");
      world.step();
      world.snapshot().free();
      world.free();
    }
    return world().positions.buffer.byteLength;
  };
  const few = make(10);
  // A world that leaks would make memory grow by whole pages: a thousand worlds of more than 30 kB
  // each would need about 500.
  const page = 65_536;
  assert.ok(make(1000) - few <= 4 * page);
});
