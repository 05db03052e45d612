// What instanced drawing wants: a matrix for each sphere.

/** Numbers in a matrix of 4 by 4. */
const SIZE = 16;

/**
 * Writes for each sphere the matrix that takes the unit sphere to it, column by column: what
 * three.js keeps in `InstancedMesh.instanceMatrix.array`.
 *
 * @throws {RangeError} if `matrices` has not room for all
 */
export function writeMatrices({ positions, radii }, matrices) {
  const room = Math.floor(matrices.length / SIZE);
  if (radii.length > room) {
    throw new RangeError(`there are ${radii.length} spheres, and room for ${room} matrices`);
  }
  matrices.fill(0, 0, SIZE * radii.length);
  radii.forEach((radius, i) => {
    const start = SIZE * i;
    matrices[start] = matrices[start + 5] = matrices[start + 10] = radius;
    matrices[start + 12] = positions[3 * i];
    matrices[start + 13] = positions[3 * i + 1];
    matrices[start + 14] = positions[3 * i + 2];
    matrices[start + 15] = 1;
  });
}
