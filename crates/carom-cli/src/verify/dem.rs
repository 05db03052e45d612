//! Benchmarks of discrete element methods for single contacts, with rigid spheres under the rule
//! `exact`: those of LAMMPS' granular tests, and of Chung and Ooi, Granular Matter 13, 643 (2011).
//!
//! Rigid spheres have no peak force, no duration of a contact and no cohesion: LAMMPS' tests 2, 3
//! and 8 and Chung and Ooi's tests 1 and 2 cannot be asked of them. Their formulas are those of
//! spheres that slide or stick during a whole impact, which the benchmarks approach as stiffness
//! grows.

use carom::{DVec3, Exact, Friction, Gravity, Sphere, SphereId, World};

use super::claim::{Claim, Expected, Fault, Measured, Outcome, Tolerance};
use super::setup::{FRAME, G, half_space, run_until, world};

const RADIUS: f64 = 0.1;
const RESTITUTION: f64 = 0.5;
const FRICTION: f64 = 0.4;
/// Normal speed of impacts \[m/s\].
const SPEED: f64 = 0.2;
const ROUNDING: &str = "rounding of an impact";
const CHUNG_OOI: &str = "Chung and Ooi (2011); rigid spheres";

pub fn claims() -> Vec<Claim> {
    let mut claims = normal();
    claims.extend(tangential());
    claims.extend(pairs());
    claims.extend(on_the_floor());
    claims.into_iter().map(|claim| claim.about(Exact::default().into())).collect()
}

/// Normal impacts with each coefficient of restitution.
fn normal() -> Vec<Claim> {
    let mut claims = Vec::new();
    for restitution in [0.1, 0.7, 1.0] {
        claims.push(Claim::new(
            format!("dem: two spheres head-on, e = {restitution}: separation by approach"),
            Expected::value(restitution, "LAMMPS, test_dem_01 (2026)"),
            Tolerance::relative(1e-12, ROUNDING),
            move |_| {
                let heavy = sphere(-2.0 * RADIUS * DVec3::X, 0.3 * DVec3::X).with_mass(3.0);
                let light = sphere(2.0 * RADIUS * DVec3::X, -0.7 * DVec3::X);
                // Coefficients of a pair are multiplied.
                let hit = meet([heavy.with_restitution(restitution), light])?;
                hit.measure(|one, other| other.velocity.x - one.velocity.x)
            },
        ));
        claims.push(Claim::new(
            format!("dem: a sphere on a plane, e = {restitution}: rebound by impact"),
            Expected::value(restitution, "Chung and Ooi (2011), test 3"),
            Tolerance::relative(1e-12, ROUNDING),
            move |_| bounce(restitution, 0.0, 0.0)?.measure(|ball, _| ball.velocity.y / SPEED),
        ));
    }
    claims
}

/// Impacts on a plane with tangential speed or spin: the sphere slides all the time, or sticks.
fn tangential() -> Vec<Claim> {
    let loss = FRICTION * (1.0 + RESTITUTION) * SPEED;
    let slides = 10.0 * loss;
    let sticks = 2.0 * loss;
    let oblique = |what: &str, expected: f64, speed: f64, spin: bool| {
        Claim::new(
            format!("dem: oblique impact on a plane at {speed:.2} m/s: {what}"),
            Expected::value(expected, "LAMMPS, test_dem_04 (2026); Chung and Ooi (2011), test 5"),
            Tolerance::relative(1e-12, ROUNDING),
            move |_| {
                let hit = bounce(RESTITUTION, speed, 0.0)?;
                hit.measure(|ball, _| if spin { -ball.angular_velocity.z } else { ball.velocity.x })
            },
        )
    };
    let spinning = |what: &str, expected: f64, surface: f64, spin: bool| {
        Claim::new(
            format!("dem: impact on a plane with r w = {surface:.2} m/s: {what}"),
            Expected::value(expected, "LAMMPS, test_dem_06 (2026); Chung and Ooi (2011), test 6"),
            Tolerance::relative(1e-12, ROUNDING),
            move |_| {
                let hit = bounce(RESTITUTION, 0.0, -surface / RADIUS)?;
                hit.measure(|ball, _| if spin { -ball.angular_velocity.z } else { ball.velocity.x })
            },
        )
    };
    vec![
        oblique("it slides, speed left [m/s]", slides - loss, slides, false),
        oblique("it slides, spin [rad/s]", 2.5 * loss / RADIUS, slides, true),
        oblique("it sticks, speed left [m/s]", 5.0 / 7.0 * sticks, sticks, false),
        oblique("it sticks, spin [rad/s]", 5.0 / 7.0 * sticks / RADIUS, sticks, true),
        spinning("it slides, speed [m/s]", loss, slides, false),
        spinning("it slides, spin left [rad/s]", (slides - 2.5 * loss) / RADIUS, slides, true),
        spinning("it sticks, speed [m/s]", 2.0 / 7.0 * sticks, sticks, false),
        spinning("it sticks, spin left [rad/s]", 2.0 / 7.0 * sticks / RADIUS, sticks, true),
    ]
}

