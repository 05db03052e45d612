//! Single impacts: drops, and two spheres.

use carom::{DVec3, Error, Rule, Sphere, World};

use super::claim::{Claim, Expected, Measured, Outcome, Tolerance};
use super::setup::{FRAME, G, run_until, world, world_with_floor};
use crate::numbers::Numbers;

/// Height from which balls are dropped \[m\].
const H: f64 = 1.0;
const RADIUS: f64 = 0.25;

/// Reason of a tolerance: the time of bounces that are too short to be simulated.
const CUT_OFF: &str = "bounces no higher than 256 roundings of the coordinates: 1.5e-7 s / (1 - e)";

pub fn claims() -> Vec<Claim> {
    let mut claims = Vec::new();
    for e in [0.5, 0.7, 0.9] {
        claims.extend(drop_claims(e));
    }
    claims.extend([
        Claim::new(
            "elastic drop: the apex is h for ever, 10,000 bounces [part of h]",
            Expected::no_error("conservation of energy"),
            Tolerance::absolute(1e-9, "as demanded; rounding of 10,000 bounces is 1e-12"),
            elastic_drop,
        ),
        Claim::new(
            "head-on, equal masses swap velocities [m/s]",
            Expected::no_error("conservation of momentum and energy"),
            Tolerance::absolute(1e-15, "rounding of 2 m/s, in multiples of 2^-52"),
            head_on,
        ),
        Claim::new(
            "oblique, equal masses, one at rest: they part at 90 degrees [cosine]",
            Expected::no_error("conservation of momentum and energy"),
            Tolerance::absolute(1e-13, "rounding of the normal, 4 m from the start"),
            |rule| pairs(rule, Kind::OneAtRest, right_angle),
        ),
        Claim::new(
            "unequal masses: 1-D formula along the line of centres [part of speed]",
            Expected::no_error("((m1 - m2) u1 + 2 m2 u2)/(m1 + m2)"),
            Tolerance::absolute(1e-13, "rounding of the normal, 4 m from the start"),
            |rule| pairs(rule, Kind::Unequal, along_the_line),
        ),
        Claim::new(
            "unequal masses: velocities across the line stay [part of speed]",
            Expected::no_error("no friction"),
            Tolerance::absolute(1e-13, "rounding of the normal, 4 m from the start"),
            |rule| pairs(rule, Kind::Unequal, across_the_line),
        ),
    ]);
    claims
}

/// Claims about a drop with restitution `e`.
fn drop_claims(e: f64) -> [Claim; 3] {
    let time = (2.0 * H / G).sqrt() * (1.0 + e) / (1.0 - e);
    let path = H * (1.0 + e * e) / (1.0 - e * e);
    // At rest, the centre of the ball is a radius from the origin.
    let contact_duration = (8.0 * 256.0 * f64::EPSILON * (RADIUS + RADIUS) / G).sqrt();
    [
        Claim::new(
            format!("drop, e = {e}: k-th rebound rises to h e^2k, k = 1..6 [part of it]"),
            Expected::no_error("closed form"),
            Tolerance::absolute(1e-12, "rounding of heights of 1 m, against a rebound of 0.2 mm"),
            move |rule| apexes(rule, e),
        ),
        Claim::new(
            format!("drop, e = {e}: rest after sqrt(2h/g)(1+e)/(1-e) [s]"),
            Expected::value(time, "closed form"),
            Tolerance::absolute(contact_duration / (1.0 - e), CUT_OFF),
            move |rule| drop(rule, e, time, |fall| fall.last()),
        ),
        Claim::new(
            format!("drop, e = {e}: path h(1+e²)/(1-e²) [m]"),
            Expected::value(path, "closed form"),
            Tolerance::relative(1e-12, "rounding of 200 times of up to 9 s"),
            move |rule| drop(rule, e, time, Fall::path),
        ),
    ]
}

/// Creates a ball above a floor with the gap `H`.
fn ball_above_floor(rule: Rule, e: f64) -> Result<World, Error> {
    let mut world = world_with_floor(rule, e)?;
    world.add_sphere(Sphere::new(DVec3::new(0.0, RADIUS + H, 0.0), RADIUS))?;
    Ok(world)
}

/// Greatest height that the ball reaches from its present state \[m\].
fn apex(world: &World) -> f64 {
    let spheres = world.spheres();
    let speed = spheres.velocities()[0].y;
    spheres.positions()[0].y - RADIUS + 0.5 * speed * speed / G
}

/// Largest relative error of the first six rebounds.
fn apexes(rule: Rule, e: f64) -> Outcome {
    let mut world = ball_above_floor(rule, e)?;
    let (mut bounces, mut expected, mut worst) = (0, H, 0.0_f64);
    while bounces < 6 && world.time() < 20.0 {
        let impacts = world.step(1.0 / 240.0)?.impacts.len();
        bounces += impacts;
        (0..impacts).for_each(|_| expected *= e * e);
        worst = worst.max((apex(&world) / expected - 1.0).abs());
    }
    match bounces {
        6.. => Ok(Measured::in_world(&world, worst)),
        _ => Err(format!("only {bounces} bounces").into()),
    }
}

/// Times of the impacts of a fall \[s\].
struct Fall(Vec<f64>);

impl Fall {
    /// Time of the last impact, after which the ball is at rest.
    fn last(&self) -> f64 {
        self.0.last().copied().unwrap_or(f64::NAN)
    }

