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
  Quaternion,
  Scene,
  Simulation,
  SimulationChanges,
  Sphere,
  SphereDescription,
  Spring,
  SpringChanges,
  SpringDescription,
  Vector,
} from "./descriptions.js";
import type { Emitter, EmitterDescription } from "./emitters.js";
import type { MaterialPair } from "./materials.js";
import type { Hit, NearBody, PredictedPath, QueryFilter } from "./queries.js";
import type {
  ContactAccount,
  EnergyAccount,
  Impact,
  ImpactGroup,
  Overlap,
  PersistentContact,
  SensorEvent,
  StageCounts,
  WellEvent,
  ZoneAccount,
} from "./reports.js";
import type { Strike } from "./strike.js";

export * from "./boundary.js";
export * from "./descriptions.js";
export * from "./emitters.js";
export * from "./materials.js";
export * from "./thermostats.js";
export * from "./queries.js";
export * from "./reports.js";
export * from "./shapes.js";
export * from "./strike.js";

/** Positions of the values in a row of `World.impactTable`; vectors take three numbers. */
export const IMPACT_COLUMNS: Readonly<{
  time: 0;
  /** 1 if body 1 is a collider, 0 if it is a sphere. */
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
  /** Numbers per row. */
  count: 16;
}>;

/** The state of a world at one time. Garbage collection or `free` releases its memory. */
export class Snapshot {
  private constructor();
  /**
   * Returns the snapshot from bytes of `toBytes`, of Python or of the C interface. A checksum detects
   * damage, but not malicious bytes: read only bytes that you trust.
   * @throws {CaromError} if the bytes are no snapshot, from another version of Carom, or damaged
   */
  static fromBytes(bytes: Uint8Array | ArrayBuffer): Snapshot;
  /** Returns the snapshot as bytes, the same ones on every platform, to store or send it. */
  toBytes(): Uint8Array;
  /** Time of the snapshot [s]. */
  readonly time: number;
  free(): void;
}

/** Where a collider is to be; what is missing stays as it is. */
export interface Pose {
  /** Position of its centre [m]. */
  position?: Vector;
  /** Rotation x, y, z, w. */
  rotation?: Quaternion;
}

/** A call that the engine refused. The world is unchanged. */
export class CaromError extends Error {}

/** An invalid scene or part of a scene. */
export class SceneError extends CaromError {
  /** Path of the faulty field, for example `colliders[1].restitution`; empty if there is none. */
  readonly field: string;
  /** Line in the text of the scene, from 1, if there is a text. */
  readonly line: number | undefined;
}

/** A built-in scene in the list. */
export interface ListedScene {
  name: string;
  title: string;
  description: string;
  origin: string;
}

/** Returns the list of built-in scenes. */
export function scenes(): ListedScene[];

/**
 * New values for fields of a scene by their paths, as in `carom run --set`; `null` removes a field:
 * `{ "simulation.rule": "exact", "emitters.0.max_spheres": null }`.
 */
export type Overrides = Record<string, unknown>;

/**
 * Spheres, forces on them, and colliders that they bounce off.
 *
 * **Arrays** (`positions` and the like) are views of the engine's memory: they are not copied, and
 * must not be written. Read them from the world each time, because a step, an addition, or any
 * world that makes the memory grow may move them. Copy (`.slice()`) what you keep. The engine
 * stores rotation and friction only if a sphere needs them; otherwise you get arrays of the
 * defaults.
 *
 * A call that throws leaves the world unchanged.
 */
export class World {
  /** Makes an empty world at time 0. @throws {SceneError} */
  constructor(simulation?: SimulationChanges);

  /**
   * Makes the world of a built-in scene, by name or title, or of the text of a scene file.
   * @throws {SceneError} with the line of the error in the text
   */
  static fromScene(nameOrToml: string, overrides?: Overrides): World;

  /** Advances the world by `dt` [s]; default: the frame time of the scene. @throws {CaromError} */
  step(dt?: number): void;
  /**
   * Returns the time of the next impact [s], if it is within `within` [s]. Costs as much as a copy
   * of the world and the step to that impact.
   * @throws {CaromError} under other rules than `exact`
   */
  nextEventTime(within: number): number | undefined;
  /**
   * Advances the world to its next impact and resolves it with all others at that time, at most by
   * `within` [s].
   * @throws {CaromError} under other rules than `exact`
   */
  stepToNextEvent(within: number): void;
  /** Time since the start [s]: the sum of all steps. */
  readonly time: number;
  /** Frame time of the scene [s]. */
  readonly frameTime: number;

