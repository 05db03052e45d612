//! Flights of the rule `exact` under forces between all spheres: against closed forms, conserved quantities and
//! themselves in other frames. Proves nothing of more spheres than take their steps together.

// What is expected need not have the same bits everywhere.
#![allow(clippy::disallowed_methods)]

mod common;

use std::f64::consts::TAU;

use carom::{
    Boundary, Collider, DVec3, Emitter, Force, Gravity, Interaction, MutualGravity, PointAttractor,
    Pose, QuadraticDrag, Settings, Shape, Sphere, SphereState, SphereStates, Spring, World,
};
use common::{G, Numbers, assert_close, exact, run, vec};

const FRAME: f64 = 1.0 / 64.0;

/// Two bodies of half a unit of mass in the apocentre of an ellipse with a semi-major axis of 1, and the period 2 pi.
fn ellipse(eccentricity: f64, scale: f64) -> World {
    let mut world = exact();
    world.add_force(MutualGravity::new(scale * scale * scale)).unwrap();
    let speed = ((1.0 - eccentricity) / (1.0 + eccentricity)).sqrt();
    for side in [0.5, -0.5] {
        let place = side * scale * vec(1.0 + eccentricity, 0.0, 0.0);
        let body = Sphere::new(place, 1e-3 * scale).with_mass(0.5);
        world.add_sphere(body.with_velocity(side * scale * vec(0.0, speed, 0.0))).unwrap();
    }
    world
}

#[test]
fn two_bodies_keep_energy_and_period_of_their_ellipse() {
    for scale in [1e-6, 1.0, 1e6] {
        let mut world = ellipse(0.9, scale);
        let (energy, start) = (world.total_energy(), world.spheres().positions()[0]);
        for _ in 0..100 {
            world.step(TAU).unwrap();
        }
        // Rounding of 10,000 steps, at random.
        assert_close(world.total_energy(), energy, 1e-13 * energy.abs());
        assert_close(world.momentum().length(), 0.0, 1e-13 * scale);
        // Where they hardly move, an error of the phase of 1e-9 periods is one of the way of the speed times that.
        let off = (world.spheres().positions()[0] - start) / scale;
        assert!(off.length() < 1e-9, "{off}");
    }
}

/// Bodies of 3, 4 and 5 kg that fall from rest in the corners of a triangle of sides 3, 4 and 5.
fn pythagorean() -> World {
    let mut world = exact();
    world.add_force(MutualGravity::new(1.0)).unwrap();
    for (mass, x, y) in [(3.0, 1.0, 3.0), (4.0, -2.0, -1.0), (5.0, 1.0, -1.0)] {
        world.add_sphere(Sphere::new(vec(x, y, 0.0), 1e-6).with_mass(mass)).unwrap();
    }
    world
}

#[test]
fn the_pythagorean_problem_ends_with_the_ejection_of_the_lightest_body() {
    let mut world = pythagorean();
    let energy = world.total_energy();
    run(&mut world, 70.0, 0.25);
    // Close passages multiply the rounding of places. IAS15 of REBOUND leaves 3e-11.
    assert_close(world.total_energy(), energy, 2e-10 * energy.abs());
    let (places, velocities) = (world.spheres().positions(), world.spheres().velocities());
    let (pair_place, pair_velocity) = (
        (4.0 * places[1] + 5.0 * places[2]) / 9.0,
        (4.0 * velocities[1] + 5.0 * velocities[2]) / 9.0,
    );
    let (offset, velocity) = (places[0] - pair_place, velocities[0] - pair_velocity);
    // It flies away faster than it can be held back, and the others circle each other.
    assert!(velocity.dot(offset) > 0.0 && offset.length() > 5.0, "{offset}");
    assert!(0.5 * velocity.length_squared() > 12.0 / offset.length());
    assert!(places[1].distance(places[2]) < 1.0);
}

