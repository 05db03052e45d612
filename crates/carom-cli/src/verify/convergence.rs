//! Order of convergence of the rule `contact` as sub-steps become shorter.

use carom::{Collider, Contact, DVec3, Error, Gravity, Pose, Rule, Shape, Sphere, World};

use super::claim::{Claim, Expected, Fault, Measured, Outcome, Tolerance};
use super::setup::{FRAME, G, half_space, run_until, world};

const RADIUS: f64 = 0.1;
/// Numbers of sub-steps per frame between which the order is measured.
const SUB_STEPS: [u32; 2] = [8, 16];
/// Number of sub-steps of the reference if there is no closed form.
const FINE: u32 = 1024;

pub fn claims() -> Vec<Claim> {
    let source = "the scheme is of first order";
    let reason = "the next order, and the error of what is compared with, 1 %";
    let order = |name: &str, measure: fn() -> Outcome| {
        let tolerance = Tolerance::absolute(0.05, reason);
        Claim::new(name, Expected::value(1.0, source), tolerance, move |_| measure())
    };
    let claims = vec![
        order("order in the sub-step: a ball slides across an incline, its slip turns", || {
            order_of(across_incline, &across_incline(fine())?)
        }),
        order("order in the sub-step: a ball rolls down a fixed sphere", || {
            order_by(off_sphere, |world| {
                let place = world.spheres().positions()[0];
                (libm::atan2(place.x, place.y) - angle_of_rolling()).abs()
            })
        }),
        order("order in the sub-step: four balls slide and roll apart, 2 sweeps", || {
            order_of(apart, &apart(fine())?)
        }),
        Claim::new(
            "four balls slide and roll apart: error with 2 sweeps by that with all that it takes",
            Expected::value(1.0, "each sub-step starts from the impulses of the one before"),
            Tolerance::absolute(0.1, "impulses change from sub-step to sub-step"),
            |_| error_of_sweeps(),
        ),
    ];
    claims.into_iter().map(|claim| claim.about(Rule::Contact(Contact::default()))).collect()
}

/// Settings of the reference.
fn fine() -> Contact {
    Contact::default().with_sub_steps(FINE).with_converged(true)
}

/// Order of convergence: the base-2 logarithm of the ratio of the errors for long and short
/// sub-steps.
fn order_by(
    motion: fn(Contact) -> Result<World, Error>,
    error: impl Fn(&World) -> f64,
) -> Result<Measured, Fault> {
    let [long, short] = SUB_STEPS.map(|count| motion(Contact::default().with_sub_steps(count)));
    let (long, short) = (long?, short?);
    Ok(Measured::in_world(&short, libm::log2(error(&long) / error(&short))))
}

/// Order of convergence of the distance of balls from `limit`.
fn order_of(motion: fn(Contact) -> Result<World, Error>, limit: &World) -> Outcome {
    order_by(motion, |world| distance(world, limit))
}

fn error_of_sweeps() -> Outcome {
    let limit = apart(fine())?;
    let few = apart(Contact::default())?;
    let all = apart(Contact::default().with_converged(true))?;
    Ok(Measured::in_world(&few, distance(&few, &limit) / distance(&all, &limit)))
}

/// Largest distance between the same ball in two worlds \[m\].
fn distance(first: &World, second: &World) -> f64 {
    let places = first.spheres().positions().iter().zip(second.spheres().positions());
    places.map(|(first, second)| first.distance(*second)).fold(0.0, f64::max)
}

fn empty(rule: Contact) -> Result<World, Error> {
    let mut world = world(rule.into())?;
    world.add_force(Gravity::new(DVec3::new(0.0, -G, 0.0)))?;
    Ok(world)
}

fn across_incline(rule: Contact) -> Result<World, Error> {
    let mut world = empty(rule)?;
    let (sine, cosine) = libm::sincos(0.5);
    let normal = DVec3::new(-sine, cosine, 0.0);
    let plane = half_space(DVec3::ZERO, normal).with_restitution(0.0).with_friction(0.1);
    world.add_collider(plane)?;
    world.add_sphere(Sphere::new(RADIUS * normal, RADIUS).with_velocity(3.0 * DVec3::Z))?;
    run_until(&mut world, 1.0, FRAME)?;
    Ok(world)
}

/// Angle from the vertical at which a ball begins to roll down a fixed sphere.
const START: f64 = 0.3;
/// Radius of that sphere \[m\].
const FIXED: f64 = 1.0;
/// Duration of the rolling \[s\]; the ball does not leave the sphere before.
const ROLLING_TIME: f64 = 0.5;

fn off_sphere(rule: Contact) -> Result<World, Error> {
    let mut world = empty(rule)?;
    let fixed = Collider::new(Shape::Sphere { radius: FIXED }, Pose::at(DVec3::ZERO));
    world.add_collider(fixed.with_restitution(0.0).with_friction(1.0))?;
    let (sine, cosine) = libm::sincos(START);
    let place = (FIXED + RADIUS) * DVec3::new(sine, cosine, 0.0);
    world.add_sphere(Sphere::new(place, RADIUS).with_restitution(0.0))?;
    run_until(&mut world, ROLLING_TIME, FRAME)?;
    Ok(world)
}

/// Angle at the end of the rolling: `angle'' = 5/7 g/(R + r) sin(angle)`, integrated by Runge-Kutta
/// in steps so short that only rounding errors remain.
fn angle_of_rolling() -> f64 {
    let steps = 2_000;
    let h = ROLLING_TIME / f64::from(steps);
    let pull = |angle: f64| 5.0 / 7.0 * G / (FIXED + RADIUS) * libm::sin(angle);
    let (mut angle, mut speed) = (START, 0.0);
    for _ in 0..steps {
        let (v1, a1) = (speed, pull(angle));
        let (v2, a2) = (speed + 0.5 * h * a1, pull(angle + 0.5 * h * v1));
        let (v3, a3) = (speed + 0.5 * h * a2, pull(angle + 0.5 * h * v2));
        let (v4, a4) = (speed + h * a3, pull(angle + h * v3));
        angle += h / 6.0 * (v1 + 2.0 * v2 + 2.0 * v3 + v4);
        speed += h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
    }
    angle
}

/// Three touching balls on a floor without friction, with one on top.
fn apart(rule: Contact) -> Result<World, Error> {
    let mut world = empty(rule)?;
    world.add_collider(half_space(DVec3::ZERO, DVec3::Y).with_restitution(0.0))?;
    let ball = |place| Sphere::new(place, RADIUS).with_friction(0.1).with_restitution(0.0);
    let ring = 2.0 / 3.0_f64.sqrt() * RADIUS;
    for number in 0..3 {
        let (sine, cosine) = libm::sincos(f64::from(number) * std::f64::consts::TAU / 3.0);
        world.add_sphere(ball(DVec3::new(ring * cosine, RADIUS, ring * sine)))?;
    }
    world.add_sphere(ball((1.0 + (8.0_f64 / 3.0).sqrt()) * RADIUS * DVec3::Y))?;
    run_until(&mut world, 0.25, FRAME)?;
    Ok(world)
}
