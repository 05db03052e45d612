//! Merges vertices that have the same position.

use glam::DVec3;

/// Distance within which vertices are merged, as a fraction of the size of the mesh: far above the rounding of
/// coordinates in files, which have six digits or more, and far below any detail.
const WELD: f64 = 1e-9;

/// Returns the distance within which vertices are merged \[m\].
pub(super) fn tolerance(vertices: &[DVec3]) -> f64 {
    let first = vertices.first().copied().unwrap_or_default();
    let apart = vertices.iter().fold(DVec3::ZERO, |most, &it| most.max((it - first).abs()));
    WELD * apart.max_element()
}

/// Returns for each vertex the lowest index of the vertices that it is merged with.
pub(super) fn weld(vertices: &[DVec3], tolerance: f64) -> Vec<u32> {
    let mut first_of: Vec<u32> = (0..vertices.len() as u32).collect();
    let mut order = first_of.clone();
    // Cells are wider than the tolerance, so most vertices are alone in their neighbourhood.
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
        // Earlier vertices are finished, so their first vertex is final.
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
