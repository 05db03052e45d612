/**
 * Carom moves spheres exactly: event-driven collisions in double precision, with the same bits on every
 * machine. Right-handed coordinate system, y up, SI units.
 *
 * @example
 * const world = World.fromScene("tutorial3");
 * for (let frame = 0; frame < 60; frame++) world.step();
 * console.log(world.time, world.positions, world.stateHash());
 */

/** Three numbers x, y, z: an array, a typed array, or any iterable, for example `THREE.Vector3`. */
export type Vector = Iterable<number>;

/** A rotation as a quaternion x, y, z, w of any length but zero. */
export type Quaternion = Iterable<number>;

/** Red, green, blue in [0, 1] (sRGB). */
export type Color = [number, number, number];

/** How a surface reflects light; the default is `satin`, a soft highlight. */
export type Finish = "matte" | "satin" | "glossy" | "metal" | "glass";

/** Properties of a new sphere. */
export interface SphereDescription {
  /** Centre [m]; default: the origin. */
  position?: Vector;
  /** Velocity [m/s]; default: at rest. */
  velocity?: Vector;
  /** Radius [m], > 0. Give this or `diameter`. */
  radius?: number;
  /** Diameter [m], > 0. Give this or `radius`. */
  diameter?: number;
  /** Mass [kg], > 0; default: 1 if `density` is not given. */
  mass?: number;
  /** Density [kg/m³], > 0, instead of `mass`. */
  density?: number;
  /** Coefficient of restitution in [0, 1]; default: 1. */
  restitution?: number;
<<<<<<< HEAD
  /** Coulomb's coefficient of friction, >= 0, by `exact` and `contact`. If missing, the other body's value counts. */
  friction?: number;
  /** Coefficient of rolling friction, >= 0. If missing, the other body's value counts. */
  rollingFriction?: number;
  /** Coefficient of spinning friction, >= 0. If missing, the other body's value counts. */
  spinningFriction?: number;
  /** Coefficient of tangential restitution in [0, 1]. If missing, the other body's value counts. */
=======
  /**
   * Coulomb's coefficient of friction, >= 0, under `exact` and `contact`; default: that of the
   * touching body.
   */
  friction?: number;
  /** Coefficient of rolling friction, >= 0; default: that of the touching body. */
  rollingFriction?: number;
  /** Coefficient of spinning friction, >= 0; default: that of the touching body. */
  spinningFriction?: number;
  /** Coefficient of tangential restitution in [0, 1]; default: that of the touching body. */
>>>>>>> plain-faces
  tangentialRestitution?: number;
  /** Orientation x, y, z, w; default: not rotated. */
  orientation?: Quaternion;
  /** Angular velocity [rad/s]; default: no rotation. */
  angularVelocity?: Vector;
  /** Moment of inertia divided by m r², > 0; default: 0.4, that of a solid ball. */
  inertiaFactor?: number;
  /** Colour; default: by density, or the scene's own. */
  color?: Iterable<number>;
  /** How the surface reflects light; without effect on motion. */
  finish?: Finish;
}

/** A sphere in a world. */
export interface Sphere {
  /** Centre [m]. */
  position: [number, number, number];
  /** Velocity [m/s]. */
  velocity: [number, number, number];
  /** Radius [m]. */
  radius: number;
  /** Mass [kg]. */
  mass: number;
  /** Coefficient of restitution in [0, 1]. */
  restitution: number;
<<<<<<< HEAD
  /** Coulomb's coefficient of friction, >= 0, by `exact` and `contact`. If missing, the other body's value counts. */
  friction?: number;
  /** Coefficient of rolling friction, >= 0. If missing, the other body's value counts. */
  rollingFriction?: number;
  /** Coefficient of spinning friction, >= 0. If missing, the other body's value counts. */
  spinningFriction?: number;
  /** Coefficient of tangential restitution in [0, 1]. If missing, the other body's value counts. */
=======
  /**
   * Coulomb's coefficient of friction, >= 0, under `exact` and `contact`; if missing, that of the
   * touching body.
   */
  friction?: number;
  /** Coefficient of rolling friction, >= 0; if missing, that of the touching body. */
  rollingFriction?: number;
  /** Coefficient of spinning friction, >= 0; if missing, that of the touching body. */
  spinningFriction?: number;
  /** Coefficient of tangential restitution in [0, 1]; if missing, that of the touching body. */
>>>>>>> plain-faces
  tangentialRestitution?: number;
  /** Orientation x, y, z, w; if missing, not rotated. */
  orientation?: [number, number, number, number];
  /** Angular velocity [rad/s]; if missing, no rotation. */
  angularVelocity?: [number, number, number];
  /** Moment of inertia divided by m r², > 0; if missing, 0.4, that of a solid ball. */
  inertiaFactor?: number;
  /** Red, green, blue (sRGB). */
  color: Color;
  /** How the surface reflects light; without effect on motion. */
  finish?: Finish;
}

