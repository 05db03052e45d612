//! Pairs of points within a distance.

use crate::cells::Cells;

/// Two points, as indices, and the square of their distance \[m²\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pair {
    /// Indices of the points.
    pub points: [usize; 2],
    /// Square of their distance \[m²\].
    pub squared_distance: f64,
}

/// Finds every pair of points \[m\] closer than `distance` \[m\], once, in an order that depends on
/// the points only.
///
/// `sides` are the sides of a periodic box \[m\], infinite along open axes. Distances are those of
/// the nearest images; so `distance` must be at most half the smallest side, else some pairs are
/// missing. Points that are not finite belong to no pair.
pub fn pairs_within(points: &[[f64; 3]], sides: [f64; 3], distance: f64) -> Vec<Pair> {
    let mut pairs = Vec::new();
    for_each_pair(points, sides, distance, |points, squared_distance| {
        pairs.push(Pair { points, squared_distance });
    });
    pairs
}

/// Counts pairs of points \[m\] by distance, in `bins` of equal width from 0 to `r_max` \[m\].
/// `sides` and `r_max` are as in [`pairs_within`].
pub fn pair_histogram(points: &[[f64; 3]], sides: [f64; 3], r_max: f64, bins: usize) -> Vec<u64> {
    let mut counts = vec![0; bins];
    let per_metre = bins as f64 / r_max;
    for_each_pair(points, sides, r_max, |_, squared_distance| {
        let bin = (squared_distance.sqrt() * per_metre) as usize;
        // Rounding may put the largest distances beyond the last bin.
        if let Some(count) = counts.get_mut(bin.min(bins.saturating_sub(1))) {
            *count += 1;
        }
    });
    counts
}

/// Visits every pair of points closer than a distance, as [`pairs_within`] finds them.
pub(crate) fn for_each_pair(
    points: &[[f64; 3]],
    sides: [f64; 3],
    distance: f64,
    mut visit: impl FnMut([usize; 2], f64),
) {
    let cells = Cells::new(points, sides, distance);
    let (halves, squared) = (sides.map(|side| 0.5 * side), distance * distance);
    let mut test = |first: usize, second: usize| {
        let (one, other) = (&cells.points[first], &cells.points[second]);
        let mut square = 0.0;
        for axis in 0..3 {
            let apart = (other[axis] - one[axis]).abs();
            // Along an open axis the half is infinite.
            let apart = if apart > halves[axis] { sides[axis] - apart } else { apart };
            square += apart * apart;
        }
        if square < squared {
            visit([cells.order[first], cells.order[second]], square);
        }
    };
    for cell in 0..cells.len() {
        let own = cells.points_of(cell);
        if own.is_empty() {
            continue;
        }
        for first in own.clone() {
            (first + 1..own.end).for_each(|second| test(first, second));
        }
        for other in cells.greater_neighbours(cell) {
            for first in own.clone() {
                cells.points_of(other).for_each(|second| test(first, second));
            }
        }
    }
}
