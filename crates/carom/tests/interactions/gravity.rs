//! Gravity between spheres: orbits, and the sum over a tree beside that over all pairs.

use std::f64::consts::TAU;

use carom::{
    Boundary, DVec3, Discrete, Integrator, MutualGravity, Rule, Settings, Sphere, SphereId, World,
};

use crate::common::{Numbers, assert_close, vec, world, world_with};
use crate::{in_frames, position, rules, run};

/// Two spheres of 1 and 2 kg that circle each other at a distance of 1 m, with G = 3.
fn double_star(rule: Rule) -> (World, [SphereId; 2]) {
    let mut world = world(rule);
    world.add_force(MutualGravity::new(3.0)).unwrap();
    // w² = G (m1 + m2) / r³ = 9.
    let light = Sphere::new(vec(2.0 / 3.0, 0.0, 0.0), 0.01).with_velocity(vec(0.0, 2.0, 0.0));
    let heavy = Sphere::new(vec(-1.0 / 3.0, 0.0, 0.0), 0.01).with_velocity(vec(0.0, -1.0, 0.0));
    let light = world.add_sphere(light).unwrap();
    let heavy = world.add_sphere(heavy.with_mass(2.0)).unwrap();
    (world, [light, heavy])
}

#[test]
fn a_double_star_comes_round_after_its_period() {
    for (rule, order) in rules() {
        let error = |frames| {
            let period = TAU / 3.0;
            let rule = in_frames(rule, period / f64::from(frames));
            let (mut world, [light, heavy]) = double_star(rule);
            assert_close(world.total_energy(), -3.0, 1e-14);
            run(&mut world, period, frames);
            let off = position(&world, light) - vec(2.0 / 3.0, 0.0, 0.0);
            off.length() + (position(&world, heavy) - vec(-1.0 / 3.0, 0.0, 0.0)).length()
        };
        if matches!(rule, Rule::Exact(_)) {
            // Rounding of some tens of steps of 15th order.
            assert!(error(4) < 1e-12);
            continue;
        }
        let (coarse, fine) = (error(2000), error(4000));
        assert!(fine < 0.2, "{rule:?}: {fine}");
        let measured = (coarse / fine).log2();
        assert!(measured > order - 0.2, "{rule:?}: {measured}");
    }
}

/// Spheres of different masses in a ball, at rest.
fn cloud(count: u32) -> World {
    let mut world = world_with(Integrator::VelocityVerlet);
    let mut numbers = Numbers(11);
    for _ in 0..count {
        // Denser in the middle, as gravity makes it.
        let place = numbers.unit_vector() * numbers.next();
        let sphere = Sphere::new(place, 1e-6).with_mass(numbers.between(0.1, 2.0));
        world.add_sphere(sphere).unwrap();
    }
    world
}

#[test]
fn a_tree_sums_what_all_pairs_do_to_the_square_of_the_opening_angle() {
    let gravity = MutualGravity::new(1e-3).with_softening(0.02);
    let after = |angle: f64| {
        let mut world = cloud(1500);
        world.add_force(gravity.with_opening_angle(angle)).unwrap();
        let energy = world.potential_energy();
        world.step(1e-3).unwrap();
        (energy, world.spheres().velocities().to_vec())
    };
    let (energy, expected) = after(0.0);
    let size = (expected.iter().map(|v| v.length_squared()).sum::<f64>() / 1500.0).sqrt();
    for (angle, bound) in [(0.2, 1e-3), (0.5, 1e-2), (1.0, 5e-2)] {
        let (by_tree, velocities) = after(angle);
        let errors = expected.iter().zip(&velocities).map(|(a, b)| (*a - *b).length_squared());
        let error = (errors.sum::<f64>() / 1500.0).sqrt() / size;
        // Of a cube that counts as one the dipole is 0; its quadrupole is angle² of the whole, with signs that
        // cancel among cubes.
        assert!(error < bound && error > 0.0, "{angle}: {error}");
        assert_close(by_tree / energy, 1.0, bound);
    }
}

#[test]
fn spheres_in_one_point_do_not_hang_the_tree() {
    let mut world = world(Discrete::default());
    world.set_settings(world.settings().with_spheres_collide(false)).unwrap();
    world.add_force(MutualGravity::new(1.0)).unwrap();
    for i in 0..1200 {
        let place = if i == 0 { DVec3::X } else { DVec3::ZERO };
        world.add_sphere(Sphere::new(place, 1e-3)).unwrap();
    }
    world.step(1e-6).unwrap();
    let pulled = world.spheres().velocities()[0].x;
    assert_close(pulled, -1199.0 * 1e-6, 1e-15);
}

#[test]
fn gravity_between_spheres_is_refused_in_a_periodic_box() {
    let periodic =
        Settings::default().with_boundary(Boundary::Periodic { size: DVec3::splat(9.0) });
    let mut closed = World::new(periodic).unwrap();
    let refused = closed.add_force(MutualGravity::new(1.0)).unwrap_err().to_string();
    assert!(refused.starts_with("force 0: `boundary` must be open"), "{refused}");
    let mut open = World::default();
    open.add_force(MutualGravity::new(1.0)).unwrap();
    let refused = open.set_settings(periodic).unwrap_err().to_string();
    assert!(refused.starts_with("settings: `boundary` must be open"), "{refused}");
}