/** What a generator makes: spheres, or colliders, whose names get their index. */
export type Generated = { sphere: SphereDescription } | { collider: ColliderDescription };

/** Positions of many spheres or colliders, as in scene files. */
export type Generator =
  | { row: { count: number; start: Vector; step: Vector } & Generated }
  | { lattice: { counts: Vector; start: Vector; spacing: Vector } & Generated }
  /** Rows, each centred on the one before; `counts` repeat if there are more rows. */
  | {
      staggeredRows: {
        rows: number;
        counts: number[];
        start: Vector;
        step: Vector;
        rowStep: Vector;
      } & Generated;
    }
  /** Hexagonal layers, one above the other along +y; the default `spacing` is the diameter. */
  | {
      closePacking: {
        counts: Vector;
        start: Vector;
        spacing?: number;
        /** Default: `"hcp"`. */
        stacking?: "hcp" | "fcc";
        sphere: SphereDescription;
      };
    }
  /**
   * Evenly on a circle about an axis, which points up by default. Colliders are rotated about it
   * with their positions.
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

/** Shape of a collider in its own frame. Lengths are full lengths [m], > 0. */
export type Shape =
  | { sphere: { radius: number } }
  /** In the local xz plane, facing local +y; spheres pass through it from behind. */
  | { rectangle: { sizeX: number; sizeZ: number } }
  /** Everything below the local xz plane. */
  | "half-space"
  | { box: { size: [number, number, number] } }
  /** Hollow: walls without thickness, with spheres bouncing off on both sides. */
  | { container: { size: [number, number, number]; open?: Side | Side[] } };

/** A side of a box in its own frame: towards -x, +x, -y, +y, -z, +z. */
export type Side = "left" | "right" | "bottom" | "top" | "back" | "front";

/** Properties of a new collider. */
export interface ColliderDescription {
  shape: Shape;
  /** Name. */
  name?: string;
  /** Position of its centre [m]; default: the origin. */
  position?: Vector;
  /** Rotation x, y, z, w; default: not rotated. */
  rotation?: Quaternion;
  /** Velocity of its centre [m/s]. */
  velocity?: Vector;
  /** Angular velocity about its centre [rad/s]. */
  angularVelocity?: Vector;
  /** Coefficient of restitution in [0, 1]; default: 1. */
  restitution?: number;
<<<<<<< HEAD
  /** Coulomb's coefficient of friction, >= 0, by `exact` and `contact`. If missing, the other body's value counts. */
  friction?: number;
  /** Coefficient of rolling friction, >= 0. If missing, the other body's value counts. */
  rollingFriction?: number;
  /** Coefficient of spinning friction, >= 0. If missing, the other body's value counts. */
  spinningFriction?: number;
  /** Coefficient of tangential restitution in [0, 1]. If missing, the other body's value counts. */
=======
  /**
   * Coulomb's coefficient of friction, >= 0, under `exact` and `contact`; default: that of the
   * touching body.
   */
  friction?: number;
  /** Coefficient of rolling friction, >= 0; default: that of the touching body. */
  rollingFriction?: number;
  /** Coefficient of spinning friction, >= 0; default: that of the touching body. */
  spinningFriction?: number;
  /** Coefficient of tangential restitution in [0, 1]; default: that of the touching body. */
>>>>>>> plain-faces
  tangentialRestitution?: number;
  /** Whether it is a trigger, which reports contact at the end of a frame but deflects nothing. */
  trigger?: boolean;
  /** Whether it is drawn. */
  visible?: boolean;
  /** Colour; default: the scene's own. */
  color?: Iterable<number>;
  /** How the surface reflects light; without effect on motion. */
  finish?: Finish;
}

