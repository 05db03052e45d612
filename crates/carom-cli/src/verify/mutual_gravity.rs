//! Flights of the rule `exact` under gravity between spheres.

use std::f64::consts::TAU;

use carom::{DVec3, MutualGravity, Rule, Sphere, World};

use super::claim::{Claim, Expected, Tolerance};
use super::runs::{change_of_energy, exact, periods_off, speed_in_apocentre};
use super::setup::world;

/// Eccentricity of the ellipse of the claims, with a semi-major axis of 1 m and a period of 2 pi s.
const ECCENTRICITY: f64 = 0.9;

/// Creates two bodies of half a kilogram in the apocentre of their ellipse.
fn in_apocentre(rule: Rule) -> Result<World, carom::Error> {
    let mut world = world(rule)?;
    world.add_force(MutualGravity::new(1.0))?;
    let speed = speed_in_apocentre(ECCENTRICITY);
    for side in [0.5, -0.5] {
        let body = Sphere::new(DVec3::new(side * (1.0 + ECCENTRICITY), 0.0, 0.0), 1e-3);
        let velocity = DVec3::new(0.0, 0.0, side * speed);
        world.add_sphere(body.with_mass(0.5).with_velocity(velocity))?;
    }
    Ok(world)
}

pub fn kepler_energy(periods: u32, bound: f64) -> Claim {
    let claim = Claim::new(
        format!("two bodies, e = 0.9, by exact: energy over {periods} periods [start]"),
        Expected::no_error("conservation of energy"),
        Tolerance::absolute(bound, "rounding of a hundred steps for each, at random"),
        move |rule| change_of_energy(in_apocentre(rule)?, periods * 4, TAU / 4.0),
    );
    claim.about(exact())
}

pub fn kepler_phase(periods: u32, bound: f64) -> Claim {
    let claim = Claim::new(
        format!("two bodies, e = 0.9, by exact: they are back after {periods} periods [periods]"),
        Expected::no_error("Kepler's third law"),
        Tolerance::absolute(bound, "the period changes by 3/2 of what the energy does, each time"),
        move |rule| periods_off(in_apocentre(rule)?, periods),
    );
    claim.about(exact())
}

pub fn pythagorean() -> Claim {
    let claim = Claim::new(
        "the Pythagorean problem by exact: energy at 70 s, after the ejection [start]",
        Expected::no_error(
            "conservation of energy (Burrau, Astron. Nachr. 195, 113 (1913); Szebehely and Peters, Astron. J. 72, \
             876 (1967))",
        ),
        Tolerance::absolute(2e-10, "rounding of places, which close passages multiply"),
        |rule| {
            let mut world = world(rule)?;
            world.add_force(MutualGravity::new(1.0))?;
            for (mass, x, y) in [(3.0, 1.0, 3.0), (4.0, -2.0, -1.0), (5.0, 1.0, -1.0)] {
                world.add_sphere(Sphere::new(DVec3::new(x, y, 0.0), 1e-6).with_mass(mass))?;
            }
            change_of_energy(world, 280, 0.25)
        },
    );
    claim.about(exact())
}
