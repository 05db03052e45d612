//! Flights of the rule `exact` under forces without a closed form: against closed forms, conserved quantities and
//! themselves in other frames. Proves nothing of forces between spheres.

// What is expected need not have the same bits everywhere.
#![allow(clippy::disallowed_methods)]

mod common;

use std::f64::consts::PI;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use carom::{
    Boundary, Buoyancy, Collider, DQuat, DVec3, Error, Exact, Force, Gravity, PointAttractor, Pose,
    QuadraticDrag, Settings, Shape, Sphere, SphereState, Vortex, World,
};
use common::{G, Numbers, assert_close, exact, run, vec, world};

const DOWN: DVec3 = DVec3::new(0.0, -G, 0.0);
const FRAME: f64 = 1.0 / 64.0;

fn fixed_ball(center: DVec3, radius: f64) -> Collider {
    Collider::new(Shape::Sphere { radius }, Pose::at(center))
}

fn floor() -> Collider {
    Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO))
}

/// Two balls about an attractor that bounce off a ball in it and off each other without loss, at a scale of
/// lengths.
fn orbit(rule: Exact, scale: f64) -> World {
    let mut world = world(rule);
    let strength = 10.0 * scale * scale * scale;
    world.add_force(PointAttractor::new(DVec3::ZERO, strength)).unwrap();
    let ball = |x: f64, speed: f64| {
        Sphere::new(scale * vec(x, 0.0, 0.0), 0.1 * scale)
            .with_velocity(scale * vec(0.0, 0.0, speed))
            .with_restitution(1.0)
    };
    world.add_sphere(ball(2.0, 2.236)).unwrap();
    world.add_sphere(ball(-3.0, 1.2)).unwrap();
    world.add_collider(fixed_ball(DVec3::ZERO, 0.3 * scale).with_restitution(1.0)).unwrap();
    world
}

#[test]
fn kepler_ellipse_of_eccentricity_0_9_keeps_energy_and_period() {
    let mut world = exact();
    world.add_force(PointAttractor::new(DVec3::ZERO, 1.0)).unwrap();
    // At its apoapsis, with semi-major axis 1: v² = (1 - e)/(1 + e).
    let speed = (0.1f64 / 1.9).sqrt();
    let start = vec(1.9, 0.0, 0.0);
    let ball = Sphere::new(start, 1e-3).with_velocity(vec(0.0, speed, 0.0));
    let id = world.add_sphere(ball).unwrap();
    let energy = world.total_energy();
    let periods = 200;
    for _ in 0..periods * 4 {
        world.step(PI / 2.0).unwrap();
    }
    // Rounding of 20,000 steps, at random, each of which adds what the one before left.
    assert_close(world.total_energy(), energy, 5e-14 * energy.abs());
    // Where it hardly moves, an error of the phase of 2 pi 1e-10 is one of the way of v times that.
    let place = world.sphere(id).unwrap().position;
    assert!((place - start).length() < 1e-10, "{place}");
}

#[test]
fn elastic_hits_in_an_attractor_keep_energy_at_any_scale() {
    for scale in [1e-6, 1.0, 1e6] {
        let mut world = orbit(Exact::default(), scale);
        let energy = world.total_energy();
        let impacts = run(&mut world, 20.0, FRAME);
        assert!(impacts > 3, "{impacts}");
        // Some hundred steps and the times of some impacts, each to rounding.
        assert_close(world.total_energy(), energy, 1e-12 * energy.abs());
    }
}

#[test]
fn frames_and_force_ticks_do_not_change_a_bit() {
    let state_of = |frame: f64, tick: f64| {
        let mut world = orbit(Exact::default().with_force_tick(tick), 1.0);
        run(&mut world, 8.0, frame);
        world.state_hash()
    };
    let expected = state_of(1.0 / 64.0, 1.0 / 240.0);
    for (frame, tick) in [
        (1.0 / 32.0, 1.0 / 240.0),
        (1.0 / 256.0, 1.0 / 240.0),
        (0.5, 1.0 / 240.0),
        (1.0 / 64.0, 1.0 / 1000.0),
    ] {
        assert_eq!(state_of(frame, tick), expected, "{frame} {tick}");
    }
}

/// Centres and velocities at each thirtieth of a second of eight, in frames that are parts of that.
fn states_by_thirtieths(frame: f64, parts: u32) -> Vec<(Vec<DVec3>, Vec<DVec3>)> {
    let mut world = orbit(Exact::default(), 1.0);
    let state = |_| {
        for _ in 0..parts {
            world.step(frame).unwrap();
        }
        (world.spheres().positions().to_vec(), world.spheres().velocities().to_vec())
    };
    (0..240).map(state).collect()
}

