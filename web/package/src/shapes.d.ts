// Shapes of colliders.

/** Shape of a collider in its own frame. Lengths are full lengths [m], > 0. */
export type Shape =
  | { sphere: { radius: number } }
  /** In the local xz plane, facing local +y; spheres pass through it from behind. */
  | { rectangle: { sizeX: number; sizeZ: number } }
  /** Everything below the local xz plane. */
  | "half-space"
  | { box: { size: [number, number, number] } }
  /** Hollow: walls without thickness, with spheres bouncing off on both sides. */
  | { container: { size: [number, number, number]; open?: Side | Side[] } }
  /** Triangles: numbers of three vertices [m] each, against the clock as seen from the front. */
  | {
      mesh: {
        vertices: [number, number, number][];
        triangles: [number, number, number][];
        /** Factor of all coordinates; default: 1. */
        scale?: number;
        /** Whether an open mesh is met from its front only; default: false. */
        oneSided?: boolean;
      };
    }
  /** Rows of heights along x [m], over a rectangle about the origin; met from above. */
  | { "height-field": { sizeX: number; sizeZ: number; heights: number[][] } }
  /** A gutter along a path from the origin towards local +x; 180 degrees of a circle by default. */
  | {
      track: {
        radius: number;
        pieces: Piece[];
        arcDegrees?: number;
        /** Facets across, an odd number; default: 21. */
        sides?: number;
        /** Largest angle between neighbouring facets along the path; default: 3. */
        facetDegrees?: number;
        /** Slope at the beginning; default: 0. */
        pitchDegrees?: number;
      };
    }
  /** Solids of revolution about local y; one radius of a cone may be 0. */
  | { cylinder: { radius: number; height: number } }
  | { cone: { bottomRadius: number; topRadius?: number; height: number } }
  /** All within a radius of a line along local y. */
  | { capsule: { radius: number; length: number } }
  | { torus: { ringRadius: number; tubeRadius: number } }
  /** In the local xz plane, facing local +y; spheres pass through it from behind. */
  | { disc: { radius: number } }
  /** Hollow, about local y: walls without thickness, with spheres bouncing off on both sides. */
  | { pipe: { radius: number; length: number; closed?: End | End[] } }
  | { bowl: { radius: number; openingDegrees?: number } }
  | { funnel: { bottomRadius: number; topRadius: number; height: number } };

/**
 * A part of the path of a track [m, degrees]. A curve is positive to the left, a bend upward; a
 * shift goes to the left, a drop down.
 */
export type Piece =
  | { straight: { length: number } }
  | { curve: { radius: number; degrees: number; bankDegrees?: number } }
  | { bend: { radius: number; degrees: number; shift?: number } }
  | { gap: { length: number; drop?: number; pitchDegrees?: number } };

/** An end of a pipe in its own frame: towards -y, +y. */
export type End = "bottom" | "top";

/** A side of a box in its own frame: towards -x, +x, -y, +y, -z, +z. */
export type Side = "left" | "right" | "bottom" | "top" | "back" | "front";
