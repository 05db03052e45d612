// What can be asked of a world between steps.

import type { Impact } from "./reports.js";

/** Which bodies a query finds: by default spheres and colliders, but no triggers. */
export interface QueryFilter {
  spheres?: boolean;
  /** Whether it finds colliders that deflect. */
  colliders?: boolean;
  triggers?: boolean;
  /** Id of a sphere that it passes over. */
  withoutSphere?: number;
  /** Groups that it is in, one bit for each of 32, as if it were a body; by default all. */
  groups?: number;
  /** Groups that it collides with, one bit for each; by default all. */
  collidesWith?: number;
}

/** A sphere or a collider by its id. */
export type Body = { sphere: number } | { collider: number };

/** What a ray or a sphere on its way meets first. */
export interface Hit {
  body: Body;
  /** Point on the surface of the body [m]. */
  point: [number, number, number];
  /** Unit normal of the body there, out of it. */
  normal: [number, number, number];
  /** Part of the way before, 0 to 1; 0 if the body is overlapped at the start. */
  fraction: number;
}

/** A body near a place. */
export interface NearBody {
  body: Body;
  /** The nearest point of its surface [m]. */
  point: [number, number, number];
  /** Unit normal of the body there, out of it. */
  normal: [number, number, number];
  /** Distance of the surfaces [m], negative if they overlap. */
  distance: number;
}

/** A piece of a predicted path: a flight from an event to the next. */
export interface PathLeg {
  /** When it begins and ends, on the world's clock [s]. */
  start: number;
  end: number;
  /** When the flight's own time is 0, on the world's clock [s]; it may be before `start`. */
  flightStart: number;
  /** Centre then [m]. */
  position: [number, number, number];
  /** Velocity then [m/s]. */
  velocity: [number, number, number];
  /** Acceleration by everything but drag [m/s²]; along a round surface that of its beginning. */
  acceleration: [number, number, number];
  /** Drag coefficient over mass [1/s], >= 0. */
  dragRate: number;
}

/** The path of a sphere as `World.predict` predicts it. */
export interface PredictedPath {
  /** Impacts of the sphere on the way; their times are from the prediction on [s]. */
  readonly impacts: Impact[];
  /** Flights from event to event without gaps. */
  readonly legs: PathLeg[];
  /**
   * Where it ends: at the end of the time asked for, at the last impact asked for, or where a step
   * would take the sphere in a stepped zone.
   */
  readonly end: "horizon" | "impacts" | "no closed form";
  /** When it ends, on the world's clock [s]. */
  readonly endTime: number;
  /**
   * Returns the centre [m] at a time on the world's clock [s], in a periodic box within it, at an
   * event after it; `undefined` outside of the path.
   */
  positionAt(time: number): [number, number, number] | undefined;
  /** Returns the velocity [m/s] at a time on the world's clock [s], as `positionAt`. */
  velocityAt(time: number): [number, number, number] | undefined;
}