#[test]
fn frames_of_a_thirtieth_and_of_its_halves_come_to_the_same_bits() {
    // Halves of a frame have its digits, and the clock sums without rounding.
    let expected = states_by_thirtieths(1.0 / 30.0, 1);
    for parts in [2, 4, 8] {
        let frame = 1.0 / (30.0 * f64::from(parts));
        assert_eq!(states_by_thirtieths(frame, parts), expected, "{frame}");
    }
}

#[test]
fn frames_whose_sums_round_differ_by_the_way_of_that_time() {
    let expected = states_by_thirtieths(1.0 / 30.0, 1);
    for parts in [3, 7] {
        let found = states_by_thirtieths(1.0 / (30.0 * f64::from(parts)), parts);
        for (number, (found, expected)) in found.iter().zip(&expected).enumerate() {
            // Each of the frames before is off by half a rounding of itself, and so is the place where each ends.
            let late = f64::EPSILON * (number + 1) as f64 / 30.0;
            for (index, (place, other)) in found.0.iter().zip(&expected.0).enumerate() {
                let speed = expected.1[index].length();
                let off = (*place - *other).length();
                assert!(
                    off <= speed * late + 4.0 * f64::EPSILON * place.length(),
                    "{number}: {off}"
                );
            }
        }
    }
}

#[test]
fn quadratic_drag_lets_a_ball_fall_by_the_hyperbolic_tangent() {
    let mut world = exact();
    let drag = QuadraticDrag::new(1.2);
    world.add_force(Gravity::new(DOWN)).unwrap();
    world.add_force(drag).unwrap();
    let (r, mass) = (0.05, 0.1);
    let id = world.add_sphere(Sphere::new(vec(0.0, 0.0, 0.0), r).with_mass(mass)).unwrap();
    let k = 0.5 * 1.2 * 0.44 * PI * r * r / mass;
    let terminal = (G / k).sqrt();
    for frames in 1..=8 {
        world.step(0.5).unwrap();
        let t = 0.5 * f64::from(frames);
        let ball = world.sphere(id).unwrap();
        let z = G * t / terminal;
        assert_close(ball.velocity.y, -terminal * z.tanh(), 1e-12 * terminal);
        let way = terminal * terminal / G * z.cosh().ln();
        assert_close(ball.position.y, -way, 1e-12 * way.max(1.0));
    }
}

#[test]
fn a_ball_that_bobs_in_a_fluid_keeps_its_energy() {
    let mut world = exact();
    world.add_force(Gravity::new(DOWN)).unwrap();
    world.add_force(Buoyancy::new(1000.0, 0.0)).unwrap();
    let (r, rho) = (0.1, 600.0);
    let mass = rho * 4.0 / 3.0 * PI * r * r * r;
    // It comes out of the fluid, and dives, in each period.
    let id = world.add_sphere(Sphere::new(vec(0.0, 0.7, 0.0), r).with_mass(mass)).unwrap();
    let energy = world.total_energy();
    run(&mut world, 10.0, FRAME);
    // The slope of the force changes where it begins to come out, and where it is out: steps end there.
    assert_close(world.total_energy(), energy, 1e-13 * mass * G);
    assert!(world.sphere(id).unwrap().position.y.abs() < 1.5);
}

#[test]
fn a_ball_bounces_on_a_planet_and_comes_to_rest() {
    let mut world = exact();
    world.add_force(PointAttractor::new(DVec3::ZERO, 9.81)).unwrap();
    world.add_collider(fixed_ball(DVec3::ZERO, 1.0).with_restitution(0.5)).unwrap();
    let ball = Sphere::new(vec(0.0, 2.1, 0.0), 0.1).with_restitution(0.5);
    let id = world.add_sphere(ball).unwrap();
    let impacts = run(&mut world, 20.0, FRAME);
    assert!(impacts > 4, "{impacts}");
    let ball = world.sphere(id).unwrap();
    // As deep as persistent contacts on curves are followed.
    assert_close(ball.position.length(), 1.1, 1e-9);
    assert!(ball.velocity.length() < 1e-9, "{}", ball.velocity);
}

