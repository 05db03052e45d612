// The declarations match the package. This file is only type-checked, never run. A line after
// `@ts-expect-error` must be wrong.

import { CaromError, IMPACT_COLUMNS, SceneError, scenes, Snapshot, World } from "carom";
import type { Collider, Hit, Impact, PredictedPath, Shape, SimulationChanges } from "carom";

const world: World = World.fromScene("tutorial3", { "simulation.rule": "exact", camera: null });
const titles: string[] = scenes().map(({ title }) => title);

world.step();
world.step(0.01);
// @ts-expect-error: a time is a number
world.step("0.01");

const positions: Float64Array = world.positions;
const colors: Float32Array = world.colors;
// @ts-expect-error: arrays are taken, not given
world.positions = positions;
world.writeMatrices(new Float32Array(16 * world.count));

const own = new World({ rule: "exact", frameTime: 1 / 240, boundary: "open" });
// @ts-expect-error: there is no such rule
new World({ rule: "exakt" });

const ball: number = own.addSphere({ position: new Float32Array(3), radius: 1, density: 700 });
// @ts-expect-error: a misspelled field
own.addSphere({ radus: 1 });
own.addCollider({ shape: { box: { size: [1, 2, 3] } }, angularVelocity: [0, 1, 0] });
own.addCollider({ shape: { container: { size: [1, 2, 3], open: "top" } } });
own.addCollider({ shape: { container: { size: [1, 2, 3], open: ["top", "front"] } } });
// @ts-expect-error: not a side
own.addCollider({ shape: { container: { size: [1, 2, 3], open: "above" } } });
// @ts-expect-error: a collider needs a shape
own.addCollider({ position: [0, 0, 0] });
own.addForce({ viscousDrag: { coefficient: 0.1 } });
const spring: number = own.addSpring({ sphere: ball, anchor: [0, 1, 0], stiffness: 8 });
own.addSpring({ spheres: [0, 1], stiffness: 8, restLength: 0.5, damping: 1, onlyPulls: true });
// @ts-expect-error: a spring has two ends
own.addSpring({ sphere: ball, stiffness: 8 });
// @ts-expect-error: a spring has a stiffness
own.addSpring({ spheres: [0, 1] });
own.setSpring(spring, { damping: 2 });
own.removeSpring(spring);
const lengths: number[] = own.springs.map(({ restLength }) => restLength);
own.setSphere(ball, { velocity: [0, 1, 0] });
own.setCollider(0, { restitution: 0.5 });
own.setNextPose(0, { position: [0, 1, 0] });
// @ts-expect-error: a misspelled field
own.setNextPose(0, { place: [0, 1, 0] }, 0.1);
own.strike(ball, { speed: 2, offset: [0, -0.4] });
// @ts-expect-error: a strike has a speed
own.strike(ball, { cueMass: 0.5 });
own.setAppliedForces(new Float64Array(3 * own.count));
const source: number = own.addEmitter({ period: 0.5, sphere: { radius: 0.1 } });
// @ts-expect-error: an emitter has a sphere
own.addEmitter({ period: 0.5 });
own.setEmitter(source, { maxSpheres: 3 });
const emitted: number[] = own.emitters.map(({ sphere }) => sphere.radius);
own.setMaterialPairs([{ materials: ["ivory", "slate"], restitution: 0.5 }]);
const depths: number[] = own.overlaps(1e-9).map(({ depth }) => depth);
const changes: SimulationChanges = { exact: { impactLaw: "simultaneous", maxImpacts: 100 } };
own.setSimulation(changes);

const hit: Hit | undefined = own.castRay([0, 0, 0], new Float32Array(3), { spheres: false });
const hits: (Hit | undefined)[] = own.castRays(own.positions, own.velocities);
// @ts-expect-error: a misspelled option
own.castRay([0, 0, 0], [1, 0, 0], { sphere: false });
const path: PredictedPath = own.predict(ball, 2, 3);
// @ts-expect-error: outside of the path there is no position
const place: [number, number, number] = path.positionAt(1);
own.applyImpulseAt(ball, [0, 1, 0], [0, 0, 0]);

const text = (impact: Impact): string =>
  "spheres" in impact.between
    ? impact.between.spheres.join(" and ")
    : `${impact.between.sphere} on ${impact.between.collider}`;
const told: string[] = world.impacts.map(text);
const firstTime: number | undefined = world.impactTable[IMPACT_COLUMNS.time];

const force: number | undefined = world.contacts[0]?.normalForce;
const friction: [number, number, number] | undefined = world.contacts[0]?.tangentialForce;
const slides: boolean | undefined = world.contacts[0]?.isSliding;
const work: number = world.work.pairTests + world.work.sweeps;
const asleep: number = world.contactAccount.asleep;
const turned: Float64Array = world.orientations;
const hasSpin: boolean = world.hasSpin;
const next: number | undefined = world.nextEventTime(1);
world.stepToNextEvent(1);
// @ts-expect-error: a bound on the time has to be given
world.stepToNextEvent();

const size = (shape: Shape): number => {
  if (shape === "half-space") return Infinity;
  if ("sphere" in shape) return 2 * shape.sphere.radius;
  if ("rectangle" in shape) return Math.max(shape.rectangle.sizeX, shape.rectangle.sizeZ);
  if ("container" in shape) return Math.max(...shape.container.size);
  return "box" in shape ? Math.max(...shape.box.size) : NaN;
};
const largest: number = Math.max(...world.colliders.map(({ shape }: Collider) => size(shape)));

const [x, , z]: [number, number, number] = world.momentum();
const before = world.snapshot();
world.restore(before);
const bytes: Uint8Array = before.toBytes();
world.restore(Snapshot.fromBytes(bytes));
// @ts-expect-error: a snapshot comes from a world or from bytes
new Snapshot();
before.free();
// @ts-expect-error: a snapshot comes from a world
world.restore({});

try {
  world.removeSphere(7);
} catch (error) {
  if (error instanceof SceneError) console.log(error.field, error.line?.toFixed());
  else if (error instanceof CaromError) console.log(error.message);
}

console.log(
  force,
  friction,
  slides,
  asleep,
  turned,
  hasSpin,
  world.rotationalEnergy(),
  work,
  next,
  titles,
  colors,
  told,
  firstTime,
  largest,
  lengths,
  emitted,
  depths,
  x,
  z,
  own.stateHash(),
  own.toToml(),
);
own.free();
