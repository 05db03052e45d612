//! Galperin's billiard: the impacts between a wall, a ball at rest and an approaching heavy ball
//! count the digits of pi.
//!
//! Galperin, "Playing pool with π (the number π from a billiard point of view)", Regular and
//! Chaotic Dynamics 8, 375 (2003).

use carom::{Collider, DVec3, Error, Pose, Rule, Shape, Sphere, World};

use super::claim::{Claim, Expected, Measured, Outcome, Tolerance};
use super::setup::{half_space, world};

/// Number of impacts for a mass ratio of `100^k`: the first `k + 1` digits of pi.
const DIGITS: [f64; 7] = [3.0, 31.0, 314.0, 3_141.0, 31_415.0, 314_159.0, 3_141_592.0];

/// Length of a frame as a fraction of the time in which the heavy ball would reach the wall. Most
/// impacts occur near the turning point; so they are spread over many frames.
const PART_OF_APPROACH: f64 = 0.1;
/// More frames than the approach and the return take.
const MOST_FRAMES: usize = 10_000;
const RADIUS: f64 = 0.5;

pub fn claims() -> Vec<Claim> {
    let claim = |k: usize, wall: Wall, name: &str| {
        let claim = Claim::new(
            format!("Galperin's billiard, {name}, masses 1 : 100^{k} [impacts]"),
            Expected::value(DIGITS[k], "Galperin 2003"),
            Tolerance::none("a count"),
            move |rule| count(rule, k, wall),
        );
        if k < 6 { claim } else { claim.slow() }
    };
    let mut claims: Vec<Claim> =
        (0..DIGITS.len()).map(|k| claim(k, Wall::HalfSpace, "half-space")).collect();
    claims.push(claim(4, Wall::Rectangle, "rectangle"));
    claims
}

#[derive(Debug, Clone, Copy)]
enum Wall {
    HalfSpace,
    Rectangle,
}

fn count(rule: Rule, k: usize, wall: Wall) -> Outcome {
    let mut world = billiard(rule, k, wall)?;
    let mut impacts = 0;
    for _ in 0..MOST_FRAMES {
        let spheres = world.spheres();
        let [light, heavy] = [0, 1].map(|i| spheres.velocities()[i].x);
        if light >= 0.0 && heavy >= light {
            return Ok(Measured::in_world(&world, impacts as f64));
        }
        let room = (spheres.positions()[1].x - 3.0 * RADIUS).max(f64::EPSILON);
        impacts += world.step(PART_OF_APPROACH * room)?.impacts.len();
    }
    Err(format!("still going on after {impacts} impacts").into())
}

/// Creates the wall at x = 0, a ball of 1 kg at rest, and one of `100^k` kg that approaches at 1
/// m/s.
fn billiard(rule: Rule, k: usize, wall: Wall) -> Result<World, Error> {
    let mut world = world(rule)?;
    let half_space = half_space(DVec3::ZERO, DVec3::X);
    world.add_collider(match wall {
        Wall::HalfSpace => half_space,
        Wall::Rectangle => {
            let shape = Shape::Rectangle { size_x: 4.0, size_z: 4.0 };
            Collider::new(shape, Pose::at(DVec3::ZERO).rotated(half_space.pose.rotation))
        }
    })?;
    let mass = (0..k).fold(1.0, |mass, _| 100.0 * mass);
    world.add_sphere(Sphere::new(DVec3::new(2.0, 0.0, 0.0), RADIUS))?;
    let heavy = Sphere::new(DVec3::new(4.0, 0.0, 0.0), RADIUS).with_mass(mass);
    world.add_sphere(heavy.with_velocity(DVec3::NEG_X))?;
    Ok(world)
}
