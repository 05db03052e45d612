// The world in JavaScript. `index.d.ts`, where editors look for documentation, explains its parts
// and their units.

import * as engine from "./engine.js";
import { contacts } from "./contacts.js";
import { attempt, attemptPart } from "./errors.js";
import { ENGINE } from "./handle.js";
import { impactGroups } from "./impact_groups.js";
import { IMPACT_COLUMNS, impacts } from "./impacts.js";
import { parse } from "./names.js";
import { quaternion, vector, vectors } from "./numbers.js";
import { overlaps } from "./overlaps.js";
import { PredictedPath } from "./path.js";
import { filterOf, hits, nearBodies } from "./queries.js";
import { sensorEvents } from "./sensor_events.js";
import { Snapshot } from "./snapshot.js";
import { Spheres } from "./spheres.js";
import { override, tables } from "./toml.js";
import { Views } from "./views.js";
import { wellEvents } from "./well_events.js";

/** A name contains no equals sign, and the text of a scene always does. */
const isToml = (text) => text.includes("=");

const EMPTY_SCENE = 'name = "world"';

export class World extends Spheres {
  #views = new Views();

  constructor(simulation = {}) {
    if (simulation instanceof engine.World) {
      super(simulation, "world");
      return;
    }
    super(engine.World.fromToml(EMPTY_SCENE, []), "world");
    this.setSimulation(simulation);
  }

  static fromScene(nameOrToml, overrides = {}) {
    const changes = Object.entries(overrides).map(override);
    const make = isToml(nameOrToml) ? engine.World.fromToml : engine.World.fromName;
    return new World(attempt(() => make(nameOrToml, changes)));
  }

  // Time.

  step(dt = this.frameTime) {
    const world = this[ENGINE];
    attempt(() => world.step(dt));
  }

  nextEventTime(within) {
    const world = this[ENGINE];
    return attempt(() => world.nextEventTime(within));
  }

  stepToNextEvent(within) {
    const world = this[ENGINE];
    attempt(() => world.stepToNextEvent(within));
  }

  get time() {
    return this[ENGINE].time;
  }

  get frameTime() {
    return this[ENGINE].frameTime;
  }

  get longestStableFrame() {
    return this[ENGINE].longestStableFrame;
  }

  snapshot() {
    return new Snapshot(this[ENGINE].snapshot());
  }

  snapshotInto(snapshot) {
    this[ENGINE].snapshotInto(snapshot[ENGINE]);
  }

  restore(snapshot) {
    this[ENGINE].restore(snapshot[ENGINE]);
  }

  stateHash() {
    return this[ENGINE].stateHash();
  }

  // Report of the last frame.

  get impacts() {
    return impacts(this.impactTable);
  }

  get impactCount() {
    return this[ENGINE].impactCount;
  }

  get impactTable() {
    const world = this[ENGINE];
    // First the address: the call makes the table, and the memory may grow.
    const place = world.impacts;
    const length = IMPACT_COLUMNS.count * world.impactCount;
    return this.#views.at("impacts", Float64Array, place, length);
  }

  get impactGroups() {
    return impactGroups(this[ENGINE].impactGroups);
  }

  get emitted() {
    return Array.from(this[ENGINE].emitted);
  }

  get retired() {
    return Array.from(this[ENGINE].retired);
  }

  get leftOut() {
    return Array.from(this[ENGINE].leftOut);
  }

  get triggers() {
    const pairs = this[ENGINE].triggers;
    return Array.from({ length: pairs.length / 2 }, (_, i) => ({
      collider: pairs[2 * i],
      sphere: pairs[2 * i + 1],
    }));
  }

  get sensorEvents() {
    return sensorEvents(this[ENGINE].sensorEvents);
  }

  get wellEvents() {
    return wellEvents(this[ENGINE].wellEvents);
  }

