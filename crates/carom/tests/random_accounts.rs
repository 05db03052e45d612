//! Random worlds under the rule `exact`: proves that the account of energy closes where springs, threads and other forces
//! meet surfaces, friction, impacts and stepped zones, and that no contact is missed; not that the motion is right beyond
//! that.
//!
//! In zones and in some persistent contacts forces are held: what they add or take by that is the entry `integration`.

// What is expected need not have the same bits everywhere.
#![allow(clippy::disallowed_methods)]

mod common;

use std::time::Instant;

use carom::{
    Buoyancy, Collider, DQuat, DVec3, Friction, Gravity, MutualGravity, PointAttractor, Pose,
    QuadraticDrag, Shape, Sides, Sphere, SphereId, Spring, ViscousDrag, Vortex, World,
};
use common::{G, Numbers, exact, vec};

const FRAME: f64 = 1.0 / 60.0;
const FRAMES: usize = 120;
/// Part of the largest energy that an account may leave open.
const CLOSED: f64 = 1e-9;
/// Part of a radius by which spheres may overlap others and surfaces: a piece of a path along a curve may miss its contacts
/// by a tenth of this, and a few follow each other.
const MISSED: f64 = 1e-6;
/// The same in a stepped zone.
const MISSED_IN_ZONE: f64 = 0.1;

/// A choice among a few.
fn one_of<T: Copy>(numbers: &mut Numbers, of: &[T]) -> T {
    of[((numbers.next() * of.len() as f64) as usize).min(of.len() - 1)]
}

/// How bodies meet in a world.
#[derive(Clone, Copy)]
struct Material {
    restitution: f64,
    friction: Friction,
}

/// Adds what the balls fall on. Returns the lowest height \[m\] of a ball above it.
fn add_colliders(world: &mut World, numbers: &mut Numbers, material: Material) -> f64 {
    let Material { restitution, friction } = material;
    let mut add = |shape, pose| {
        let collider = Collider::new(shape, pose).with_restitution(restitution);
        world.add_collider(collider.with_friction(friction)).unwrap();
    };
    let lying = DQuat::from_rotation_x(std::f64::consts::FRAC_PI_2);
    let tilt = DQuat::from_axis_angle(numbers.unit_vector(), 0.3 * numbers.next());
    match (9.0 * numbers.next()) as u32 {
        0 => {
            let size = DVec3::splat(2.0);
            add(Shape::Container { size, open: Sides::NONE }, Pose::at(DVec3::ZERO).rotated(tilt));
            return -0.5;
        }
        1 => add(Shape::HalfSpace, Pose::at(DVec3::ZERO).rotated(tilt)),
        2 => {
            add(Shape::HalfSpace, Pose::at(vec(0.0, -0.4, 0.0)));
            add(
                Shape::Box { size: vec(0.6, 0.8, 0.6) },
                Pose::at(vec(0.0, -0.4, 0.0)).rotated(tilt),
            );
        }
        3 => add(Shape::Bowl { radius: 1.2, opening: 1.4 }, Pose::at(vec(0.0, 1.2, 0.0))),
        4 => add(
            Shape::Cylinder { radius: 0.4, height: 3.0 },
            Pose::at(vec(0.0, -0.4, 0.0)).rotated(tilt * lying),
        ),
        5 => add(Shape::Sphere { radius: 0.6 }, Pose::at(vec(0.0, -0.6, 0.0))),
        6 => {
            let shape = Shape::Funnel { bottom_radius: 0.13, top_radius: 1.2, height: 1.0 };
            add(shape, Pose::at(vec(0.0, 0.2, 0.0)));
        }
        7 => {
            for step in 0..5 {
                let part = f64::from(step);
                let place = vec(0.4 * (part - 2.0), -0.2 * part - 0.1, 0.0);
                add(Shape::Box { size: vec(0.4, 0.6, 3.0) }, Pose::at(place));
            }
        }
        _ => {}
    }
    0.2
}

