//! The cell list finds the same pairs as a comparison of all points.
#![allow(missing_docs)]

use carom_analysis::{pair_histogram, pairs_within};
use proptest::prelude::*;

/// Finds all pairs closer than a distance by comparing all points with all, at the nearest images.
fn by_all(points: &[[f64; 3]], sides: [f64; 3], distance: f64) -> Vec<[usize; 2]> {
    let mut pairs = Vec::new();
    for first in 0..points.len() {
        for second in first + 1..points.len() {
            let square: f64 = (0..3)
                .map(|axis| {
                    let apart = points[second][axis] - points[first][axis];
                    let side = sides[axis];
                    let apart = if side.is_finite() {
                        apart - side * (apart / side).round()
                    } else {
                        apart
                    };
                    apart * apart
                })
                .sum();
            if square < distance * distance {
                pairs.push([first, second]);
            }
        }
    }
    pairs
}

fn found(points: &[[f64; 3]], sides: [f64; 3], distance: f64) -> Vec<[usize; 2]> {
    let sorted = |[one, other]: [usize; 2]| [one.min(other), one.max(other)];
    let pairs = pairs_within(points, sides, distance);
    let mut pairs: Vec<_> = pairs.iter().map(|pair| sorted(pair.points)).collect();
    pairs.sort_unstable();
    pairs
}

fn side() -> impl Strategy<Value = f64> {
    prop_oneof![Just(f64::INFINITY), 1.0..20.0]
}

proptest! {
    #[test]
    fn every_pair_is_found_once(
        points in prop::collection::vec([-15.0..15.0, -15.0..15.0, -15.0..15.0], 0..120),
        sides in [side(), side(), side()],
        part in 0.01..1.0,
    ) {
        let smallest = sides.into_iter().fold(f64::INFINITY, f64::min).min(20.0);
        let distance: f64 = 0.5 * smallest * part;
        prop_assert_eq!(found(&points, sides, distance), by_all(&points, sides, distance));
    }
}

#[test]
fn points_in_one_place_and_none_are_no_trouble() {
    for count in [0, 1, 2, 50] {
        let points = vec![[1.0, 2.0, 3.0]; count];
        for sides in [[f64::INFINITY; 3], [4.0; 3], [4.0, f64::INFINITY, 4.0]] {
            assert_eq!(found(&points, sides, 1.0).len(), count * count.saturating_sub(1) / 2);
        }
    }
}

#[test]
fn a_lattice_has_its_shells_in_their_bins() {
    let points: Vec<[f64; 3]> =
        (0..1000).map(|n| [n % 10, n / 10 % 10, n / 100].map(f64::from)).collect();
    // 6 neighbours at 1, 12 at √2, 8 at √3, 6 at 2; each pair once.
    let counts = pair_histogram(&points, [10.0; 3], 2.1, 21);
    assert_eq!([counts[10], counts[14], counts[17], counts[20]], [3000, 6000, 4000, 3000]);
    assert_eq!(counts.iter().sum::<u64>(), 16_000);
}

#[test]
fn points_that_are_not_finite_are_near_none() {
    let points = [[f64::NAN; 3], [0.0; 3], [f64::INFINITY, 0.0, 0.0], [0.5, 0.0, 0.0]];
    for sides in [[f64::INFINITY; 3], [4.0; 3]] {
        assert_eq!(found(&points, sides, 1.0), [[1, 3]]);
    }
}
