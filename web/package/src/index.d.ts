/**
 * Carom moves spheres exactly: event-driven collisions in double precision, with the same bits on every
 * machine. Right-handed coordinate system, y up, SI units.
 *
 * @example
 * const world = World.fromScene("tutorial3");
 * for (let frame = 0; frame < 60; frame++) world.step();
 * console.log(world.time, world.positions, world.stateHash());
 */

/** Three numbers x, y, z: an array, a typed array, or anything that yields them, as `THREE.Vector3`. */
export type Vector = Iterable<number>;

/** A rotation x, y, z, w, of any length but zero, as four numbers. */
export type Quaternion = Iterable<number>;

/** Red, green, blue in [0, 1] (sRGB). */
export type Color = [number, number, number];

/** How a surface takes light: a soft highlight (`satin`) unless given. */
export type Finish = "matte" | "satin" | "glossy" | "metal" | "glass";

/** A sphere as it is added. */
export interface SphereDescription {
  /** Centre [m]; the origin unless given. */
  position?: Vector;
  /** [m/s]; at rest unless given. */
  velocity?: Vector;
  /** [m], > 0. Give this or `diameter`. */
  radius?: number;
  /** [m], > 0. Give this or `radius`. */
  diameter?: number;
  /** [kg], > 0; 1 unless this or `density` is given. */
  mass?: number;
  /** [kg/m³], > 0, instead of `mass`. */
  density?: number;
  /** Coefficient of restitution in [0, 1]; 1 unless given. */
  restitution?: number;
  /** Coulomb's coefficient of friction, >= 0, by `exact` and `contact`. If missing, the other body's value counts. */
  friction?: number;
  /** Coefficient of rolling friction, >= 0. If missing, the other body's value counts. */
  rollingFriction?: number;
  /** Coefficient of spinning friction, >= 0. If missing, the other body's value counts. */
  spinningFriction?: number;
  /** Coefficient of tangential restitution in [0, 1]. If missing, the other body's value counts. */
  tangentialRestitution?: number;
  /** How it is turned, x, y, z, w; not turned unless given. */
  orientation?: Quaternion;
  /** Along the axis [rad/s]; it does not turn unless given. */
  angularVelocity?: Vector;
  /** Moment of inertia divided by m r², > 0; 0.4, that of a solid ball, unless given. */
  inertiaFactor?: number;
  /** By density, or the scene's own, unless given. */
  color?: Iterable<number>;
  /** How its surface takes light; it changes no motion. */
  finish?: Finish;
}

/** A sphere as it is. */
export interface Sphere {
  /** Centre [m]. */
  position: [number, number, number];
  /** [m/s] */
  velocity: [number, number, number];
  /** [m] */
  radius: number;
  /** [kg] */
  mass: number;
  /** Coefficient of restitution in [0, 1]. */
  restitution: number;
  /** Coulomb's coefficient of friction, >= 0, by `exact` and `contact`. If missing, the other body's value counts. */
  friction?: number;
  /** Coefficient of rolling friction, >= 0. If missing, the other body's value counts. */
  rollingFriction?: number;
  /** Coefficient of spinning friction, >= 0. If missing, the other body's value counts. */
  spinningFriction?: number;
  /** Coefficient of tangential restitution in [0, 1]. If missing, the other body's value counts. */
  tangentialRestitution?: number;
  /** How it is turned, x, y, z, w; not turned unless given. */
  orientation?: [number, number, number, number];
  /** Along the axis [rad/s]; it does not turn unless given. */
  angularVelocity?: [number, number, number];
  /** Moment of inertia divided by m r², > 0; 0.4, that of a solid ball, unless given. */
  inertiaFactor?: number;
  /** Red, green, blue (sRGB). */
  color: Color;
  /** How its surface takes light; it changes no motion. */
  finish?: Finish;
}

