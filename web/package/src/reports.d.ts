// What worlds report of their last step.

import type { Force } from "./descriptions.js";

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
