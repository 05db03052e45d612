// The world in JavaScript. `index.d.ts`, where editors look for documentation, explains its parts
// and their units.

import * as engine from "./engine.js";
import { contacts } from "./contacts.js";
import { attempt, attemptPart, CaromError } from "./errors.js";
import { IMPACT_COLUMNS, impacts } from "./impacts.js";
import { writeMatrices } from "./matrices.js";
import { parse } from "./names.js";
import { PredictedPath } from "./path.js";
import { filterOf, hits, nearBodies, vector, vectors } from "./queries.js";
import { sensorEvents } from "./sensor_events.js";
import { override, tables } from "./toml.js";
import { Views } from "./views.js";
import { wellEvents } from "./well_events.js";

/** A name contains no equals sign, and the text of a scene always does. */
const isToml = (text) => text.includes("=");

const EMPTY_SCENE = 'name = "world"';

export class World {
  /** The world of the engine; empty after `free`. */
  #engine;
  #views = new Views();

  constructor(simulation = {}) {
    if (simulation instanceof engine.World) {
      this.#engine = simulation;
      return;
    }
    this.#engine = engine.World.fromToml(EMPTY_SCENE, []);
    this.setSimulation(simulation);
  }

  static fromScene(nameOrToml, overrides = {}) {
    const changes = Object.entries(overrides).map(override);
    const make = isToml(nameOrToml) ? engine.World.fromToml : engine.World.fromName;
    return new World(attempt(() => make(nameOrToml, changes)));
  }

  free() {
    this.#engine?.free();
    this.#engine = undefined;
  }

  get #world() {
    if (this.#engine === undefined) throw new CaromError("this world has been freed");
    return this.#engine;
  }

  // Time.

  step(dt = this.frameTime) {
    const world = this.#world;
    attempt(() => world.step(dt));
  }

  nextEventTime(within) {
    const world = this.#world;
    return attempt(() => world.nextEventTime(within));
  }

  stepToNextEvent(within) {
    const world = this.#world;
    attempt(() => world.stepToNextEvent(within));
  }

  get time() {
    return this.#world.time;
  }

  get frameTime() {
    return this.#world.frameTime;
  }

  snapshot() {
    return this.#world.snapshot();
  }

  snapshotInto(snapshot) {
    this.#world.snapshotInto(snapshot);
  }

  restore(snapshot) {
    this.#world.restore(snapshot);
  }

  stateHash() {
    return this.#world.stateHash();
  }

  // Arrays of spheres.

  get count() {
    return this.#world.count;
  }

  get positions() {
    return this.#view("positions", Float64Array, 3);
  }

  get velocities() {
    return this.#view("velocities", Float64Array, 3);
  }

  get radii() {
    return this.#view("radii", Float64Array, 1);
  }

  get masses() {
    return this.#view("masses", Float64Array, 1);
  }

  get ids() {
    return this.#view("ids", Float64Array, 1);
  }

  get colors() {
    return this.#view("colors", Float32Array, 3);
  }

  get orientations() {
    return this.#viewOr("orientations", NOT_TURNED);
  }

  get angularVelocities() {
    return this.#viewOr("angularVelocities", AT_REST);
  }

  get inertiaFactors() {
    return this.#viewOr("inertiaFactors", SOLID_BALL);
  }

  get frictions() {
    return this.#viewOr("frictions", SILENT);
  }

  get rollingFrictions() {
    return this.#viewOr("rollingFrictions", SILENT);
  }

  get spinningFrictions() {
    return this.#viewOr("spinningFrictions", SILENT);
  }

  get tangentialRestitutions() {
    return this.#viewOr("tangentialRestitutions", SILENT);
  }

