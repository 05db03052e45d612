//! Friction in persistent contacts under forces that are not linear, under the rule `exact`: against closed forms and the
//! account of energy.

// What is expected need not have the same bits everywhere.
#![allow(clippy::disallowed_methods)]

mod common;

use carom::{Collider, DQuat, DVec3, Exact, Gravity, Pose, Shape, Sphere, SphereId, Spring, World};
use common::{G, account_of_run, assert_close, exact, vec};

const FRAME: f64 = 1.0 / 64.0;
const MU: f64 = 0.1;
/// Stiffness of the springs \[N/m\].
const K: f64 = 20.0;
/// So much inertia that nothing turns: a block. The angular velocity is below rounding of what is compared.
const BLOCK: f64 = 1e18;

/// A world with gravity along -y and a rough floor.
fn rough_floor() -> World {
    let mut world = exact();
    world.add_force(Gravity::new(vec(0.0, -G, 0.0))).unwrap();
    let floor = Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO)).with_friction(MU);
    world.add_collider(floor).unwrap();
    world
}

/// A ball of 1 kg on the floor that does not bounce.
fn lying(x: f64) -> Sphere {
    let ball = Sphere::new(vec(x, 0.1, 0.0), 0.1).with_mass(1.0).with_restitution(0.0);
    ball.with_friction(MU)
}

/// The chain of balls that a scene of the tests lays over a cylinder, with lengths, times and masses in these units.
struct Chain {
    balls: i32,
    unit: f64,
    /// Distance of neighbours \[units\].
    spacing: f64,
    restitution: f64,
}

impl Chain {
    /// Balls of 20 g, 2 cm in radius, on springs of 5 kN/m above a cylinder of 0.3 m.
    fn over_cylinder(&self) -> World {
        let Self { balls, unit, spacing, restitution } = *self;
        let mut world = exact();
        world.add_force(Gravity::new(vec(0.0, -G / unit, 0.0))).unwrap();
        let lying = DQuat::from_rotation_x(std::f64::consts::FRAC_PI_2);
        let shape = Shape::Cylinder { radius: 0.3 * unit, height: unit };
        let cylinder = Collider::new(shape, Pose { position: DVec3::ZERO, rotation: lying });
        let cylinder = cylinder.with_friction(0.4).with_restitution(restitution);
        world.add_collider(cylinder).unwrap();
        let (height, half) = (0.34, f64::from(balls - 1) / 2.0);
        let angle = 2.0 * (0.5 * spacing / height).asin();
        let ball = |number: i32| {
            let angle = (f64::from(number) - half) * angle;
            let place = vec(height * angle.sin(), height * angle.cos(), 0.0);
            let ball = Sphere::new(place * unit, 0.02 * unit).with_mass(0.02 * unit);
            ball.with_friction(0.4).with_restitution(restitution)
        };
        let balls: Vec<SphereId> =
            (0..balls).map(|number| world.add_sphere(ball(number)).unwrap()).collect();
        for pair in balls.windows(2) {
            let spring = Spring::between(pair[0], pair[1], spacing * unit);
            world.add_spring(spring.with_stiffness(5000.0 / unit).with_damping(0.5)).unwrap();
        }
        world
    }
}

#[test]
fn a_chain_over_a_rough_cylinder_loses_what_its_contacts_take() {
    for unit in [1.0, 1e6] {
        let mut world = Chain { balls: 16, unit, spacing: 0.05, restitution: 0.5 }.over_cylinder();
        let start = world.total_energy();
        let (account, left) = account_of_run(&mut world, 40, FRAME * unit);
        assert!(account.contacts < -0.01 * start, "{unit}: {account:?}");
        assert!(world.contacts().len() > 8, "{unit}");
        // Rounding of some thousand steps.
        assert!(left.abs() < 1e-12 * start, "{unit}: {left:e} J of {start} J");
    }
}

#[test]
fn a_row_of_balls_that_falls_on_a_rough_cylinder_loses_what_its_contacts_take() {
    // The ball in the middle does not slide, and its neighbours lift it off.
    let mut world = exact();
    world.add_force(Gravity::new(vec(0.0, -G, 0.0))).unwrap();
    let lying = DQuat::from_rotation_x(std::f64::consts::FRAC_PI_2);
    let pose = Pose { position: DVec3::ZERO, rotation: lying };
    let cylinder = Collider::new(Shape::Cylinder { radius: 0.3, height: 2.0 }, pose);
    world.add_collider(cylinder.with_friction(0.5).with_restitution(0.3)).unwrap();
    let ball = |number: i32| {
        let place = vec(0.15 * f64::from(number - 4), 0.8, 0.01);
        Sphere::new(place, 0.06).with_mass(0.1).with_restitution(0.3)
    };
    let balls: Vec<SphereId> =
        (0..9).map(|number| world.add_sphere(ball(number)).unwrap()).collect();
    for pair in balls.windows(2) {
        let spring = Spring::between(pair[0], pair[1], 0.15);
        world.add_spring(spring.with_stiffness(500.0).with_damping(0.5)).unwrap();
    }
    let start = world.total_energy();
    let (account, left) = account_of_run(&mut world, 60, 1.0 / 60.0);
    assert!(account.contacts < -0.01 * start, "{account:?}");
    assert!(left.abs() < 1e-12 * start, "{left:e} J of {start} J");
}

