//! Surfaces of revolution under the rule `exact`: pendulums in bowls and pipes, a ball that rolls in an upright pipe,
//! loops, a billiard in a sphere; and a turntable.

use std::f64::consts::FRAC_PI_2;

use carom::{
    Collider, Contact, DQuat, DVec3, Ends, Error, Exact, Gravity, Pose, Rule, Shape, Sphere, World,
};

use super::claim::{Claim, Expected, Fault, Measured, Outcome, Tolerance};
use super::setup::{G, world};

/// Radius of the hollows \[m\].
const HOLLOW: f64 = 1.0;
/// Radius of the balls \[m\].
const BALL: f64 = 0.1;
/// Where the centre of a ball runs \[m\].
const PATH: f64 = HOLLOW - BALL;
/// Amplitude of the swings \[rad\].
const AMPLITUDE: f64 = 1.0;
const STEPS: &str = "rounding of the steps of 15th order";

pub fn claims() -> Vec<Claim> {
    let mut claims = swings();
    claims.extend(loops());
    claims.extend(half_pipe());
    claims.push(upright_pipe());
    claims.push(billiard());
    let mut claims: Vec<Claim> =
        claims.into_iter().map(|claim| claim.about(Exact::default().into())).collect();
    // Under `exact` friction on a surface that turns is stepped.
    claims.push(turntable(Contact::default().into()));
    claims
}

/// A world with gravity and one hollow of this shape about the origin.
fn hollow(shape: Shape, rotation: DQuat, friction: f64) -> Result<World, Error> {
    let mut world = world(Exact::default().into())?;
    world.add_force(Gravity::new(DVec3::new(0.0, -G, 0.0)))?;
    let pose = Pose::at(DVec3::ZERO).rotated(rotation);
    world.add_collider(Collider::new(shape, pose).with_friction(friction))?;
    Ok(world)
}

fn lying_pipe(friction: f64) -> Result<World, Error> {
    let pipe = Shape::Pipe { radius: HOLLOW, length: 2.0, closed: Ends::NONE };
    hollow(pipe, DQuat::from_rotation_x(FRAC_PI_2), friction)
}

fn bowl(opening: f64, friction: f64) -> Result<World, Error> {
    hollow(Shape::Bowl { radius: HOLLOW, opening }, DQuat::IDENTITY, friction)
}

fn place(world: &World) -> DVec3 {
    world.spheres().positions()[0]
}

/// Claims about small swings at the bottom.
fn swings() -> Vec<Claim> {
    let claim = |name: &str, friction: f64, world: fn(f64) -> Result<World, Error>| {
        let factor = if friction > 0.0 { 1.4 } else { 1.0 };
        let expected = 4.0 * quarter_period(factor * PATH);
        Claim::new(
            name,
            Expected::value(expected, "Landau and Lifshitz, Mechanics (1976), 11 and 39"),
            Tolerance::relative(1e-12, STEPS),
            move |_| period(world(friction)?, expected),
        )
    };
    vec![
        claim(
            "exact: period of a ball that slides in a bowl, 2 pi sqrt((R - r)/g) [s]",
            0.0,
            |it| bowl(FRAC_PI_2, it),
        ),
        claim("exact: and of one that rolls, 2 pi sqrt(7 (R - r)/(5 g)) [s]", 1.0, |it| {
            bowl(FRAC_PI_2, it)
        }),
        claim("exact: period of a ball that slides in a lying pipe [s]", 0.0, lying_pipe),
        claim("exact: and of one that rolls there [s]", 1.0, lying_pipe),
    ]
}

/// Quarter of the period of a pendulum of this length \[m\] from the amplitude, by the arithmetic-geometric mean \[s\].
fn quarter_period(length: f64) -> f64 {
    let (mut a, mut b) = (1.0, libm::cos(0.5 * AMPLITUDE));
    for _ in 0..8 {
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
    }
    (length / G).sqrt() * FRAC_PI_2 / a
}

