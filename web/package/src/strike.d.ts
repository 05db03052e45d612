// What a cue does to a sphere.

/** The blow of a cue, by which it hits a sphere at one instant and one point. */
export interface Strike {
  /** Speed of the cue [m/s], >= 0. */
  speed: number;
  /** Direction from above, counterclockwise from +x [degrees]; default: 0. */
  azimuthDegrees?: number;
  /** Angle by which the cue points down, in [0, 90] [degrees]; default: 0. */
  elevationDegrees?: number;
  /** Offset from the centre to the right and up, in parts of the radius; default: none. */
  offset?: [number, number];
  /** Mass of the cue [kg], > 0; default: 0.567. */
  cueMass?: number;
}
