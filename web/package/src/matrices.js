// Matrices for instanced drawing, one for each sphere.

/** Numbers in a 4 by 4 matrix. */
const SIZE = 16;

/**
 * Writes for each sphere the matrix that maps the unit sphere to it, with its rotation, column by
 * column: the format of `InstancedMesh.instanceMatrix.array` in three.js.
 *
 * @throws {RangeError} if `matrices` is too short
 */
export function writeMatrices({ positions, radii, orientations }, matrices) {
  const room = Math.floor(matrices.length / SIZE);
  if (radii.length > room) {
    throw new RangeError(`there are ${radii.length} spheres, and room for ${room} matrices`);
  }
  radii.forEach((radius, i) => {
    const start = SIZE * i;
    // Written number by number: a list for each sphere would take longer than everything else.
    const x = orientations[4 * i];
    const y = orientations[4 * i + 1];
    const z = orientations[4 * i + 2];
    const w = orientations[4 * i + 3];
    const twice = 2 * radius;
    matrices[start] = radius - twice * (y * y + z * z);
    matrices[start + 1] = twice * (x * y + w * z);
    matrices[start + 2] = twice * (x * z - w * y);
    matrices[start + 3] = 0;
    matrices[start + 4] = twice * (x * y - w * z);
    matrices[start + 5] = radius - twice * (x * x + z * z);
    matrices[start + 6] = twice * (y * z + w * x);
    matrices[start + 7] = 0;
    matrices[start + 8] = twice * (x * z + w * y);
    matrices[start + 9] = twice * (y * z - w * x);
    matrices[start + 10] = radius - twice * (x * x + y * y);
    matrices[start + 11] = 0;
    matrices[start + 12] = positions[3 * i];
    matrices[start + 13] = positions[3 * i + 1];
    matrices[start + 14] = positions[3 * i + 2];
    matrices[start + 15] = 1;
  });
}
