//! Derivatives of runs under the rule `exact`.

use carom::{
    Boundary, DVec3, Friction, Gravity, Rule, Settings, Sphere, SphereId, SphereTangent, Tangents,
    Tape, Variation, World,
};

use super::claim::{Claim, Expected, Fault, Measured, Outcome, Tolerance};
use super::lyapunov;
use super::runs::exact;
use super::setup::{G, half_space, world, world_with_floor};
use super::two_balls;

pub fn claims() -> Vec<Claim> {
    let launched = |axis: usize, expected: f64| {
        Claim::new(
            format!(
                "launch over floor and wall, found by Newton's method, {} [m/s]",
                ["x", "y"][axis]
            ),
            Expected::value(expected, "Zhong et al. 2022, arXiv 2207.05060, task 2"),
            Tolerance::absolute(1e-4, "published digits"),
            move |rule| launch(rule, axis),
        )
    };
    let claims = [
        Claim::new(
            "elastic balls head-on: last place and velocity by those of each ball at the start",
            Expected::no_error("closed form: 1 and 0 (nimblephysics, issue 97)"),
            Tolerance::absolute(1e-12, "rounding"),
            head_on,
        ),
        launched(0, 10.1957),
        launched(1, -4.0907),
        Claim::new(
            "push of a ball that takes another one to a goal: least loss, found by descent",
            Expected::value(1.396_542, "Zhong et al. 2022, arXiv 2207.05060, task 3"),
            Tolerance::absolute(1e-6, "published digits"),
            two_balls::least_loss,
        ),
        Claim::new(
            "shot that slides, rolls and stops: way by speed, spin and friction [part]",
            Expected::no_error("closed form (Coriolis 1835)"),
            Tolerance::absolute(1e-12, "rounding"),
            shot,
        ),
        Claim::new(
            "elastic balls in a periodic box: sum of the Lyapunov spectrum [largest exponent]",
            Expected::no_error("conservation of volume (Liouville 1838)"),
            Tolerance::absolute(1e-10, "rounding of each flight and impact"),
            spectrum,
        ),
    ];
    let of_gases = lyapunov::claims();
    claims.into_iter().chain(of_gases).map(|claim| claim.about(exact())).collect()
}

/// Derivatives of a number that is the place, or the velocity, along an axis.
fn place_along(axis: DVec3) -> SphereTangent {
    SphereTangent { position: axis, ..SphereTangent::default() }
}

fn velocity_along(axis: DVec3) -> SphereTangent {
    SphereTangent { velocity: axis, ..SphereTangent::default() }
}

fn head_on(rule: Rule) -> Outcome {
    let mut world = world(rule)?;
    let ball = |x: f64, v: f64| {
        Sphere::new(DVec3::new(x, 0.0, 0.0), 0.5).with_velocity(DVec3::new(v, 0.0, 0.0))
    };
    let balls = [ball(-2.0, 1.0), ball(0.0, 0.0)];
    let [first, second] = [world.add_sphere(balls[0])?, world.add_sphere(balls[1])?];
    let mut tape = Tape::start(&world)?;
    tape.step(&mut world, 3.0)?;
    let place = tape.gradient(&[(second, place_along(DVec3::X))])?;
    let velocity = tape.gradient(&[(second, velocity_along(DVec3::X))])?;
    let off = [
        place.sphere(first).position.x - 1.0,
        place.sphere(second).position.x,
        velocity.sphere(first).velocity.x - 1.0,
        velocity.sphere(second).velocity.x,
    ];
    Ok(Measured::in_world(&world, off.into_iter().fold(0.0, |most, it| most.max(it.abs()))))
}

/// Ball of 0.1 m that is launched over a floor and a wall at 1.75 m, to be at (-2, 1.5) after 0.6 s.
///
/// In the paper time is cut into 288 steps; here it is not.
fn launched(rule: Rule, velocity: DVec3) -> Result<(World, SphereId), Fault> {
    let mut world = world(rule)?;
    world.add_force(Gravity::new(DVec3::new(0.0, -9.8, 0.0)))?;
    for (point, normal) in [(DVec3::ZERO, DVec3::Y), (DVec3::new(1.75, 0.0, 0.0), DVec3::NEG_X)] {
        world.add_collider(half_space(point, normal).with_restitution(0.92))?;
    }
    let ball = Sphere::new(DVec3::new(-0.5, 1.0, 0.0), 0.1).with_velocity(velocity);
    let ball = world.add_sphere(ball)?;
    Ok((world, ball))
}