/** What a generator makes: spheres, or colliders whose names get the numbers of their places. */
export type Generated = { sphere: SphereDescription } | { collider: ColliderDescription };

/** Places for many spheres or colliders, as scene files describe them. */
export type Generator =
  | { row: { count: number; start: Vector; step: Vector } & Generated }
  | { lattice: { counts: Vector; start: Vector; spacing: Vector } & Generated }
  /** Rows, each centred on the one before; `counts` begin anew where there are more rows. */
  | {
      staggeredRows: {
        rows: number;
        counts: number[];
        start: Vector;
        step: Vector;
        rowStep: Vector;
      } & Generated;
    }
  /** Hexagonal layers, one above the other along +y; `spacing` is the diameter unless given. */
  | {
      closePacking: {
        counts: Vector;
        start: Vector;
        spacing?: number;
        /** `"hcp"` unless given. */
        stacking?: "hcp" | "fcc";
        sphere: SphereDescription;
      };
    }
  /**
   * Evenly on a circle, about an axis that points up unless given; colliders are turned about it
   * along with their places.
   */
  | {
      ring: {
        count: number;
        center: Vector;
        radius: number;
        axis?: Vector;
      } & Generated;
    }
  | {
      random: {
        count: number;
        min: Vector;
        max: Vector;
        seed: number;
        speed?: number;
        radiusRange?: [number, number];
        sphere: SphereDescription;
      };
    };

/** Form of a collider in its own frame. Lengths are full ones [m], > 0. */
export type Shape =
  | { sphere: { radius: number } }
  /** In the local xz plane, facing local +y; from behind spheres pass it. */
  | { rectangle: { sizeX: number; sizeZ: number } }
  /** Everything below the local xz plane. */
  | "half-space"
  | { box: { size: [number, number, number] } }
  /** Hollow: walls without thickness, off which spheres bounce on either side. */
  | { container: { size: [number, number, number]; open?: Side | Side[] } };

/** A side of a box in its own frame: towards -x, +x, -y, +y, -z, +z. */
export type Side = "left" | "right" | "bottom" | "top" | "back" | "front";

/** A surface as it is added. */
export interface ColliderDescription {
  shape: Shape;
  /** What it is called. */
  name?: string;
  /** Of its centre [m]; the origin unless given. */
  position?: Vector;
  /** x, y, z, w; not turned unless given. */
  rotation?: Quaternion;
  /** Of its centre [m/s]. */
  velocity?: Vector;
  /** About its centre, along the axis [rad/s]. */
  angularVelocity?: Vector;
  /** Coefficient of restitution in [0, 1]; 1 unless given. */
  restitution?: number;
  /** Coulomb's coefficient of friction, >= 0, by `exact` and `contact`. If missing, the other body's value counts. */
  friction?: number;
  /** Coefficient of rolling friction, >= 0. If missing, the other body's value counts. */
  rollingFriction?: number;
  /** Coefficient of spinning friction, >= 0. If missing, the other body's value counts. */
  spinningFriction?: number;
  /** Coefficient of tangential restitution in [0, 1]. If missing, the other body's value counts. */
  tangentialRestitution?: number;
  /** A trigger reports contact at the end of a frame, and deflects nothing. */
  trigger?: boolean;
  /** Whether it is to be drawn. */
  visible?: boolean;
  /** The scene's own unless given. */
  color?: Iterable<number>;
  /** How its surface takes light; it changes no motion. */
  finish?: Finish;
}

/** A surface as it is. */
export interface Collider {
  id: number;
  name: string;
  shape: Shape;
  /** [m] */
  position: [number, number, number];
  /** x, y, z, w */
  rotation: [number, number, number, number];
  /** [m/s] */
  velocity: [number, number, number];
  /** [rad/s] */
  angularVelocity: [number, number, number];
  restitution: number;
  /** Coulomb's coefficient of friction, >= 0, by `exact` and `contact`. If missing, the other body's value counts. */
  friction?: number;
  /** Coefficient of rolling friction, >= 0. If missing, the other body's value counts. */
  rollingFriction?: number;
  /** Coefficient of spinning friction, >= 0. If missing, the other body's value counts. */
  spinningFriction?: number;
  /** Coefficient of tangential restitution in [0, 1]. If missing, the other body's value counts. */
  tangentialRestitution?: number;
  trigger: boolean;
  visible: boolean;
  color: Color;
  /** How its surface takes light; it changes no motion. */
  finish?: Finish;
}

