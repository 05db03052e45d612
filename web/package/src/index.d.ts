/**
 * Carom moves spheres exactly: event-driven collisions in double precision, with the same bits on every
 * machine. Right-handed coordinate system, y up, SI units.
 *
 * @example
 * const world = World.fromScene("tutorial3");
 * for (let frame = 0; frame < 60; frame++) world.step();
 * console.log(world.time, world.positions, world.stateHash());
 */

import type {
  Collider,
  ColliderDescription,
  Force,
  Generator,
  Scene,
  Simulation,
  SimulationChanges,
  Sphere,
  SphereDescription,
  Spring,
  SpringChanges,
  SpringDescription,
} from "./descriptions.js";
import type {
  ContactAccount,
  EnergyAccount,
  Impact,
  PersistentContact,
  StageCounts,
  ZoneAccount,
} from "./reports.js";

export * from "./descriptions.js";
export * from "./reports.js";

/** Where what stands in a row of `World.impactTable`; vectors take three places. */
export const IMPACT_COLUMNS: Readonly<{
  time: 0;
  /** 1 where body 1 is a collider, 0 where it is a sphere. */
  isCollider: 1;
  /** Ids of bodies 1 and 2. */
  first: 2;
  second: 3;
  point: 4;
  normal: 7;
  approachSpeed: 10;
  separationSpeed: 11;
  impulse: 12;
  tangentialImpulse: 13;
  /** Numbers in a row. */
  count: 16;
}>;

/** A world at one moment. Its memory is given back when it is collected as garbage, or by `free`. */
export interface Snapshot {
  free(): void;
}

/** Something that the engine refused. What it was refused for is as it was before. */
export class CaromError extends Error {}

/** A scene, or a description of a part of one, that makes no sense. */
export class SceneError extends CaromError {
  /** Path of the field that is to blame, like `colliders[1].restitution`; empty for none. */
  readonly field: string;
  /** Line in the text of the scene, from 1, where it has one. */
  readonly line: number | undefined;
}

/** A built-in scene, as it is listed. */
export interface ListedScene {
  name: string;
  title: string;
  description: string;
  origin: string;
}

/** The built-in scenes. */
export function scenes(): ListedScene[];

/** New values for fields of a scene by their paths, as `carom run --set` takes them; `null` takes a
 *  field out: `{ "simulation.rule": "exact", "emitters.0.max_spheres": null }`. */
export type Overrides = Record<string, unknown>;

/**
 * Spheres, what acts on them, and what they bounce off.
 *
 * **Arrays** (`positions` and the like) are views of the engine's own memory: nothing is copied, and
 * nothing is to be written there. Take them from the world each time: a step, an addition, or any other
 * world that makes the memory grow may move them. Copy (`.slice()`) what is to stay. Of rotation and
 * friction the engine has arrays only where a sphere needs them; elsewhere you get ones that say so.
 *
 * A call that throws leaves the world as it was.
 */
export class World {
  /** An empty world at time 0. @throws {SceneError} */
  constructor(simulation?: SimulationChanges);

  /** The world of a built-in scene, by name or title, or of the text of a scene file.
   *  @throws {SceneError} with the line, where the text is wrong */
  static fromScene(nameOrToml: string, overrides?: Overrides): World;

  /** Advances the world by `dt` [s], a frame of the scene unless given. @throws {CaromError} */
  step(dt?: number): void;
  /** The time of the next impact [s], if one comes within so many seconds. Costs as much as a copy of
   *  the world and the step to that impact. @throws {CaromError} by other rules than `exact` */
  nextEventTime(within: number): number | undefined;
  /** Advances the world to its next impact, and answers it with all others at that instant; by
   *  `within` [s] if none comes before. @throws {CaromError} by other rules than `exact` */
  stepToNextEvent(within: number): void;
  /** Since the beginning [s]: the sum of all steps. */
  readonly time: number;
  /** Length of a frame of the scene [s]. */
  readonly frameTime: number;

  /** Everything the future depends on, to return to. */
  snapshot(): Snapshot;
  /** Returns to a snapshot, also of another world, bit for bit. The impacts of the last frame are
   *  gone. */
  restore(snapshot: Snapshot): void;
  /** The state as one number in 16 hexadecimal digits, to compare worlds to the bit: the same that
   *  `carom run` prints. */
  stateHash(): string;

  /** How many spheres there are. */
  readonly count: number;
  /** Centres [m]: x, y, z, x, y, z, ... */
  readonly positions: Float64Array;
  /** Velocities [m/s]: x, y, z, x, y, z, ... */
  readonly velocities: Float64Array;
  /** [m] */
  readonly radii: Float64Array;
  /** [kg] */
  readonly masses: Float64Array;
  /** Ids, ascending; an id is never given twice. `ids.indexOf(id)` is the place in the arrays. */
  readonly ids: Float64Array;
  /** Red, green, blue, red, ... in [0, 1] (sRGB). */
  readonly colors: Float32Array;
  /** How spheres are turned: quaternions x, y, z, w, x, ... */
  readonly orientations: Float64Array;
  /** Angular velocities, along the axes [rad/s]: x, y, z, x, y, z, ... */
  readonly angularVelocities: Float64Array;
  /** Moments of inertia divided by m r². */
  readonly inertiaFactors: Float64Array;
  /** Coefficients of friction, >= 0; `NaN` where a sphere says nothing of it: then the coefficient of
   *  what it touches counts. */
  readonly frictions: Float64Array;
  /** Coefficients of rolling friction, as `frictions`. */
  readonly rollingFrictions: Float64Array;
  /** Coefficients of spinning friction, as `frictions`. */
  readonly spinningFrictions: Float64Array;
  /** Coefficients of tangential restitution in [0, 1], as `frictions`. */
  readonly tangentialRestitutions: Float64Array;
  /** Writes for each sphere the matrix of 4 by 4 that takes the unit sphere to it, turned as it is,
   *  column by column: for `THREE.InstancedMesh.instanceMatrix.array`.
   *  @throws {RangeError} if there is not room */
  writeMatrices(matrices: Float32Array | Float64Array | number[]): void;

