//! Balls that slide and roll on round surfaces at rest under the rule `exact` move by their closed forms, to rounding.

use std::f64::consts::PI;

use carom::{
    Collider, DQuat, DVec3, Ends, Exact, Gravity, Pose, Settings, Shape, Sphere, ViscousDrag, World,
};

const G: f64 = 9.81;
/// Radius of the hollows \[m\].
const HOLLOW: f64 = 1.0;
/// Radius of the balls \[m\].
const BALL: f64 = 0.1;
/// Distance of the centre of a ball in a hollow from its axis \[m\].
const PATH: f64 = HOLLOW - BALL;
/// A solid ball that rolls is as heavy as one that slides and has 7/5 of its mass.
const ROLLING: f64 = 1.4;
const FRAME: f64 = 1.0 / 64.0;

/// A world with gravity and one surface; all lengths and the gravity are `scale` times as large.
fn world(collider: Collider, scale: f64) -> World {
    let mut world = World::new(Settings::default().with_rule(Exact::default())).unwrap();
    world.add_force(Gravity::new(DVec3::new(0.0, -G * scale, 0.0))).unwrap();
    world.add_collider(collider).unwrap();
    world
}

fn at_origin(shape: Shape) -> Collider {
    Collider::new(shape, Pose::at(DVec3::ZERO))
}

/// None, or so much that balls only roll.
fn friction(is_rough: bool) -> f64 {
    if is_rough { 100.0 } else { 0.0 }
}

fn bowl(is_rough: bool, scale: f64) -> World {
    let bowl = at_origin(Shape::Bowl { radius: HOLLOW * scale, opening: 0.4 });
    world(bowl.with_friction(friction(is_rough)), scale)
}

fn lying_pipe(is_rough: bool) -> World {
    let pipe = Shape::Pipe { radius: HOLLOW, length: 2.0, closed: Ends::NONE };
    let pose = Pose::at(DVec3::ZERO).rotated(DQuat::from_rotation_x(0.5 * PI));
    world(Collider::new(pipe, pose).with_friction(friction(is_rough)), 1.0)
}

fn ball(place: DVec3, velocity: DVec3) -> Sphere {
    Sphere::new(place, BALL).with_velocity(velocity).with_restitution(0.0)
}

/// The place of a ball in a hollow at an angle from the lowest one \[rad\].
fn in_hollow(angle: f64) -> DVec3 {
    PATH * DVec3::new(libm::sin(angle), -libm::cos(angle), 0.0)
}

fn place(world: &World) -> DVec3 {
    world.spheres().positions()[0]
}

/// Quarter of the period of a pendulum of this length \[m\] from an amplitude \[rad\], by the arithmetic-geometric mean.
fn quarter_period(length: f64, amplitude: f64) -> f64 {
    let (mut a, mut b) = (1.0, libm::cos(0.5 * amplitude));
    for _ in 0..8 {
        (a, b) = (0.5 * (a + b), f64::sqrt(a * b));
    }
    (length / G).sqrt() * 0.5 * PI / a
}

#[test]
fn balls_in_bowls_and_pipes_swing_by_the_elliptic_integral() {
    for (is_rough, amplitude) in
        [false, true].into_iter().flat_map(|it| [0.1, 1.0, 1.5].map(|amplitude| (it, amplitude)))
    {
        let factor = if is_rough { ROLLING } else { 1.0 };
        let quarter = quarter_period(factor * PATH, amplitude);
        for mut world in [bowl(is_rough, 1.0), lying_pipe(is_rough)] {
            world.add_sphere(ball(in_hollow(amplitude), DVec3::ZERO)).unwrap();
            for swing in 0..10 {
                world.step(quarter).unwrap();
                let off = place(&world).x.abs();
                // Rounding of some hundred steps.
                assert!(off < 1e-12, "{is_rough} {amplitude} {swing}: {off:e}");
                world.step(quarter).unwrap();
            }
        }
    }
}

#[test]
fn a_ball_in_a_bowl_keeps_its_energy_at_any_size_at_little_work() {
    for (is_rough, power) in
        [false, true].into_iter().flat_map(|it| [-20, 0, 20].map(|power| (it, power)))
    {
        let scale = libm::ldexp(1.0, power);
        let mut world = bowl(is_rough, scale);
        let place = in_hollow(1.0);
        let velocity = DVec3::new(0.0, 0.0, 1.0);
        let mut ball = ball(place, velocity);
        if is_rough {
            // It rolls from the start, about the axis across its way and the normal.
            ball = ball.with_angular_velocity(-place.normalize().cross(velocity) / BALL);
        }
        ball.position *= scale;
        ball.radius *= scale;
        ball.velocity *= scale;
        world.add_sphere(ball).unwrap();
        let start = world.total_energy();
        let (mut largest, mut predictions) = (0.0f64, 0);
        for _ in 0..640 {
            predictions += world.step(FRAME).unwrap().work.predictions;
            largest = largest.max((world.total_energy() / start - 1.0).abs());
        }
        // Rounding of some hundred steps.
        assert!(largest < 1e-12, "{is_rough} {scale}: {largest:e}");
        // Five swings of some thirty steps each.
        assert!(predictions < 1000, "{is_rough} {scale}: {predictions}");
    }
}