  /**
   * The longest frame [s] in which motion on springs is certainly stable; infinite without springs,
   * and under the rule `exact`. The other rules refuse longer frames.
   */
  readonly longestStableFrame: number;

  /** Returns a snapshot of everything that the future depends on. */
  snapshot(): Snapshot;
  /**
   * Takes a snapshot into the memory of an earlier one, which is overwritten: for a game that goes
   * back, and takes one in each frame.
   */
  snapshotInto(snapshot: Snapshot): void;
  /**
   * Restores a snapshot of this or another world, bit for bit. The impacts of the last frame are
   * removed.
   */
  restore(snapshot: Snapshot): void;
  /**
   * Returns the state hash in 16 hexadecimal digits, to compare worlds to the bit; `carom run`
   * prints the same.
   */
  stateHash(): string;

  /** Number of spheres. */
  readonly count: number;
  /** Centres [m]: x, y, z, x, y, z, ... */
  readonly positions: Float64Array;
  /** Velocities [m/s]: x, y, z, x, y, z, ... */
  readonly velocities: Float64Array;
  /** Radii [m]. */
  readonly radii: Float64Array;
  /** Masses [kg]. */
  readonly masses: Float64Array;
  /** Coefficients of restitution in [0, 1]. */
  readonly restitutions: Float64Array;
  /** Ids, ascending; an id is never reused. `ids.indexOf(id)` is the index in the arrays. */
  readonly ids: Float64Array;
  /** Colours: red, green, blue, red, ... in [0, 1] (sRGB). */
  readonly colors: Float32Array;
  /** Orientations: quaternions x, y, z, w, x, ... */
  readonly orientations: Float64Array;
  /** Angular velocities [rad/s]: x, y, z, x, y, z, ... */
  readonly angularVelocities: Float64Array;
  /** Moments of inertia divided by m r². */
  readonly inertiaFactors: Float64Array;
  /**
   * Coefficients of friction, >= 0; `NaN` for a sphere without its own: then the coefficient of the
   * touching body counts.
   */
  readonly frictions: Float64Array;
  /** Coefficients of rolling friction, as `frictions`. */
  readonly rollingFrictions: Float64Array;
  /** Coefficients of spinning friction, as `frictions`. */
  readonly spinningFrictions: Float64Array;
  /** Coefficients of tangential restitution in [0, 1], as `frictions`. */
  readonly tangentialRestitutions: Float64Array;
  /** Forces applied to single spheres [N]: x, y, z, x, ...; each acts until it is set again. */
  readonly appliedForces: Float64Array;
  /**
   * Applies a force [N] to each sphere, besides those that act on all: x, y, z, x, y, z, ... in the
   * order of the arrays. An empty list removes them; new spheres have none.
   * @throws {CaromError} for another number of forces than spheres, or one that is not finite
   */
  setAppliedForces(forces: Iterable<number>): void;
  /**
   * Writes for each sphere the 4 by 4 matrix that maps the unit sphere to it, with its rotation,
   * column by column: for `THREE.InstancedMesh.instanceMatrix.array`.
   * @throws {RangeError} if `matrices` is too short
   */
  writeMatrices(matrices: Float32Array | Float64Array | number[]): void;

  /** Impacts of the last frame in order of time. */
  readonly impacts: Impact[];
  /** Number of impacts of the last frame. */
  readonly impactCount: number;
  /** The impacts as one array, `IMPACT_COLUMNS.count` numbers for each; a view like those above. */
  readonly impactTable: Float64Array;
  /** Groups of impacts at one time in the last frame; none under `discrete` and `bisect`. */
  readonly impactGroups: ImpactGroup[];
  /** Ids of the spheres that emitters added in the last frame. */
  readonly emitted: number[];
  /** Ids of the spheres that emitters removed to make space. */
  readonly retired: number[];
  /**
   * Ids of the spheres that emitters left out for lack of space (`needs_room` of an emitter, the
   * default under the rule `contact`); no sphere ever has them.
   */
  readonly leftOut: number[];
  /**
   * Spheres inside triggers at the end of the last frame. A sphere that passes a trigger within a
   * frame is not among them; `sensorEvents` has it.
   */
  readonly triggers: { collider: number; sphere: number }[];
  /** Entries of spheres into triggers, and exits, of the last frame in order of time. */
  readonly sensorEvents: SensorEvent[];
  /** What pairs of spheres did at the edges of their wells in the last frame, in order of time. */
  readonly wellEvents: WellEvent[];
  /** The work of the last frame. */
  readonly work: StageCounts;
  /** Changes of the energy in the last frame. */
  readonly energyAccount: EnergyAccount;
  /** Quality of the solution of the last frame, under `contact` and in stepped zones. */
  readonly contactAccount: ContactAccount;
  /** Spheres that `exact` stepped in the last frame. */
  readonly zoneAccount: ZoneAccount;
  /** Groups in which two bodies met as often as a frame allows, under the rule `bisect`. */
  readonly unfinishedIslands: number;
  /** Whether any sphere was ever in a zone. */
  readonly wasStepped: boolean;

