// What is around the spheres.

/**
 * Open space, or a periodic box about the origin [m], `Infinity` along an open axis; under `exact`
 * and `contact`. With a shear rate [1/s] the mean flow along x is that times y;
 * `relativeVelocities` adds it to velocities at the start.
 */
export type Boundary =
  | "open"
  | {
      periodic: {
        size: [number, number, number];
        shearRate?: number;
        relativeVelocities?: boolean;
      };
    };