  #view(name, Type, width) {
    const world = this.#world;
    return this.#views.at(name, Type, world[name], width * world.count);
  }

  /** Returns an array that the engine stores only if a sphere differs from the default. */
  #viewOr(name, usual) {
    const world = this.#world;
    const isUsual = world[name] === undefined;
    return isUsual
      ? this.#views.repeated(name, usual, world.count)
      : this.#view(name, Float64Array, usual.length);
  }

  writeMatrices(matrices) {
    writeMatrices(this, matrices);
  }

  // Report of the last frame.

  get impacts() {
    return impacts(this.impactTable);
  }

  get impactCount() {
    return this.#world.impactCount;
  }

  get impactTable() {
    const world = this.#world;
    // First the address: the call makes the table, and the memory may grow.
    const place = world.impacts;
    const length = IMPACT_COLUMNS.count * world.impactCount;
    return this.#views.at("impacts", Float64Array, place, length);
  }

  get emitted() {
    return Array.from(this.#world.emitted);
  }

  get retired() {
    return Array.from(this.#world.retired);
  }

  get leftOut() {
    return Array.from(this.#world.leftOut);
  }

  get triggers() {
    const pairs = this.#world.triggers;
    return Array.from({ length: pairs.length / 2 }, (_, i) => ({
      collider: pairs[2 * i],
      sphere: pairs[2 * i + 1],
    }));
  }

  get sensorEvents() {
    return sensorEvents(this.#world.sensorEvents);
  }

  get wellEvents() {
    return wellEvents(this.#world.wellEvents);
  }

  get work() {
    const [predictions, pairTests, events, cellCrossings, ...others] = this.#world.work;
    const [groups, solverIterations, searches, sweeps, contacts] = others;
    const ofEvents = { predictions, pairTests, events, cellCrossings, groups, solverIterations };
    return { ...ofEvents, searches, sweeps, contacts };
  }

  get energyAccount() {
    const [contacts, colliders, kicks, growth, ...others] = this.#world.energyAccount;
    const [shear, thermostat, forces, applied, correction, emission] = others;
    const ofBodies = { contacts, colliders, kicks, growth, shear, thermostat };
    return { ...ofBodies, forces, applied, correction, emission };
  }

  get contactAccount() {
    const [limitedSubSteps, residual, largestOverlap, ...counts] = this.#world.contactAccount;
    const [asleep, squeezed] = counts;
    return { limitedSubSteps, residual, largestOverlap, asleep, squeezed };
  }

  get zoneAccount() {
    const [spheres, sphereSeconds, ticks, joined, left] = this.#world.zoneAccount;
    return { spheres, sphereSeconds, ticks, joined, left };
  }

  get wasStepped() {
    return this.#world.wasStepped;
  }

  // Present state.

  get contacts() {
    return contacts(this.#world.contacts);
  }

  get hasSpin() {
    return this.#world.hasSpin;
  }

  // Queries.

  castRay(origin, way, filter) {
    const [starts, ways] = [vector("origin", origin), vector("way", way)];
    return this.castRays(starts, ways, filter)[0];
  }

  castRays(origins, ways, filter) {
    const world = this.#world;
    const starts = vectors("origins", origins);
    const leads = vectors("ways", ways, starts.length / 3);
    const finds = filterOf(filter);
    return hits(attempt(() => world.castRays(starts, leads, finds)));
  }

  castSphere(center, radius, way, filter) {
    const world = this.#world;
    const [start, lead] = [vector("center", center), vector("way", way)];
    const finds = filterOf(filter);
    return hits(attempt(() => world.castSphere(start, radius, lead, finds)))[0];
  }

  nearest(point, within = Infinity, filter = {}) {
    const world = this.#world;
    const [place, finds] = [vector("point", point), filterOf(filter)];
    return nearBodies(attempt(() => world.nearest(place, within, finds)))[0];
  }

  overlapping(center, radius, filter) {
    const world = this.#world;
    const [place, finds] = [vector("center", center), filterOf(filter)];
    return nearBodies(attempt(() => world.overlapping(place, radius, finds)));
  }

  predict(id, horizon, mostImpacts = 10_000) {
    const world = this.#world;
    return new PredictedPath(attempt(() => world.predict(id, horizon, mostImpacts)));
  }

  // Sums over all spheres.

  kineticEnergy() {
    return this.#world.kineticEnergy();
  }

  rotationalEnergy() {
    return this.#world.rotationalEnergy();
  }

  potentialEnergy() {
    return this.#world.potentialEnergy();
  }

  totalEnergy() {
    return this.kineticEnergy() + this.potentialEnergy();
  }

  momentum() {
    return Array.from(this.#world.momentum());
  }

  angularMomentum() {
    return Array.from(this.#world.angularMomentum());
  }

  // Contents of the world.

  get scene() {
    const { simulation, forces, colliders, ...scene } = parse(this.#world.scene());
    return scene;
  }

  get simulation() {
    return parse(this.#world.scene()).simulation;
  }

  get colliders() {
    return parse(this.#world.colliders()).map((collider) => ({ ...COLLIDER, ...collider }));
  }

  get forces() {
    return parse(this.#world.forces());
  }

  get springs() {
    return parse(this.#world.springs()).map((spring) => ({ ...SPRING, ...spring }));
  }

  sphere(id) {
    const world = this.#world;
    return parse(attempt(() => world.sphere(id)));
  }

  toToml() {
    return this.#world.toToml();
  }

  // Add, change, remove.

  add({ spheres, generators, colliders, forces, ...others }) {
    const [unknown] = Object.keys(others);
    if (unknown !== undefined) {
      const known = "spheres, generators, colliders and forces";
      throw new TypeError(`to a running world ${known} can be added, not "${unknown}"`);
    }
    const [world, text] = [this.#world, tables({ spheres, generators, colliders, forces })];
    return parse(attemptPart(() => world.add(text)));
  }

  addSphere(sphere) {
    return this.add({ spheres: [sphere] }).spheres[0];
  }

  addCollider(collider) {
    return this.add({ colliders: [collider] }).colliders[0];
  }

  addForce(force) {
    return this.add({ forces: [force] }).forces[0];
  }

  addSpring(spring) {
    const world = this.#world;
    return attemptPart(() => world.addSpring(tables({ springs: [spring] })));
  }

  setSphere(id, changes) {
    // A size or mass of another kind replaces the present one.
    const { radius, mass, ...rest } = this.sphere(id);
    const size = changes.diameter === undefined ? { radius } : {};
    const weight = changes.density === undefined ? { mass } : {};
    const text = tables({ spheres: [{ ...rest, ...size, ...weight, ...changes }] });
    attemptPart(() => this.#world.setSphere(id, text));
  }

  applyImpulse(id, impulse) {
    const [world, given] = [this.#world, vector("impulse", impulse)];
    attempt(() => world.applyImpulse(id, given));
  }

  applyImpulseAt(id, impulse, point) {
    const world = this.#world;
    const [given, place] = [vector("impulse", impulse), vector("point", point)];
    attempt(() => world.applyImpulseAt(id, given, place));
  }

  setVelocity(id, velocity) {
    const [world, given] = [this.#world, vector("velocity", velocity)];
    attempt(() => world.setVelocity(id, given));
  }

  setAngularVelocity(id, angularVelocity) {
    const [world, given] = [this.#world, vector("angularVelocity", angularVelocity)];
    attempt(() => world.setAngularVelocity(id, given));
  }

  setCollider(id, changes) {
    const { id: _, ...now } = this.colliders.find((collider) => collider.id === id) ?? {};
    const text = tables({ colliders: [{ ...now, ...changes }] });
    attemptPart(() => this.#world.setCollider(id, text));
  }

  setForce(id, force) {
    const text = tables({ forces: [force] });
    attemptPart(() => this.#world.setForce(id, text));
  }

  setSpring(id, changes) {
    const { id: _, ...now } = this.springs.find((spring) => spring.id === id) ?? {};
    // A pair replaces a sphere and a point, and the reverse.
    const { spheres, sphere, anchor, ...numbers } = now;
    const isToPoint = (changes.sphere ?? changes.anchor) !== undefined;
    const pair = isToPoint ? {} : { spheres };
    const ends = changes.spheres === undefined ? { sphere, anchor, ...pair } : {};
    const text = tables({ springs: [{ ...numbers, ...ends, ...changes }] });
    attemptPart(() => this.#world.setSpring(id, text));
  }

  setSimulation(changes) {
    const now = this.simulation;
    const exact = { ...now.exact, ...changes.exact };
    const bisect = { ...now.bisect, ...changes.bisect };
    const discrete = { ...now.discrete, ...changes.discrete };
    const contact = { ...now.contact, ...changes.contact };
    const text = tables({ simulation: { ...now, ...changes, exact, bisect, discrete, contact } });
    attemptPart(() => this.#world.setSimulation(text));
  }

  removeSphere(id) {
    attempt(() => this.#world.removeSphere(id));
  }

  removeCollider(id) {
    attempt(() => this.#world.removeCollider(id));
  }

  removeForce(id) {
    attempt(() => this.#world.removeForce(id));
  }

  removeSpring(id) {
    attempt(() => this.#world.removeSpring(id));
  }
}

// `using world = ...`, if the language supports it.
if (Symbol.dispose) World.prototype[Symbol.dispose] = World.prototype.free;

// Defaults of a sphere.
const NOT_TURNED = [0, 0, 0, 1];
const AT_REST = [0, 0, 0];
const SOLID_BALL = [2 / 5];
/** A sphere without its own friction. */
const SILENT = [NaN];

/** Defaults of a collider, which scene files leave out. */
const COLLIDER = {
  name: "",
  velocity: [0, 0, 0],
  angularVelocity: [0, 0, 0],
  trigger: false,
  visible: true,
};

/** Defaults of a spring, which scene files leave out. */
const SPRING = { damping: 0, onlyPulls: false };