#[test]
fn a_net_that_falls_on_a_rough_sphere_loses_what_its_contacts_take() {
    // Damped springs and many slips, each of which begins new steps.
    let mut world = exact();
    world.add_force(Gravity::new(vec(0.0, -G, 0.0))).unwrap();
    let sphere = Collider::new(Shape::Sphere { radius: 0.4 }, Pose::at(DVec3::ZERO));
    world.add_collider(sphere.with_friction(0.5).with_restitution(0.3)).unwrap();
    let along = |number: i32, from: f64| from + 0.15 * f64::from(number);
    let ball = |number: i32| {
        let place = vec(along(number / 5, -0.27), 0.8, along(number % 5, -0.28));
        Sphere::new(place, 0.06).with_mass(0.05).with_restitution(0.2).with_friction(0.5)
    };
    let balls: Vec<SphereId> =
        (0..25).map(|number| world.add_sphere(ball(number)).unwrap()).collect();
    let knots = (0..25).flat_map(|first| [(first, first + 5), (first, first + 1)]);
    let knots =
        knots.filter(|&(first, second)| second < 25 && (second != first + 1 || second % 5 > 0));
    for (first, second) in knots {
        let spring = Spring::between(balls[first], balls[second], 0.15);
        world.add_spring(spring.with_stiffness(300.0).with_damping(0.5)).unwrap();
    }
    let start = world.total_energy();
    let (account, left) = account_of_run(&mut world, 30, 1.0 / 60.0);
    assert!(account.contacts < -0.1 * start, "{account:?}");
    // Rounding of some hundred steps.
    assert!(left.abs() < 1e-14 * start, "{left:e} J of {start} J");
}

#[test]
fn a_chain_whose_balls_touch_loses_what_its_contacts_take() {
    // Between neighbours act forces of rounding, torques of their friction, and thousands of impacts in a frame, with
    // as much work as groups may have by default.
    let patient = Exact::default().with_zone_budget(10_000_000);
    for unit in [1.0, 1e-6] {
        let mut world = Chain { balls: 24, unit, spacing: 0.04, restitution: 0.5 }.over_cylinder();
        world.set_settings(world.settings().with_rule(patient)).unwrap();
        let start = world.total_energy();
        let (account, left) = account_of_run(&mut world, 12, unit / 60.0);
        assert!(account.contacts < -0.01 * start, "{unit}: {account:?}");
        // Rounding of some thousand steps.
        assert!(left.abs() < 1e-13 * start, "{unit}: {left:e} J of {start} J");
    }
}

#[test]
fn balls_on_springs_that_jam_in_a_rough_funnel_lose_what_their_contacts_take() {
    // Slips end in many contacts at a time, and friction decides which contacts press.
    let mut world = exact();
    world.add_force(Gravity::new(vec(0.0, -G, 0.0))).unwrap();
    let shape = Shape::Funnel { top_radius: 1.0, bottom_radius: 0.1, height: 1.0 };
    let funnel = Collider::new(shape, Pose::at(DVec3::ZERO));
    world.add_collider(funnel.with_friction(0.5).with_restitution(0.3)).unwrap();
    let ball = |number: i32| {
        let (part, angle) = (f64::from(number), 0.63 * f64::from(number));
        let place = vec(0.5 * angle.cos(), 0.8 + 0.01 * part, 0.4 * angle.sin());
        Sphere::new(place, 0.1).with_mass(0.5).with_friction(0.5).with_restitution(0.3)
    };
    let balls: Vec<SphereId> =
        (0..10).map(|number| world.add_sphere(ball(number)).unwrap()).collect();
    for (place, &ball) in balls.iter().enumerate() {
        let spring = Spring::between(ball, balls[(place + 1) % 10], 0.25);
        world.add_spring(spring.with_stiffness(500.0).with_damping(0.5)).unwrap();
    }
    let start = world.total_energy();
    let (account, left) = account_of_run(&mut world, 60, 1.0 / 60.0);
    assert!(account.contacts < -0.5 * start, "{account:?}");
    // Rounding of some thousand steps.
    assert!(left.abs() < 1e-13 * start, "{left:e} J of {start} J");
}