/// Mean period of some swings of a ball from the amplitude, by its state about when they are `expected` to end \[s\].
fn period(mut world: World, expected: f64) -> Outcome {
    let place = PATH * DVec3::new(libm::sin(AMPLITUDE), -libm::cos(AMPLITUDE), 0.0);
    world.add_sphere(Sphere::new(place, BALL).with_restitution(0.0))?;
    let swings = 4.75;
    world.step(swings * expected)?;
    let late = self::place(&world).x / world.spheres().velocities()[0].x;
    let measured = (swings * expected - late) / swings;
    Ok(Measured::in_world(&world, measured))
}

/// Claims about the least height from which a ball gets round.
fn loops() -> Vec<Claim> {
    let claim = |name: &str, friction: f64, expected: f64| {
        Claim::new(
            name,
            Expected::value(expected, "0.7 v² and the slip near the top"),
            Tolerance::absolute(5e-4, "three digits are given"),
            move |_| least_height(friction),
        )
    };
    vec![
        Claim::new(
            "exact: least height for a loop without friction, 5/2 (R - r) [R - r]",
            Expected::value(2.5, "energy"),
            Tolerance::relative(1e-12, STEPS),
            |_| height_without_force(),
        ),
        claim("exact: least height for a loop with friction .3 [R - r]", 0.3, 2.731),
        claim("exact: least height for a loop with friction .5 [R - r]", 0.5, 2.712),
        claim("exact: least height for a loop with friction 1: near 27/10 [R - r]", 1.0, 2.703),
    ]
}

/// Height above the lowest place of the centre, in parts of the radius of its path, from which the wall exerts no force
/// on a ball that slides over the top. The force grows linearly with the height, so two heights give it.
fn height_without_force() -> Outcome {
    let [low, high] = [2.6, 3.0];
    let [(_, less), (world, more)] = [force_at_the_top(low)?, force_at_the_top(high)?];
    Ok(Measured::in_world(&world, low - less * (high - low) / (more - less)))
}

/// Force of the wall on a ball at the top \[N\] that comes from this height, in parts of the radius of its path.
fn force_at_the_top(height: f64) -> Result<(World, f64), Fault> {
    let mut world = lying_pipe(0.0)?;
    let speed = (2.0 * G * height * PATH).sqrt();
    let ball = Sphere::new(DVec3::new(0.0, -PATH, 0.0), BALL).with_restitution(0.0);
    world.add_sphere(ball.with_velocity(DVec3::X * speed))?;
    while place(&world).y < (1.0 - 1e-14) * PATH {
        // Most of the way to the top, at this speed.
        let way = PATH * libm::atan2(place(&world).x, place(&world).y);
        world.step(0.9 * way / world.spheres().velocities()[0].length())?;
    }
    let force = world.contacts().first().map(|contact| contact.normal_force);
    Ok((world, force.ok_or("the ball left the wall")?))
}

/// Least height above the lowest place of the centre, in parts of the radius of its path, from which a ball that rolls
/// gets round.
fn least_height(friction: f64) -> Outcome {
    let (mut low, mut high) = (2.0, 3.2);
    let mut last = None;
    for _ in 0..20 {
        let height = 0.5 * (low + high);
        // The kinetic energy of a ball that rolls is 0.7 m v².
        let speed = (height * PATH * G / 0.7).sqrt();
        let (world, goes_round) = round(friction, speed)?;
        last = Some(world);
        if goes_round { high = height } else { low = height }
    }
    let world = last.ok_or("no loop was tried")?;
    Ok(Measured::in_world(&world, 0.5 * (low + high)))
}

/// Whether a ball with this speed at the lowest place stays on the wall as far as the top \[m/s\].
fn round(friction: f64, speed: f64) -> Result<(World, bool), Fault> {
    let mut world = lying_pipe(friction)?;
    let ball = Sphere::new(DVec3::new(0.0, -PATH, 0.0), BALL)
        .with_restitution(0.0)
        .with_velocity(DVec3::X * speed)
        .with_angular_velocity(DVec3::Z * (-speed / BALL));
    world.add_sphere(ball)?;
    while world.time() < 2.0 {
        let is_high = place(&world).y > 0.8 * PATH;
        world.step(if is_high { 1.0 / 2000.0 } else { 1.0 / 240.0 })?;
        let place = place(&world);
        // One that leaves the wall shortly before the top comes back to it shortly after.
        if place.y > 0.0 && world.contacts().is_empty() {
            return Ok((world, false));
        }
        if place.x < 0.0 {
            return Ok((world, place.y > 0.0));
        }
    }
    Ok((world, false))
}

