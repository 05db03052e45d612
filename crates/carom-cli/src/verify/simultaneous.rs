//! Simultaneous impacts: rows, symmetric hits, and random groups.
//!
//! The five properties are those that Smith, Kaufman, Vouga, Tamstorf and Grinspun require of an
//! impact operator: "Reflections on Simultaneous Impact", ACM TOG 31(4), 2012.

use carom::{BodyPair, DVec3, Error, Impact, Rule, Sphere, World};

use super::claim::{Claim, Expected, Measured, Outcome, Tolerance};
use super::setup::{FRAME, run_until, world};
use crate::numbers::Numbers;

/// Number of balls in the cradle.
const BALLS: usize = 5;
/// Number of random groups for each property.
const GROUPS: usize = 100;
const SPHERES_PER_GROUP: usize = 12;
const SOURCE: &str = "Smith et al. 2012";

pub fn claims() -> Vec<Claim> {
    let mut claims: Vec<Claim> = (1..BALLS).map(cradle).collect();
    claims.extend([
        Claim::new(
            "cradle: all but the balls that leave are exactly still, k = 1..4 [m/s]",
            Expected::no_error("conservation of momentum and energy"),
            Tolerance::none("exactly"),
            |rule| {
                let speeds: Result<Vec<Measured>, Error> =
                    (1..BALLS).map(|k| cradle_error(rule, k, 0..BALLS - k)).collect();
                Ok(Measured::largest(speeds?))
            },
        ),
        Claim::new(
            "one ball into two: it leaves at -v/5, they at 2 sqrt(3)/5 v, 30 degrees [part of v]",
            Expected::no_error("conservation of momentum and energy"),
            Tolerance::absolute(1e-14, "rounding of the places where they meet"),
            one_into_two,
        ),
        Claim::new(
            "one ball into two: symmetric to the last bit [m/s]",
            Expected::no_error("mirror symmetry"),
            Tolerance::none("exactly"),
            asymmetry_of_one_into_two,
        ),
    ]);
    let rounding = "rounding of sums over a group, in parts of its speeds";
    for (name, measure) in [
        ("break-away: nothing closes after", approach_after as fn(&Answered) -> f64),
        ("energy is conserved", energy_error),
        ("momentum is conserved", momentum_error),
        ("one-sided impulses explain every velocity", impulse_error),
    ] {
        claims.push(Claim::new(
            format!("groups at random: {name} [relative]"),
            Expected::no_error(SOURCE),
            Tolerance::absolute(1e-12, rounding),
            move |rule| groups(rule, measure),
        ));
    }
    claims.push(Claim::new(
        "groups at random: symmetry is preserved [relative]",
        Expected::no_error(SOURCE),
        Tolerance::absolute(1e-12, rounding),
        symmetric_groups,
    ));
    claims
}

/// Claim that a touching cradle hit by k balls ejects k balls.
fn cradle(k: usize) -> Claim {
    Claim::new(
        format!("cradle of {BALLS}, {k} in: {k} out at the same speed [m/s]"),
        Expected::no_error("conservation of momentum and energy"),
        Tolerance::absolute(1e-15, "rounding of 1 m/s, in multiples of 2^-52"),
        move |rule| Ok(cradle_error(rule, k, 0..BALLS)?),
    )
}

/// Largest error of the velocities of these balls, after k balls arrived at 1 m/s from the left.
fn cradle_error(rule: Rule, k: usize, balls: std::ops::Range<usize>) -> Result<Measured, Error> {
    let mut world = world(rule)?;
    for i in 0..BALLS {
        let (gap, speed) = if i < k { (1.0, 1.0) } else { (0.0, 0.0) };
        let sphere = Sphere::new(DVec3::new(i as f64 - gap, 0.0, 0.0), 0.5);
        world.add_sphere(sphere.with_velocity(speed * DVec3::X))?;
    }
    run_until(&mut world, 2.0, FRAME)?;
    let error = |i: usize| {
        let expected = if i < BALLS - k { DVec3::ZERO } else { DVec3::X };
        (world.spheres().velocities()[i] - expected).length()
    };
    Ok(Measured::in_world(&world, balls.map(error).fold(0.0, f64::max)))
}

