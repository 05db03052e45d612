// Sources of spheres.

import type { Quaternion, Sphere, SphereDescription, Vector } from "./descriptions.js";

/** Properties of a new emitter. */
export interface EmitterDescription {
  name?: string;
  /** Where its spheres start [m]; default: the origin. */
  position?: Vector;
  /** Rotation x, y, z, w; it turns the velocity of its spheres, too. */
  rotation?: Quaternion;
  /** Time between two spheres [s], > 0. */
  period: number;
  /** Most of its spheres at one time; the oldest goes before another comes. */
  maxSpheres?: number;
  /** Spheres in all, those left out included. */
  count?: number;
  /** Whether a sphere that would overlap another one is left out. */
  needsRoom?: boolean;
  /** The sphere that it emits. */
  sphere: SphereDescription;
}

/** An emitter of a world. */
export interface Emitter extends EmitterDescription {
  id: number;
  position: [number, number, number];
  rotation: [number, number, number, number];
  sphere: Sphere;
}