  /** Impacts of the last frame in order of time, an object each. */
  readonly impacts: Impact[];
  /** How many there are. */
  readonly impactCount: number;
  /** The same as one array of numbers, `IMPACT_COLUMNS.count` for each, a view as those above. */
  readonly impactTable: Float64Array;
  /** Spheres that emitters put into the world in the last frame. */
  readonly emitted: number[];
  /** Spheres that emitters took out again to make place. */
  readonly retired: number[];
  /** Numbers of the spheres that emitters left out, for there was no room (`needs_room` of an emitter, the
   *  default under the rule `contact`): no sphere ever has them. */
  readonly leftOut: number[];
  /** Spheres inside triggers at the end of the last frame. One that goes through a trigger within a frame is
   *  not among them: make a trigger wider than the way of a frame, or the steps shorter. */
  readonly triggers: { collider: number; sphere: number }[];
  /** The work of the last frame. */
  readonly work: StageCounts;
  /** What became of the energy in the last frame. */
  readonly energyAccount: EnergyAccount;
  /** How good the solution of the last frame is, by `contact` and in stepped zones. */
  readonly contactAccount: ContactAccount;
  /** What was stepped in the last frame by `exact`. */
  readonly zoneAccount: ZoneAccount;
  /** Whether spheres were in zones so far. */
  readonly wasStepped: boolean;

  /** The contacts that persist, in the order of ids, pairs of spheres first: what a ball that lies on
   *  the floor is in. Known by `exact` and `contact` after a step; none where something was changed
   *  since, or by other rules. By `exact`, reading them solves for the forces. */
  readonly contacts: PersistentContact[];
  /** Whether spheres are turned or turn, or may come to: an emitter emits such, or there is friction,
   *  which acts by `exact` and `contact`. */
  readonly hasSpin: boolean;

  /** [J], the energy of rotation included. */
  kineticEnergy(): number;
  /** Kinetic energy of rotation [J]. */
  rotationalEnergy(): number;
  /** [J], in all springs and all forces that have one. */
  potentialEnergy(): number;
  /** [J] */
  totalEnergy(): number;
  /** [kg m/s] */
  momentum(): [number, number, number];
  /** About the origin [kg m²/s], that of spin included. */
  angularMomentum(): [number, number, number];

  /** Names, emitters, camera, light and colours of the scene. */
  readonly scene: Scene;
  /** How the world is stepped. */
  readonly simulation: Simulation;
  /** Surfaces where they are now, to be drawn. */
  readonly colliders: Collider[];
  /** Forces, each with its id. */
  readonly forces: (Force & { id: number })[];
  /** Springs, each with its id. */
  readonly springs: Spring[];
  /** One sphere. @throws {CaromError} if it is not in the world */
  sphere(id: number): Sphere;
  /** The world of now as the text of a scene file: there, time begins at 0, and emitters begin
   *  anew. */
  toToml(): string;

  /** Adds all of these, or nothing, and answers with their ids. They may overlap what is there.
   *  @throws {SceneError} */
  add(part: {
    spheres?: SphereDescription[];
    generators?: Generator[];
    colliders?: ColliderDescription[];
    forces?: Force[];
  }): { spheres: number[]; colliders: number[]; forces: number[] };
  /** Adds one, and answers with its id. @throws {SceneError} */
  addSphere(sphere: SphereDescription): number;
  /** Adds one, and answers with its id. @throws {SceneError} */
  addCollider(collider: ColliderDescription): number;
  /** Adds one, and answers with its id. @throws {SceneError} */
  addForce(force: Force): number;

  /** Adds a spring between two spheres, or from one to a fixed point, and answers with its id. It goes with
   *  either sphere. @throws {CaromError} */
  addSpring(spring: SpringDescription): number;

  /** Changes what is given of a sphere. @throws {CaromError} */
  setSphere(id: number, changes: SphereDescription): void;
  /** Changes what is given of a collider. In a new place it is at once: what is there it does not push, and
   *  a ball whose centre is in a box then falls through. What moves gets a `velocity` [m/s] and an
   *  `angularVelocity` [rad/s], which take it along in the next steps. @throws {CaromError} */
  setCollider(id: number, changes: Partial<ColliderDescription>): void;
  /** Puts a force in the place of another. @throws {CaromError} */
  setForce(id: number, force: Force): void;
  /** Changes what is given of a spring: what it joins, or how it pulls. @throws {CaromError} */
  setSpring(id: number, changes: SpringChanges): void;
  /** Changes what is given of how the world is stepped. @throws {SceneError} */
  setSimulation(changes: SimulationChanges): void;
  /** @throws {CaromError} if it is not in the world */
  removeSphere(id: number): void;
  /** @throws {CaromError} if there is no such collider */
  removeCollider(id: number): void;
  /** @throws {CaromError} if there is no such force */
  removeForce(id: number): void;
  /** @throws {CaromError} if there is no such spring */
  removeSpring(id: number): void;

  /** Gives the memory of the world back now, and not when it is collected as garbage. */
  free(): void;
}

// `using world = ...`, for those whose TypeScript knows it.
declare global {
  interface SymbolConstructor {
    readonly dispose: unique symbol;
  }
}
export interface World {
  [Symbol.dispose](): void;
}
export interface Snapshot {
  [Symbol.dispose](): void;
}