#[test]
fn a_ball_rests_on_the_ground_of_a_fluid() {
    for friction in [0.0, 0.4] {
        let mut world = exact();
        world.add_force(Gravity::new(DOWN)).unwrap();
        world.add_force(Buoyancy::new(500.0, 10.0)).unwrap();
        world.add_force(QuadraticDrag::new(500.0)).unwrap();
        let ground = floor().with_restitution(0.3).with_friction(friction);
        world.add_collider(ground).unwrap();
        let ball = Sphere::new(vec(0.0, 1.0, 0.0), 0.1)
            .with_mass(10.0)
            .with_velocity(vec(1.0, 0.0, 0.0))
            .with_friction(friction);
        let id = world.add_sphere(ball).unwrap();
        run(&mut world, 20.0, FRAME);
        let ball = world.sphere(id).unwrap();
        assert_close(ball.position.y, 0.1, 1e-12);
        assert_close(ball.velocity.y, 0.0, 1e-12);
    }
}

/// A force [m/s²] of one sign above a height, and of the other below it.
#[derive(Debug)]
struct Jump;

impl Force for Jump {
    fn on(&self, sphere: &SphereState, _time: f64) -> DVec3 {
        -sphere.mass * sphere.position.y.signum() * DVec3::Y
    }

    fn potential_energy(&self, sphere: &SphereState, _time: f64) -> f64 {
        sphere.mass * sphere.position.y.abs()
    }
}

#[test]
fn a_jump_of_a_force_is_crossed_where_it_is() {
    let mut world = exact();
    world.add_force(Jump).unwrap();
    let id = world.add_sphere(Sphere::new(vec(0.0, 2.0, 0.0), 0.1)).unwrap();
    let energy = world.total_energy();
    // From 2 m at 1 m/s² it takes 2 s to the middle, and 8 s for a period.
    run(&mut world, 16.0, FRAME);
    assert_close(world.total_energy(), energy, 1e-10);
    assert_close(world.sphere(id).unwrap().position.y, 2.0, 1e-9);
}

/// A force that is another at each evaluation, as of a program that has an error.
#[derive(Debug)]
struct Noise(Arc<AtomicUsize>);

impl Force for Noise {
    fn on(&self, sphere: &SphereState, _time: f64) -> DVec3 {
        let count = self.0.fetch_add(1, Ordering::Relaxed);
        let pseudo = (count.wrapping_mul(0x9E37_79B9) >> 8) % 1000;
        sphere.mass * pseudo as f64 * 1e-3 * DVec3::Y
    }
}

#[test]
fn a_force_without_a_course_takes_bounded_work() {
    let count = Arc::new(AtomicUsize::new(0));
    let mut world = exact();
    world.add_force(Noise(count.clone())).unwrap();
    world.add_sphere(Sphere::new(DVec3::ZERO, 0.1)).unwrap();
    run(&mut world, 1.0, FRAME);
    // Some hundred steps of the length of a force tick, with a hundred evaluations each.
    let evaluations = count.load(Ordering::Relaxed);
    assert!(evaluations < 200_000, "{evaluations}");
}

#[test]
fn balls_in_a_box_about_an_attractor_never_overlap_and_keep_energy() {
    let mut world = exact();
    world.add_force(PointAttractor::new(vec(0.1, 0.2, 0.3), 3.0).with_softening(0.2)).unwrap();
    world.add_force(Gravity::new(DOWN)).unwrap();
    let walls = [DVec3::X, DVec3::Y, DVec3::Z].into_iter().flat_map(|axis| [axis, -axis]);
    for normal in walls {
        let rotation = DQuat::from_rotation_arc(DVec3::Y, normal);
        let pose = Pose { position: -1.0 * normal, rotation };
        world.add_collider(Collider::new(Shape::HalfSpace, pose).with_restitution(1.0)).unwrap();
    }
    let mut numbers = Numbers(5);
    for i in 0..27 {
        let cell = vec(f64::from(i % 3), f64::from(i / 3 % 3), f64::from(i / 9)) - DVec3::ONE;
        let ball = Sphere::new(0.6 * cell, 0.15)
            .with_velocity(2.0 * numbers.vector())
            .with_restitution(1.0);
        world.add_sphere(ball).unwrap();
    }
    let energy = world.total_energy();
    let mut impacts = 0;
    for _ in 0..128 {
        impacts += world.step(FRAME).unwrap().impacts.len();
        let places = world.spheres().positions();
        for (i, place) in places.iter().enumerate() {
            assert!(place.abs().max_element() < 0.85 + 1e-12, "{place}");
            for other in &places[..i] {
                assert!((*place - *other).length() > 0.3 - 1e-12);
            }
        }
    }
    assert!(impacts > 100, "{impacts}");
    assert_close(world.total_energy(), energy, 1e-12 * energy.abs());
}