#[test]
fn bodies_that_meet_elastically_on_their_ellipse_keep_its_energy() {
    // At the pericentre, at .1, they would be within each other; they fall back to where they were at rest.
    let mut world = exact();
    world.add_force(MutualGravity::new(1.0)).unwrap();
    for side in [0.5, -0.5] {
        let body = Sphere::new(side * DVec3::X, 0.1).with_mass(0.5).with_restitution(1.0);
        world.add_sphere(body).unwrap();
    }
    let energy = world.total_energy();
    // From rest at r0 = 1 to r = .2: t = sqrt(r0³/2) (acos(sqrt(s)) + sqrt(s (1 - s))), s = r/r0.
    let s = 0.2f64;
    let to_impact = 0.5f64.sqrt() * (s.sqrt().acos() + (s * (1.0 - s)).sqrt());
    let mut impacts = 0;
    for number in 1..=20 {
        while world.time() + FRAME < 2.0 * to_impact * f64::from(number) {
            impacts += world.step(FRAME).unwrap().impacts.len();
        }
        let left = 2.0 * to_impact * f64::from(number) - world.time();
        impacts += world.step(left).unwrap().impacts.len();
        assert_eq!(impacts, number as usize);
        // Rounding of some tens of steps for each time, and of the times of impacts.
        assert_close(world.total_energy(), energy, 1e-13 * f64::from(number) * energy.abs());
        let places = world.spheres().positions();
        assert_close(places[0].distance(places[1]), 1.0, 1e-11);
    }
}

/// Balls of different masses that attract each other in a box, with emitted ones, a spring and forces on each.
fn cloud(numbers: &mut Numbers, count: u32, is_lossless: bool) -> World {
    let mut world = exact();
    world.add_force(MutualGravity::new(0.5)).unwrap();
    world.add_force(Gravity::new(vec(0.0, -0.5, 0.0))).unwrap();
    world.add_force(PointAttractor::new(vec(0.2, -3.0, 0.1), 0.3)).unwrap();
    let (restitution, normals) = match is_lossless {
        true => (1.0, [DVec3::X, -DVec3::X, DVec3::Y, -DVec3::Y, DVec3::Z, -DVec3::Z]),
        false => (0.5, [DVec3::Y; 6]),
    };
    for normal in normals {
        let pose = Pose::at(-2.0 * normal);
        let pose = pose.rotated(carom::DQuat::from_rotation_arc(DVec3::Y, normal));
        let wall = Collider::new(Shape::HalfSpace, pose);
        world.add_collider(wall.with_restitution(restitution)).unwrap();
    }
    let mut balls = Vec::new();
    for i in 0..count {
        let [column, row] = [i % 3, i / 3].map(|it| f64::from(it) - 1.0);
        let place = vec(column, row, 0.0) + 0.2 * numbers.vector();
        let ball = Sphere::new(place, 0.1).with_mass(numbers.between(0.2, 1.0));
        let ball = ball.with_velocity(numbers.vector()).with_restitution(restitution);
        balls.push(world.add_sphere(ball).unwrap());
    }
    let spring = Spring::between(balls[0], balls[4], 0.8).with_stiffness(20.0);
    world.add_spring(spring.with_only_pulls(true)).unwrap();
    if !is_lossless {
        world.add_force(QuadraticDrag::new(1.2)).unwrap();
        let emitted = Sphere::new(DVec3::ZERO, 0.1).with_mass(0.3).with_restitution(0.5);
        let emitter = Emitter::new(emitted, 0.3).with_position(vec(0.05, 2.5, 0.03));
        world.add_emitter(emitter.with_max_spheres(4)).unwrap();
    }
    world
}

#[test]
fn balls_that_attract_each_other_in_a_box_keep_their_energy() {
    for seed in 1..=3 {
        let mut world = cloud(&mut Numbers(seed), 9, true);
        let energy = world.total_energy();
        let scale = energy.abs().max(world.kinetic_energy());
        let impacts = run(&mut world, 3.0, FRAME);
        assert!(impacts > 10, "{impacts}");
        // Rounding of some thousand steps and some tens of impacts.
        assert_close(world.total_energy(), energy, 1e-12 * scale);
    }
}

#[test]
fn frames_do_not_change_a_bit() {
    for is_lossless in [true, false] {
        let state_of = |frame: f64| {
            let mut world = cloud(&mut Numbers(3), 9, is_lossless);
            run(&mut world, 2.0, frame);
            world.state_hash()
        };
        let expected = state_of(FRAME);
        for frame in [1.0 / 32.0, 1.0 / 256.0] {
            assert_eq!(state_of(frame), expected, "{is_lossless} {frame}");
        }
    }
}