  get work() {
    const [predictions, pairTests, events, cellCrossings, ...others] = this[ENGINE].work;
    const [groups, solverIterations, searches, sweeps, contacts] = others;
    const ofEvents = { predictions, pairTests, events, cellCrossings, groups, solverIterations };
    return { ...ofEvents, searches, sweeps, contacts };
  }

  get energyAccount() {
    const [contacts, colliders, kicks, growth, ...others] = this[ENGINE].energyAccount;
    const [shear, thermostat, forces, applied, correction, emission, integration] = others;
    const ofBodies = { contacts, colliders, kicks, growth, shear, thermostat };
    return { ...ofBodies, forces, applied, correction, emission, integration };
  }

  get contactAccount() {
    const [limitedSubSteps, residual, largestOverlap, ...counts] = this[ENGINE].contactAccount;
    const [asleep, squeezed] = counts;
    return { limitedSubSteps, residual, largestOverlap, asleep, squeezed };
  }

  get zoneAccount() {
    const [spheres, sphereSeconds, ticks, joined, left] = this[ENGINE].zoneAccount;
    return { spheres, sphereSeconds, ticks, joined, left };
  }

  get unfinishedIslands() {
    return this[ENGINE].unfinishedIslands;
  }

  get wasStepped() {
    return this[ENGINE].wasStepped;
  }

  // Present state.

  get contacts() {
    return contacts(this[ENGINE].contacts);
  }

  overlaps(tolerance = 0) {
    const world = this[ENGINE];
    return overlaps(attempt(() => world.overlaps(tolerance)));
  }

  get hasSpin() {
    return this[ENGINE].hasSpin;
  }

  // Queries.

  castRay(origin, way, filter) {
    const [starts, ways] = [vector("origin", origin), vector("way", way)];
    return this.castRays(starts, ways, filter)[0];
  }

  castRays(origins, ways, filter) {
    const world = this[ENGINE];
    const starts = vectors("origins", origins);
    const leads = vectors("ways", ways, starts.length / 3);
    const finds = filterOf(filter);
    return hits(attempt(() => world.castRays(starts, leads, finds)));
  }

  castSphere(center, radius, way, filter) {
    const world = this[ENGINE];
    const [start, lead] = [vector("center", center), vector("way", way)];
    const finds = filterOf(filter);
    return hits(attempt(() => world.castSphere(start, radius, lead, finds)))[0];
  }

  nearest(point, within = Infinity, filter = {}) {
    const world = this[ENGINE];
    const [place, finds] = [vector("point", point), filterOf(filter)];
    return nearBodies(attempt(() => world.nearest(place, within, finds)))[0];
  }

  overlapping(center, radius, filter) {
    const world = this[ENGINE];
    const [place, finds] = [vector("center", center), filterOf(filter)];
    return nearBodies(attempt(() => world.overlapping(place, radius, finds)));
  }

  predict(id, horizon, mostImpacts = 10_000) {
    const world = this[ENGINE];
    return new PredictedPath(attempt(() => world.predict(id, horizon, mostImpacts)));
  }

  // Sums over all spheres.

  kineticEnergy() {
    return this[ENGINE].kineticEnergy();
  }

  rotationalEnergy() {
    return this[ENGINE].rotationalEnergy();
  }

  potentialEnergy() {
    return this[ENGINE].potentialEnergy();
  }

  totalEnergy() {
    return this.kineticEnergy() + this.potentialEnergy();
  }

  momentum() {
    return Array.from(this[ENGINE].momentum());
  }

  angularMomentum() {
    return Array.from(this[ENGINE].angularMomentum());
  }

  // Contents of the world.

  get scene() {
    const { simulation, forces, colliders, ...scene } = parse(this[ENGINE].scene());
    return scene;
  }

  get simulation() {
    return parse(this[ENGINE].scene()).simulation;
  }

  get colliders() {
    return parse(this[ENGINE].colliders()).map((collider) => ({ ...COLLIDER, ...collider }));
  }