#[test]
fn a_vortex_in_a_periodic_box_carries_balls_without_overlap() {
    let size = DVec3::splat(2.0);
    let settings = Settings::default().with_rule(Exact::default());
    let settings = settings.with_boundary(Boundary::Periodic { size });
    let mut world = World::new(settings).unwrap();
    world.add_force(Vortex::new(DVec3::ZERO, 3.0, 0.5)).unwrap();
    for i in 0..27 {
        let cell = vec(f64::from(i % 3), f64::from(i / 3 % 3), f64::from(i / 9)) - DVec3::ONE;
        let ball = Sphere::new(0.6 * cell, 0.1).with_velocity(vec(1.0, 0.3 * cell.x, 0.0));
        world.add_sphere(ball).unwrap();
    }
    for _ in 0..64 {
        world.step(FRAME).unwrap();
        let places = world.spheres().positions();
        for (i, place) in places.iter().enumerate() {
            for other in &places[..i] {
                let offset = *place - *other;
                let nearest = offset - 2.0 * (offset / 2.0).round();
                assert!(nearest.length() > 0.2 - 1e-12);
            }
        }
    }
}

#[test]
fn moving_and_turning_surfaces_are_met_on_curves() {
    let mut world = exact();
    world.add_force(Gravity::new(DOWN)).unwrap();
    // So weak that the path is a parabola to 1e-9.
    world.add_force(QuadraticDrag::new(1e-12)).unwrap();
    let shape = Shape::Rectangle { size_x: 50.0, size_z: 50.0 };
    let lift =
        Collider::new(shape.clone(), Pose::at(DVec3::ZERO)).moving(vec(0.0, 1.0, 0.0), DVec3::ZERO);
    world.add_collider(lift).unwrap();
    let turned = Collider::new(shape, Pose::at(vec(200.0, 0.0, 0.0)))
        .moving(DVec3::ZERO, vec(0.0, 2.0, 0.0));
    world.add_collider(turned).unwrap();
    let height = 3.0;
    for x in [0.0, 200.0] {
        world.add_sphere(Sphere::new(vec(x + 1.0, height + 0.2, 0.0), 0.2)).unwrap();
    }
    let report = world.step(1.0).unwrap();
    let times: Vec<f64> = report.impacts.iter().map(|impact| impact.time).collect();
    // h - g t²/2 = u t
    let onto_lift = (-1.0 + (1.0 + 2.0 * G * height).sqrt()) / G;
    assert_close(times[0], onto_lift, 1e-9);
    let onto_table = (2.0 * height / G).sqrt();
    assert!(times.iter().any(|time| (time - onto_table).abs() < 1e-9), "{times:?}");
}

#[test]
fn applied_forces_add_to_a_curve_for_their_frame() {
    let mut world = exact();
    // It pulls with 1e-30 m/s²: nothing.
    world.add_force(PointAttractor::new(vec(1e15, 0.0, 0.0), 1.0)).unwrap();
    let id = world.add_sphere(Sphere::new(DVec3::ZERO, 0.1)).unwrap();
    let mass = world.spheres().masses()[0];
    let frames = 16;
    for frame in 0..frames {
        let force = if frame % 2 == 0 { 2.0 } else { -1.0 };
        world.set_applied_forces(&[mass * force * DVec3::X]).unwrap();
        world.step(0.25).unwrap();
    }
    // 8 frames of 2 m/s², 8 of -1.
    assert_close(world.sphere(id).unwrap().velocity.x, 2.0, 1e-12);
}

/// A force that is no number beyond a place.
#[derive(Debug)]
struct Broken;

impl Force for Broken {
    fn on(&self, sphere: &SphereState, _time: f64) -> DVec3 {
        if sphere.position.x > 1.0 { DVec3::NAN } else { DVec3::ZERO }
    }
}

#[test]
fn a_force_that_is_no_number_is_refused_with_its_sphere() {
    let mut world = exact();
    world.add_force(Broken).unwrap();
    let ball = Sphere::new(DVec3::ZERO, 0.1).with_velocity(vec(1.0, 0.0, 0.0));
    let id = world.add_sphere(ball).unwrap();
    let refused = (0..200).find_map(|_| world.step(FRAME).err());
    match refused {
        Some(Error::NonFiniteState { sphere, .. }) => assert_eq!(sphere, id),
        other => panic!("{other:?}"),
    }
}