#[test]
fn a_soft_rough_cube_on_stairs_loses_what_its_contacts_take() {
    let mut world = exact();
    world.add_force(Gravity::new(vec(0.0, -G, 0.0))).unwrap();
    for step in 0..5 {
        let place = vec(0.4 * f64::from(step), -0.3 * f64::from(step), 0.0);
        let stair = Collider::new(Shape::Box { size: vec(0.4, 0.3, 3.0) }, Pose::at(place));
        world.add_collider(stair.with_friction(0.5).with_restitution(0.3)).unwrap();
    }
    let part = |number: i32| 0.3 * f64::from(number);
    let places = (0..27).map(|n| vec(0.07 + part(n / 9), 0.7 + part(n / 3 % 3), part(n % 3)));
    let places: Vec<DVec3> = places.collect();
    let ball = |&place: &DVec3| {
        let ball = Sphere::new(place, 0.1).with_mass(1.0);
        world.add_sphere(ball.with_friction(0.5).with_restitution(0.3)).unwrap()
    };
    let balls: Vec<SphereId> = places.iter().map(ball).collect();
    for first in 0..27 {
        for second in first + 1..27 {
            let length = places[first].distance(places[second]);
            if length < 0.53 {
                let spring = Spring::between(balls[first], balls[second], length);
                world.add_spring(spring.with_stiffness(2000.0)).unwrap();
            }
        }
    }
    let start = world.total_energy();
    let (account, left) = account_of_run(&mut world, 128, FRAME);
    assert!(account.contacts < -0.2 * start, "{account:?}");
    // Rounding of some thousand steps.
    assert!(left.abs() < 1e-12 * start, "{left:e} J of {start} J");
}

/// Advances by frames. Returns the place of a ball along x \[m\] after each.
fn places(world: &mut World, ball: SphereId, frames: usize) -> Vec<f64> {
    let place = |_| {
        world.step(FRAME).unwrap();
        world.sphere(ball).unwrap().position.x
    };
    (0..frames).map(place).collect()
}

/// A ball on a spring from x to 0, with this moment of inertia divided by m r².
fn on_spring(world: &mut World, x: f64, inertia_factor: f64) -> SphereId {
    let ball = world.add_sphere(lying(x).with_inertia_factor(inertia_factor)).unwrap();
    let spring = Spring::to_point(ball, vec(0.0, 0.1, 0.0), 0.0).with_stiffness(K);
    world.add_spring(spring).unwrap();
    ball
}

/// Where a block on a spring is at a time \[s\] that is released at x0 > 0 \[m\]: half swings about `±μ m g/k`, each
/// shorter by `2 μ m g/k` on its side, until one ends within `μ m g/k`.
fn block_at(x0: f64, time: f64) -> f64 {
    let (rate, reach) = (K.sqrt(), MU * G / K);
    let half = std::f64::consts::PI / rate;
    let (mut x, mut left) = (x0, time);
    while x.abs() > reach {
        let center = reach * x.signum();
        if left < half {
            return center + (x - center) * (rate * left).cos();
        }
        (x, left) = (2.0 * center - x, left - half);
    }
    x
}

#[test]
fn a_block_on_a_spring_loses_the_same_amplitude_in_each_half_swing_and_stops() {
    let mut world = rough_floor();
    let ball = on_spring(&mut world, 0.52, BLOCK);
    for (frame, x) in (1u32..).zip(places(&mut world, ball, 8 * 64)) {
        // Rounding of some hundred steps.
        assert_close(x, block_at(0.52, FRAME * f64::from(frame)), 1e-13);
    }
    // Rounding where the slip ends.
    assert!(world.sphere(ball).unwrap().velocity.length() < 1e-13);
}

#[test]
fn a_ball_that_rolls_on_a_spring_swings_with_its_turning_mass() {
    let mut world = rough_floor();
    let ball = on_spring(&mut world, 0.1, 0.4);
    let start = world.total_energy();
    let rate = (K / 1.4).sqrt();
    for (frame, x) in (1u32..).zip(places(&mut world, ball, 10 * 64)) {
        let exact = 0.1 * (rate * FRAME * f64::from(frame)).cos();
        // Rounding of some hundred steps.
        assert_close(x, exact, 1e-13);
    }
    assert_close(world.total_energy(), start, 1e-13 * start);
}

