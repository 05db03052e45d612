//! Friction and spin under the rule `contact`: sliding, rolling, bouncing, and heaps held by
//! friction.

use carom::{Collider, Contact, DQuat, DVec3, Error, Friction, Gravity, Pose, Rule, Shape, Sphere};
use carom::{SphereId, World};

use super::claim::{Claim, Expected, Measured, Outcome, Tolerance};
use super::setup::{FRAME, G, run_until, world};

const RADIUS: f64 = 0.1;
/// Length of a sub-step by default \[s\].
const SUB_STEP: f64 = FRAME / 8.0;

const ROUNDING: &str = "rounding of some hundred sub-steps";

pub fn claims() -> Vec<Claim> {
    let mut claims = vec![
        Claim::new(
            "a sliding ball rolls with 5/7 of its speed [part of it]",
            Expected::value(5.0 / 7.0, "Coriolis (1835)"),
            Tolerance::relative(1e-10, ROUNDING),
            |_| sliding().map(|(speed, _)| speed),
        ),
        Claim::new(
            "a ball that slides with v rolls after 2 v/(7 mu g) [s]",
            Expected::value(2.0 * 3.0 / (7.0 * 0.2 * G), "Coriolis (1835)"),
            Tolerance::absolute(FRAME + SUB_STEP, "seen at the end of a frame"),
            |_| sliding().map(|(_, time)| time),
        ),
        Claim::new(
            "a superball turns its slip round, and keeps its energy [relative]",
            Expected::no_error("Garwin, Am. J. Phys. 37, 88 (1969)"),
            Tolerance::absolute(1e-11, ROUNDING),
            superball,
        ),
        Claim::new(
            "rolling friction stops a ball after v²/(2 5/7 mu g) [m]",
            Expected::value(1.0 / (2.0 * 5.0 / 7.0 * 0.02 * G), "torque mu r N"),
            Tolerance::absolute(SUB_STEP, "a sub-step at the speed with which it begins"),
            |_| rolling_friction(),
        ),
    ];
    for (mu, expected) in [(0.5, 5.0 / 7.0), (0.16, 5.0 / 7.0), (0.1, 1.0 - 0.1 / libm::tan(0.5))] {
        claims.push(Claim::new(
            format!("an incline of 0.5 rad, mu = {mu}: acceleration [part of g sin a]"),
            Expected::value(expected, "rolls while tan a <= 7/2 mu, slides else"),
            Tolerance::relative(1e-9, ROUNDING),
            move |_| incline(mu),
        ));
    }
    for (degrees, tangential, spin) in
        [(45.0, 0.8178, 502.3), (60.0, 0.8948, 355.2), (75.0, 0.9512, 183.9)]
    {
        let source = "Chung and Ooi, Granular Matter 13, 643 (2011), test 4; rigid balls";
        let reason = "the published figure has four digits";
        claims.push(Claim::new(
            format!("oblique bounce at {degrees} degrees: tangential restitution"),
            Expected::value(tangential, source),
            Tolerance::absolute(5e-5, reason),
            move |rule| oblique(rule, degrees).map(|(tangential, _)| tangential),
        ));
        claims.push(Claim::new(
            format!("oblique bounce at {degrees} degrees: spin [rad/s]"),
            Expected::value(spin, source),
            Tolerance::absolute(0.05, reason),
            move |rule| oblique(rule, degrees).map(|(_, spin)| spin),
        ));
    }
    for (balls, floor, stands) in [(0.33, 0.083, 1.0), (0.3, 0.083, 0.0), (0.33, 0.076, 0.0)] {
        claims.push(Claim::new(
            format!("four balls, mu = {balls} between them and {floor} on the floor: they stand"),
            Expected::value(stands, "statics: from 0.3178 and 0.0795 on"),
            Tolerance::none("they stand or fall"),
            move |_| tetrahedron(balls, floor),
        ));
    }
    claims.extend(pyramids());
    claims.into_iter().map(|claim| claim.about(Rule::Contact(Contact::default()))).collect()
}

