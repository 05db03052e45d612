//! Random scenes of a few spheres that make it hard for the rule `exact`: radii and masses of very different
//! sizes, spheres that touch from the start, edges and corners, surfaces that move and turn. Every frame
//! ends soon, nothing leaves a closed box, energy is not gained, nothing overlaps.

// The physics knows no clock; a test that must not hang does.
#![allow(clippy::disallowed_methods)]

mod common;

use std::ops::Range;
use std::time::{Duration, Instant};

use carom::{
    Collider, DQuat, DVec3, Friction, Gravity, Pose, Settings, Shape, Sides, Sphere, StopRequest,
    World,
};
use common::{Numbers, vec};

/// Half the width of the box \[m\].
const HALF: f64 = 2.0;
const SECONDS: f64 = 5.0;
const PATIENCE: Duration = Duration::from_secs(60);

/// What a scene has.
struct Scene {
    world: World,
    is_closed: bool,
    /// Whether surfaces do work.
    is_driven: bool,
}

/// Ten to a power between two.
fn scale(numbers: &mut Numbers, low: f64, high: f64) -> f64 {
    10f64.powf(numbers.between(low, high))
}

fn scene(seed: u64) -> Scene {
    let mut numbers = Numbers(seed.wrapping_mul(7919) + 13);
    let mut world = World::new(Settings::default()).unwrap();
    let began = Instant::now();
    world.set_stop_request(Some(StopRequest::new(move || began.elapsed() > PATIENCE)));
    if numbers.next() < 0.7 {
        world.add_force(Gravity::new(10.0 * numbers.vector())).unwrap();
    }
    let restitution = [0.0, 0.3, 0.7, 0.95, 1.0][(5.0 * numbers.next()) as usize];
    let is_closed = numbers.next() < 0.7;
    let pose = Pose { position: DVec3::ZERO, rotation: rotation(&mut numbers) };
    let pose = if numbers.next() < 0.5 { pose } else { Pose::at(DVec3::ZERO) };
    if is_closed {
        let shape = Shape::Container { size: DVec3::splat(2.0 * HALF), open: Sides::default() };
        world.add_collider(Collider::new(shape, pose).with_restitution(restitution)).unwrap();
    }
    let is_driven = numbers.next() < 0.4;
    for _ in 0..(3.0 * numbers.next()) as usize {
        let (size, radius) = (vec(0.8, 0.5, 0.3), 0.4);
        let shape =
            if numbers.next() < 0.5 { Shape::Box { size } } else { Shape::Sphere { radius } };
        let place = Pose { position: 0.5 * numbers.vector(), rotation: rotation(&mut numbers) };
        let mut obstacle = Collider::new(shape, place).with_restitution(restitution);
        if is_driven {
            obstacle = obstacle.moving(0.02 * numbers.vector(), numbers.vector());
        }
        world.add_collider(obstacle).unwrap();
    }
    add_spheres(&mut world, &mut numbers, restitution, pose);
    Scene { world, is_closed, is_driven }
}

fn rotation(numbers: &mut Numbers) -> DQuat {
    DQuat::from_axis_angle(numbers.unit_vector(), numbers.between(0.0, 6.0))
}

/// Two to twelve spheres that overlap nothing; some touch the one before.
fn add_spheres(world: &mut World, numbers: &mut Numbers, restitution: f64, pose: Pose) {
    let count = 2 + (11.0 * numbers.next()) as usize;
    let mut tries = 0;
    let mut last: Option<Sphere> = None;
    while world.spheres().len() < count && tries < 2000 {
        tries += 1;
        let radius = 0.6 * scale(numbers, -3.0, 0.0).max(6e-4);
        let inside = HALF - radius;
        let place = match last {
            Some(last) if numbers.next() < 0.4 => {
                last.position + (last.radius + radius) * numbers.unit_vector()
            }
            _ => pose.rotation * (inside * numbers.vector()),
        };
        let local = pose.rotation.inverse() * place;
        if local.abs().max_element() > inside {
            continue;
        }
        let sphere = Sphere::new(place, radius)
            .with_mass(scale(numbers, -4.5, 4.5))
            .with_restitution(restitution)
            .with_velocity(5.0 * numbers.vector());
        let id = world.add_sphere(sphere).unwrap();
        // Touching counts, overlapping by more than rounding does not.
        let overlaps = world.overlaps(0.0).iter().any(|overlap| overlap.depth > 1e-13);
        if overlaps {
            world.remove_sphere(id).unwrap();
        } else {
            last = Some(sphere);
        }
    }
}