#[test]
fn a_chain_of_blocks_is_braked_as_one() {
    let mut world = rough_floor();
    let block = |place: i32| {
        let ball = lying(0.25 * f64::from(place)).with_inertia_factor(BLOCK);
        ball.with_velocity(vec(1.5, 0.0, 0.0))
    };
    let blocks: Vec<SphereId> =
        (0..12).map(|place| world.add_sphere(block(place)).unwrap()).collect();
    for pair in blocks.windows(2) {
        let spring = Spring::between(pair[0], pair[1], 0.25).with_stiffness(500.0);
        world.add_spring(spring.with_damping(0.5)).unwrap();
    }
    let energy = world.total_energy();
    let (account, left) = account_of_run(&mut world, 2 * 64, FRAME);
    for (place, &block) in (0..).zip(&blocks) {
        let Sphere { position, velocity, .. } = world.sphere(block).unwrap();
        // v²/(2 μ g); rounding of some hundred steps.
        let way = 1.5 * 1.5 / (2.0 * MU * G);
        assert_close(position.x, 0.25 * f64::from(place) + way, 1e-12);
        assert!(velocity.length() < 1e-12, "{velocity}");
    }
    assert_close(account.contacts, -0.5 * 12.0 * 1.5 * 1.5, 1e-12);
    assert!(left.abs() < 1e-13 * energy, "{left:e}");
}

#[test]
fn touching_rough_balls_on_relaxed_springs_drift_on_together() {
    let mut world = exact();
    let part = |number: usize| -0.3 + 0.2 * number as f64;
    let velocity = vec(0.2244513394091675, -1.3089890882059005, -1.2334153224781965);
    let places: Vec<DVec3> =
        (0..27).map(|it| vec(part(it / 9), 0.1 + part(it / 3 % 3), part(it % 3))).collect();
    let ball = |&place: &DVec3| {
        let ball = Sphere::new(place, 0.1).with_mass(1.0).with_velocity(velocity);
        ball.with_restitution(0.3).with_friction(0.2)
    };
    let ids: Vec<SphereId> =
        places.iter().map(|place| world.add_sphere(ball(place)).unwrap()).collect();
    for (second, &place) in places.iter().enumerate() {
        for first in (0..second).filter(|&first| places[first].distance(place) < 0.3) {
            let length = places[first].distance(place);
            let spring = Spring::between(ids[first], ids[second], length).with_stiffness(1000.0);
            world.add_spring(spring).unwrap();
        }
    }
    for _ in 0..32 {
        world.step(FRAME).unwrap();
    }
    for (&place, &start) in world.spheres().positions().iter().zip(&places) {
        // Springs that are too long by rounding, at some ten oscillations.
        assert!(place.distance(start + 0.5 * velocity) < 1e-12, "{place}");
    }
}

/// A ball of 1 m, dropped onto two of 0.1 m that lie 0.35 m from the axis of a bowl of 3 m, where all lengths are in this
/// unit \[m\].
fn dropped_onto_two(unit: f64, friction: f64) -> World {
    let mut world = exact();
    world.add_force(Gravity::new(vec(0.0, -G * unit, 0.0))).unwrap();
    let bowl = Shape::Bowl { radius: 3.0 * unit, opening: std::f64::consts::FRAC_PI_2 };
    let bowl = Collider::new(bowl, Pose::at(vec(0.0, 3.0 * unit, 0.0)));
    world.add_collider(bowl.with_friction(friction).with_restitution(0.0)).unwrap();
    let lies = 3.0 - (2.9f64.powi(2) - 0.35f64.powi(2)).sqrt();
    let bears = lies + (1.1f64.powi(2) - 0.35f64.powi(2)).sqrt();
    let balls = [(0.35, lies + 1e-9, 0.1), (-0.35, lies + 1e-9, 0.1), (0.0, bears + 0.02, 1.0)];
    for (x, y, radius) in balls {
        let ball = Sphere::new(unit * vec(x, y, 0.0), unit * radius).with_density(1000.0);
        world.add_sphere(ball.with_friction(friction).with_restitution(0.0)).unwrap();
    }
    world
}

#[test]
fn friction_above_the_tangent_of_half_a_wedge_holds_a_heavy_ball_on_light_ones_in_a_bowl() {
    // The angle between the normals of a light ball, at the bowl and at the heavy ball.
    let half = 0.5 * ((0.35f64 / 1.1).asin() - (0.35f64 / 2.9).asin());
    let height =
        3.0 - (2.9f64.powi(2) - 0.35f64.powi(2)).sqrt() + (1.1f64.powi(2) - 0.35f64.powi(2)).sqrt();
    for unit in [1e-6, 1.0, 1e6] {
        for (friction, holds) in [(0.5 * half.tan(), false), (4.0 * half.tan(), true)] {
            let mut world = dropped_onto_two(unit, friction);
            let energy = world.total_energy();
            let (_, left) = account_of_run(&mut world, 64, FRAME);
            let sunk = height - world.spheres().positions()[2].y / unit;
            // The impact squeezes them out by a part of the radius of the light balls.
            assert_eq!(sunk < 0.01, holds, "unit {unit}, friction {friction}: {sunk}");
            // Rounding of some hundred steps.
            assert!((left / energy).abs() < 1e-11, "unit {unit}: {left:e} of {energy:e}");
        }
    }
}