/** A collider in a world. */
export interface Collider {
  id: number;
  name: string;
  shape: Shape;
  /** Position of its centre [m]. */
  position: [number, number, number];
  /** Rotation x, y, z, w. */
  rotation: [number, number, number, number];
  /** Velocity [m/s]. */
  velocity: [number, number, number];
  /** Angular velocity [rad/s]. */
  angularVelocity: [number, number, number];
  restitution: number;
<<<<<<< HEAD
  /** Coulomb's coefficient of friction, >= 0, by `exact` and `contact`. If missing, the other body's value counts. */
  friction?: number;
  /** Coefficient of rolling friction, >= 0. If missing, the other body's value counts. */
  rollingFriction?: number;
  /** Coefficient of spinning friction, >= 0. If missing, the other body's value counts. */
  spinningFriction?: number;
  /** Coefficient of tangential restitution in [0, 1]. If missing, the other body's value counts. */
=======
  /**
   * Coulomb's coefficient of friction, >= 0, under `exact` and `contact`; if missing, that of the
   * touching body.
   */
  friction?: number;
  /** Coefficient of rolling friction, >= 0; if missing, that of the touching body. */
  rollingFriction?: number;
  /** Coefficient of spinning friction, >= 0; if missing, that of the touching body. */
  spinningFriction?: number;
  /** Coefficient of tangential restitution in [0, 1]; if missing, that of the touching body. */
>>>>>>> plain-faces
  tangentialRestitution?: number;
  trigger: boolean;
  visible: boolean;
  color: Color;
  /** How the surface reflects light; without effect on motion. */
  finish?: Finish;
}

/** A force on every sphere. */
export type Force =
  /** The same acceleration for every sphere [m/s²]. */
  | { gravity: { acceleration: Vector } }
  /** The same force on every sphere [N], whatever its mass. */
  | { constant: { force: Vector } }
  /** Against the velocity and proportional to it; coefficient [kg/s], >= 0. */
  | { viscousDrag: { coefficient: number } }
  /** Gravity of a fixed point mass: G M [m³/s²]; `position` and `softening` [m]. */
  | {
      pointAttractor: { gravitationalParameter: number; position?: Vector; softening?: number };
    }
  /** Gravity between spheres; constant [m³/(kg s²)], by default nature's; `softening` [m]. */
  | { mutualGravity: { constant?: number; softening?: number; openingAngle?: number } }
  /** Viscous drag in wind [m/s]; coefficient [kg/s], >= 0. */
  | { wind: { velocity: Vector; coefficient: number } }
  /** Viscous drag in air that circles an axis: circulation [m²/s], core radius [m]. */
  | {
      vortex: {
        circulation: number;
        coreRadius: number;
        coefficient: number;
        position?: Vector;
        axis?: Vector;
      };
    }
  /**
   * Drag by the square of the velocity relative to a medium: density [kg/m³], viscosity [Pa s],
   * wind [m/s].
   */
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

/** Ends of a spring: ids of two spheres, or the id of a sphere and a fixed point `anchor` [m]. */
export type SpringEnds = { spheres: [number, number] } | { sphere: number; anchor: Vector };

/** Properties of a spring. */
export interface SpringNumbers {
  /** Length without force [m], >= 0; default: the length when the spring is added. */
  restLength?: number;
  /** Stiffness [N/m], >= 0. */
  stiffness: number;
  /** Damping [kg/s], >= 0; default: 0. */
  damping?: number;
  /** Whether it is a thread, which only pulls and is slack up to its rest length. */
  onlyPulls?: boolean;
}

/** Properties of a new spring with a damper. */
export type SpringDescription = SpringEnds & SpringNumbers;

/** Changes of a spring. */
export interface SpringChanges extends Partial<SpringNumbers> {
  /** Ids of its two spheres, instead of its present ends. */
  spheres?: [number, number];
  /** Id of the sphere at its first end, for a spring that ends at a point. */
  sphere?: number;
  /** The fixed point at its second end [m]. */
  anchor?: Vector;
}

/** A spring in a world: with `spheres`, or with `sphere` and `anchor`. */
export interface Spring extends Required<SpringNumbers> {
  id: number;
  /** Ids of its two spheres. */
  spheres?: [number, number];
  /** Id of the sphere that it connects to a fixed point. */
  sphere?: number;
  /** The fixed point [m]. */
  anchor?: [number, number, number];
}

/** How spheres move under forces, for `bisect` and `discrete`; `exact` needs none. */
export type Integrator =
  "semi-implicit-euler" | "explicit-euler" | "velocity-verlet" | "runge-kutta-4";