/// Restitution of a ball that falls into a lying pipe.
const SOFT: f64 = 0.2;
/// Where its centre is at first, from the axis of the pipe across and up \[m\].
const DROPPED_AT: [f64; 2] = [0.4 / 0.52 * PATH, 0.1 / 0.52 * PATH];

/// Claims about a ball that falls into a lying pipe: its bounces take a part of its energy, and sliding takes none.
fn half_pipe() -> Vec<Claim> {
    let drop = || -> Result<World, Fault> {
        let mut world = lying_pipe(0.0)?;
        let [x, y] = DROPPED_AT;
        world.add_sphere(Sphere::new(DVec3::new(x, y, 0.0), BALL).with_restitution(SOFT))?;
        Ok(world)
    };
    let above_bottom = |world: &World| {
        let weight = G * world.spheres().masses()[0];
        world.total_energy() + weight * PATH
    };
    let run = |world: &mut World, until: f64| -> Result<(), Error> {
        while world.time() < until {
            world.step(1.0 / 60.0)?;
        }
        Ok(())
    };
    let bounces = Claim::new(
        "exact: energy that a ball falling into a lying pipe loses in its bounces [part of that above the bottom]",
        Expected::value(
            lost_in_bounces(),
            "bounces between parabolas and a circle, each with e = 0.2",
        ),
        Tolerance::relative(1e-6, "bounces below a contact's duration are not answered apart"),
        move |_| {
            let mut world = drop()?;
            let before = above_bottom(&world);
            run(&mut world, 6.0)?;
            let lost = before - above_bottom(&world);
            Ok(Measured::in_world(&world, lost / before))
        },
    );
    let sliding = Claim::new(
        "exact: and loses as it slides to and fro for 5 s afterwards [part]",
        Expected::no_error("without friction a fixed wall does no work"),
        Tolerance::absolute(1e-12, STEPS),
        move |_| {
            let mut world = drop()?;
            run(&mut world, 1.0)?;
            let before = above_bottom(&world);
            run(&mut world, 6.0)?;
            let lost = before - above_bottom(&world);
            Ok(Measured::in_world(&world, lost / before))
        },
    );
    vec![bounces, sliding]
}

/// Part of the energy above the bottom that the bounces of the ball take: in units of the radius of its path and of g,
/// from parabola to parabola, each up to where it comes back to the circle.
fn lost_in_bounces() -> f64 {
    let [x, y] = DROPPED_AT.map(|it| it / PATH);
    let [mut place, mut velocity] = [[x, y], [0.0; 2]];
    let dot = |a: [f64; 2], b: [f64; 2]| a[0] * b[0] + a[1] * b[1];
    let at = |place: [f64; 2], velocity: [f64; 2], t: f64| {
        [place[0] + velocity[0] * t, place[1] + velocity[1] * t - 0.5 * t * t]
    };
    let mut lost = 0.0;
    // Each bounce takes 1/25 of what the one before took.
    for _ in 0..10 {
        let is_inside = |t: f64| dot(at(place, velocity, t), at(place, velocity, t)) < 1.0;
        let outward = -dot(place, velocity);
        // Twice the time in which it comes back to the tangent, and up to the bottom at first.
        let (mut low, mut high) =
            if lost == 0.0 { (0.0, 2.0) } else { (0.5 * outward, 4.0 * outward) };
        for _ in 0..100 {
            let middle = 0.5 * (low + high);
            if is_inside(middle) { low = middle } else { high = middle }
        }
        velocity = [velocity[0], velocity[1] - high];
        place = at(place, [velocity[0], velocity[1] + high], high);
        let approach = dot(velocity, place);
        lost += 0.5 * (1.0 - SOFT * SOFT) * approach * approach;
        velocity = [0, 1].map(|axis| velocity[axis] - (1.0 + SOFT) * approach * place[axis]);
    }
    lost / (y + 1.0)
}

