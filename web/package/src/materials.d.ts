// Materials, pairs of them, and laws of restitution.

/** How a surface reflects light; the default is `satin`, a soft highlight. */
export type Finish = "matte" | "satin" | "glossy" | "metal" | "glass" | "wood" | "cloth";

/** Restitution that depends on the speed of approach v along the normal. Speeds in m/s. */
export type RestitutionLaw =
  /** restitution (v/speed)^-exponent above the speed; defaults: 1 and 1/4. */
  | { powerLaw: { speed: number; restitution?: number; exponent?: number } }
  /** Viscoelastic spheres: 0.3987 at the speed. */
  | { viscoelastic: { speed: number } }
  /** 1 below the speed. */
  | { cutoff: { speed: number; restitution: number } };

/** Coefficients that spheres and colliders share, or that contacts of two materials have. */
export interface MaterialCoefficients {
  restitution?: number;
  restitutionLaw?: RestitutionLaw;
  friction?: number;
  rollingFriction?: number;
  spinningFriction?: number;
  tangentialRestitution?: number;
}

/** Fields that spheres and colliders of a material share. */
export interface Material extends MaterialCoefficients {
  /** Density of spheres without a mass [kg/m³]. */
  density?: number;
  color?: Iterable<number>;
  finish?: Finish;
}

/** Coefficients of the contacts of two materials, instead of those that combine rules give. */
export interface MaterialPair extends MaterialCoefficients {
  /** Names of the two materials. */
  materials: [string, string];
  /**
   * Non-additivity parameter D from -0.9 to 9: spheres touch where their centres are (1 + D) times
   * the sum of their radii apart; default 0.
   */
  nonAdditivity?: number;
}
