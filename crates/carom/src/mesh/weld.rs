//! Vertices that are one place.

use glam::DVec3;

/// Vertices are one place within this part of the size of the mesh: far above the rounding of the coordinates of
/// files, which have six digits or more, and far below any shape.
const WELD: f64 = 1e-9;

/// The distance \[m\] within which vertices are one place.
pub(super) fn tolerance(vertices: &[DVec3]) -> f64 {
    let first = vertices.first().copied().unwrap_or_default();
    let apart = vertices.iter().fold(DVec3::ZERO, |most, &it| most.max((it - first).abs()));
    WELD * apart.max_element()
}

/// For each vertex, the lowest-numbered one in its place.
pub(super) fn weld(vertices: &[DVec3], tolerance: f64) -> Vec<u32> {
    let mut first_of: Vec<u32> = (0..vertices.len() as u32).collect();
    let mut order = first_of.clone();
    // Cells are wider than the tolerance, so most vertices have no other cell within it.
    let width = 16.0 * tolerance.max(f64::MIN_POSITIVE);
    let origin = vertices.first().copied().unwrap_or_default();
    let cell = |place: DVec3| ((place - origin) / width).floor().to_array().map(|it| it as i64);
    order.sort_unstable_by_key(|&it| (cell(vertices[it as usize]), it));
    let cells: Vec<[i64; 3]> = order.iter().map(|&it| cell(vertices[it as usize])).collect();
    for vertex in 0..vertices.len() as u32 {
        let place = vertices[vertex as usize];
        let (low, high) = (cell(place - tolerance), cell(place + tolerance));
        for x in low[0]..=high[0] {
            for y in low[1]..=high[1] {
                for z in low[2]..=high[2] {
                    let begin = cells.partition_point(|&it| it < [x, y, z]);
                    let same = order[begin..].iter().zip(&cells[begin..]);
                    for (&other, _) in same.take_while(|it| *it.1 == [x, y, z]) {
                        let is_near = (vertices[other as usize] - place).length_squared()
                            <= tolerance * tolerance;
                        if is_near && other < first_of[vertex as usize] {
                            first_of[vertex as usize] = other;
                        }
                    }
                }
            }
        }
        // Those before it are done: what it is one with may itself be one with another.
        let first = first_of[vertex as usize];
        first_of[vertex as usize] = first_of[first as usize];
    }
    first_of
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn vertices_within_a_billionth_of_the_size_are_one_at_any_size() {
        for size in [1e-6, 1.0, 1e6] {
            let near = size * DVec3::new(1.0, 0.5e-9, 0.0);
            let far = size * DVec3::new(1.0, 3e-9, 0.0);
            let vertices = [DVec3::ZERO, size * DVec3::X, near, far];
            assert_eq!(weld(&vertices, tolerance(&vertices)), [0, 1, 1, 3]);
        }
    }
}