#[test]
fn frames_do_not_change_a_bit_of_a_ball_in_a_bowl() {
    let run = |frames: u32| {
        let mut world = bowl(true, 1.0);
        world.add_sphere(ball(in_hollow(1.0), DVec3::new(0.0, 0.0, 1.0))).unwrap();
        for _ in 0..4 * frames {
            world.step(1.0 / f64::from(frames)).unwrap();
        }
        place(&world)
    };
    let expected = run(32);
    assert!([64, 128, 256].into_iter().all(|frames| run(frames) == expected));
}

/// Force of a lying pipe on a ball at its top, as a part of its weight, that comes from this height above the lowest
/// place \[m\].
fn force_at_the_top(height: f64) -> f64 {
    let mut world = lying_pipe(false);
    world.add_sphere(ball(in_hollow(0.0), DVec3::X * (2.0 * G * height).sqrt())).unwrap();
    while place(&world).y < (1.0 - 1e-14) * PATH {
        // The time to the top, from before it.
        let way = PATH * (PI - libm::atan2(place(&world).x, -place(&world).y));
        world.step(0.9 * way / world.spheres().velocities()[0].length()).unwrap();
    }
    let weight = G * world.spheres().masses()[0];
    world.contacts()[0].normal_force / weight
}

#[test]
fn a_ball_goes_round_a_loop_from_five_halves_of_its_radius() {
    // The force grows linearly with the height, so two of them give the one from which there is none.
    let [low, high] = [2.6, 3.0];
    let [less, more] = [low, high].map(|part| force_at_the_top(part * PATH));
    let least = low - less * (high - low) / (more - less);
    assert!((least - 2.5).abs() < 1e-12, "{:e}", least - 2.5);
}

#[test]
fn a_ball_that_rolls_in_an_upright_pipe_swings_up_and_down() {
    let pipe = Shape::Pipe { radius: HOLLOW, length: 20.0, closed: Ends::NONE };
    let mut world = world(at_origin(pipe).with_friction(1e3), 1.0);
    let rate = 6.0;
    // Without slip where it touches the wall.
    let speed = rate * PATH;
    let ball = ball(DVec3::X * PATH, DVec3::Z * -speed);
    world.add_sphere(ball.with_angular_velocity(DVec3::Y * (-speed / BALL))).unwrap();
    // Gualtieri et al., Am. J. Phys. 74, 497 (2006).
    let omega = (2.0_f64 / 7.0).sqrt() * rate;
    let drop = 5.0 / 7.0 * G / (omega * omega);
    let mut worst = 0.0f64;
    for _ in 0..320 {
        world.step(FRAME).unwrap();
        let expected = -drop * (1.0 - libm::cos(omega * world.time()));
        worst = worst.max((place(&world).y - expected).abs());
    }
    // Rounding of some hundred steps.
    assert!(worst < 1e-12 * drop, "{:e}", worst / drop);
}

#[test]
fn a_ball_that_begins_to_slide_in_a_pipe_slows_down_by_its_closed_form() {
    let (friction, slip) = (0.05, 0.01);
    let pipe = Shape::Pipe { radius: HOLLOW, length: 2.0, closed: Ends::NONE };
    let pose = Pose::at(DVec3::ZERO).rotated(DQuat::from_rotation_x(0.5 * PI));
    let mut world = world(Collider::new(pipe, pose).with_friction(friction), 1.0);
    let (start, speed) = (1.0f64, 4.0);
    let along = DVec3::new(libm::cos(start), libm::sin(start), 0.0);
    // It turns a little faster than it rolls, so that friction drives it.
    let spin = -DVec3::Z * (speed * (1.0 + slip) / BALL);
    let ball = ball(in_hollow(start), along * speed).with_angular_velocity(spin);
    world.add_sphere(ball).unwrap();
    // Of y = v² over the angle: y' = -2 g l sin + 2 μ (y + g l cos).
    let (weight, square) = (G * PATH, friction * friction);
    let a = weight * (2.0 - 4.0 * square) / (1.0 + 4.0 * square);
    let b = 6.0 * friction * weight / (1.0 + 4.0 * square);
    let steady = |angle: f64| a * libm::cos(angle) + b * libm::sin(angle);
    let square_at = |angle: f64| {
        let first = speed * speed - steady(start);
        first * libm::exp(2.0 * friction * (angle - start)) + steady(angle)
    };
    // It leaves the pipe soon after.
    for _ in 0..16 {
        world.step(FRAME).unwrap();
        let angle = libm::atan2(place(&world).x, -place(&world).y);
        let off = world.spheres().velocities()[0].length_squared() - square_at(angle);
        // Rounding of some steps at 16 m²/s².
        assert!(off.abs() < 1e-12, "{angle}: {off:e}");
    }
}

