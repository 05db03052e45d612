//! Flights of the rule `exact` on springs and threads.

use std::f64::consts::PI;

use carom::{DVec3, Gravity, Rule, Sphere, Spring, World};

use super::claim::{Claim, Expected, Measured, Tolerance};
use super::runs::{change_of_energy, exact, other_states};
use super::setup::{G, world};

/// Creates two balls of 1 and 3 kg, which touch at 1 m, on a spring of 2 m and 6 N/m, let go at a length \[m\].
fn pair(rule: Rule, length: f64) -> Result<World, carom::Error> {
    let mut world = world(rule)?;
    let light = Sphere::new(DVec3::ZERO, 0.5).with_mass(1.0).with_restitution(1.0);
    let light = world.add_sphere(light)?;
    let heavy = Sphere::new(DVec3::new(length, 0.0, 0.0), 0.5).with_mass(3.0);
    let heavy = world.add_sphere(heavy.with_restitution(1.0))?;
    world.add_spring(Spring::between(light, heavy, 2.0).with_stiffness(6.0))?;
    Ok(world)
}

/// Rate of their oscillation \[1/s\]: w² = k (1/m + 1/M).
fn rate() -> f64 {
    libm::sqrt(8.0)
}

/// Distance of the first two spheres along x \[m\].
fn distance(world: &World) -> f64 {
    let places = world.spheres().positions();
    places[1].x - places[0].x
}

pub fn pair_on_spring() -> Claim {
    let claim = Claim::new(
        "two balls on a spring by exact: l = l0 + A cos(w t) for 10 s [m]",
        Expected::no_error("closed form"),
        Tolerance::absolute(2e-12, "rounding of some hundred steps, which adds to the phase"),
        |rule| {
            let mut world = pair(rule, 2.5)?;
            let mut largest = 0.0_f64;
            for _ in 0..20 {
                world.step(0.5)?;
                let expected = 2.0 + 0.5 * libm::cos(rate() * world.time());
                largest = largest.max((distance(&world) - expected).abs());
            }
            Ok(Measured::in_world(&world, largest))
        },
    );
    claim.about(exact())
}

pub fn energy_of_impacts() -> Claim {
    let claim = Claim::new(
        "two balls on a spring by exact: elastic impacts between keep the energy for 40 s [start]",
        Expected::no_error("conservation of energy"),
        Tolerance::absolute(1e-12, "rounding of some thousand steps, and of the places of impacts"),
        |rule| change_of_energy(pair(rule, 3.5)?, 2400, 1.0 / 60.0),
    );
    claim.about(exact())
}

/// Creates a ball of 4 kg in the point where its thread of 0.9 m and 10 kN/m is fixed.
fn on_thread(rule: Rule) -> Result<World, carom::Error> {
    let mut world = world(rule)?;
    world.add_force(Gravity::new(DVec3::new(0.0, -G, 0.0)))?;
    let ball = world.add_sphere(Sphere::new(DVec3::ZERO, 0.1).with_mass(4.0))?;
    let thread = Spring::to_point(ball, DVec3::ZERO, 0.9).with_stiffness(1e4);
    world.add_spring(thread.with_only_pulls(true))?;
    Ok(world)
}

pub fn bungee() -> Claim {
    let claim = Claim::new(
        "a ball falls into its thread by exact: it is back at the top after each of 40 periods [m]",
        Expected::no_error("closed form: two parabolas, and a cosine between"),
        Tolerance::absolute(1e-10, "rounding of 80 times at which the thread gets taut or slack"),
        |rule| {
            let mut world = on_thread(rule)?;
            let (speed, w) = (libm::sqrt(2.0 * G * 0.9), libm::sqrt(1e4 / 4.0));
            let taut = 2.0 / w * (PI - libm::atan(speed * w / G));
            let period = 2.0 * speed / G + taut;
            let mut largest = 0.0_f64;
            for number in 1..=40 {
                world.step(f64::from(number) * period - world.time())?;
                largest = largest.max(world.spheres().positions()[0].y.abs());
            }
            Ok(Measured::in_world(&world, largest))
        },
    );
    claim.about(exact())
}

/// Time in which a pendulum on a spring of 1 m, let go at an angle \[rad\], comes down \[s\]. The stiffness is `k`
/// weights by metre.
fn quarter_period(rule: Rule, angle: f64, k: f64) -> Result<(World, f64), carom::Error> {
    let mut world = world(rule)?;
    world.add_force(Gravity::new(DVec3::new(0.0, -G, 0.0)))?;
    // The spring bears the ball from the start.
    let length = 1.0 + libm::cos(angle) / k;
    let start = length * DVec3::new(libm::sin(angle), -libm::cos(angle), 0.0);
    let ball = world.add_sphere(Sphere::new(start, 0.1).with_mass(1.0))?;
    world.add_spring(Spring::to_point(ball, DVec3::ZERO, 1.0).with_stiffness(k * G))?;
    let state = |world: &World| (world.spheres().positions()[0], world.spheres().velocities()[0]);
    while state(&world).0.y > -0.999 {
        world.step(1.0 / 64.0)?;
    }
    // Newton's method: the speed hardly changes there.
    let left = |world: &World| state(world).0.x / -state(world).1.x;
    while left(&world).abs() > 1e-4 {
        world.step(left(&world).max(1e-4))?;
    }
    let time = world.time() + left(&world);
    Ok((world, time))
}