/// Impacts of two spheres that spin alike, so that their surfaces slide past each other.
fn pairs() -> Vec<Claim> {
    // Masses as the cubes of radii.
    let sizes =
        [("identical spheres, test 7", 1.0_f64), ("a sphere five times as large, test 8", 5.0)];
    let mut claims = Vec::new();
    for (which, ratio) in sizes {
        let mass = ratio.powi(3);
        let reduced = mass / (1.0 + mass);
        let limit = FRICTION * (1.0 + RESTITUTION) * reduced * 2.0 * SPEED;
        // Surfaces stop each other by an impulse of 2/7 of the reduced mass.
        let sticking = 2.0 / 7.0 * reduced;
        for (how, surface) in
            [("slide", 10.0 * limit / sticking), ("stick", 0.5 * limit / sticking)]
        {
            let impulse = limit.min(sticking * surface);
            claims.push(Claim::new(
                format!("dem: {which}, that {how}: tangential speed of the small one [m/s]"),
                Expected::value(impulse, CHUNG_OOI),
                Tolerance::relative(1e-12, ROUNDING),
                move |_| {
                    let rough = |it: Sphere| it.with_friction(FRICTION);
                    let spin = -surface / (2.0 * RADIUS);
                    let small = sphere(-2.0 * RADIUS * DVec3::X, SPEED * DVec3::X).with_mass(1.0);
                    let mut large = sphere(2.0 * RADIUS * ratio * DVec3::X, -SPEED * DVec3::X);
                    large.radius *= ratio;
                    let small = small.with_angular_velocity(spin * DVec3::Z);
                    let large =
                        large.with_mass(mass).with_angular_velocity(spin / ratio * DVec3::Z);
                    let hit = meet([rough(small).with_restitution(RESTITUTION), rough(large)])?;
                    hit.measure(|small, _| small.velocity.y.abs())
                },
            ));
        }
    }
    claims
}

/// Sliding and rolling on a floor.
fn on_the_floor() -> Vec<Claim> {
    let (speed, rolling) = (2.0, 0.05);
    let ends = 2.0 * speed / (7.0 * FRICTION * G);
    let slip = |ball: &Sphere| ball.velocity.x + ball.angular_velocity.z * ball.radius;
    vec![
        Claim::new(
            "dem: slip ceases at 2 v/(7 mu g): slip then [m/s]",
            Expected::no_error("LAMMPS, test_dem_05 (2026); closed form"),
            Tolerance::absolute(1e-12, ROUNDING),
            move |_| rolled(FRICTION, speed, 0.0, ends)?.measure(|ball, _| slip(ball)),
        ),
        Claim::new(
            "dem: and the sphere rolls with 5/7 of its speed [part of it]",
            Expected::value(5.0 / 7.0, "LAMMPS, test_dem_05 (2026); closed form"),
            Tolerance::relative(1e-12, ROUNDING),
            move |_| {
                rolled(FRICTION, speed, 0.0, ends + 1.0)?.measure(|ball, _| ball.velocity.x / speed)
            },
        ),
        Claim::new(
            "dem: rolling friction slows a rolling sphere by 5/7 mu g [m/s after 1 s]",
            Expected::value(
                speed - 5.0 / 7.0 * rolling * G,
                "LAMMPS, test_dem_07 (2026); closed form",
            ),
            Tolerance::relative(1e-12, ROUNDING),
            move |_| {
                let friction = Friction::sliding(FRICTION).with_rolling(rolling);
                let spin = -speed / RADIUS;
                rolled(friction, speed, spin, 1.0)?.measure(|ball, _| ball.velocity.x)
            },
        ),
    ]
}

fn sphere(position: DVec3, velocity: DVec3) -> Sphere {
    Sphere::new(position, RADIUS).with_velocity(velocity)
}

/// Two spheres after an impact, or one twice.
struct Hit {
    world: World,
    ids: [SphereId; 2],
}

impl Hit {
    fn measure(self, quantity: impl Fn(&Sphere, &Sphere) -> f64) -> Outcome {
        let [one, other] = [self.world.sphere(self.ids[0])?, self.world.sphere(self.ids[1])?];
        Ok(Measured::in_world(&self.world, quantity(&one, &other)))
    }
}

/// Runs two spheres in empty space until they have met.
fn meet(spheres: [Sphere; 2]) -> Result<Hit, Fault> {
    let mut world = world(Exact::default().into())?;
    let ids = [world.add_sphere(spheres[0])?, world.add_sphere(spheres[1])?];
    run_until(&mut world, 2.0, FRAME)?;
    Ok(Hit { world, ids })
}

/// Runs a sphere against a plane without gravity, with a tangential speed and a spin about z.
fn bounce(restitution: f64, speed: f64, spin: f64) -> Result<Hit, Fault> {
    let mut world = world(Exact::default().into())?;
    let plane = half_space(DVec3::ZERO, DVec3::Y).with_restitution(restitution);
    world.add_collider(plane.with_friction(FRICTION))?;
    let ball = sphere(1.1 * RADIUS * DVec3::Y, DVec3::new(speed, -SPEED, 0.0));
    let id = world.add_sphere(ball.with_angular_velocity(spin * DVec3::Z))?;
    run_until(&mut world, 2.0, FRAME)?;
    Ok(Hit { world, ids: [id; 2] })
}

/// Runs a sphere that slides or rolls on a floor for `time` \[s\].
fn rolled(friction: impl Into<Friction>, speed: f64, spin: f64, time: f64) -> Result<Hit, Fault> {
    let mut world = world(Exact::default().into())?;
    world.add_force(Gravity::new(-G * DVec3::Y))?;
    let floor = half_space(DVec3::ZERO, DVec3::Y).with_restitution(0.0);
    world.add_collider(floor.with_friction(friction))?;
    let ball = sphere(RADIUS * DVec3::Y, speed * DVec3::X).with_angular_velocity(spin * DVec3::Z);
    let id = world.add_sphere(ball)?;
    // 16 equal frames end at the time itself.
    run_until(&mut world, time, time / 16.0)?;
    Ok(Hit { world, ids: [id; 2] })
}
