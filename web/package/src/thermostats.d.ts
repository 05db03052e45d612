// Thermostats: what changes the velocities of all spheres.

/** What changes the velocities of all spheres, under `exact`. Temperatures are k T [J]. */
export type Thermostat =
  /** Velocities of Maxwell's distribution, at random times of this frequency [Hz] for each sphere. */
  | { andersen: { frequency: number; temperature: number; seed: number } }
  /** One factor for all velocities, every interval [s]. */
  | { rescale: { interval: number; temperature: number } }
  /** Random changes every interval [s] that keep the momentum; the strength in m²/s³. */
  | { whiteNoise: { interval: number; strength: number; seed: number } };