/// Adds friction and spin to the spheres of a world.
fn roughen(world: &mut World, seed: u64) {
    let mut numbers = Numbers(seed.wrapping_mul(104_729) + 7);
    for id in world.spheres().ids().to_vec() {
        let friction = Friction::sliding(scale(&mut numbers, -2.0, 0.5))
            .with_rolling(0.1 * numbers.next())
            .with_spinning(0.1 * numbers.next())
            .with_tangential_restitution((2.0 * numbers.next() - 1.0).max(0.0));
        let spin = 20.0 * numbers.vector();
        let sphere = world.sphere(id).unwrap().with_friction(friction);
        world.set_sphere(id, sphere.with_angular_velocity(spin)).unwrap();
    }
}

/// Runs a scene, with friction or without; says what is wrong with it.
fn fault(seed: u64, is_rough: bool) -> Option<String> {
    let Scene { mut world, is_closed, is_driven } = scene(seed);
    if is_rough {
        roughen(&mut world, seed);
    }
    let (began, start) = (Instant::now(), world.total_energy());
    let (mut scale, mut energy) = (start.abs().max(world.kinetic_energy()), start);
    let mut in_zone = false;
    let smallest = world.spheres().radii().iter().copied().fold(f64::INFINITY, f64::min);
    while world.time() < SECONDS {
        let report = match world.step(1.0 / 60.0) {
            Ok(report) => report,
            Err(error) => return Some(error.to_string()),
        };
        in_zone |= report.zone_account.joined > 0;
        let place = format!("at {:.2} s, zone {in_zone}, driven {is_driven}", world.time());
        let now = world.total_energy();
        scale = scale.max(world.kinetic_energy());
        let gained = (now - energy) / scale;
        // Kept to this by the pieces of path along curves.
        if !is_driven && !in_zone && gained > 1e-7 {
            return Some(format!("gains {gained:e} of its energy {place}"));
        }
        if !is_driven && now - start > 1e-3 * scale {
            return Some(format!("has gained {:e} of its energy {place}", (now - start) / scale));
        }
        energy = now;
        let depths = world.overlaps(0.0).into_iter().map(|overlap| overlap.depth / smallest);
        let overlap = depths.fold(0.0, f64::max);
        if !in_zone && overlap > 1e-6 {
            return Some(format!("overlaps by {overlap:e} {place}"));
        }
        // The corner of the box is the farthest place in it.
        let is_out = |center: &DVec3| center.length() > HALF * 3f64.sqrt();
        if is_closed && world.spheres().positions().iter().any(is_out) {
            return Some(format!("one has escaped {place}"));
        }
    }
    let took = began.elapsed();
    (took > PATIENCE).then(|| format!("took {took:?}, zone {in_zone}"))
}

fn check(seeds: Range<u64>, is_rough: bool) {
    let faults = seeds.filter_map(|seed| Some(format!("{seed}: {}", fault(seed, is_rough)?)));
    let faults: Vec<String> = faults.collect();
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn sixty_scenes_go_on() {
    check(0..60, false);
}

#[test]
fn sixty_scenes_with_friction_go_on() {
    check(0..60, true);
}

#[test]
#[ignore = "takes minutes"]
fn a_thousand_scenes_go_on() {
    check(0..1000, false);
    check(0..1000, true);
}
