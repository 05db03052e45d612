// What worlds are made of: spheres, shapes, forces, springs, and how they are stepped.

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
