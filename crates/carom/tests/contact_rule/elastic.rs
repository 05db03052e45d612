//! Elastic bounces lose nothing, wherever the forces point.

use carom::{Collider, DVec3, Gravity, Pose, Shape, Sides, Sphere, ViscousDrag, World};

use super::{Random, world};

const EDGE: f64 = 4.0;

/// A closed box about the origin with edges of [`EDGE`] times `unit` \[m\].
fn closed_box(unit: f64) -> Collider {
    let size = DVec3::splat(EDGE * unit);
    Collider::new(Shape::Container { size, open: Sides::NONE }, Pose::at(DVec3::ZERO))
}

#[test]
fn an_elastic_ball_keeps_its_energy_between_floor_and_ceiling() {
    // In frames of whole powers of two the scaled worlds round alike.
    let frame = 0.015625;
    let directions = [DVec3::NEG_Y, DVec3::Y, DVec3::X, DVec3::new(1.0, -2.0, 0.5).normalize()];
    for direction in directions {
        let ends = [-20, 0, 20].map(|exponent| {
            let unit = libm::ldexp(1.0, exponent);
            let mut world = world();
            world.add_force(Gravity::new(10.0 * unit * direction)).unwrap();
            world.add_collider(closed_box(unit)).unwrap();
            let ball = Sphere::new(unit * DVec3::new(0.3, 1.2, -0.4), 0.1 * unit)
                .with_velocity(unit * DVec3::new(3.0, 7.0, 5.0));
            let id = world.add_sphere(ball).unwrap();
            let (energy, largest) = (world.total_energy(), 100.0 * unit * unit);
            let mut bounces = 0;
            for _ in 0..640 {
                bounces += world.step(frame).unwrap().impacts.len();
                // The rounding of some hundred bounces.
                let lost = (world.total_energy() - energy).abs();
                assert!(lost < 1e-12 * largest, "{direction} {unit}: {lost} at {}", world.time());
            }
            assert!(bounces > 20, "{bounces}");
            world.sphere(id).unwrap().position / unit
        });
        assert_eq!(ends[0], ends[1]);
        assert_eq!(ends[2], ends[1]);
    }
}

/// Elastic balls in a closed box.
fn gas() -> World {
    let mut world = world();
    world.add_collider(closed_box(1.0)).unwrap();
    let mut random = Random(5);
    for number in 0..27 {
        let cell = [number % 3, number / 3 % 3, number / 9].map(f64::from);
        let ball = Sphere::new(DVec3::from_array(cell) - 1.0 + 0.2 * random.vector(), 0.12)
            .with_velocity(8.0 * random.vector());
        world.add_sphere(ball).unwrap();
    }
    world
}

/// What contacts take of the energy of a world in ten seconds, as a part of it.
fn taken(mut world: World) -> f64 {
    let energy = world.kinetic_energy();
    let mut taken: f64 = 0.0;
    for _ in 0..600 {
        taken += world.step(1.0 / 60.0).unwrap().energy_account.contacts;
    }
    taken.abs() / energy
}

#[test]
fn contacts_of_elastic_balls_take_no_energy_under_gravity() {
    let mut world = gas();
    world.add_force(Gravity::new(DVec3::new(0.0, -9.81, 0.0))).unwrap();
    assert!(taken(world) < 1e-9);
}

#[test]
fn contacts_of_elastic_balls_take_no_energy_where_a_wall_moves_elsewhere() {
    let mut world = gas();
    let size = DVec3::splat(1.0);
    let wall = Collider::new(Shape::Box { size }, Pose::at(DVec3::new(9.0, 0.0, 0.0)));
    world.add_collider(wall.moving(DVec3::ZERO, DVec3::Y)).unwrap();
    assert!(taken(world) < 1e-9);
}

/// In a sub-step h with a bounce after a time t, drag of the rate c divides a speed by (1 + c t) (1 + c (h - t)); in one
/// without, by 1 + c h. So n sub-steps with m bounces divide it by (1 + c h)^n times at most (1 + (c h)²/4)^m.
#[test]
fn drag_alone_slows_an_elastic_ball_between_two_walls() {
    let (frame, sub_steps, rate) = (0.015625, 8, 0.5);
    let mut world = world();
    world.add_force(ViscousDrag::new(rate)).unwrap();
    world.add_collider(closed_box(1.0)).unwrap();
    let speed = 10.0;
    let ball = Sphere::new(DVec3::ZERO, 0.1).with_velocity(DVec3::new(speed, 0.0, 0.0));
    let id = world.add_sphere(ball).unwrap();
    let (mut bounces, mut limited) = (0, 0);
    let (frames, h) = (256, frame / f64::from(sub_steps));
    for _ in 0..frames {
        let report = world.step(frame).unwrap();
        bounces += report.impacts.len() as i32;
        limited += report.contact_account.limited_sub_steps;
    }
    let alone = speed / libm::pow(1.0 + rate * h, f64::from(frames * sub_steps));
    let least = alone / libm::pow(1.0 + 0.25 * (rate * h) * (rate * h), f64::from(bounces));
    let ends = world.sphere(id).unwrap().velocity.x.abs();
    assert!(
        bounces > 4 && (least..=alone * (1.0 + 1e-12)).contains(&ends),
        "{least} {ends} {alone}"
    );
    assert_eq!(limited, 0);
}