/// Simulates a central hit of a ball at 1 m/s along x on two touching balls at rest.
fn hit_two(rule: Rule) -> Result<World, Error> {
    let mut world = world(rule)?;
    world.add_sphere(Sphere::new(DVec3::new(-4.0, 0.0, 0.0), 0.5).with_velocity(DVec3::X))?;
    for z in [-0.5, 0.5] {
        world.add_sphere(Sphere::new(DVec3::new(0.0, 0.0, z), 0.5))?;
    }
    run_until(&mut world, 5.0, FRAME)?;
    Ok(world)
}

fn one_into_two(rule: Rule) -> Outcome {
    let world = hit_two(rule)?;
    let root = 3.0_f64.sqrt();
    // At 30 degrees: cosine √3/2, sine 1/2.
    let away = |side: f64| 0.4 * root * DVec3::new(0.5 * root, 0.0, 0.5 * side);
    let expected = [DVec3::new(-0.2, 0.0, 0.0), away(-1.0), away(1.0)];
    let errors = world.spheres().velocities().iter().zip(expected).map(|(v, it)| (v - it).length());
    Ok(Measured::in_world(&world, errors.fold(0.0, f64::max)))
}

fn asymmetry_of_one_into_two(rule: Rule) -> Outcome {
    let world = hit_two(rule)?;
    let velocities = world.spheres().velocities();
    let mirrored = velocities[1] * DVec3::new(1.0, 1.0, -1.0);
    let error = (mirrored - velocities[2]).length() + velocities[0].z.abs();
    // Without an impact, any result would be symmetric.
    let value = if velocities[1] == DVec3::ZERO { f64::INFINITY } else { error };
    Ok(Measured::in_world(&world, value))
}

/// A group of spheres before and after its impacts were answered.
struct Answered {
    masses: Vec<f64>,
    places: Vec<DVec3>,
    before: Vec<DVec3>,
    after: Vec<DVec3>,
    impacts: Vec<Impact>,
}

/// Length of a frame \[s\] in which only touching spheres collide.
const INSTANT: f64 = 1e-9;
/// Spheres of diameter 1 touch if their centres are closer than this.
const TOUCHING: f64 = 1.0 + 1e-9;

/// Answers the impacts of a group of touching spheres of diameter 1.
fn answered(
    rule: Rule,
    places: Vec<DVec3>,
    masses: Vec<f64>,
    before: Vec<DVec3>,
) -> Result<(Measured, Answered), Error> {
    let mut world = world(rule)?;
    for (i, &place) in places.iter().enumerate() {
        let sphere = Sphere::new(place, 0.5).with_mass(masses[i]);
        world.add_sphere(sphere.with_velocity(before[i]))?;
    }
    let impacts = world.step(INSTANT)?.impacts.clone();
    let after = world.spheres().velocities().to_vec();
    Ok((Measured::in_world(&world, 0.0), Answered { masses, places, before, after, impacts }))
}

/// Largest error of random groups.
fn groups(rule: Rule, error: fn(&Answered) -> f64) -> Outcome {
    let mut numbers = Numbers::new(1);
    let mut measured = Vec::new();
    for _ in 0..GROUPS {
        let places = cluster(&mut numbers);
        let masses = places.iter().map(|_| libm::exp2(numbers.between(-3.0, 3.0))).collect();
        let velocities = places.iter().map(|_| numbers.normal_vector()).collect();
        let (world, answered) = answered(rule, places, masses, velocities)?;
        measured.push(Measured { value: error(&answered), ..world });
    }
    Ok(Measured::largest(measured))
}

