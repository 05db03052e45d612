//! Flights of the rule `exact` under forces without a closed form.

use std::f64::consts::{PI, TAU};

use carom::{
    Collider, DVec3, Gravity, PointAttractor, Pose, QuadraticDrag, Rule, Shape, Sphere, World,
};

use super::claim::{Claim, Expected, Measured, Tolerance};
use super::runs::{change_of_energy, exact, other_states, periods_off, speed_in_apocentre};
use super::setup::{G, world};

/// Eccentricity of the ellipse of the claims, with a semi-major axis of 1 m and 1 m³/s² in its focus.
const ECCENTRICITY: f64 = 0.9;
/// Periods that they last.
const PERIODS: u32 = 1000;

/// Creates a sphere at the apocentre of its ellipse.
fn in_apocentre(rule: Rule) -> Result<World, carom::Error> {
    let mut world = world(rule)?;
    world.add_force(PointAttractor::new(DVec3::ZERO, 1.0))?;
    let speed = speed_in_apocentre(ECCENTRICITY);
    let start = Sphere::new(DVec3::new(1.0 + ECCENTRICITY, 0.0, 0.0), 1e-3);
    world.add_sphere(start.with_velocity(DVec3::new(0.0, 0.0, speed)))?;
    Ok(world)
}

pub fn kepler_energy() -> Claim {
    let claim = Claim::new(
        "Kepler, e = 0.9, by exact: energy over 1,000 periods [start]",
        Expected::no_error("conservation of energy"),
        Tolerance::absolute(1e-13, "rounding of 100,000 steps, at random"),
        |rule| change_of_energy(in_apocentre(rule)?, PERIODS * 4, TAU / 4.0),
    );
    claim.about(exact())
}

pub fn kepler_phase() -> Claim {
    let claim = Claim::new(
        "Kepler, e = 0.9, by exact: it is back after 1,000 periods [periods]",
        Expected::no_error("Kepler's third law"),
        Tolerance::absolute(1e-9, "the period changes by 3/2 of what the energy does, each time"),
        |rule| periods_off(in_apocentre(rule)?, PERIODS),
    );
    claim.about(exact())
}

pub fn quadratic_drag() -> Claim {
    let (mass, radius, density) = (0.1, 0.05, 1.2);
    let claim = Claim::new(
        "fall with quadratic drag by exact: v = u tanh(g t/u), u = sqrt(2 m g/(rho c A)) [u]",
        Expected::no_error("closed form"),
        Tolerance::absolute(1e-13, "rounding of some tens of steps"),
        move |rule| {
            let mut world = world(rule)?;
            world.add_force(Gravity::new(DVec3::new(0.0, -G, 0.0)))?;
            world.add_force(QuadraticDrag::new(density).with_drag_coefficient(0.5))?;
            world.add_sphere(Sphere::new(DVec3::ZERO, radius).with_mass(mass))?;
            let area = PI * radius * radius;
            let terminal = libm::sqrt(2.0 * mass * G / (density * 0.5 * area));
            let mut largest = 0.0_f64;
            for _ in 0..40 {
                world.step(0.1)?;
                let expected = terminal * libm::tanh(G * world.time() / terminal);
                let speed = -world.spheres().velocities()[0].y;
                largest = largest.max((speed - expected).abs() / terminal);
            }
            Ok(Measured::in_world(&world, largest))
        },
    );
    claim.about(exact())
}

/// Two balls about an attractor that bounce off a fixed one in it and off each other.
fn with_hits(rule: Rule) -> Result<World, carom::Error> {
    let mut world = world(rule)?;
    world.add_force(PointAttractor::new(DVec3::ZERO, 10.0))?;
    for (x, speed) in [(2.0, 2.236), (-3.0, 1.2)] {
        let start = Sphere::new(DVec3::new(x, 0.0, 0.0), 0.1).with_restitution(1.0);
        world.add_sphere(start.with_velocity(DVec3::new(0.0, 0.0, speed)))?;
    }
    let middle = Collider::new(Shape::Sphere { radius: 0.3 }, Pose::at(DVec3::ZERO));
    world.add_collider(middle)?;
    Ok(world)
}

pub fn energy_of_hits() -> Claim {
    let claim = Claim::new(
        "elastic hits about an attractor by exact: the energy is kept for 20 s [start]",
        Expected::no_error("conservation of energy"),
        Tolerance::absolute(1e-12, "rounding of some hundred steps, and of the places of hits"),
        |rule| change_of_energy(with_hits(rule)?, 1200, 1.0 / 60.0),
    );
    claim.about(exact())
}

pub fn bits_of_frames() -> Claim {
    let claim = Claim::new(
        "elastic hits about an attractor by exact: bits in frames of 1/32, 1/64, 1/256 s [other]",
        Expected::no_error("flights follow from their events alone"),
        Tolerance::none("whole numbers"),
        |rule| other_states(|| with_hits(rule)),
    );
    claim.about(exact())
}