/** How the coefficient of a contact follows from those of its two bodies. */
export type CombineRule = "product" | "minimum" | "maximum" | "average" | "geometric-mean";

/** Simulation settings. */
export interface Simulation {
  /** `exact` (the default) finds every impact at its exact time. */
  rule: "exact" | "contact" | "bisect" | "discrete";
  /** Frame time [s], > 0; default: 1/60. */
  frameTime: number;
  /** Duration that is worth watching [s], > 0. */
  duration: number;
  /** Whether spheres collide with each other; they always collide with colliders. */
  spheresCollide: boolean;
  /** How the restitution of a contact follows from those of its two bodies. */
  combineRule: CombineRule;
  /**
   * How the friction of a contact follows from those of its two bodies; default: `geometric-mean`.
   */
  frictionCombineRule?: CombineRule;
  /** Whether spheres may overlap at the start. */
  allowOverlap: boolean;
  /** A periodic box about the origin [m], `Infinity` along an open axis; under `exact`. */
  boundary: "open" | { periodic: { size: [number, number, number] } };
  /**
   * Parameters of `exact`: how simultaneous impacts among touching spheres are resolved; duration
   * of a contact [s]; largest number of impacts per sphere and frame; whether contacts that take
   * too much work are stepped (default: "automatic"), from which work of a group in a tick on, in
   * contacts times iterations, and the length of a tick [s]; how long forces without a closed form
   * are held constant [s].
   */
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
  /**
   * Parameters of `contact`: sub-steps per frame, sweeps over all contacts in each, whether sweeps
   * continue until convergence, and the speed below which a ball may fall asleep, as a part of
   * sqrt(a r), the speed after falling half its radius (0: never). Defaults: 8, 2, false and 0.02.
   */
  contact?: { subSteps: number; sweeps: number; converged: boolean; sleepSpeed: number };
}

/** Changes of the simulation settings; missing ones stay. */
export type SimulationChanges = Partial<
  Omit<Simulation, "exact" | "bisect" | "discrete" | "contact">
> & {
  exact?: Partial<Simulation["exact"]>;
  bisect?: Partial<Simulation["bisect"]>;
  discrete?: Partial<Simulation["discrete"]>;
  contact?: Partial<NonNullable<Simulation["contact"]>>;
};