/** A force on every sphere. */
export type Force =
  /** The same acceleration for every sphere [m/s²]. */
  | { gravity: { acceleration: Vector } }
  /** The same force on every sphere, whatever its mass [N]. */
  | { constant: { force: Vector } }
  /** Against the velocity and proportional to it; the coefficient [kg/s], >= 0. */
  | { viscousDrag: { coefficient: number } }
  /** Gravity of a fixed point mass: G M [m³/s²]; `position` and `softening` [m]. */
  | {
      pointAttractor: { gravitationalParameter: number; position?: Vector; softening?: number };
    }
  /** Gravity between spheres: nature's constant [m³/(kg s²)] unless given; `softening` [m]. */
  | { mutualGravity: { constant?: number; softening?: number; openingAngle?: number } }
  /** Viscous drag in a wind [m/s]; the coefficient [kg/s], >= 0. */
  | { wind: { velocity: Vector; coefficient: number } }
  /** Viscous drag in air that goes round an axis: circulation [m²/s], core radius [m]. */
  | {
      vortex: {
        circulation: number;
        coreRadius: number;
        coefficient: number;
        position?: Vector;
        axis?: Vector;
      };
    }
  /** Drag of a medium by the square of the velocity: density [kg/m³], viscosity [Pa s], wind [m/s]. */
  | {
      quadraticDrag: {
        density: number;
        dragCoefficient?: number;
        viscosity?: number;
        wind?: Vector;
      };
    }
  /** Buoyancy in a fluid with a level surface: density [kg/m³], height [m], gravity [m/s²]. */
  | { buoyancy: { density: number; surfaceHeight?: number; gravity?: Vector } };

/** What a spring joins: two spheres, or a sphere and a fixed point `anchor` [m]. Spheres go by their ids. */
export type SpringEnds = { spheres: [number, number] } | { sphere: number; anchor: Vector };

/** How a spring pulls. */
export interface SpringNumbers {
  /** Length without force [m], >= 0; the length at the moment it is added unless given. */
  restLength?: number;
  /** [N/m], >= 0 */
  stiffness: number;
  /** [kg/s], >= 0; 0 unless given. */
  damping?: number;
  /** Whether it only pulls, as a thread does, which is slack up to its rest length. */
  onlyPulls?: boolean;
}

/** A spring with a damper beside it, as it is added. */
export type SpringDescription = SpringEnds & SpringNumbers;

/** What changes of a spring. */
export interface SpringChanges extends Partial<SpringNumbers> {
  /** Ids of the two spheres that it joins, instead of what it joined. */
  spheres?: [number, number];
  /** Id of the sphere at its first end, of a spring that ends at a point. */
  sphere?: number;
  /** The fixed point [m] at which it ends. */
  anchor?: Vector;
}

/** A spring as it is: it has `spheres`, or `sphere` and `anchor`. */
export interface Spring extends Required<SpringNumbers> {
  id: number;
  /** Ids of the two spheres that it joins. */
  spheres?: [number, number];
  /** Id of the sphere that it joins to a fixed point. */
  sphere?: number;
  /** The fixed point [m]. */
  anchor?: [number, number, number];
}

/** How spheres move under forces, by `bisect` and `discrete`; `exact` needs none. */
export type Integrator =
  "semi-implicit-euler" | "explicit-euler" | "velocity-verlet" | "runge-kutta-4";

