//! Balls that settle on a ring of contact under the rule `exact`, against closed forms: on the axis of a funnel, a torus
//! or the mouth of a pipe a ball touches along a circle. They caught balls that slid to the axis and on through the wall.

mod common;

use carom::{Collider, DVec3, Ends, EnergyAccount, Gravity, Pose, Shape, Sphere, World};
use common::{G, account_of_run, assert_close, exact, vec};

const FRAME: f64 = 1.0 / 64.0;
const BALL: f64 = 0.2;
/// Radii and height of the funnel \[m\].
const TOP: f64 = 1.5;
const BOTTOM: f64 = 0.02;
const HEIGHT: f64 = 1.0;
/// Radii of the torus \[m\].
const RING: f64 = 0.2;
const TUBE: f64 = 0.08;
/// Radius of the pipe \[m\].
const PIPE: f64 = 0.12;
/// Height of a funnel with walls that are less steep \[m\].
const FLAT: f64 = 0.7;

/// A surface about the y axis with its centre at the origin, and the ball on its ring.
struct Ring {
    /// The surface, this many times as large.
    shape: fn(f64) -> Shape,
    /// Height of a ball at rest \[m\].
    height: f64,
    /// Parts of the unit normal of contact to the axis and along it.
    normal: [f64; 2],
}

/// The normal of a funnel of this height \[m\], and the height of a ball at rest on its ring \[m\].
fn funnel(height: f64) -> ([f64; 2], f64) {
    let slant = ((TOP - BOTTOM) * (TOP - BOTTOM) + height * height).sqrt();
    let normal = [height / slant, (TOP - BOTTOM) / slant];
    // The apex of the cone, and the ball above it.
    let apex = -0.5 * height - BOTTOM * height / (TOP - BOTTOM);
    (normal, apex + BALL / normal[1])
}

fn rings() -> [Ring; 4] {
    let [(steep, steep_height), (flat, flat_height)] = [HEIGHT, FLAT].map(funnel);
    let torus = ((BALL + TUBE) * (BALL + TUBE) - RING * RING).sqrt();
    let pipe = (BALL * BALL - PIPE * PIPE).sqrt();
    [
        Ring {
            shape: |s| Shape::Funnel {
                top_radius: TOP * s,
                bottom_radius: BOTTOM * s,
                height: HEIGHT * s,
            },
            height: steep_height,
            normal: steep,
        },
        Ring {
            shape: |s| Shape::Funnel {
                top_radius: TOP * s,
                bottom_radius: BOTTOM * s,
                height: FLAT * s,
            },
            height: flat_height,
            normal: flat,
        },
        Ring {
            shape: |s| Shape::Torus { ring_radius: RING * s, tube_radius: TUBE * s },
            height: torus,
            normal: [RING / (BALL + TUBE), torus / (BALL + TUBE)],
        },
        Ring {
            shape: |s| Shape::Pipe { radius: PIPE * s, length: 0.5 * s, closed: Ends::NONE },
            height: 0.25 + pipe,
            normal: [PIPE / BALL, pipe / BALL],
        },
    ]
}

/// A world with gravity and the surface of a ring; lengths and gravity are `scale` times as large.
fn world(ring: &Ring, scale: f64, (restitution, friction): (f64, f64)) -> World {
    let mut world = exact();
    world.add_force(Gravity::new(vec(0.0, -G * scale, 0.0))).unwrap();
    let surface = Collider::new((ring.shape)(scale), Pose::at(DVec3::ZERO));
    let surface = surface.with_restitution(restitution).with_friction(friction);
    world.add_collider(surface).unwrap();
    world
}

/// A ball of 1 kg that bounces and slides as the surface says.
fn ball(place: DVec3, scale: f64, friction: f64) -> Sphere {
    Sphere::new(place * scale, BALL * scale).with_mass(1.0).with_friction(friction)
}

/// Where a ball begins beside the axis, above the surface.
fn beside(ring: &Ring) -> DVec3 {
    vec(0.1, ring.height + 0.5, 0.02)
}

fn place(world: &World) -> DVec3 {
    world.spheres().positions()[0]
}

#[test]
fn a_ball_rests_on_a_ring_at_the_height_of_its_geometry() {
    for (number, ring) in rings().iter().enumerate() {
        for (restitution, friction) in [(0.0, 0.0), (0.3, 0.0), (0.0, 0.2)] {
            let mut world = world(ring, 1.0, (restitution, friction));
            world.add_sphere(ball(beside(ring), 1.0, friction)).unwrap();
            let (_, left) = account_of_run(&mut world, 256, FRAME);
            let case = format!("ring {number}, {restitution}, {friction}");
            assert!(left.abs() < 1e-12 * G * BALL, "{case}: {left:e} J");
            // A bounce that is lower than 1e-7 of the radius counts as none.
            let there = place(&world);
            let off = (there - vec(0.0, ring.height, 0.0)).length();
            assert!(off < 1e-7 * BALL, "{case}: {there} is {off:e} m off");
            account_of_run(&mut world, 640, FRAME);
            let drift = (place(&world) - there).length();
            assert!(drift < 1e-12 * BALL, "{case}: {drift:e} m");
            assert!(world.spheres().velocities()[0].length() < 1e-12, "{case}");
        }
    }
}