/// Smallest friction with which two touching balls support a third.
fn pyramids() -> [Claim; 2] {
    let sticks = libm::tan(15.0_f64.to_radians());
    let source = "statics: the direction of the force on each contact";
    let reason = "near the threshold a heap falls too slowly to be seen in three seconds";
    [
        Claim::new(
            "two balls and one on top stand from mu = tan 15 degrees between them on",
            Expected::value(sticks, source),
            Tolerance::relative(1e-3, reason),
            |_| threshold(0.2, 0.4, |balls| pyramid(balls, 0.5)),
        ),
        Claim::new(
            "two balls and one on top stand from mu = tan 15 degrees / 3 on the floor on",
            Expected::value(sticks / 3.0, source),
            Tolerance::relative(1e-3, reason),
            |_| threshold(0.05, 0.2, |floor| pyramid(0.5, floor)),
        ),
    ]
}

/// Creates a world under the rule `contact` with a plane through the origin that rises towards +x
/// by this angle \[rad\].
fn on_plane(angle: f64, friction: impl Into<Friction>) -> Result<World, Error> {
    let mut world = world(Contact::default().into())?;
    world.add_force(Gravity::new(DVec3::new(0.0, -G, 0.0)))?;
    let (sine, cosine) = libm::sincos(0.5 * angle);
    let pose = Pose::at(DVec3::ZERO).rotated(DQuat::from_xyzw(0.0, 0.0, sine, cosine));
    let plane = Collider::new(Shape::HalfSpace, pose).with_restitution(0.0);
    world.add_collider(plane.with_friction(friction))?;
    Ok(world)
}

fn ball_on_floor(world: &mut World, velocity: DVec3, spin: DVec3) -> Result<SphereId, Error> {
    let ball = Sphere::new(RADIUS * DVec3::Y, RADIUS).with_velocity(velocity);
    world.add_sphere(ball.with_angular_velocity(spin))
}

/// Speed at which a sliding ball starts to roll, and the time.
fn sliding() -> Result<(Measured, Measured), super::claim::Fault> {
    let mut world = on_plane(0.0, 0.2)?;
    let id = ball_on_floor(&mut world, 3.0 * DVec3::X, DVec3::ZERO)?;
    let mut rolls_since = f64::INFINITY;
    while world.time() < 1.0 {
        world.step(FRAME)?;
        let ball = world.sphere(id)?;
        if ball.velocity.x + RADIUS * ball.angular_velocity.z < 1e-9 {
            rolls_since = rolls_since.min(world.time());
        }
    }
    let speed = world.sphere(id)?.velocity.x / 3.0;
    Ok((Measured::in_world(&world, speed), Measured::in_world(&world, rolls_since)))
}

/// Acceleration of a ball on an incline, relative to that without friction.
fn incline(mu: f64) -> Outcome {
    let angle = 0.5;
    let mut world = on_plane(angle, mu)?;
    let (sine, cosine) = libm::sincos(angle);
    let id = world.add_sphere(Sphere::new(RADIUS * DVec3::new(-sine, cosine, 0.0), RADIUS))?;
    run_until(&mut world, 1.0, FRAME)?;
    let speed = world.sphere(id)?.velocity.length();
    Ok(Measured::in_world(&world, speed / (G * sine * world.time())))
}

/// Deviation of a bounce from the ideal: of the slip from its reverse, and of the energy from its
/// value before.
pub fn superball(rule: Rule) -> Outcome {
    let mut world = world(rule)?;
    let friction = Friction::sliding(100.0).with_tangential_restitution(1.0);
    let floor = Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO)).with_friction(friction);
    world.add_collider(floor)?;
    let ball = Sphere::new(DVec3::new(0.0, 0.3, 0.0), RADIUS)
        .with_velocity(DVec3::new(2.0, -3.0, 1.0))
        .with_angular_velocity(DVec3::new(4.0, 7.0, -20.0));
    let id = world.add_sphere(ball)?;
    let slip =
        |ball: Sphere| ball.velocity.with_y(0.0) + ball.angular_velocity.cross(-RADIUS * DVec3::Y);
    let (before, energy) = (slip(ball), world.kinetic_energy());
    run_until(&mut world, 0.5, FRAME)?;
    let turned = (slip(world.sphere(id)?) + before).length() / before.length();
    let gain = (world.kinetic_energy() / energy - 1.0).abs();
    Ok(Measured::in_world(&world, turned.max(gain)))
}

