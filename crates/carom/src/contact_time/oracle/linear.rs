//! The closed form for straight paths against the root with 77 digits.

use glam::DVec3;

use super::generate::Numbers;
use super::number::{Big, Number, Vector};
use crate::contact_time::sphere_sphere_linear;

/// How far |r + v t| at the answer may be off R, in roundings of |r| + R. The radicand has a few
/// of them, the root and the quotient one or two each.
const ROUNDINGS: f64 = 6.0;

/// What touches counts as zero up to 16 roundings, here as in the search.
const TOUCHING: f64 = 17.0;

/// Time of contact and smallest distance on the way, by the school formula.
fn exactly(offset: DVec3, velocity: DVec3, radius_sum: f64) -> (Option<Big>, f64) {
    let (r, v) = (Vector::<Big>::of(offset), Vector::<Big>::of(velocity));
    let (a, b) = (v.dot(&v), r.dot(&v));
    let radius = Big::of(radius_sum);
    let c = r.dot(&r) - radius.clone() * radius;
    let discriminant = b.clone() * b.clone() - a.clone() * c.clone();
    let smallest = (r.dot(&r) - b.clone() * b.clone() / a.clone()).root();
    let gap = (smallest - Big::of(radius_sum)).to_f64().value();
    let zero = Big::of(0.0);
    let time = if b >= zero || discriminant < zero {
        None
    } else if c <= zero {
        Some(zero)
    } else {
        Some((-b - discriminant.root()) / a)
    };
    (time, gap)
}

/// Two spheres, with an impact parameter anywhere or within rounding of a graze, close by or far
/// away, touching and overlapping too.
fn encounter(numbers: &mut Numbers) -> (DVec3, DVec3, f64) {
    let radius_sum = numbers.decade(-3.0, 3.0);
    let along = numbers.direction();
    let across = along.cross(numbers.direction()).normalize();
    let part = match numbers.bits() % 5 {
        0 => 1.0 - numbers.decade(-17.0, -1.0),
        1 => 1.0 + numbers.decade(-17.0, -1.0),
        2 => 0.0,
        _ => numbers.between(0.0, 1.2),
    };
    let ahead = match numbers.bits() % 4 {
        // On the surface, but for rounding.
        0 => radius_sum * (1.0 - part * part).max(0.0).sqrt(),
        _ => radius_sum * numbers.decade(-3.0, 5.0),
    };
    let speed = numbers.decade(-6.0, 8.0);
    let direction = if numbers.one_in(8) { along } else { -along };
    (ahead * along + part * radius_sum * across, speed * direction, radius_sum)
}

#[test]
fn straight_paths_meet_when_the_exact_root_says() {
    const COUNT: usize = 20_000;
    let mut numbers = Numbers(20);
    let (mut contacts, mut worst) = (0, 0.0_f64);
    for _ in 0..COUNT {
        let (r, v, radius_sum) = encounter(&mut numbers);
        let rounding = f64::EPSILON * (r.length() + radius_sum);
        let (exact, smallest) = exactly(r, v, radius_sum);
        let answer = sphere_sphere_linear(r, v, radius_sum);
        let situation = || format!("{answer:?} for {r:?} {v:?} {radius_sum:?}, exactly {exact:?}");
        match (&exact, answer) {
            (None, None) => {}
            (Some(_), None) => {
                // A graze, or a touch that closes no more than rounding.
                assert!(smallest > -TOUCHING * rounding, "missed by {smallest:e}: {}", situation());
            }
            (None, Some(_)) => {
                assert!(smallest < ROUNDINGS * rounding, "made up, {smallest:e}: {}", situation());
            }
            (Some(exact), Some(t)) => {
                contacts += 1;
                let place = Vector::<Big>::of(r).plus(&Vector::of(v).times(&Big::of(t)));
                let d = (place.length() - Big::of(radius_sum)).to_f64().value();
                let start = (Vector::<Big>::of(r).length() - Big::of(radius_sum)).to_f64().value();
                if *exact > Big::of(0.0) {
                    let off = d.abs() / rounding;
                    assert!(off <= ROUNDINGS, "d is {d:e}, {off} roundings: {}", situation());
                    worst = worst.max(off);
                } else {
                    assert!(start - d <= ROUNDINGS * rounding, "late: {}", situation());
                }
            }
        }
    }
    println!("{contacts} contacts of {COUNT}, off by at most {worst} roundings");
    assert!(contacts * 2 > COUNT);
}
