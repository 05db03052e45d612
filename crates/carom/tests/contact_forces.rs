//! Forces at persistent contacts, against statics and against the conditions that define them.
//!
//! Geometry is made here, so these say nothing about detection.

// What is expected need not have the same bits everywhere.
#![allow(clippy::disallowed_methods)]

mod common;

use carom::DVec3;
use carom::respond::{ContactForces, contact_forces};
use common::group::{Group, pair, surface};
use common::{Numbers, assert_close, assert_close_vec, vec};

/// Roundings: results of a handful of operations on numbers of order 1.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

#[test]
fn stack_of_ten_weighs_on_the_floor_tenfold() {
    let (mass, g) = (0.3, 9.81);
    let mut contacts = vec![surface(0, DVec3::Y, 0.5)];
    contacts.extend((1..10).map(|i| pair(i - 1, i, DVec3::Y, 0.5)));
    let mut accelerations = vec![vec(0.0, -g, 0.0); 10];
    let forces = contact_forces(&contacts, &[mass; 10], &mut accelerations, &[0.0; 10]).forces;
    for (i, force) in forces.iter().enumerate() {
        let weight = (10 - i) as f64 * mass * g;
        assert_close(*force, weight, ROUNDING * weight);
    }
    for acceleration in accelerations {
        assert_close_vec(acceleration, DVec3::ZERO, ROUNDING * g);
    }
}

#[test]
fn force_on_a_pyramid_follows_statics() {
    // One ball on two, on a floor, held apart by walls: the upper contacts at 30 degrees from
    // the vertical carry m g / (2 cos 30), the walls half of it, the floor 3/2 m g.
    let (s, c) = (0.5, 0.75f64.sqrt());
    let contacts = [
        surface(0, DVec3::X, 1.0),
        surface(0, DVec3::Y, 1.0),
        surface(1, -DVec3::X, 1.0),
        surface(1, DVec3::Y, 1.0),
        pair(0, 1, DVec3::X, 1.0),
        pair(0, 2, vec(s, c, 0.0), 1.0),
        pair(1, 2, vec(-s, c, 0.0), 1.0),
    ];
    let mut accelerations = [vec(0.0, -10.0, 0.0); 3];
    let forces = contact_forces(&contacts, &[2.0; 3], &mut accelerations, &[0.0; 7]).forces;
    let along = 20.0 / (2.0 * c);
    let expected = [along * s, 30.0, along * s, 30.0, 0.0, along, along];
    for (force, expected) in forces.into_iter().zip(expected) {
        assert_close(force, expected, 20.0 * ROUNDING);
    }
    accelerations.into_iter().for_each(|a| assert_close_vec(a, DVec3::ZERO, 10.0 * ROUNDING));
}

#[test]
fn sphere_that_leaves_a_contact_gets_no_force() {
    // Sliding over a fixed sphere so fast that gravity does not hold it: v²/R > g.
    let contacts = [surface(0, DVec3::Y, 1.0)];
    let gravity = vec(0.0, -10.0, 0.0);
    let mut accelerations = [gravity];
    let forces = contact_forces(&contacts, &[2.0], &mut accelerations, &[11.0]).forces;
    assert_eq!(forces, [0.0]);
    assert_eq!(accelerations, [gravity]);
    // Slower, it is held by what is left of its weight.
    let forces = contact_forces(&contacts, &[2.0], &mut accelerations, &[4.0]).forces;
    assert_close(forces[0], 12.0, 12.0 * ROUNDING);
    assert_close(accelerations[0].y, -4.0, 4.0 * ROUNDING);
}

/// Asserts `f >= 0, w >= 0, f w = 0` of a group whose velocities are accelerations.
#[track_caller]
fn assert_complementary(group: &Group, bias: &[f64], response: &ContactForces) {
    assert!(response.complete);
    for ((contact, bias), force) in group.contacts.iter().zip(bias).zip(&response.forces) {
        let w = group.opening(contact) + bias;
        assert!(w >= -response.resolution, "closes at {w}");
        assert!(*force >= 0.0);
        assert!(*force == 0.0 || w <= response.resolution, "pushes a contact that opens at {w}");
    }
}

#[test]
fn forces_in_heaps_hold_them_and_do_not_pull() {
    let mut numbers = Numbers(9);
    for decades in [0.0, 3.0, 9.0] {
        for mut group in
            [Group::heap(200, &mut numbers, |_| 0.0), Group::packing(4, &mut numbers, |_| 0.0)]
        {
            group.velocities.fill(vec(0.0, -9.81, 0.0));
            for mass in &mut group.masses {
                *mass = 10f64.powf(numbers.between(0.0, decades));
            }
            let bias: Vec<f64> = group.contacts.iter().map(|_| numbers.next()).collect();
            let Group { contacts, masses, velocities } = &mut group;
            let response = contact_forces(contacts, masses, velocities, &bias);
            // Light spheres may be squeezed out at many times g.
            let largest = group.velocities.iter().map(|a| a.length()).fold(9.81, f64::max);
            assert!(response.resolution < 1e-13 * largest);
            assert_complementary(&group, &bias, &response);
        }
    }
}

#[test]
fn heavy_sphere_on_light_ones_is_carried() {
    // A column whose weight is all in its top: the light ones carry a trillion times their own.
    let masses = [1e-6, 2e-3, 1.0, 1e6];
    let mut contacts = vec![surface(0, DVec3::Y, 1.0)];
    contacts.extend((1..4).map(|i| pair(i - 1, i, DVec3::Y, 1.0)));
    let mut accelerations = vec![vec(0.0, -10.0, 0.0); 4];
    let response = contact_forces(&contacts, &masses, &mut accelerations, &[0.0; 4]);
    for (i, force) in response.forces.iter().enumerate() {
        let weight = 10.0 * masses[i..].iter().sum::<f64>();
        assert_close(*force, weight, ROUNDING * weight);
    }
    for acceleration in accelerations {
        assert_close_vec(acceleration, DVec3::ZERO, response.resolution);
    }
}

#[test]
fn surfaces_that_accelerate_into_each_other_are_told_of() {
    let contacts = [surface(0, DVec3::X, 1.0), surface(0, -DVec3::X, 1.0)];
    let mut accelerations = [vec(1.0, 2.0, 0.0)];
    let response = contact_forces(&contacts, &[1.0], &mut accelerations, &[-3.0, -3.0]);
    assert!(!response.complete);
    assert_close_vec(accelerations[0], vec(0.0, 2.0, 0.0), ROUNDING);
}

#[test]
fn extreme_accelerations_do_no_harm() {
    let contacts = [surface(0, DVec3::Y, 1.0), pair(0, 1, DVec3::Y, 1.0)];
    for size in [0.0, 1e-310, 1e-200, 1e200, 1e300, f64::INFINITY, f64::NAN] {
        let mut accelerations = [vec(0.0, -size, 0.0); 2];
        let response = contact_forces(&contacts, &[1e-3, 1e3], &mut accelerations, &[0.0; 2]);
        let finite = accelerations.iter().all(|a| a.is_finite());
        assert!(finite || !size.is_finite());
        assert_eq!(response.forces.len(), 2);
    }
}
