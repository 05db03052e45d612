//! Balls that cross their box several times in a sub-step of the rule `contact`: none leaves it, and none
//! gains energy. What it has caught: balls thrown through walls by other balls.

mod common;

use carom::{Collider, Contact, DQuat, DVec3, Pose, Rule, Settings, Shape, Sides, Sphere, World};
use common::Numbers;

/// Twenty elastic balls in a closed box of 1 m, each in a direction of its own with this speed \[m/s\].
fn box_of_balls(speed: f64, radius: f64) -> World {
    let settings = Settings::default().with_rule(Rule::Contact(Contact::default()));
    let mut world = World::new(settings).unwrap();
    let shape = Shape::Container { size: DVec3::ONE, open: Sides::default() };
    world.add_collider(Collider::new(shape, Pose::at(DVec3::ZERO))).unwrap();
    let mut numbers = Numbers(3);
    for place in 0..20 {
        let at = [place % 3, place / 3 % 3, place / 9].map(|it| 0.3 * f64::from(it) - 0.3);
        let velocity = speed * numbers.unit_vector();
        world.add_sphere(Sphere::new(at.into(), radius).with_velocity(velocity)).unwrap();
    }
    world
}

#[test]
fn balls_in_a_closed_box_stay_in_it_at_any_speed() {
    for radius in [0.03, 0.12] {
        for speed in [5.0, 20.0, 50.0, 100.0, 300.0, 1e3, 1e4] {
            let mut world = box_of_balls(speed, radius);
            let start = world.kinetic_energy();
            for _ in 0..40 {
                world.step(1.0 / 60.0).unwrap();
                let case = format!("{radius} m, {speed} m/s, at {} s", world.time());
                // A centre on a wall would be half out.
                let mut centers = world.spheres().positions().iter();
                assert!(centers.all(|it| it.abs().max_element() < 0.5), "{case}");
                // Impulses add no energy but by rounding, in each of a thousand sub-steps.
                assert!(world.kinetic_energy() <= start * (1.0 + 1e-12), "{case}");
            }
        }
    }
}

#[test]
fn a_fast_ball_stays_in_a_box_whatever_it_passes_there() {
    let mut numbers = Numbers(5);
    for case in 0..400 {
        let settings = Settings::default().with_rule(Rule::Contact(Contact::default()));
        let mut world = World::new(settings).unwrap();
        let e = f64::from(case % 2);
        let walls = Shape::Container { size: DVec3::splat(4.0), open: Sides::default() };
        let walls = Collider::new(walls, Pose::at(DVec3::ZERO));
        world.add_collider(walls.with_restitution(e)).unwrap();
        let position = numbers.vector();
        let rotation = DQuat::from_rotation_arc(DVec3::Y, numbers.unit_vector());
        let obstacle = Shape::Box { size: DVec3::new(0.8, 0.5, 0.3) };
        let obstacle = Collider::new(obstacle, Pose { position, rotation });
        world.add_collider(obstacle.with_restitution(e)).unwrap();
        // Outside of the obstacle, whatever its turn.
        let at = position + 0.6 * numbers.unit_vector();
        let velocity = 700.0 * numbers.unit_vector();
        world.add_sphere(Sphere::new(at, 0.0164).with_velocity(velocity)).unwrap();
        for _ in 0..4 {
            world.step(1.0 / 64.0).unwrap();
            let center = world.spheres().positions()[0];
            assert!(center.abs().max_element() < 2.0, "{case}: {center} at {} s", world.time());
        }
    }
}
