// What worlds are made of: spheres, shapes, forces, springs, and how they are stepped.

import type { Boundary } from "./boundary.js";
import type { Finish, Material, MaterialPair, RestitutionLaw } from "./materials.js";
import type { Shape } from "./shapes.js";
import type { Strike } from "./strike.js";
import type { Thermostat } from "./thermostats.js";

/** Three numbers x, y, z: an array, a typed array, or any iterable, for example `THREE.Vector3`. */
export type Vector = Iterable<number>;

/** A rotation as a quaternion x, y, z, w of any length but zero. */
export type Quaternion = Iterable<number>;

/** Red, green, blue in [0, 1] (sRGB). */
export type Color = [number, number, number];

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
  /** Speed at which the radius grows [m/s], >= 0, under `exact`; default: 0. */
  growthSpeed?: number;
  /** Name of its material in a scene, whose fields count where its own are missing. */
  material?: string;
  /** Coefficient of restitution in [0, 1]; default: 1. */
  restitution?: number;
  /** Restitution by the speed of approach, instead of `restitution`. */
  restitutionLaw?: RestitutionLaw;
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
  tangentialRestitution?: number;
  /** Orientation x, y, z, w; default: not rotated. */
  orientation?: Quaternion;
  /** Angular velocity [rad/s]; default: no rotation. */
  angularVelocity?: Vector;
  /** The blow of a cue that sets it in motion, besides its velocities. */
  strike?: Strike;
  /** Moment of inertia divided by m r², > 0; default: 0.4, that of a solid ball. */
  inertiaFactor?: number;
  /** Groups that it is in, one bit for each of 32; default: 1, the first. */
  groups?: number;
  /** Groups that it collides with, one bit for each; default: all. */
  collidesWith?: number;
  /** A number to find it by; without effect on motion. */
  userData?: number;
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
  /** Restitution by the speed of approach, instead of `restitution`. */
  restitutionLaw?: RestitutionLaw;
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
  tangentialRestitution?: number;
  /** Orientation x, y, z, w; if missing, not rotated. */
  orientation?: [number, number, number, number];
  /** Angular velocity [rad/s]; if missing, no rotation. */
  angularVelocity?: [number, number, number];
  /** Moment of inertia divided by m r², > 0; if missing, 0.4, that of a solid ball. */
  inertiaFactor?: number;
  /** Groups that it is in, one bit for each of 32; if missing, 1, the first. */
  groups?: number;
  /** Groups that it collides with, one bit for each; if missing, all. */
  collidesWith?: number;
  /** A number to find it by; without effect on motion. */
  userData?: number;
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
    }
  /** A fluid in equilibrium. It fills the periodic box, or one with walls between two corners. */
  | {
      denseFluid: {
        /** At most 100,000. */
        count: number;
        /** k T [J]. */
        temperature: number;
        seed: number;
        /** Instead of a radius, which follows from it. */
        packingFraction?: number;
        radiusRange?: [number, number];
        min?: Vector;
        max?: Vector;
        sphere: Omit<SphereDescription, "radius"> & { radius?: number };
      };
    };

/**
 * A part of the motion of a collider, as a function of time. Axes are directions; default: up. A
 * pivot is a point of the axis, from the position of the collider [m]; default: there. Phases are
 * those at the start; default: 0.
 */
export type Motion =
  | { steady: { velocity: Vector } }
  /** To and fro along the axis: amplitude [m], frequency [Hz]. */
  | { oscillate: { axis?: Vector; amplitude: number; frequency: number; phaseDegrees?: number } }
  /** Steadily about the axis: rate [rad/s]. */
  | { turn: { axis?: Vector; pivot?: Vector; rate: number } }
  /** To and fro about the axis. */
  | {
      swing: {
        axis?: Vector;
        pivot?: Vector;
        amplitudeDegrees: number;
        frequency: number;
        phaseDegrees?: number;
      };
    }
  /** Through displacements [m] and rotations at times [s], with rest before and after or repeated. */
  | {
      keyframes: {
        times: number[];
        positions?: Vector[];
        rotations?: Quaternion[];
        pivot?: Vector;
        repeat?: boolean;
      };
    };

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
  /**
   * Velocity of the material along the surface, in its own coordinates [m/s], as of a conveyor
   * belt; default: 0.
   */
  surfaceVelocity?: Vector;
  /** Motion about the place where it is at rest: one, or parts that act one after the other. */
  motion?: Motion | Motion[];
  /** Name of its material in a scene, whose fields count where its own are missing. */
  material?: string;
  /** Coefficient of restitution in [0, 1]; default: 1. */
  restitution?: number;
  /** Restitution by the speed of approach, instead of `restitution`. */
  restitutionLaw?: RestitutionLaw;
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
  tangentialRestitution?: number;
  /**
   * Compliance of the surface: the frequency of its vibration across the normal divided by that
   * along it, in [1, 2], instead of a tangential restitution; default: rigid.
   */
  cushion?: number;
  /** Whether it is a trigger, which reports contact at the end of a frame but deflects nothing. */
  trigger?: boolean;
  /** Whether a sphere that enters this trigger leaves the world. */
  capture?: boolean;
  /** Speed that an impact adds along the normal [m/s], >= 0; default: 0. */
  kick?: number;
  /** Groups that it is in, one bit for each of 32; default: 1, the first. */
  groups?: number;
  /** Groups that it collides with, one bit for each; default: all. */
  collidesWith?: number;
  /** A number to find it by; without effect on motion. */
  userData?: number;
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
  /** Motion about the place where it is at rest, which `position` and `rotation` then say. */
  motion?: Motion | Motion[];
  /** Name of its material. */
  material?: string;
  restitution: number;
  /** Restitution by the speed of approach, instead of `restitution`. */
  restitutionLaw?: RestitutionLaw;
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
  /** Number of dimensions; with 2, spheres are discs in the plane z = 0. Default: 3. */
  dimensions?: 2 | 3;
  /** Frame time [s], > 0; default: 1/60. */
  frameTime: number;
  /** Duration that is worth watching [s], > 0. */
  duration: number;
  /** Whether spheres collide with each other; they always collide with colliders. */
  spheresCollide: boolean;
  /** How the restitution of a contact follows from those of its two bodies. */
  combineRule: CombineRule;
  /** How the friction of a contact follows from those of its bodies; default: `geometric-mean`. */
  frictionCombineRule?: CombineRule;
  /** Whether spheres may overlap at the start. */
  allowOverlap: boolean;
  boundary: Boundary;
  thermostat?: Thermostat;
  /** Well of two spheres [J], up to a multiple of the sum of their radii; under `exact`. */
  pairPotential?: { squareWell: { depth: number; rangeRatio: number } };
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
  /** Materials by name. */
  materials?: Record<string, Material>;
  /** Pairs of materials whose contacts have coefficients of their own. */
  materialPairs?: MaterialPair[];
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
  /** What to try: a path of the scene file, and the ends of a slider. */
  try?: { text: string; path: string; range: [number, number] }[];
  colors?: {
    background?: Color;
    colliders?: Color;
    spheres?: Color;
    densities?: { density: number; color: Color }[];
  };
}
