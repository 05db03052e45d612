//! Extreme masses, numbers and places: no answer does harm.

use carom::DVec3;
use carom::respond::resolve;

use crate::common::group::{Group, surface};
use crate::common::{Numbers, vec};
use crate::{LAWS, assert_lawful, assert_lawful_within};

#[test]
fn mass_ratios_of_a_trillion_are_survived() {
    let mut numbers = Numbers(6);
    for e in [0.0, 0.5, 1.0] {
        for round in 0..200 {
            let masses: Vec<f64> = (0..5).map(|_| 10f64.powf(numbers.between(-6.0, 6.0))).collect();
            let speeds: Vec<f64> = (0..5).map(|_| numbers.between(-1.0, 1.0)).collect();
            let mut before = Group::row(&masses, &speeds, e);
            before.contacts.push(surface(0, DVec3::X, e));
            for law in LAWS {
                let mut after = before.clone();
                let response = after.resolve(law);
                let what = format!("{law:?}, e = {e}, round {round}, {masses:?} {speeds:?}");
                // A thousand impacts that reverse everything add up their roundings.
                assert_lawful_within(2e-12, &before, &after, &response, &what);
            }
        }
    }
}

#[test]
fn sphere_wedged_between_walls_stops() {
    for law in LAWS {
        for e in [0.0, 0.5, 1.0] {
            let mut group = Group {
                contacts: vec![surface(0, DVec3::X, e), surface(0, -DVec3::X, e)],
                masses: vec![2.0],
                velocities: vec![vec(0.7, 0.2, 0.0)],
            };
            let before = group.clone();
            let response = group.resolve(law);
            assert_lawful(&before, &group, &response, &format!("{law:?}, e = {e}"));
            assert_eq!(group.velocities[0].y, 0.2);
        }
    }
}

#[test]
fn sphere_crushed_between_surfaces_is_not_thrown_about() {
    // Nothing can keep the walls from closing; what matters is that nothing worse comes of it.
    for law in LAWS {
        let mut contacts = [surface(0, DVec3::X, 1.0), surface(0, -DVec3::X, 1.0)];
        contacts[0].surface_velocity = DVec3::X;
        contacts[1].surface_velocity = -2.0 * DVec3::X;
        let mut velocities = [vec(0.3, 0.2, 0.0)];
        let response = resolve(law, &contacts, &[1.0], &mut velocities);
        assert!(response.cut_short);
        assert!(velocities[0].x.abs() <= 2.0, "{law:?}: {}", velocities[0]);
        assert_eq!(velocities[0].y, 0.2);
    }
}

#[test]
fn nothing_moves_where_nothing_closes() {
    for law in LAWS {
        let mut group = Group::row(&[1.0; 3], &[-1.0, 0.0, 0.5], 1.0);
        let before = group.velocities.clone();
        assert_eq!(group.resolve(law).impulses, [0.0, 0.0]);
        assert_eq!(group.velocities, before);
    }
}

#[test]
fn extreme_numbers_do_no_harm() {
    for law in LAWS {
        for speed in [1e-310, 1e-200, 1e200, 1e308, f64::INFINITY, f64::NAN, 0.0] {
            for e in [0.0, 0.5, 1.0] {
                let mut group = Group::row(&[1e-200, 1.0, 1e200], &[speed, 0.0, -speed], e);
                group.resolve(law);
                // Twice the largest number is none.
                let representable = speed.is_finite() && speed.abs() < 1e308;
                let finite = group.velocities.iter().all(|v| v.is_finite());
                assert!(finite || !representable, "{law:?}, {speed}, {e}");
            }
        }
        resolve(law, &[], &[], &mut []);
    }
}