/// Distance that a ball rolls from a speed of 1 m/s.
fn rolling_friction() -> Outcome {
    let mut world = on_plane(0.0, Friction::sliding(0.5).with_rolling(0.02))?;
    let id = ball_on_floor(&mut world, DVec3::X, -1.0 / RADIUS * DVec3::Z)?;
    run_until(&mut world, 10.0, FRAME)?;
    Ok(Measured::in_world(&world, world.sphere(id)?.position.x))
}

/// Tangential coefficient of restitution of a ball that hits a plate at this angle to its normal,
/// and its spin afterwards.
pub fn oblique(rule: Rule, degrees: f64) -> Result<(Measured, Measured), super::claim::Fault> {
    let mut world = world(rule)?;
    let plate = Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO)).with_restitution(0.98);
    world.add_collider(plate.with_friction(0.092))?;
    let (sine, cosine) = libm::sincos(degrees.to_radians());
    let ball = Sphere::new(DVec3::new(0.0, 0.01, 0.0), 0.0025)
        .with_density(4000.0)
        .with_velocity(3.9 * DVec3::new(sine, -cosine, 0.0));
    let id = world.add_sphere(ball)?;
    run_until(&mut world, 0.1, FRAME)?;
    let after = world.sphere(id)?;
    let tangential = after.velocity.x / ball.velocity.x;
    let spin = after.angular_velocity.length();
    Ok((Measured::in_world(&world, tangential), Measured::in_world(&world, spin)))
}

/// Smallest coefficient of friction with which a heap stands, by bisection; `stands` measures 1 or
/// 0.
fn threshold(low: f64, high: f64, stands: impl Fn(f64) -> Outcome) -> Outcome {
    let (mut falls_at, mut stands_at) = (low, high);
    let mut measured = Vec::new();
    for _ in 0..12 {
        let middle = 0.5 * (falls_at + stands_at);
        measured.push(stands(middle)?);
        if measured.last().is_some_and(|it| it.value > 0.0) {
            stands_at = middle;
        } else {
            falls_at = middle;
        }
    }
    let end = Measured::sum(measured);
    Ok(Measured { value: stands_at, ..end })
}

/// Measures 1 if a ball on two touching balls is still there after three seconds, else 0.
fn pyramid(balls: f64, floor: f64) -> Outcome {
    // The friction of a contact is the geometric mean of both, so the plane's is chosen to give
    // `floor`.
    let mut world = on_plane(0.0, floor * floor / balls)?;
    for x in [-RADIUS, RADIUS] {
        let place = DVec3::new(x, RADIUS, 0.0);
        world.add_sphere(Sphere::new(place, RADIUS).with_friction(balls))?;
    }
    let height = RADIUS + 3.0_f64.sqrt() * RADIUS;
    let top = world.add_sphere(Sphere::new(height * DVec3::Y, RADIUS).with_friction(balls))?;
    run_until(&mut world, 3.0, FRAME)?;
    let stands = height - world.sphere(top)?.position.y < 0.01 * RADIUS;
    Ok(Measured::in_world(&world, f64::from(u8::from(stands))))
}

/// Measures 1 if four touching balls still stand after three seconds, else 0.
fn tetrahedron(balls: f64, floor: f64) -> Outcome {
    // The friction of a contact is the geometric mean of both, so the plane's is chosen to give
    // `floor`.
    let mut world = on_plane(0.0, floor * floor / balls)?;
    let ring = 2.0 / 3.0_f64.sqrt() * RADIUS;
    for number in 0..3 {
        let (sine, cosine) = libm::sincos(f64::from(number) * std::f64::consts::TAU / 3.0);
        let place = DVec3::new(ring * cosine, RADIUS, ring * sine);
        world.add_sphere(Sphere::new(place, RADIUS).with_friction(balls))?;
    }
    let height = RADIUS + (8.0_f64 / 3.0).sqrt() * RADIUS;
    let top = Sphere::new(height * DVec3::Y, RADIUS).with_friction(balls);
    let top = world.add_sphere(top)?;
    run_until(&mut world, 3.0, FRAME)?;
    let stands = height - world.sphere(top)?.position.y < 0.01 * RADIUS;
    Ok(Measured::in_world(&world, f64::from(u8::from(stands))))
}