fn launch(rule: Rule, axis: usize) -> Outcome {
    let mut velocity = DVec3::new(5.0, -5.0, 0.0);
    for _ in 0..20 {
        let (mut world, ball) = launched(rule, velocity)?;
        let mut tape = Tape::start(&world)?;
        tape.step(&mut world, 0.6)?;
        let off = world.spheres().positions()[0] - DVec3::new(-2.0, 1.5, 0.0);
        if off.length() < 1e-12 {
            return Ok(Measured::in_world(&world, velocity[axis]));
        }
        let along = |axis: DVec3| -> Result<DVec3, Fault> {
            Ok(tape.gradient(&[(ball, place_along(axis))])?.sphere(ball).velocity)
        };
        let (x, y) = (along(DVec3::X)?, along(DVec3::Y)?);
        let determinant = x.x * y.y - x.y * y.x;
        velocity.x -= (y.y * off.x - x.y * off.y) / determinant;
        velocity.y -= (x.x * off.y - y.x * off.x) / determinant;
    }
    Err("Newton's method found no launch".into())
}

fn shot(rule: Rule) -> Outcome {
    let (speed, spin, sliding, rolling, radius) = (0.9, -4.0, 0.2, 0.05, 0.03);
    let mut world = world_with_floor(rule, 0.5)?;
    let floor = world.colliders().next().ok_or("no floor")?.0;
    let collider = world.collider(floor)?;
    let friction = Friction::sliding(sliding).with_rolling(rolling);
    world.set_collider(floor, collider.with_friction(friction))?;
    let ball = Sphere::new(DVec3::new(0.0, radius, 0.0), radius)
        .with_velocity(DVec3::new(speed, 0.0, 0.0))
        .with_angular_velocity(DVec3::new(0.0, 0.0, -spin));
    let ball = world.add_sphere(ball)?;
    let mut tape = Tape::start(&world)?;
    for _ in 0..6 {
        tape.step(&mut world, 1.0)?;
    }
    let gradient = tape.gradient(&[(ball, place_along(DVec3::X))])?;
    // With the slip s and the velocity w as it rolls, the way is s (v + w)/(7 mu g) + 7 w²/(10 mu_r g).
    let slip = speed - radius * spin;
    let rolls = speed - 2.0 / 7.0 * slip;
    let slides = |v: f64, s: f64| 2.0 * s / (7.0 * sliding * G) * (v - s / 7.0);
    let by_rolls = 1.4 * rolls / (rolling * G);
    let by_slip = 2.0 * (speed - 2.0 * slip / 7.0) / (7.0 * sliding * G) - 2.0 / 7.0 * by_rolls;
    let by_speed = 2.0 * slip / (7.0 * sliding * G) + by_rolls + by_slip;
    let of_ball = gradient.sphere(ball);
    let off = [
        of_ball.velocity.x / by_speed - 1.0,
        -of_ball.angular_velocity.z / (-radius * by_slip) - 1.0,
        gradient.collider(floor).friction / (-slides(speed, slip) / sliding) - 1.0,
    ];
    Ok(Measured::in_world(&world, off.into_iter().fold(0.0, |most, it| most.max(it.abs()))))
}

fn spectrum(rule: Rule) -> Outcome {
    let boundary = Boundary::Periodic { size: DVec3::splat(4.0) };
    let mut world = World::new(Settings::default().with_rule(rule).with_boundary(boundary))?;
    let balls = [
        ([-1.0, 0.2, 0.0], [0.3, -0.8, 0.5]),
        ([1.0, 0.0, 0.3], [-0.6, 0.4, 0.7]),
        ([0.0, -1.2, -1.0], [0.5, 0.6, -0.4]),
    ];
    let mut directions = Vec::new();
    for (place, velocity) in balls {
        let ball = Sphere::new(place.into(), 0.6).with_velocity(velocity.into());
        let ball = world.add_sphere(ball)?;
        for axis in DVec3::AXES {
            directions.push(Variation::default().with_position(ball, axis));
            directions.push(Variation::default().with_velocity(ball, axis));
        }
    }
    let mut tangents = Tangents::new(&world, directions)?;
    let mut sums = vec![0.0; tangents.len()];
    for _ in 0..400 {
        tangents.step(&mut world, 0.25)?;
        for (sum, size) in sums.iter_mut().zip(tangents.orthonormalize(1.0, 1.0)) {
            *sum += libm::log(size);
        }
    }
    let largest = sums.iter().copied().fold(0.0, f64::max);
    if largest < 20.0 {
        return Err("hardly anything grows".into());
    }
    Ok(Measured::in_world(&world, sums.iter().sum::<f64>().abs() / largest))
}