/// Random centres of touching spheres: neighbours on a face-centred cubic lattice with x >= 0.
fn cluster(numbers: &mut Numbers) -> Vec<DVec3> {
    // In units of half the lattice constant; neighbours differ by 1 along two axes.
    let mut sites = vec![[0_i32; 3]];
    while sites.len() < SPHERES_PER_GROUP {
        let mut site = sites[numbers.index(sites.len())];
        let left_out = numbers.index(3);
        for axis in (0..3).filter(|axis| *axis != left_out) {
            site[axis] += if numbers.unit() < 0.5 { -1 } else { 1 };
        }
        if site[0] >= 0 && !sites.contains(&site) {
            sites.push(site);
        }
    }
    let unit = 0.5_f64.sqrt();
    sites.iter().map(|site| unit * DVec3::from_array(site.map(f64::from))).collect()
}

/// Largest difference between a group that is symmetric in x and its mirror image after the
/// impacts.
fn symmetric_groups(rule: Rule) -> Outcome {
    let mut numbers = Numbers::new(2);
    let mirror = |v: DVec3| v * DVec3::new(-1.0, 1.0, 1.0);
    let mut measured = Vec::new();
    for _ in 0..GROUPS {
        let (mut places, mut masses, mut velocities) = (Vec::new(), Vec::new(), Vec::new());
        let mut pairs = Vec::new();
        for place in cluster(&mut numbers) {
            let (mass, velocity) = (numbers.between(0.2, 5.0), numbers.normal_vector());
            let first = places.len();
            // A sphere on the plane of symmetry is single and moves along the plane.
            let is_single = place.x == 0.0;
            places.push(place);
            velocities.push(if is_single {
                velocity * DVec3::new(0.0, 1.0, 1.0)
            } else {
                velocity
            });
            masses.push(mass);
            if !is_single {
                places.push(mirror(place));
                velocities.push(mirror(velocity));
                masses.push(mass);
            }
            pairs.push([first, places.len() - 1]);
        }
        let (world, answered) = answered(rule, places, masses, velocities)?;
        let after = &answered.after;
        let differences = pairs.iter().map(|&[i, j]| (mirror(after[i]) - after[j]).length());
        let value = differences.fold(0.0, f64::max) / fastest(&answered);
        measured.push(Measured { value, ..world });
    }
    Ok(Measured::largest(measured))
}

fn fastest(answered: &Answered) -> f64 {
    answered.before.iter().map(|v| v.length()).fold(0.0, f64::max)
}

/// Largest speed at which touching spheres still approach after the impacts.
fn approach_after(answered: &Answered) -> f64 {
    let Answered { places, after, .. } = answered;
    let mut worst: f64 = 0.0;
    for j in 0..places.len() {
        for i in 0..j {
            let offset = places[j] - places[i];
            if offset.length() < TOUCHING {
                worst = worst.max((after[i] - after[j]).dot(offset));
            }
        }
    }
    worst / fastest(answered)
}

fn energy_error(answered: &Answered) -> f64 {
    let energy = |velocities: &[DVec3]| -> f64 {
        answered.masses.iter().zip(velocities).map(|(m, v)| 0.5 * m * v.length_squared()).sum()
    };
    (energy(&answered.after) / energy(&answered.before) - 1.0).abs()
}

fn momentum_error(answered: &Answered) -> f64 {
    let Answered { masses, before, after, .. } = answered;
    let change: DVec3 = (0..masses.len()).map(|i| masses[i] * (after[i] - before[i])).sum();
    let scale: f64 = (0..masses.len()).map(|i| masses[i] * before[i].length()).sum();
    change.length() / scale
}

/// Largest change of momentum that the impulses, which must not be negative, do not explain.
fn impulse_error(answered: &Answered) -> f64 {
    let Answered { masses, before, after, impacts, .. } = answered;
    let mut left: Vec<DVec3> =
        (0..masses.len()).map(|i| masses[i] * (after[i] - before[i])).collect();
    for impact in impacts {
        let BodyPair::Spheres(first, second) = impact.between else { return f64::INFINITY };
        if impact.impulse < 0.0 {
            return f64::INFINITY;
        }
        left[first.number() as usize] += impact.impulse * impact.normal;
        left[second.number() as usize] -= impact.impulse * impact.normal;
    }
    let scale: f64 = (0..masses.len()).map(|i| masses[i] * before[i].length()).sum();
    left.iter().map(|it| it.length()).fold(0.0, f64::max) / scale
}