  /**
   * Persistent contacts in the order of ids, pairs of spheres first; for example those of a ball
   * that lies on the floor. Available after a step under `exact` and `contact`; empty after a
   * change, or under other rules. Under `exact`, reading them solves for the forces.
   */
  readonly contacts: PersistentContact[];
  /**
   * Returns the bodies that overlap by more than `tolerance` [m] (default: 0), in the order of ids.
   * @throws {CaromError} if the tolerance is negative
   */
  overlaps(tolerance?: number): Overlap[];
  /**
   * Whether spheres are rotated or rotate, or may start to: because an emitter emits such spheres,
   * or by friction, which acts under `exact` and `contact`.
   */
  readonly hasSpin: boolean;

  /**
   * Returns what a ray meets first that starts at `origin` and leads along `way` to its end [m]. A
   * rectangle is met from its front only.
   * @throws {CaromError} if a number is not finite, or the way crosses too many periodic boxes
   */
  castRay(origin: Vector, way: Vector, filter?: QueryFilter): Hit | undefined;
  /**
   * Returns what many rays meet first, much faster than as many calls of `castRay`. `origins` and
   * `ways` are arrays like `positions`: x, y, z, x, y, z, ...
   * @throws {CaromError} as `castRay`
   */
  castRays(
    origins: Iterable<number>,
    ways: Iterable<number>,
    filter?: QueryFilter,
  ): (Hit | undefined)[];
  /**
   * Returns what a sphere meets first that moves straight from `center` along `way` to its end [m].
   * @throws {CaromError} as `castRay`, and if the radius is not positive
   */
  castSphere(center: Vector, radius: number, way: Vector, filter?: QueryFilter): Hit | undefined;
  /**
   * Returns the body nearest to a point, if its surface is at most `within` [m] away (default:
   * however far).
   * @throws {CaromError} if a number is not finite or `within` is negative
   */
  nearest(point: Vector, within?: number, filter?: QueryFilter): NearBody | undefined;
  /**
   * Returns the bodies that touch or overlap a sphere [m]: spheres first, then colliders, in the
   * order of ids.
   * @throws {CaromError} if the radius is not positive
   */
  overlapping(center: Vector, radius: number, filter?: QueryFilter): NearBody[];
  /**
   * Predicts the path of a sphere for `horizon` [s], or up to its impact number `mostImpacts`
   * (default: 10,000), without a step: flights in closed form, and what it meets. The other spheres keep to their
   * flights, but for those that it strikes. While nothing else interferes, steps under `exact` give
   * the same to the bit.
   * @throws {CaromError} if the sphere is not in the world or the horizon not positive, and with
   * springs or forces that are not linear
   */
  predict(id: number, horizon: number, mostImpacts?: number): PredictedPath;

  /** Returns the kinetic energy, with rotation [J]. */
  kineticEnergy(): number;
  /** Returns the kinetic energy of rotation [J]. */
  rotationalEnergy(): number;
  /** Returns the potential energy in all springs and forces that have one [J]. */
  potentialEnergy(): number;
  /** Returns the kinetic and potential energy [J]. */
  totalEnergy(): number;
  /** Returns the momentum [kg m/s]. */
  momentum(): [number, number, number];
  /** Returns the angular momentum about the origin, with spin [kg m²/s]. */
  angularMomentum(): [number, number, number];

  /** Names, emitters, camera, light and colours of the scene. */
  readonly scene: Scene;
  /** Simulation settings. */
  readonly simulation: Simulation;
  /** Colliders with their present poses, for drawing. */
  readonly colliders: Collider[];
  /** Forces with their ids. */
  readonly forces: (Force & { id: number })[];
  /** Pairs of materials whose contacts have coefficients of their own. */
  readonly materialPairs: MaterialPair[];
  /** Emitters with their ids, in the order in which they emit. */
  readonly emitters: Emitter[];
  /** Springs with their ids. */
  readonly springs: Spring[];
  /** Returns one sphere. @throws {CaromError} if it is not in the world */
  sphere(id: number): Sphere;
  /**
   * Returns the present world as the text of a scene file. There, time starts at 0 and emitters
   * start again.
   */
  toToml(): string;