/** Coefficient of a contact from those of its two bodies. */
export type CombineRule = "product" | "minimum" | "maximum" | "average" | "geometric-mean";

/** How a world is stepped. */
export interface Simulation {
  /** `exact` (the default) finds every impact at its own time. */
  rule: "exact" | "contact" | "bisect" | "discrete";
  /** Length of a frame [s], > 0; 1/60 unless given. */
  frameTime: number;
  /** Time worth watching [s], > 0. */
  duration: number;
  /** Whether spheres collide with one another; with colliders they always do. */
  spheresCollide: boolean;
  /** Restitution of a contact from that of its two bodies. */
  combineRule: CombineRule;
  /** Friction of a contact from that of its two bodies; `geometric-mean` unless given. */
  frictionCombineRule?: CombineRule;
  /** Whether spheres may overlap at the start. */
  allowOverlap: boolean;
  /** A box about the origin that repeats itself [m], `Infinity` along an open axis; by `exact`. */
  boundary: "open" | { periodic: { size: [number, number, number] } };
  /** Parameters of `exact`: how impacts at one instant among spheres that touch are answered; how
   *  long a contact lasts [s]; impacts per sphere and frame at most; whether spheres in contact that
   *  take too much work are stepped ("automatic" unless given), from which work of a group in a tick
   *  on, in contacts times iterations, and how long a tick is [s]; how long forces without a closed
   *  form are held [s]. */
  exact: {
    impactLaw: "reflection" | "simultaneous" | "sequential";
    contactDuration: number;
    maxImpacts: number;
    zones?: "automatic" | "never";
    zoneBudget?: number;
    zoneTick?: number;
    forceTick?: number;
  };
  /** Parameters of `bisect`. */
  bisect: {
    integrator: Integrator;
    tolerance: number;
    maxHalvings: number;
    maxImpacts: number;
    windBack: "touched" | "all";
  };
  /** Parameters of `discrete`. */
  discrete: { integrator: Integrator };
  /** Parameters of `contact`: sub-steps of a frame, sweeps over all contacts in each, whether sweeps go
   *  on until the solution has converged, and below which part of sqrt(a r), the speed after falling
   *  through half its radius, a ball may fall asleep, none with 0; 8, 2, false and 0.02 unless given. */
  contact?: { subSteps: number; sweeps: number; converged: boolean; sleepSpeed: number };
}

/** New values for how a world is stepped; what is not named stays. */
export type SimulationChanges = Partial<
  Omit<Simulation, "exact" | "bisect" | "discrete" | "contact">
> & {
  exact?: Partial<Simulation["exact"]>;
  bisect?: Partial<Simulation["bisect"]>;
  discrete?: Partial<Simulation["discrete"]>;
  contact?: Partial<NonNullable<Simulation["contact"]>>;
};

/** What a scene says besides what there is in its world. */
export interface Scene {
  name: string;
  title?: string;
  description?: string;
  origin?: string;
  /** Sources of spheres, in the words of scene files. */
  emitters?: object[];
  /** Looks along its local -z. */
  camera?: {
    position: [number, number, number];
    rotation: [number, number, number, number];
    verticalFovDegrees: number;
    near: number;
    far: number;
  };
  /** Shines along its local -z. */
  sun?: { rotation: [number, number, number, number]; color: Color; intensity: number };
  colors?: {
    background?: Color;
    colliders?: Color;
    spheres?: Color;
    densities?: { density: number; color: Color }[];
  };
}

/** Two bodies that met. */
export interface Impact {
  /** Since the start of the frame [s]. */
  time: number;
  /** Ids: of two spheres, bodies 1 and 2, or of a collider, body 1, and a sphere, body 2. */
  between: { spheres: [number, number] } | { collider: number; sphere: number };
  /** Where on the surface of body 1 [m]. */
  point: [number, number, number];
  /** Unit normal from body 1 to body 2. */
  normal: [number, number, number];
  /** Along the normal before the impact [m/s], > 0. */
  approachSpeed: number;
  /** Along the normal after it [m/s]. */
  separationSpeed: number;
  /** On body 2 along the normal, on body 1 against it [N s]. */
  impulse: number;
  /** Of friction, across the normal: on body 2, and against it on body 1 [N s]. */
  tangentialImpulse: [number, number, number];
}