    /// Length of the path \[m\]: the first fall, and `g Δt²/8` up and down between impacts.
    fn path(&self) -> f64 {
        let flights = self.0.windows(2).map(|pair| pair[1] - pair[0]);
        H + flights.map(|t| 0.25 * G * t * t).sum::<f64>()
    }
}

/// Drops a ball and measures until half a second after it should have come to rest.
fn drop(rule: Rule, e: f64, rest: f64, measure: impl Fn(&Fall) -> f64) -> Outcome {
    let mut world = ball_above_floor(rule, e)?;
    let mut times = Vec::new();
    while world.time() < rest + 0.5 {
        let start = world.time();
        times.extend(world.step(FRAME)?.impacts.iter().map(|impact| start + impact.time));
    }
    Ok(Measured::in_world(&world, measure(&Fall(times))))
}

fn elastic_drop(rule: Rule) -> Outcome {
    let mut world = ball_above_floor(rule, 1.0)?;
    // Bounces are 0.9 s apart, so every flight is checked.
    let (frame, mut bounces, mut worst) = (0.25, 0, 0.0_f64);
    while bounces < 10_000 && world.time() < 10_000.0 {
        bounces += world.step(frame)?.impacts.len();
        worst = worst.max((apex(&world) - H).abs() / H);
    }
    match bounces {
        10_000.. => Ok(Measured::in_world(&world, worst)),
        _ => Err(format!("only {bounces} bounces").into()),
    }
}

fn head_on(rule: Rule) -> Outcome {
    let mut world = world(rule)?;
    let velocities = [DVec3::new(2.0, 0.0, 0.0), DVec3::new(-1.0, 0.0, 0.0)];
    for (place, velocity) in [-2.0, 2.0].into_iter().zip(velocities) {
        world.add_sphere(Sphere::new(place * DVec3::X, 0.5).with_velocity(velocity))?;
    }
    run_until(&mut world, 2.0, FRAME)?;
    let after = world.spheres().velocities();
    let error = (after[0] - velocities[1]).length().max((after[1] - velocities[0]).length());
    Ok(Measured::in_world(&world, error))
}

/// Two spheres before and after an impact.
struct Pair {
    masses: [f64; 2],
    before: [DVec3; 2],
    after: [DVec3; 2],
    /// Direction from the first centre to the second at the impact.
    normal: DVec3,
}

/// Kinds of pairs that collide.
#[derive(Debug, Clone, Copy)]
enum Kind {
    /// Equal masses; the second sphere is at rest.
    OneAtRest,
    /// Mass ratios up to 64; both spheres move.
    Unequal,
}

/// Largest error over a hundred different impacts of two spheres.
fn pairs(rule: Rule, kind: Kind, error: fn(&Pair) -> f64) -> Outcome {
    let mut numbers = Numbers::new(1);
    let measured: Result<Vec<Measured>, Error> = (0..100)
        .map(|_| {
            let normal = numbers.direction();
            // They approach at up to 60 degrees from the line of centres.
            let closing = loop {
                let direction = numbers.direction();
                if direction.dot(normal) > 0.5 {
                    break direction;
                }
            };
            let (ratio, drift) = match kind {
                Kind::OneAtRest => (1.0, DVec3::ZERO),
                Kind::Unequal => (libm::exp2(numbers.between(-6.0, 6.0)), numbers.direction()),
            };
            let before = [closing + drift, drift];
            let pair = Pair { masses: [1.0, ratio], before, after: [DVec3::ZERO; 2], normal };
            collide(rule, pair, error)
        })
        .collect();
    Ok(Measured::largest(measured?))
}

/// Measures the error of two spheres that collide after a second.
fn collide(rule: Rule, pair: Pair, error: fn(&Pair) -> f64) -> Result<Measured, Error> {
    let mut world = world(rule)?;
    let radii = [0.3, 0.2];
    let centers = [DVec3::ZERO, (radii[0] + radii[1]) * pair.normal];
    for i in 0..2 {
        let start = centers[i] - pair.before[i];
        let sphere = Sphere::new(start, radii[i]).with_mass(pair.masses[i]);
        world.add_sphere(sphere.with_velocity(pair.before[i]))?;
    }
    run_until(&mut world, 2.0, FRAME)?;
    let after = [0, 1].map(|i| world.spheres().velocities()[i]);
    Ok(Measured::in_world(&world, error(&Pair { after, ..pair })))
}

fn right_angle(pair: &Pair) -> f64 {
    let [first, second] = pair.after;
    (first.dot(second) / (first.length() * second.length())).abs()
}

fn along_the_line(pair: &Pair) -> f64 {
    let ([m1, m2], total) = (pair.masses, pair.masses[0] + pair.masses[1]);
    let [u1, u2] = pair.before.map(|v| v.dot(pair.normal));
    let expected =
        [((m1 - m2) * u1 + 2.0 * m2 * u2) / total, ((m2 - m1) * u2 + 2.0 * m1 * u1) / total];
    let after = pair.after.map(|v| v.dot(pair.normal));
    (0..2).map(|i| (after[i] - expected[i]).abs() / speed(pair)).fold(0.0, f64::max)
}

fn across_the_line(pair: &Pair) -> f64 {
    let across = |v: DVec3| v - v.dot(pair.normal) * pair.normal;
    let errors = (0..2).map(|i| (across(pair.after[i]) - across(pair.before[i])).length());
    errors.fold(0.0, f64::max) / speed(pair)
}

/// Larger of the two speeds before the impact.
fn speed(pair: &Pair) -> f64 {
    pair.before[0].length().max(pair.before[1].length())
}
