//! Height fields as vertices and triangles.

use glam::DVec3;

use super::MeshError;

/// Returns vertices \[m\] and triangles, facing up, for rows of heights over a rectangle of this `size` along x and
/// z \[m\].
pub(super) fn grid(
    size: [f64; 2],
    rows: &[Vec<f64>],
) -> Result<(Vec<DVec3>, Vec<[u32; 3]>), MeshError> {
    if !size.iter().all(|it| it.is_finite() && *it > 0.0) {
        return Err(MeshError::Size(size));
    }
    let columns = rows.first().map_or(0, Vec::len);
    if rows.len() < 2 || columns < 2 {
        return Err(MeshError::FewHeights { rows: rows.len(), columns });
    }
    let mut vertices = Vec::with_capacity(rows.len() * columns);
    let place =
        |number: usize, count: usize, size: f64| size * (number as f64 / (count - 1) as f64 - 0.5);
    for (row, heights) in rows.iter().enumerate() {
        if heights.len() != columns {
            return Err(MeshError::UnequalRows { row, columns, found: heights.len() });
        }
        for (column, &height) in heights.iter().enumerate() {
            if !height.is_finite() {
                return Err(MeshError::HeightNotFinite { row, column, height });
            }
            let (x, z) = (place(column, columns, size[0]), place(row, rows.len(), size[1]));
            vertices.push(DVec3::new(x, height, z));
        }
    }
    let number = |row: usize, column: usize| (row * columns + column) as u32;
    let mut triangles = Vec::with_capacity(2 * (rows.len() - 1) * (columns - 1));
    for row in 0..rows.len() - 1 {
        for column in 0..columns - 1 {
            let [here, right] = [number(row, column), number(row, column + 1)];
            let [below, opposite] = [number(row + 1, column), number(row + 1, column + 1)];
            triangles.extend([[here, below, opposite], [here, opposite, right]]);
        }
    }
    Ok((vertices, triangles))
}