/** Two bodies that stay in contact, and the force between them. */
export interface PersistentContact {
  /** Ids: of two spheres, bodies 1 and 2, or of a collider, body 1, and a sphere, body 2. */
  between: { spheres: [number, number] } | { collider: number; sphere: number };
  /** Where on the surface of body 1 [m]. */
  point: [number, number, number];
  /** Unit normal from body 1 to body 2. */
  normal: [number, number, number];
  /** Distance of the two surfaces [m]: zero but for rounding, negative where they overlap. */
  gap: number;
  /** On body 2 along the normal, on body 1 against it [N], >= 0. */
  normalForce: number;
  /** Force of friction on body 2, across the normal, and against it on body 1 [N]; zero under rules
   *  without friction. */
  tangentialForce: [number, number, number];
  /** Whether the surfaces slide on each other, or would at the least touch: friction is as large as
   *  it can be. */
  isSliding: boolean;
}

/** The work of a frame by stage: counts that depend on the world alone, not on the machine. */
export interface StageCounts {
  /** How often the next events of a sphere were predicted, by `exact`. */
  predictions: number;
  /** Pairs of spheres that were tested for a meeting; by other rules, for a contact. */
  pairTests: number;
  /** Events taken from the queue, void ones among them, by `exact`. */
  events: number;
  /** How many of these events were cell crossings. */
  cellCrossings: number;
  /** Groups of touching bodies that were answered as a whole, by `exact`. */
  groups: number;
  /** Iterations of the solvers of these groups, each counted once for every contact. */
  solverIterations: number;
  /** How often neighbours were found anew, by `contact`. */
  searches: number;
  /** How often all contacts were gone through, by `contact`. */
  sweeps: number;
  /** Contacts that a sweep goes through at the end of the frame, by `contact`. */
  contacts: number;
}

/** What became of the energy in a frame: `totalEnergy()` changes by these, by the work of forces that
 *  have no potential, and by the error of the integration. */
export interface EnergyAccount {
  /** Work of contacts [J]: what restitution and friction took, <= 0 but for errors. */
  contacts: number;
  /** Work of moving colliders [J]. */
  colliders: number;
  /** Work of moving spheres out of what they overlap [J]. */
  correction: number;
  /** Energy of emitted spheres, less that of those taken out [J]. */
  emission: number;
}

/** How good the solution of a frame is: by `contact`, and in the stepped zones of `exact`; else 0. */
export interface ContactAccount {
  /** Sub-steps in which impulses were scaled down for them not to add energy. */
  limitedSubSteps: number;
  /** Largest change of a normal impulse in the last sweep, as a part of the largest impulse. */
  residual: number;
  /** Largest overlap before it was corrected, as a part of the sum of radii. */
  largestOverlap: number;
  /** Spheres that sleep at the end of the frame: at rest, until something comes near or changes. */
  asleep: number;
  /** How often a sphere was pressed into a surface by half its radius, in each sub-step: no motion keeps
   *  apart what presses it. */
  squeezed: number;
}

/** Spheres that were not moved from impact to impact by `exact`, but stepped: their contacts took too
 *  much work. How good their motion is, `ContactAccount` tells. */
export interface ZoneAccount {
  /** Spheres in a zone at the end of the frame. */
  spheres: number;
  /** Time that they spent in it in this frame, of all together [s]. */
  sphereSeconds: number;
  /** Ticks at which a zone was stepped. */
  ticks: number;
  /** Spheres that came into a zone. */
  joined: number;
  /** Spheres that left one. */
  left: number;
}

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
