//! No tunnelling: at any speed, every impact occurs, and no other.
//!
//! Small balls are shot at a target that they reach within one frame: half of them hit a known
//! point, half of them pass closely. All targets are convex, so a reflected ball does not return.

use carom::{BodyPair, Collider, DVec3, Error, Pose, Rule, Shape, Sphere, World};

use super::claim::{Claim, Expected, Measured, Outcome, Tolerance};
use super::setup::{FRAME, half_space, world};
use crate::numbers::Numbers;

/// Radius of the balls \[m\].
const RADIUS: f64 = 1e-3;
/// Speeds \[m/s\]; at the highest, a ball flies 1,700 km in a frame, 1e9 times its radius.
const SPEEDS: [f64; 4] = [1e2, 1e4, 1e6, 1e8];
/// Number of shots at each speed.
const SHOTS: usize = 50;
/// Distance at which balls pass, relative to the distance at which they hit.
const PASSING: f64 = 1.05;

pub fn claims() -> Vec<Claim> {
    let targets = [
        ("another ball, both moving", Target::Ball),
        ("a fixed sphere", Target::FixedSphere),
        ("the face of a rectangle", Target::Face),
        ("the edge of a rectangle", Target::Edge),
        ("the corner of a rectangle", Target::Corner),
        ("the edge of a box", Target::BoxEdge),
        ("the corner of a box", Target::BoxCorner),
    ];
    let mut claims: Vec<Claim> = targets
        .into_iter()
        .map(|(name, target)| {
            Claim::new(
                format!("no tunnelling: {name}, up to 1e8 m/s [shots gone right]"),
                Expected::value((SPEEDS.len() * SHOTS) as f64, "geometry"),
                Tolerance::none("a count"),
                move |rule| shoot_all(rule, target),
            )
        })
        .collect();
    claims.extend([
        between(Sides::HalfSpaces, "half-spaces"),
        between(Sides::Rectangles, "rectangles"),
        between(Sides::FixedSpheres, "fixed spheres"),
    ]);
    claims
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Target {
    Ball,
    FixedSphere,
    Face,
    Edge,
    Corner,
    BoxEdge,
    BoxCorner,
}

/// A ball on its way to the target.
struct Shot {
    /// A point of the target's surface nearest to the ball's path \[m\].
    point: DVec3,
    /// Direction from that point to the ball at its closest approach.
    normal: DVec3,
    /// Direction of flight.
    direction: DVec3,
    is_hit: bool,
}

impl Target {
    /// Shape of the target at the origin; `None` for a moving ball.
    fn shape(self) -> Option<Shape> {
        match self {
            Self::Ball => None,
            Self::FixedSphere => Some(Shape::Sphere { radius: 0.5 }),
            Self::Face | Self::Edge | Self::Corner => {
                Some(Shape::Rectangle { size_x: 2.0, size_z: 3.0 })
            }
            Self::BoxEdge | Self::BoxCorner => Some(Shape::Box { size: DVec3::new(2.0, 2.0, 3.0) }),
        }
    }

    /// Random point of the surface, with a normal there.
    fn point_and_normal(self, numbers: &mut Numbers) -> (DVec3, DVec3) {
        let top = if matches!(self, Self::BoxEdge | Self::BoxCorner) { 1.0 } else { 0.0 };
        let (x, z) = (numbers.between(-0.9, 0.9), numbers.between(-1.4, 1.4));
        // Clearly between the normals of the faces that meet at an edge or a corner.
        let [a, b, c] = [0; 3].map(|_| numbers.between(0.2, 1.0));
        match self {
            Self::Ball => (DVec3::ZERO, numbers.direction()),
            Self::FixedSphere => {
                let normal = numbers.direction();
                (0.5 * normal, normal)
            }
            Self::Face => (DVec3::new(x, top, z), DVec3::Y),
            Self::Edge | Self::BoxEdge => {
                (DVec3::new(1.0, top, z), DVec3::new(a, b, 0.0).normalize())
            }
            Self::Corner | Self::BoxCorner => {
                (DVec3::new(1.0, top, 1.5), DVec3::new(a, b, c).normalize())
            }
        }
    }

    /// Random shot that hits or passes. At rectangles, which have only a front, it comes from the
    /// front.
    fn shot(self, is_hit: bool, numbers: &mut Numbers) -> Shot {
        let (point, normal) = self.point_and_normal(numbers);
        let direction = loop {
            if !is_hit {
                break numbers.direction_across(normal);
            }
            let direction = numbers.direction();
            let has_no_back = matches!(self, Self::Ball | Self::FixedSphere);
            if direction.dot(normal) < -0.2 && (has_no_back || direction.y < -0.05) {
                break direction;
            }
        };
        Shot { point, normal, direction, is_hit }
    }
}

fn shoot_all(rule: Rule, target: Target) -> Outcome {
    let mut numbers = Numbers::new(1);
    let mut measured = Vec::new();
    for speed in SPEEDS {
        for i in 0..SHOTS {
            let shot = target.shot(i % 2 == 0, &mut numbers);
            // Time of the closest approach.
            let time = FRAME * numbers.between(0.05, 0.9);
            measured.push(match target.shape() {
                Some(shape) => shoot_at(rule, shape, &shot, speed, time)?,
                None => shoot_ball_at_ball(rule, &shot, speed, time)?,
            });
        }
    }
    Ok(Measured::sum(measured))
}

/// Shoots at a fixed shape; measures 1 if the outcome is right, else 0.
fn shoot_at(
    rule: Rule,
    shape: Shape,
    shot: &Shot,
    speed: f64,
    time: f64,
) -> Result<Measured, Error> {
    let mut world = world(rule)?;
    world.add_collider(Collider::new(shape, Pose::at(DVec3::ZERO)))?;
    let distance = if shot.is_hit { RADIUS } else { PASSING * RADIUS };
    let velocity = speed * shot.direction;
    let start = shot.point + distance * shot.normal - time * velocity;
    world.add_sphere(Sphere::new(start, RADIUS).with_velocity(velocity))?;
    let impacts = world.step(FRAME)?.impacts.len();
    let change = -2.0 * velocity.dot(shot.normal) * shot.normal;
    let is_right = is_right(&world, shot, impacts, velocity, change);
    Ok(Measured::in_world(&world, f64::from(u8::from(is_right))))
}

/// Shoots two balls of equal mass at each other, each with half the speed, with a common velocity
/// added.
fn shoot_ball_at_ball(rule: Rule, shot: &Shot, speed: f64, time: f64) -> Result<Measured, Error> {
    let mut world = world(rule)?;
    let distance = if shot.is_hit { 2.0 * RADIUS } else { 2.0 * PASSING * RADIUS };
    let across = shot.direction.any_orthonormal_vector();
    let velocities = [0.5, -0.5].map(|part| speed * (part * shot.direction + 0.3 * across));
    let places = [distance * shot.normal, DVec3::ZERO];
    for (place, velocity) in places.into_iter().zip(velocities) {
        let sphere = Sphere::new(place - time * velocity, RADIUS);
        world.add_sphere(sphere.with_velocity(velocity))?;
    }
    let impacts = world.step(FRAME)?.impacts.len();
    let change = -speed * shot.direction.dot(shot.normal) * shot.normal;
    let is_right = is_right(&world, shot, impacts, velocities[0], change);
    Ok(Measured::in_world(&world, f64::from(u8::from(is_right))))
}

/// Whether the first ball was hit once and its velocity changed by `change`, or passed if it
/// should.
fn is_right(world: &World, shot: &Shot, impacts: usize, before: DVec3, change: DVec3) -> bool {
    let after = world.spheres().velocities()[0];
    if !shot.is_hit {
        return impacts == 0 && after == before;
    }
    // At 1,700 km, positions have a resolution of 0.2 nm, so the normal is known to 1e-6 of the
    // radius.
    impacts == 1 && (after - before - change).length() < 1e-4 * before.length()
}

/// Sides between which a ball flies to and fro.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Sides {
    HalfSpaces,
    Rectangles,
    FixedSpheres,
}

