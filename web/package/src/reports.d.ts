// What worlds report of their last step.

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

/** Impacts at one instant among bodies that touch each other, with their momentum and energy. */
export interface ImpactGroup {
  /** Index of its first impact in `impacts`. */
  first: number;
  /** Number of its impacts. */
  count: number;
  /** Momentum of its spheres before [kg m/s]. */
  momentumBefore: [number, number, number];
  /** Momentum after, less what colliders gave [kg m/s]: as before, up to rounding. */
  momentumAfter: [number, number, number];
  /** Kinetic energy of its spheres before [J]. */
  energyBefore: number;
  /** Kinetic energy after, less the work of moving colliders, of kicks and of growth [J]. */
  energyAfter: number;
  /** Change of the kinetic energy that the coefficients of restitution demand [J], <= 0. */
  energyDemanded: number;
  /** Work of moving colliders [J]. */
  colliderWork: number;
  /** Work of the kicks of colliders, and of spheres that grow [J]. */
  kickWork: number;
}

/** A sphere that enters a trigger or leaves it, however small the trigger and fast the sphere. */
export interface SensorEvent {
  /** Time since the start of the frame [s]. */
  time: number;
  /** Id of the trigger. */
  collider: number;
  /** Id of the sphere. */
  sphere: number;
  /** Whether the sphere enters; else it leaves. */
  enters: boolean;
  /** Point on the surface of the trigger [m]. */
  point: [number, number, number];
  /** Unit normal from that surface to the sphere. */
  normal: [number, number, number];
  /** Speed of the sphere relative to the trigger [m/s]. */
  speed: number;
}

/** Two spheres at the edge of the well between them (`simulation.pairPotential`). */
export interface WellEvent {
  /** Time since the start of the frame [s]. */
  time: number;
  /** Ids of the spheres, ascending. */
  spheres: [number, number];
  /** They enter the well, leave it, or turn back at its edge. */
  kind: "capture" | "dissociation" | "bounce";
  /** Unit vector from the first centre to the second. */
  normal: [number, number, number];
  /** Distance of the centres [m]. */
  distance: number;
  /** Impulse that drives the spheres apart [N s]; < 0 where it draws them together. */
  impulse: number;
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

/** Two bodies that overlap. */
export interface Overlap {
  /** Ids of two spheres, or of a collider and a sphere. */
  between: { spheres: [number, number] } | { collider: number; sphere: number };
  /** Depth of the overlap of their surfaces [m], > 0. */
  depth: number;
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
 * Changes of the energy in a frame: `totalEnergy()` changes by these, and by the error of the
 * integration.
 */
export interface EnergyAccount {
  /** Work of contacts [J]: the change by restitution and friction, <= 0 up to errors. */
  contacts: number;
  /** Work of moving colliders [J]. */
  colliders: number;
  /** Work of the kicks of colliders [J]. */
  kicks: number;
  /** Work of growing spheres [J]. */
  growth: number;
  /** Work of the steady shear of a periodic box [J]. */
  shear: number;
  /** Energy that a thermostat added [J]; < 0 where it took some. */
  thermostat: number;
  /** Work of forces without a potential [J]: drag, wind, vortices, dampers of springs. */
  forces: number;
  /** Work of the forces applied to single spheres [J]. */
  applied: number;
  /** Work of the correction of overlaps [J]. */
  correction: number;
  /** Energy of emitted spheres minus that of removed ones [J]. */
  emission: number;
  /** Energy that held forces add under `exact`, in stepped zones and some persistent contacts [J]. */
  integration: number;
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