/// Gualtieri et al., Am. J. Phys. 74, 497 (2006): the golfer's dilemma.
fn upright_pipe() -> Claim {
    let rate = 6.0;
    let omega = (2.0_f64 / 7.0).sqrt() * rate;
    let drop = 5.0 / 7.0 * G / (omega * omega);
    Claim::new(
        "exact: a ball that rolls round an upright pipe swings with sqrt(2/7) of its rate [part of 2 x 0.68 m]",
        Expected::no_error("Gualtieri et al., Am. J. Phys. 74, 497 (2006)"),
        Tolerance::absolute(1e-12, STEPS),
        move |_| {
            let pipe = Shape::Pipe { radius: HOLLOW, length: 20.0, closed: Ends::NONE };
            let mut world = hollow(pipe, DQuat::IDENTITY, 1e3)?;
            let speed = rate * PATH;
            let ball = Sphere::new(DVec3::X * PATH, BALL)
                .with_restitution(0.0)
                .with_velocity(DVec3::Z * -speed)
                .with_angular_velocity(DVec3::Y * (-speed / BALL));
            world.add_sphere(ball)?;
            let mut worst = 0.0_f64;
            while world.time() < 5.0 {
                world.step(1.0 / 60.0)?;
                let expected = -drop * (1.0 - libm::cos(omega * world.time()));
                worst = worst.max((place(&world).y - expected).abs() / (2.0 * drop));
            }
            Ok(Measured::in_world(&world, worst))
        },
    )
}

/// Without gravity, angular momentum about the centre of a sphere is kept.
fn billiard() -> Claim {
    Claim::new(
        "exact: change of angular momentum in 10 s of billiard in a sphere [part of it]",
        Expected::no_error("normals lead to the centre"),
        Tolerance::absolute(1e-13, "rounding of some fifty impacts"),
        |_| {
            let mut world = world(Exact::default().into())?;
            let sphere = Shape::Bowl { radius: HOLLOW, opening: 0.0 };
            world.add_collider(Collider::new(sphere, Pose::at(DVec3::ZERO)))?;
            let start = DVec3::new(0.2, 0.3, -0.1);
            let ball = Sphere::new(start, BALL).with_velocity(DVec3::new(3.0, 1.0, 2.0));
            world.add_sphere(ball)?;
            let momentum = |world: &World| place(world).cross(world.spheres().velocities()[0]);
            let before = momentum(&world);
            while world.time() < 10.0 {
                world.step(1.0 / 60.0)?;
            }
            let change = (momentum(&world) - before).length() / before.length();
            Ok(Measured::in_world(&world, change))
        },
    )
}

/// A ball that rolls on a turntable goes in circles at 2/7 of its rate.
fn turntable(rule: Rule) -> Claim {
    let rate = 3.0;
    let duration = 2.0;
    Claim::new(
        "contact: a ball that rolls on a turntable circles at 2/7 of its rate [part]",
        Expected::value(2.0 / 7.0, "Weltner, Am. J. Phys. 47, 984 (1979)"),
        Tolerance::relative(1e-2, "friction on what moves is of first order in a sub-step"),
        move |_| {
            let mut world = world(rule)?;
            world.add_force(Gravity::new(DVec3::new(0.0, -G, 0.0)))?;
            let disc = Collider::new(Shape::Disc { radius: 3.0 }, Pose::at(DVec3::ZERO));
            let turning = DVec3::Y * rate;
            world.add_collider(disc.moving(DVec3::ZERO, turning).with_friction(1.0))?;
            let start = DVec3::new(0.5, BALL, 0.0);
            let velocity = DVec3::new(0.3, 0.0, 0.4);
            // Without slip: v - ω × r n is the velocity of the disc there.
            let beside = velocity - turning.cross(start);
            let ball = Sphere::new(start, BALL)
                .with_restitution(0.0)
                .with_velocity(velocity)
                .with_angular_velocity(DVec3::Y.cross(beside) / BALL);
            world.add_sphere(ball)?;
            while world.time() < duration - 1e-9 {
                world.step(1.0 / 60.0)?;
            }
            let now = world.spheres().velocities()[0];
            // Angle about +y from the first velocity to the last.
            let angle = libm::atan2(velocity.cross(now).y, velocity.dot(now));
            Ok(Measured::in_world(&world, angle / (rate * duration)))
        },
    )
    .about(rule)
}