/// A force between every two spheres: `-k r - c v`, with the offset and the velocity of one as seen from the other.
#[derive(Debug)]
struct Bonds {
    /// Stiffness \[N/m\].
    stiffness: f64,
    /// \[kg/s\]
    damping: f64,
}

impl Force for Bonds {
    fn on(&self, _sphere: &SphereState, _time: f64) -> DVec3 {
        DVec3::ZERO
    }

    fn interaction(&self) -> Option<&dyn Interaction> {
        Some(self)
    }
}

impl Interaction for Bonds {
    fn add_forces(&self, spheres: &SphereStates, _time: f64, forces: &mut [DVec3]) {
        for (i, force) in forces.iter_mut().enumerate() {
            for j in 0..spheres.len() {
                let velocity = spheres.velocities[j] - spheres.velocities[i];
                *force += self.stiffness * spheres.offset(i, j) + self.damping * velocity;
            }
        }
    }

    fn potential_energy(&self, spheres: &SphereStates, _time: f64) -> f64 {
        let pairs = (0..spheres.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
        pairs.map(|(i, j)| 0.5 * self.stiffness * spheres.offset(i, j).length_squared()).sum()
    }
}

#[test]
fn a_force_of_a_program_between_all_spheres_is_followed_to_rounding() {
    for damping in [0.0, 0.3] {
        let mut world = exact();
        world.set_settings(Settings::default().with_spheres_collide(false)).unwrap();
        world.add_force(Bonds { stiffness: 2.0, damping }).unwrap();
        let mut numbers = Numbers(7);
        let starts: Vec<DVec3> = (0..5).map(|_| numbers.vector()).collect();
        for &start in &starts {
            world.add_sphere(Sphere::new(start, 0.01).with_mass(1.0)).unwrap();
        }
        let centre = starts.iter().sum::<DVec3>() / 5.0;
        // About the centre of mass: x'' = -5 k x - 5 c x'.
        let (square, b) = (10.0f64, 2.5 * damping);
        let w = (square - b * b).sqrt();
        for _ in 0..8 {
            world.step(0.7).unwrap();
            let t = world.time();
            let factor = (-b * t).exp() * ((w * t).cos() + b / w * (w * t).sin());
            for (&start, &place) in starts.iter().zip(world.spheres().positions()) {
                // Rounding of some hundred steps.
                let expected = centre + factor * (start - centre);
                assert!((place - expected).length() < 1e-12, "{damping} {place} {expected}");
            }
        }
    }
}

#[test]
fn a_force_between_spheres_in_a_periodic_box_changes_its_image_without_a_hang() {
    let periodic = Boundary::Periodic { size: DVec3::splat(4.0) };
    let mut world = World::new(Settings::default().with_boundary(periodic)).unwrap();
    world.add_force(Bonds { stiffness: 0.5, damping: 0.0 }).unwrap();
    let mut numbers = Numbers(9);
    for i in 0..6 {
        let place = vec(f64::from(i % 3) - 1.0, f64::from(i / 3) - 0.5, 0.0);
        let ball = Sphere::new(place, 0.1).with_velocity(3.0 * numbers.vector());
        world.add_sphere(ball.with_restitution(1.0)).unwrap();
    }
    let energy = world.total_energy();
    run(&mut world, 1.0, FRAME);
    // The potential of the nearest image is continuous; its force turns round within a step.
    assert_close(world.total_energy(), energy, 1e-6 * energy);
}

#[test]
fn a_ball_that_others_attract_rests_on_the_floor() {
    let mut world = exact();
    world.add_force(MutualGravity::new(1.0)).unwrap();
    world.add_force(Gravity::new(vec(0.0, -G, 0.0))).unwrap();
    let floor = Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO)).with_restitution(0.5);
    world.add_collider(floor).unwrap();
    for (x, y) in [(0.0, 0.5), (1.0, 0.8), (0.45, 1.5), (-2.0, 0.1)] {
        let ball = Sphere::new(vec(x, y, 0.0), 0.1).with_mass(0.1).with_restitution(0.5);
        world.add_sphere(ball).unwrap();
    }
    run(&mut world, 6.0, FRAME);
    for (place, velocity) in world.spheres().positions().iter().zip(world.spheres().velocities()) {
        // On the floor to rounding; without friction they roll towards each other.
        assert!(place.y > 0.1 - 1e-9 && velocity.y.abs() < 1.0, "{place} {velocity}");
    }
}