  /**
   * Adds all of these, or none. Returns their ids. They may overlap existing ones.
   * @throws {SceneError}
   */
  add(part: {
    spheres?: SphereDescription[];
    generators?: Generator[];
    colliders?: ColliderDescription[];
    forces?: Force[];
  }): { spheres: number[]; colliders: number[]; forces: number[] };
  /** Adds a sphere. Returns its id. @throws {SceneError} */
  addSphere(sphere: SphereDescription): number;
  /** Adds a collider. Returns its id. @throws {SceneError} */
  addCollider(collider: ColliderDescription): number;
  /** Adds a force. Returns its id. @throws {SceneError} */
  addForce(force: Force): number;

  /**
   * Adds a spring between two spheres, or from one to a fixed point. Returns its id. It is removed
   * with either sphere.
   * @throws {CaromError}
   */
  addSpring(spring: SpringDescription): number;

  /** Adds an emitter, whose first sphere is due now. Returns its id. @throws {SceneError} */
  addEmitter(emitter: EmitterDescription): number;

  /** Changes the given properties of a sphere. @throws {CaromError} */
  setSphere(id: number, changes: SphereDescription): void;
  /**
   * Applies an impulse [N s] to a sphere at its centre: its velocity changes by the impulse over
   * its mass.
   * @throws {CaromError} if it is not in the world, or the new velocity is not finite
   */
  applyImpulse(id: number, impulse: Vector): void;
  /**
   * Applies an impulse [N s] to a sphere at a point [m]: also its angular velocity changes, by
   * (point - centre) × impulse over its moment of inertia.
   * @throws {CaromError} as `applyImpulse`
   */
  applyImpulseAt(id: number, impulse: Vector, point: Vector): void;
  /**
   * Strikes a sphere with a cue: its velocity and its angular velocity change at once.
   * @throws {CaromError} if the sphere is not in the world, or a number is invalid
   */
  strike(id: number, strike: Strike): void;
  /** Sets the velocity of a sphere [m/s]. @throws {CaromError} */
  setVelocity(id: number, velocity: Vector): void;
  /** Sets the angular velocity of a sphere [rad/s]. @throws {CaromError} */
  setAngularVelocity(id: number, angularVelocity: Vector): void;
  /**
   * Changes the given properties of a collider. A new position applies at once, without pushing
   * spheres; a ball whose centre is then in a box falls through it. To move a collider, use
   * `setNextPose`, or set `velocity` [m/s] and `angularVelocity` [rad/s], with which the next steps
   * move it.
   * @throws {CaromError}
   */
  setCollider(id: number, changes: Partial<ColliderDescription>): void;
  /**
   * Sets the velocities of a collider so that it reaches a pose after `dt` [s] (default: the frame
   * time of the scene), by the shorter rotation. A step of this length takes it there, and spheres
   * feel its velocity. It moves on until it gets another velocity.
   * @throws {CaromError} if there is no such collider, a number is invalid, or a motion moves it
   */
  setNextPose(id: number, pose: Pose, dt?: number): void;
  /** Replaces a force. @throws {CaromError} */
  setForce(id: number, force: Force): void;
  /** Changes the given properties of a spring: its ends, or how it pulls. @throws {CaromError} */
  setSpring(id: number, changes: SpringChanges): void;
  /**
   * Changes the given properties of an emitter. With another period it starts again now.
   * @throws {CaromError}
   */
  setEmitter(id: number, changes: Partial<EmitterDescription>): void;
  /**
   * Replaces the pairs of materials, which are those of the scene; later steps use them.
   * @throws {SceneError} for a material that the scene does not have, or an invalid number
   */
  setMaterialPairs(pairs: MaterialPair[]): void;
  /** Changes the given simulation settings. @throws {SceneError} */
  setSimulation(changes: SimulationChanges): void;
  /** @throws {CaromError} if it is not in the world */
  removeSphere(id: number): void;
  /** @throws {CaromError} if there is no such collider */
  removeCollider(id: number): void;
  /** @throws {CaromError} if there is no such force */
  removeForce(id: number): void;
  /** @throws {CaromError} if there is no such spring */
  removeSpring(id: number): void;
  /** Removes an emitter; its spheres stay. @throws {CaromError} if there is no such emitter */
  removeEmitter(id: number): void;

  /** Releases the memory of the world now, without waiting for garbage collection. */
  free(): void;
}

// `using world = ...`, for versions of TypeScript that support it.
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