/// Adds some forces besides springs.
fn add_forces(world: &mut World, numbers: &mut Numbers) {
    if numbers.next() < 0.85 {
        world.add_force(Gravity::new(vec(0.0, -G, 0.0))).unwrap();
    }
    match (10.0 * numbers.next()) as u32 {
        0 => world.add_force(PointAttractor::new(vec(0.0, -1.0, 0.2), 8.0).with_softening(0.3)),
        1 => world.add_force(QuadraticDrag::new(20.0)),
        2 => world.add_force(Buoyancy::new(300.0, 0.5)),
        3 => world.add_force(Vortex::new(vec(0.1, 0.0, 0.0), 2.0, 0.3).with_core_radius(0.2)),
        4 => world.add_force(ViscousDrag::new(0.2)),
        5 => world.add_force(MutualGravity::new(0.5).with_softening(0.1)),
        _ => return,
    }
    .unwrap();
}

/// Adds springs or threads between some of the balls, and from the first to a point.
fn add_springs(world: &mut World, numbers: &mut Numbers, material: Material, balls: &[SphereId]) {
    let stiffness = 10f64.powf(numbers.between(0.5, 4.5));
    let damping = one_of(numbers, &[0.0, 0.0, 0.5, 5.0]);
    // Elastic balls that a damper brings to rest on each other bounce ever more often, without end.
    let damping = if material.restitution == 1.0 { 0.0 } else { damping };
    let only_pulls = numbers.next() < 0.5;
    let length = one_of(numbers, &[0.0, 0.15, 0.3, 0.6]);
    let spring = |spring: Spring| {
        spring.with_stiffness(stiffness).with_damping(damping).with_only_pulls(only_pulls)
    };
    let count = balls.len();
    let pairs: Vec<(usize, usize)> = match (5.0 * numbers.next()) as u32 {
        0 => Vec::new(),
        1 => (1..count).map(|second| (second - 1, second)).collect(),
        2 if count > 2 => (0..count).map(|first| (first, (first + 1) % count)).collect(),
        3 => (0..count)
            .flat_map(|first| (first + 1..count).map(move |second| (first, second)))
            .filter(|_| numbers.next() < 0.4)
            .collect(),
        _ => (1..count).step_by(2).map(|second| (second - 1, second)).collect(),
    };
    for (first, second) in pairs {
        world.add_spring(spring(Spring::between(balls[first], balls[second], length))).unwrap();
    }
    if numbers.next() < 0.4 {
        let point = vec(0.0, 0.9, 0.0);
        world.add_spring(spring(Spring::to_point(balls[0], point, length))).unwrap();
    }
}

/// The world of a seed, with this friction instead of its own.
fn world_of(seed: u64, friction: Option<Friction>) -> World {
    let mut numbers = Numbers(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1);
    let numbers = &mut numbers;
    for _ in 0..4 {
        numbers.next();
    }
    let mut world = exact();
    let material = Material {
        restitution: one_of(numbers, &[0.0, 0.3, 0.6, 1.0]),
        friction: Friction::sliding(one_of(numbers, &[0.0, 0.0, 0.0, 0.5])),
    };
    let material = Material { friction: friction.unwrap_or(material.friction), ..material };
    let lowest = add_colliders(&mut world, numbers, material);
    add_forces(&mut world, numbers);
    let count = one_of(numbers, &[1, 2, 3, 4, 5]);
    let radius = one_of(numbers, &[0.05, 0.08, 0.1]);
    let mut places: Vec<DVec3> = Vec::new();
    let mut balls = Vec::new();
    while balls.len() < count {
        let place = vec(0.4, 0.35, 0.4) * numbers.vector() + vec(0.0, lowest + 0.6, 0.0);
        if places.iter().any(|other| other.distance(place) < 2.2 * radius) {
            continue;
        }
        places.push(place);
        let ball = Sphere::new(place, radius)
            .with_mass(10f64.powf(numbers.between(-2.0, 1.0)))
            .with_velocity(numbers.vector())
            .with_restitution(material.restitution)
            .with_friction(material.friction);
        balls.push(world.add_sphere(ball).unwrap());
    }
    add_springs(&mut world, numbers, material, &balls);
    world
}