/** A scene without the contents of its world. */
export interface Scene {
  name: string;
  title?: string;
  description?: string;
  origin?: string;
  /** Emitters of spheres in the format of scene files. */
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

/** An impact of two bodies. */
export interface Impact {
  /** Time since the start of the frame [s]. */
  time: number;
  /** Ids of two spheres, bodies 1 and 2, or of a collider, body 1, and a sphere, body 2. */
  between: { spheres: [number, number] } | { collider: number; sphere: number };
  /** Point on the surface of body 1 [m]. */
  point: [number, number, number];
  /** Unit normal from body 1 to body 2. */
  normal: [number, number, number];
  /** Speed along the normal before the impact [m/s], > 0. */
  approachSpeed: number;
  /** Speed along the normal after the impact [m/s]. */
  separationSpeed: number;
  /** Impulse along the normal [N s], on body 2; the opposite acts on body 1. */
  impulse: number;
  /** Impulse of friction across the normal [N s], on body 2; the opposite acts on body 1. */
  tangentialImpulse: [number, number, number];
}

/** Two bodies in persistent contact, and the force between them. */
export interface PersistentContact {
  /** Ids of two spheres, bodies 1 and 2, or of a collider, body 1, and a sphere, body 2. */
  between: { spheres: [number, number] } | { collider: number; sphere: number };
  /** Point on the surface of body 1 [m]. */
  point: [number, number, number];
  /** Unit normal from body 1 to body 2. */
  normal: [number, number, number];
  /** Distance of the two surfaces [m]: zero up to rounding, negative if they overlap. */
  gap: number;
  /** Force along the normal [N], >= 0, on body 2; the opposite acts on body 1. */
  normalForce: number;
  /**
   * Force of friction across the normal [N], on body 2; the opposite acts on body 1. Zero under
   * rules without friction.
   */
  tangentialForce: [number, number, number];
  /**
   * Whether the surfaces slide on each other, or would under the smallest tangential force:
   * friction is at its limit.
   */
  isSliding: boolean;
}

/** The work of a frame by stage: counts that depend only on the world, not on the machine. */
export interface StageCounts {
  /** Number of predictions of a sphere's next events, under `exact`. */
  predictions: number;
  /** Pairs of spheres tested for an impact, or under other rules for a contact. */
  pairTests: number;
  /** Events taken from the queue, with outdated ones, under `exact`. */
  events: number;
  /** Number of cell crossings among these events. */
  cellCrossings: number;
  /** Groups of touching bodies resolved as a whole, under `exact`. */
  groups: number;
  /** Iterations of the solvers of these groups, counted once per contact. */
  solverIterations: number;
  /** Number of neighbour searches, under `contact`. */
  searches: number;
  /** Number of sweeps over all contacts, under `contact`. */
  sweeps: number;
  /** Contacts per sweep at the end of the frame, under `contact`. */
  contacts: number;
}

/**
 * Changes of the energy in a frame: `totalEnergy()` changes by these, by the work of forces without
 * a potential, and by the error of the integration.
 */
export interface EnergyAccount {
  /** Work of contacts [J]: the change by restitution and friction, <= 0 up to errors. */
  contacts: number;
  /** Work of moving colliders [J]. */
  colliders: number;
  /** Work of the correction of overlaps [J]. */
  correction: number;
  /** Energy of emitted spheres minus that of removed ones [J]. */
  emission: number;
}

/** Quality of the solution of a frame under `contact`, and in stepped zones of `exact`; else 0. */
export interface ContactAccount {
  /** Sub-steps in which impulses were reduced so that they add no energy. */
  limitedSubSteps: number;
  /** Largest change of a normal impulse in the last sweep, relative to the largest impulse. */
  residual: number;
  /** Largest overlap before its correction, relative to the sum of radii. */
  largestOverlap: number;
  /** Sleeping spheres at the end of the frame: at rest until something comes near or changes. */
  asleep: number;
  /**
   * How often a sphere was pressed into a surface by half its radius, summed over sub-steps: no
   * motion can separate what squeezes it.
   */
  squeezed: number;
}

/**
 * Spheres that `exact` stepped instead of moving them from impact to impact, because their contacts
 * took too much work. `ContactAccount` has the quality of their motion.
 */
export interface ZoneAccount {
  /** Spheres in a zone at the end of the frame. */
  spheres: number;
  /** Total time of all spheres in zones in this frame [s]. */
  sphereSeconds: number;
  /** Ticks at which a zone was stepped. */
  ticks: number;
  /** Spheres that joined a zone. */
  joined: number;
  /** Spheres that left a zone. */
  left: number;
}

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
export interface Snapshot {
  free(): void;
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

  /** Returns a snapshot of everything that the future depends on. */
  snapshot(): Snapshot;
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
   * frame is not among them: make a trigger wider than the path of a frame, or the steps shorter.
   */
  readonly triggers: { collider: number; sphere: number }[];
  /** The work of the last frame. */
  readonly work: StageCounts;
  /** Changes of the energy in the last frame. */
  readonly energyAccount: EnergyAccount;
  /** Quality of the solution of the last frame, under `contact` and in stepped zones. */
  readonly contactAccount: ContactAccount;
  /** Spheres that `exact` stepped in the last frame. */
  readonly zoneAccount: ZoneAccount;
  /** Whether any sphere was ever in a zone. */
  readonly wasStepped: boolean;

  /**
   * Persistent contacts in the order of ids, pairs of spheres first; for example those of a ball
   * that lies on the floor. Available after a step under `exact` and `contact`; empty after a
   * change, or under other rules. Under `exact`, reading them solves for the forces.
   */
  readonly contacts: PersistentContact[];
  /**
   * Whether spheres are rotated or rotate, or may start to: because an emitter emits such spheres,
   * or by friction, which acts under `exact` and `contact`.
   */
  readonly hasSpin: boolean;

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

  /** Changes the given properties of a sphere. @throws {CaromError} */
  setSphere(id: number, changes: SphereDescription): void;
  /**
   * Changes the given properties of a collider. A new position applies at once, without pushing
   * spheres; a ball whose centre is then in a box falls through it. To move a collider, set
   * `velocity` [m/s] and `angularVelocity` [rad/s], with which the next steps move it.
   * @throws {CaromError}
   */
  setCollider(id: number, changes: Partial<ColliderDescription>): void;
  /** Replaces a force. @throws {CaromError} */
  setForce(id: number, force: Force): void;
  /** Changes the given properties of a spring: its ends, or how it pulls. @throws {CaromError} */
  setSpring(id: number, changes: SpringChanges): void;
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