pub fn pendulum() -> Claim {
    let angle = 170.0_f64.to_radians();
    // K(sin(angle/2)) by the arithmetic-geometric mean.
    let (mut a, mut b) = (1.0, libm::cos(0.5 * angle));
    for _ in 0..8 {
        (a, b) = (0.5 * (a + b), libm::sqrt(a * b));
    }
    let claim = Claim::new(
        "pendulum at 170 degrees by exact: a quarter of the period is sqrt(l/g) K(sin 85 degrees) [s]",
        Expected::value(
            libm::sqrt(1.0 / G) * 0.5 * PI / a,
            "elliptic integral (Landau and Lifshitz, Mechanics, section 11)",
        ),
        Tolerance::relative(1e-10, "of two springs, whose give falls with their stiffness"),
        move |rule| {
            let (_, soft) = quarter_period(rule, angle, 1e6)?;
            let (world, stiff) = quarter_period(rule, angle, 2e6)?;
            Ok(Measured::in_world(&world, 2.0 * stiff - soft))
        },
    );
    claim.about(exact())
}

pub fn cradle() -> Claim {
    let claim = Claim::new(
        "cradle on threads by exact: balls that touch keep the energy for 20 s [start]",
        Expected::no_error("conservation of energy"),
        Tolerance::absolute(1e-11, "rounding of some ten thousand steps, and of low bounces"),
        |rule| {
            let mut world = world(rule)?;
            world.add_force(Gravity::new(DVec3::new(0.0, -G, 0.0)))?;
            for number in 0..5 {
                let hook = DVec3::new(0.2 * f64::from(number), 0.0, 0.0);
                let (x, y) = if number == 0 { (-0.55, -0.78) } else { (0.0, -0.954) };
                let ball = Sphere::new(hook + DVec3::new(x, y, 0.0), 0.1).with_restitution(1.0);
                let ball = world.add_sphere(ball.with_mass(1.0))?;
                for side in [-0.3, 0.3] {
                    let hook = hook + side * DVec3::Z;
                    let thread = Spring::to_point(ball, hook, 1.0).with_stiffness(2e4);
                    world.add_spring(thread.with_only_pulls(true))?;
                }
            }
            change_of_energy(world, 1200, 1.0 / 60.0)
        },
    );
    claim.about(exact())
}

/// Balls of the chain of the claim, each 1 kg, and stiffness of its springs \[N/m\].
const CHAIN: usize = 7;
const STIFFNESS: f64 = 40.0;

/// Returns how far a ball of the chain is from its place at the start \[m\].
fn displaced(ball: usize) -> f64 {
    0.2 * libm::sin(7.0 * ball as f64)
}

/// Creates a chain of balls on springs between two fixed points, 1 m apart but for their displacements.
fn chain(rule: Rule) -> Result<World, carom::Error> {
    let mut world = world(rule)?;
    let mut balls = Vec::new();
    for ball in 1..=CHAIN {
        let place = DVec3::new(ball as f64 + displaced(ball), 0.0, 0.0);
        balls.push(world.add_sphere(Sphere::new(place, 0.1).with_mass(1.0))?);
    }
    let end = DVec3::new(CHAIN as f64 + 1.0, 0.0, 0.0);
    let inner = balls.windows(2).map(|two| Spring::between(two[0], two[1], 0.7));
    let outer = [(balls[0], DVec3::ZERO), (balls[CHAIN - 1], end)];
    let outer = outer.map(|(ball, point)| Spring::to_point(ball, point, 0.7));
    for spring in inner.chain(outer) {
        world.add_spring(spring.with_stiffness(STIFFNESS))?;
    }
    Ok(world)
}

/// Returns where a ball of the chain is at a time \[m\]: the sum of the normal modes.
fn in_normal_modes(ball: usize, time: f64) -> f64 {
    let angle = |i: usize, mode: usize| (i * mode) as f64 * PI / (CHAIN as f64 + 1.0);
    let mode = |mode: usize| {
        let part: f64 = (1..=CHAIN).map(|i| displaced(i) * libm::sin(angle(i, mode))).sum();
        let rate = 2.0 * libm::sqrt(STIFFNESS) * libm::sin(0.5 * angle(1, mode));
        part * libm::sin(angle(ball, mode)) * libm::cos(rate * time)
    };
    let modes: f64 = (1..=CHAIN).map(mode).sum();
    ball as f64 + 2.0 / (CHAIN as f64 + 1.0) * modes
}

pub fn normal_modes() -> Claim {
    let claim = Claim::new(
        "a chain of balls and springs by exact: the sum of its normal modes for 10 s [m]",
        Expected::no_error("closed form (Goldstein, Classical Mechanics, chapter 6)"),
        Tolerance::absolute(1e-10, "rounding of some thousand steps, which adds to phases"),
        |rule| {
            let mut world = chain(rule)?;
            let mut largest = 0.0_f64;
            for _ in 0..20 {
                world.step(0.5)?;
                for (ball, place) in (1..).zip(world.spheres().positions()) {
                    let expected = in_normal_modes(ball, world.time());
                    largest = largest.max((place.x - expected).abs());
                }
            }
            Ok(Measured::in_world(&world, largest))
        },
    );
    claim.about(exact())
}

pub fn bits_of_frames() -> Claim {
    let claim = Claim::new(
        "a ball falls into its thread by exact: bits in frames of 1/32, 1/64, 1/256 s [other]",
        Expected::no_error("flights follow from their events alone"),
        Tolerance::none("whole numbers"),
        |rule| other_states(|| on_thread(rule)),
    );
    claim.about(exact())
}