/// What became of a world.
struct Outcome {
    /// Largest part of the energy that a frame, or all frames together, leave open.
    open: f64,
    /// Largest part of the energy that all frames up to one added by held forces.
    integration: f64,
    had_zone: bool,
    /// Largest part of a radius by which a sphere overlaps another one or a surface at the end of a frame.
    overlap: f64,
    seconds: f64,
}

fn outcome(seed: u64, friction: Option<Friction>) -> Outcome {
    let mut world = world_of(seed, friction);
    let start = Instant::now();
    let mut energy = world.total_energy();
    let mut largest = energy.abs().max(world.kinetic_energy());
    let (mut sum, mut most, mut had_zone) = (0.0f64, 0.0f64, false);
    let (mut integration, mut most_integration) = (0.0f64, 0.0f64);
    let mut overlap = 0.0f64;
    for _ in 0..FRAMES {
        let report = world.step(FRAME).unwrap();
        let (zones, account) = (report.zone_account, report.energy_account);
        had_zone |= zones.joined > 0 || zones.spheres > 0;
        integration += account.integration;
        most_integration = most_integration.max(integration.abs());
        let account = account.total();
        let left = world.total_energy() - energy - account;
        energy += left + account;
        largest = largest.max(energy.abs()).max(world.kinetic_energy());
        sum += left;
        most = most.max(left.abs()).max(sum.abs());
        let radius = world.spheres().radii()[0];
        let depths = world.overlaps(MISSED * radius).into_iter().map(|it| it.depth / radius);
        overlap = depths.fold(overlap, f64::max);
    }
    let [open, integration] = [most, most_integration].map(|it| it / largest);
    Outcome { open, integration, had_zone, overlap, seconds: start.elapsed().as_secs_f64() }
}

/// Checks the worlds with these seeds, with this friction instead of their own.
fn assert_worlds_hold(seeds: impl Iterator<Item = u64>, friction: Option<Friction>) {
    let (mut zones, mut slowest) = (0, (0, 0.0));
    let (mut open_worlds, mut integrated, mut missed) = (Vec::new(), Vec::new(), Vec::new());
    for seed in seeds {
        let Outcome { open, integration, had_zone, overlap, seconds } = outcome(seed, friction);
        zones += u32::from(had_zone);
        if seconds > slowest.1 {
            slowest = (seed, seconds);
        }
        if integration > CLOSED {
            integrated.push((seed, integration));
        }
        if open > CLOSED {
            open_worlds.push((seed, open, had_zone));
        }
        if overlap > if had_zone { MISSED_IN_ZONE } else { MISSED } {
            missed.push((seed, overlap, had_zone));
        }
    }
    println!("{zones} worlds with a zone; slowest {slowest:?}; by held forces {integrated:?}");
    assert!(open_worlds.is_empty(), "{open_worlds:?}");
    assert!(missed.is_empty(), "{missed:?}");
}

#[test]
fn random_worlds_close_their_account_and_miss_no_contact() {
    // In two of them a ball on a spring pushed one without, and the account stayed open.
    assert_worlds_hold((1205..1215).chain(1295..1305), None);
}

#[test]
fn worlds_with_stepped_zones_close_their_account() {
    // Up to 3e-5 of the energy was in no entry; in the last, the work of a vortex on a sphere that was held back.
    assert_worlds_hold([1003, 1178, 1280, 1346, 1354, 1421, 2805].into_iter(), None);
}

#[test]
#[ignore = "takes minutes"]
fn two_thousand_random_worlds_close_their_account_and_miss_no_contact() {
    assert_worlds_hold(1000..3000, None);
}