  get forces() {
    return parse(this[ENGINE].forces());
  }

  get materialPairs() {
    return parse(this[ENGINE].scene()).materialPairs ?? [];
  }

  get emitters() {
    return parse(this[ENGINE].emitters());
  }

  get springs() {
    return parse(this[ENGINE].springs()).map((spring) => ({ ...SPRING, ...spring }));
  }

  toToml() {
    return this[ENGINE].toToml();
  }

  // Add, change, remove.

  add({ spheres, generators, colliders, forces, ...others }) {
    const [unknown] = Object.keys(others);
    if (unknown !== undefined) {
      const known = "spheres, generators, colliders and forces";
      throw new TypeError(`to a running world ${known} can be added, not "${unknown}"`);
    }
    const [world, text] = [this[ENGINE], tables({ spheres, generators, colliders, forces })];
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
    const world = this[ENGINE];
    return attemptPart(() => world.addSpring(tables({ springs: [spring] })));
  }

  addEmitter(emitter) {
    const world = this[ENGINE];
    return attemptPart(() => world.addEmitter(tables({ emitters: [emitter] })));
  }

  setCollider(id, changes) {
    const { id: _, ...now } = this.colliders.find((collider) => collider.id === id) ?? {};
    const text = tables({ colliders: [{ ...now, ...changes }] });
    attemptPart(() => this[ENGINE].setCollider(id, text));
  }

  setNextPose(id, pose, dt = this.frameTime) {
    const { position, rotation, ...others } = pose;
    const [unknown] = Object.keys(others);
    if (unknown !== undefined) throw new TypeError(`a pose has no "${unknown}"`);
    const world = this[ENGINE];
    const place = position && vector("position", position);
    const turn = rotation && quaternion("rotation", rotation);
    attempt(() => world.setNextPose(id, place, turn, dt));
  }

  setForce(id, force) {
    const text = tables({ forces: [force] });
    attemptPart(() => this[ENGINE].setForce(id, text));
  }

  setSpring(id, changes) {
    const { id: _, ...now } = this.springs.find((spring) => spring.id === id) ?? {};
    // A pair replaces a sphere and a point, and the reverse.
    const { spheres, sphere, anchor, ...numbers } = now;
    const isToPoint = (changes.sphere ?? changes.anchor) !== undefined;
    const pair = isToPoint ? {} : { spheres };
    const ends = changes.spheres === undefined ? { sphere, anchor, ...pair } : {};
    const text = tables({ springs: [{ ...numbers, ...ends, ...changes }] });
    attemptPart(() => this[ENGINE].setSpring(id, text));
  }

  setEmitter(id, changes) {
    const { id: _, ...now } = this.emitters.find((emitter) => emitter.id === id) ?? {};
    const text = tables({ emitters: [{ ...now, ...changes }] });
    attemptPart(() => this[ENGINE].setEmitter(id, text));
  }

  setMaterialPairs(materialPairs) {
    const text = tables({ materialPairs });
    attemptPart(() => this[ENGINE].setMaterialPairs(text));
  }

  setSimulation(changes) {
    const now = this.simulation;
    const exact = { ...now.exact, ...changes.exact };
    const bisect = { ...now.bisect, ...changes.bisect };
    const discrete = { ...now.discrete, ...changes.discrete };
    const contact = { ...now.contact, ...changes.contact };
    const text = tables({ simulation: { ...now, ...changes, exact, bisect, discrete, contact } });
    attemptPart(() => this[ENGINE].setSimulation(text));
  }

  removeCollider(id) {
    attempt(() => this[ENGINE].removeCollider(id));
  }

  removeForce(id) {
    attempt(() => this[ENGINE].removeForce(id));
  }

  removeSpring(id) {
    attempt(() => this[ENGINE].removeSpring(id));
  }

  removeEmitter(id) {
    attempt(() => this[ENGINE].removeEmitter(id));
  }
}

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
