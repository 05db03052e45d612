//! The four contact states, and the distances of the public shapes they rest on. Rectangles and
//! boxes are tested by what spheres do at them, in `discrete.rs` and `bisect.rs`.

use carom::DVec3;
use carom::detect::{ContactState, Separation, classify, sphere_half_space, sphere_sphere};

const TOLERANCE: f64 = 1e-6;

fn state(distance: f64, velocity: f64, acceleration: f64) -> ContactState {
    classify(distance, TOLERANCE, velocity, || acceleration)
}

#[test]
fn distance_decides_first() {
    assert_eq!(state(2e-6, -1.0, -1.0), ContactState::Separate);
    assert_eq!(state(-2e-6, -1.0, 0.0), ContactState::Intersecting);
}

#[test]
fn the_tolerance_itself_is_touching_distance() {
    assert_eq!(state(TOLERANCE, -1.0, 0.0), ContactState::Colliding);
    assert_eq!(state(-TOLERANCE, -1.0, 0.0), ContactState::Colliding);
}

#[test]
fn overlapping_bodies_that_stand_still_or_part_do_not_collide() {
    assert_eq!(state(-1e-3, 0.0, -1.0), ContactState::Separate);
    assert_eq!(state(-1e-3, 1.0, -1.0), ContactState::Separate);
}

#[test]
fn at_touching_distance_velocity_decides_and_then_acceleration() {
    assert_eq!(state(0.0, -1e-300, 1.0), ContactState::Colliding);
    assert_eq!(state(0.0, 1e-300, -1.0), ContactState::Separate);
    assert_eq!(state(0.0, 0.0, -1.0), ContactState::Resting);
    assert_eq!(state(0.0, 0.0, 0.0), ContactState::Separate);
    assert_eq!(state(0.0, 0.0, 1.0), ContactState::Separate);
}

#[test]
fn spheres_are_apart_by_the_gap_along_the_line_of_centres() {
    let separation = sphere_sphere([DVec3::ZERO, DVec3::new(3.0, 4.0, 0.0)], [1.0, 2.0]);
    let expected = Separation {
        distance: 2.0,
        normal: DVec3::new(0.6, 0.8, 0.0),
        point: DVec3::new(0.6, 0.8, 0.0),
    };
    assert_eq!(separation, expected);
}

#[test]
fn coincident_centres_have_a_finite_normal() {
    let separation = sphere_sphere([DVec3::ONE, DVec3::ONE], [1.0, 2.0]);
    assert_eq!((separation.distance, separation.normal.length()), (-3.0, 1.0));
}

#[test]
fn a_half_space_is_solid_however_deep() {
    let plane = (DVec3::new(0.0, 1.0, 0.0), DVec3::Y);
    let distance = |y| sphere_half_space(plane, DVec3::new(5.0, y, -5.0), 0.5).distance;
    assert_eq!((distance(2.0), distance(1.5), distance(-9.0)), (0.5, 0.0, -10.5));
}