#[test]
fn a_ball_that_slides_through_the_axis_keeps_the_part_of_its_speed_along_the_other_wall() {
    for ring in &rings()[..2] {
        let mut world = world(ring, 1.0, (0.0, 0.0));
        world.add_sphere(ball(beside(ring), 1.0, 0.0)).unwrap();
        let mut speeds = Vec::new();
        for _ in 0..256 {
            speeds.extend(world.step(FRAME).unwrap().impacts.iter().map(|it| it.approach_speed));
        }
        let [outward, along] = ring.normal;
        let kept = along * along - outward * outward;
        // The first one is that of the fall.
        for pair in speeds[1..].windows(2).take(5) {
            assert_close(pair[1] / pair[0], kept, 1e-9);
        }
        assert!(speeds.len() > 6, "{speeds:?}");
    }
}

#[test]
fn a_ball_that_falls_on_a_ring_hops_with_its_restitution() {
    for ring in rings() {
        for restitution in [0.3, 0.8, 1.0] {
            let mut world = world(&ring, 1.0, (restitution, 0.0));
            world.add_sphere(ball(vec(0.0, ring.height + 0.5, 0.0), 1.0, 0.0)).unwrap();
            let mut speeds = Vec::new();
            while speeds.len() < 4 {
                let report = world.step(FRAME).unwrap();
                speeds.extend(report.impacts.iter().map(|it| it.approach_speed));
            }
            for pair in speeds.windows(2) {
                // Each bounce is found within rounding of its height, which is a few centimetres at last.
                assert_close(pair[1] / pair[0], restitution, 1e-8);
            }
        }
    }
}

#[test]
fn a_ball_on_a_ring_moves_alike_at_any_scale() {
    for ring in rings() {
        for (restitution, friction) in [(0.0, 0.0), (0.3, 0.2)] {
            let run = |scale: f64| {
                let mut world = world(&ring, scale, (restitution, friction));
                world.add_sphere(ball(beside(&ring), scale, friction)).unwrap();
                for _ in 0..128 {
                    world.step(FRAME).unwrap();
                }
                place(&world) / scale
            };
            let expected = run(1.0);
            for scale in [libm::exp2(-20.0), libm::exp2(20.0)] {
                assert_eq!(run(scale), expected);
            }
        }
    }
}

#[test]
fn a_ring_holds_a_ball_against_what_its_walls_bear() {
    for ring in rings() {
        let [outward, along] = ring.normal;
        for (part, is_held) in [(0.9, true), (1.1, false)] {
            // The force on the ball is inside the cone of the normals where it is held.
            let pull = part * G * outward / along;
            let mut world = exact();
            let (sin, cos) = libm::sincos(0.7);
            world.add_force(Gravity::new(vec(pull * cos, -G, pull * sin))).unwrap();
            let surface = Collider::new((ring.shape)(1.0), Pose::at(DVec3::ZERO));
            world.add_collider(surface.with_restitution(0.0)).unwrap();
            world.add_sphere(ball(vec(0.0, ring.height, 0.0), 1.0, 0.0)).unwrap();
            let (_, left) = account_of_run(&mut world, 16, FRAME);
            // Of the energy of a fall by the radius of a ball of 1 kg.
            assert!(left.abs() < 1e-10 * G * BALL, "{left:e} J");
            let way = (place(&world) - vec(0.0, ring.height, 0.0)).length();
            assert!((way < 1e-12) == is_held, "{part}: {way:e} m");
        }
    }
}

#[test]
fn balls_that_meet_on_a_ring_lose_what_their_impacts_take() {
    for ring in rings() {
        for restitution in [0.0, 0.3, 0.8, 1.0] {
            let mut world = world(&ring, 1.0, (restitution, 0.0));
            world.add_sphere(ball(vec(0.0, ring.height, 0.0), 1.0, 0.0)).unwrap();
            let other = vec(0.05, ring.height + 0.7, -0.03);
            world.add_sphere(Sphere::new(other, 0.1).with_mass(0.3)).unwrap();
            let start = world.total_energy();
            let mut sum = EnergyAccount::default();
            for _ in 0..32 {
                sum += world.step(FRAME).unwrap().energy_account;
            }
            let left = world.total_energy() - start - sum.total();
            assert!(left.abs() < 1e-9 * G * BALL, "{restitution}: {left:e} J");
            assert!(place(&world).y > ring.height - 1e-9 * BALL, "{restitution}");
        }
    }
}