#[test]
fn a_ball_leaves_a_fixed_sphere_at_two_thirds_of_its_height() {
    let mut world = world(at_origin(Shape::Sphere { radius: 1.0 }), 1.0);
    let (speed, length) = (0.1, 1.0 + BALL);
    world.add_sphere(ball(DVec3::Y * length, DVec3::X * speed)).unwrap();
    for _ in 0..150 {
        world.step(FRAME).unwrap();
    }
    // Where g cos = v²/l, with v² = speed² + 2 g l (1 - cos).
    let cos = 2.0 / 3.0 + speed * speed / (3.0 * G * length);
    let across = world.spheres().velocities()[0].x;
    let expected = (G * length * cos).sqrt() * cos;
    assert!((across - expected).abs() < 1e-13, "{:e}", across - expected);
}

#[test]
fn friction_takes_what_its_account_says_from_a_ball_that_rolls_over_an_edge() {
    let table = at_origin(Shape::Box { size: DVec3::new(2.0, 1.0, 2.0) });
    let mut world = world(table.with_friction(friction(true)), 1.0);
    let velocity = DVec3::X * 0.2;
    let spin = -DVec3::Z * (0.2 / BALL);
    world
        .add_sphere(ball(DVec3::new(0.9, 0.5 + BALL, 0.0), velocity).with_angular_velocity(spin))
        .unwrap();
    let missing = largest_missing(&mut world, 100);
    assert!(place(&world).y < -1.0);
    // Rounding of some ten steps at 6 J.
    assert!(missing < 1e-13, "{missing:e}");
}

#[test]
fn drag_takes_what_its_account_says_from_a_ball_that_rolls_in_a_bowl() {
    let mut world = bowl(true, 1.0);
    world.add_force(ViscousDrag::new(0.1)).unwrap();
    world.add_sphere(ball(in_hollow(1.0), DVec3::ZERO)).unwrap();
    let missing = largest_missing(&mut world, 640);
    // Rounding of a frame at 9 J.
    assert!(missing < 1e-13, "{missing:e}");
}

/// The largest energy of some frames that no account of a frame has \[J\]; no ball may join a zone.
fn largest_missing(world: &mut World, frames: usize) -> f64 {
    let mut largest = 0.0f64;
    for _ in 0..frames {
        let before = world.total_energy();
        let report = world.step(FRAME).unwrap();
        assert_eq!(report.zone_account.joined, 0);
        let account = report.energy_account.total();
        let missing = world.total_energy() - before - account;
        largest = largest.max(missing.abs());
    }
    largest
}

#[test]
fn balls_that_touch_in_a_bowl_lose_what_their_contacts_take() {
    for friction in [0.0, 0.3] {
        let collider = at_origin(Shape::Bowl { radius: HOLLOW, opening: 1.5 });
        let mut world = world(collider.with_friction(friction).with_restitution(0.5), 1.0);
        for (x, y, z) in [(0.1, -0.3, 0.0), (-0.1, -0.2, 0.1), (0.0, -0.1, -0.1), (0.1, 0.0, 0.1)] {
            let ball = Sphere::new(DVec3::new(x, y, z), 0.06).with_mass(1.0).with_restitution(0.5);
            world.add_sphere(ball.with_friction(friction)).unwrap();
        }
        let missing = largest_missing(&mut world, 192);
        let deepest = world.overlaps(0.0).iter().map(|it| it.depth).fold(0.0, f64::max);
        // Rounding of some thousand steps at 40 J, and of the gaps.
        assert!(missing < 1e-12, "{friction}: {missing:e}");
        assert!(deepest < 1e-13, "{friction}: {deepest:e}");
    }
}

#[test]
fn balls_that_jam_in_a_funnel_gain_no_energy() {
    let funnel = Shape::Funnel { bottom_radius: 0.05, top_radius: 1.0, height: 1.0 };
    let funnel = Collider::new(funnel, Pose::at(DVec3::new(0.0, -0.5, 0.0)));
    let mut world = world(funnel.with_friction(0.3).with_restitution(0.0), 1.0);
    for (x, y, z) in [(0.15, 0.1, 0.02), (-0.12, 0.15, -0.03), (0.03, 0.3, 0.13)] {
        world.add_sphere(Sphere::new(DVec3::new(x, y, z), BALL).with_mass(1.0)).unwrap();
    }
    let mut gained = 0.0;
    for frame in 0..192 {
        let before = world.total_energy();
        let account = world.step(FRAME).unwrap().energy_account.total();
        gained += world.total_energy() - before - account;
        // Rounding of 192 energies of 30 J.
        assert!(gained.abs() < 3e-12, "{frame}: {gained:e}");
    }
}