/// Claim about a ball that flies to and fro between two sides.
fn between(sides: Sides, name: &str) -> Claim {
    // Impacts are 10 m apart. The ball starts in the middle and ends a sixth of a flight beyond it,
    // far from an impact.
    let (flights, speed) = (150_000.0_f64, 1e8_f64);
    let duration = (flights + 1.0 / 6.0) * 10.0 / speed;
    Claim::new(
        format!("no impact is lost to and fro between two {name}, 1e8 m/s [impacts]"),
        Expected::value(flights, "one for each 10 m"),
        Tolerance::none("a count"),
        move |rule| {
            let mut world = world(rule)?;
            for side in [-1.0, 1.0] {
                world.add_collider(side_of(sides, side))?;
            }
            let sphere = Sphere::new(DVec3::ZERO, RADIUS);
            world.add_sphere(sphere.with_velocity(DVec3::new(speed, 0.0, 0.0)))?;
            let impacts = &world.step(duration)?.impacts;
            let count = impacts.iter().filter(|it| is_with_collider(it.between)).count();
            Ok(Measured::in_world(&world, count as f64))
        },
    )
}

fn is_with_collider(between: BodyPair) -> bool {
    matches!(between, BodyPair::Collider { .. })
}

/// Creates a fixed body whose surface is 5 m plus a radius from the origin along x.
fn side_of(sides: Sides, side: f64) -> Collider {
    let place = side * (5.0 + RADIUS) * DVec3::X;
    let half_space = half_space(place, -side * DVec3::X);
    match sides {
        Sides::HalfSpaces => half_space,
        Sides::Rectangles => half_space.with_shape(Shape::Rectangle { size_x: 1.0, size_z: 1.0 }),
        Sides::FixedSpheres => {
            let pose = Pose::at(place + side * DVec3::X);
            Collider::new(Shape::Sphere { radius: 1.0 }, pose)
        }
    }
}
