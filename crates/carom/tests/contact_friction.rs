//! The rule `contact` for single spheres: sliding, rolling, spinning and bouncing with friction, against
//! closed forms.
//!
//! A sub-step changes velocities as the closed forms say, but for the one in which a motion begins or
//! ends: so times are right to a sub-step, velocities that a motion ends with to rounding.

use carom::{
    Collider, Contact, DQuat, DVec3, Discrete, Friction, Gravity, Pose, Settings, Shape, Sphere,
    World,
};

const G: f64 = 9.81;
const FRAME: f64 = 1.0 / 60.0;
const SUB_STEP: f64 = FRAME / 8.0;
/// Rounding of some hundred sub-steps, relative.
const ROUNDING: f64 = 1e-11;

fn world() -> World {
    World::new(Settings::default().with_rule(Contact::default())).unwrap()
}

/// A plane through the origin that rises towards +x by this angle, under gravity.
fn on_plane(angle: f64, friction: impl Into<Friction>) -> World {
    let mut world = world();
    world.add_force(Gravity::new(DVec3::new(0.0, -G, 0.0))).unwrap();
    let pose = Pose::at(DVec3::ZERO).rotated(DQuat::from_rotation_z(angle));
    let plane = Collider::new(Shape::HalfSpace, pose).with_restitution(0.0).with_friction(friction);
    world.add_collider(plane).unwrap();
    world
}

/// Takes so many frames.
fn run(world: &mut World, frames: u32) {
    for _ in 0..frames {
        world.step(FRAME).unwrap();
    }
}

fn assert_close(value: f64, expected: f64, tolerance: f64) {
    assert!((value - expected).abs() <= tolerance, "{value} instead of {expected}");
}

#[test]
fn a_sliding_ball_comes_to_roll_with_five_sevenths_of_its_speed() {
    // Coriolis, "Theorie mathematique des effets du jeu de billard" (1835).
    let (v0, mu, radius) = (3.0, 0.2, 0.03);
    let mut world = on_plane(0.0, mu);
    let ball = Sphere::new(DVec3::new(0.0, radius, 0.0), radius).with_velocity(v0 * DVec3::X);
    let id = world.add_sphere(ball).unwrap();
    let rolls_at = 2.0 * v0 / (7.0 * mu * G);
    let mut found = f64::NAN;
    for _ in 0..60 {
        world.step(FRAME).unwrap();
        let ball = world.sphere(id).unwrap();
        let slip = ball.velocity.x + radius * ball.angular_velocity.z;
        if found.is_nan() && slip < 1e-9 {
            found = world.time();
        }
        let sliding_speed = v0 - mu * G * world.time();
        if found.is_nan() {
            assert_close(ball.velocity.x, sliding_speed, ROUNDING * v0);
        }
    }
    assert!((rolls_at..=rolls_at + FRAME + SUB_STEP).contains(&found), "{found} {rolls_at}");
    let ball = world.sphere(id).unwrap();
    assert_close(ball.velocity.x, 5.0 / 7.0 * v0, ROUNDING * v0);
    assert_close(ball.angular_velocity.z, -5.0 / 7.0 * v0 / radius, ROUNDING * v0 / radius);
    // The way until it rolls, 12 v0² / (49 mu g), and on at that speed; each sub-step moves by its last
    // velocity, so the way lacks half a sub-step of what the speed loses.
    let way = 12.0 * v0 * v0 / (49.0 * mu * G) + 5.0 / 7.0 * v0 * (world.time() - rolls_at);
    assert_close(ball.position.x, way, SUB_STEP * 2.0 / 7.0 * v0);
}

#[test]
fn a_ball_on_an_incline_rolls_or_slides_by_its_friction() {
    let angle = 0.5_f64;
    // It rolls while tan(angle) <= 7/2 mu, with 5/7 of the acceleration of sliding freely.
    for (mu, expected) in [
        (0.5, 5.0 / 7.0 * G * libm::sin(angle)),
        (0.16, 5.0 / 7.0 * G * libm::sin(angle)),
        (0.1, G * (libm::sin(angle) - 0.1 * libm::cos(angle))),
        (0.0, G * libm::sin(angle)),
    ] {
        let mut world = on_plane(angle, mu);
        let normal = DVec3::new(-libm::sin(angle), libm::cos(angle), 0.0);
        let id = world.add_sphere(Sphere::new(0.1 * normal, 0.1)).unwrap();
        run(&mut world, 60);
        let ball = world.sphere(id).unwrap();
        assert_close(ball.velocity.length(), expected * world.time(), 1e-9 * expected);
        // The overlap stays where it began.
        assert_close(ball.position.dot(normal), 0.1, 1e-9);
    }
}

#[test]
fn a_hollow_ball_rolls_down_more_slowly_than_a_solid_one() {
    let angle = 0.3_f64;
    for factor in [carom::SOLID_BALL, carom::THIN_SHELL] {
        let mut world = on_plane(angle, 1.0);
        let normal = DVec3::new(-libm::sin(angle), libm::cos(angle), 0.0);
        let ball = Sphere::new(0.1 * normal, 0.1).with_inertia_factor(factor);
        let id = world.add_sphere(ball).unwrap();
        run(&mut world, 60);
        let expected = G * libm::sin(angle) / (1.0 + factor) * world.time();
        assert_close(world.sphere(id).unwrap().velocity.length(), expected, 1e-9 * expected);
    }
}

#[test]
fn rolling_friction_stops_a_ball_with_five_sevenths_of_its_coefficient_times_g() {
    let (v0, mu_r, radius) = (1.0, 0.02, 0.03);
    let mut world = on_plane(0.0, Friction::sliding(0.5).with_rolling(mu_r));
    let ball = Sphere::new(DVec3::new(0.0, radius, 0.0), radius)
        .with_velocity(v0 * DVec3::X)
        .with_angular_velocity(-v0 / radius * DVec3::Z);
    let id = world.add_sphere(ball).unwrap();
    run(&mut world, 60);
    let deceleration = 5.0 / 7.0 * mu_r * G;
    let velocity = world.sphere(id).unwrap().velocity.x;
    assert_close(velocity, v0 - deceleration * world.time(), 1e-9);
    run(&mut world, (60.0 * v0 / deceleration) as u32);
    let ball = world.sphere(id).unwrap();
    assert_close(ball.velocity.length(), 0.0, 1e-12);
    assert_close(ball.position.x, v0 * v0 / (2.0 * deceleration), SUB_STEP * v0);
}

#[test]
fn spinning_friction_stops_a_spinning_ball_in_the_time_of_its_torque() {
    let (w0, mu_s, radius) = (20.0, 0.05, 0.1);
    let mut world = on_plane(0.0, Friction::sliding(0.5).with_spinning(mu_s));
    let ball =
        Sphere::new(DVec3::new(0.0, radius, 0.0), radius).with_angular_velocity(w0 * DVec3::Y);
    let id = world.add_sphere(ball).unwrap();
    run(&mut world, 60);
    let deceleration = 2.5 * mu_s * G / radius;
    let spin = |world: &World| world.sphere(id).unwrap().angular_velocity;
    assert_close(spin(&world).y, w0 - deceleration * world.time(), 1e-9 * w0);
    run(&mut world, 60);
    assert_close(spin(&world).length(), 0.0, 1e-12);
    assert_close(world.sphere(id).unwrap().position.with_y(0.0).length(), 0.0, 1e-12);
}

#[test]
fn a_superball_turns_its_slip_round() {
    // Garwin, Am. J. Phys. 37, 88 (1969): e = beta = 1.
    let mut world = world();
    let floor = Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO))
        .with_friction(Friction::sliding(100.0).with_tangential_restitution(1.0));
    world.add_collider(floor).unwrap();
    let radius = 0.05;
    let (velocity, spin) = (DVec3::new(2.0, -3.0, 1.0), DVec3::new(4.0, 7.0, -20.0));
    let ball = Sphere::new(DVec3::new(0.0, 0.2, 0.0), radius)
        .with_velocity(velocity)
        .with_angular_velocity(spin);
    let id = world.add_sphere(ball).unwrap();
    let energy = world.kinetic_energy();
    run(&mut world, 30);
    let ball = world.sphere(id).unwrap();
    let slip = velocity.with_y(0.0) + spin.cross(-radius * DVec3::Y);
    let expected = velocity.with_y(-velocity.y) - 4.0 / 7.0 * slip;
    assert_close((ball.velocity - expected).length(), 0.0, ROUNDING);
    assert_close(world.kinetic_energy(), energy, ROUNDING * energy);
    let after = ball.velocity.with_y(0.0) + ball.angular_velocity.cross(-radius * DVec3::Y);
    assert_close((after + slip).length(), 0.0, ROUNDING);
}

#[test]
fn oblique_bounces_stick_or_slide_as_rigid_balls_do() {
    // Chung and Ooi, "Benchmark tests for verifying discrete element modelling codes", Granular Matter 13
    // (2011), test 4: aluminium oxide balls; here with beta0 = 0, by Walton's law.
    let (radius, e, mu, speed) = (0.0025, 0.98, 0.092, 3.9);
    for degrees in [5.0_f64, 20.0, 30.0, 35.0, 45.0, 60.0, 75.0, 85.0] {
        let angle = degrees.to_radians();
        let mut world = world();
        let plate = Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO))
            .with_restitution(e)
            .with_friction(mu);
        world.add_collider(plate).unwrap();
        let velocity = speed * DVec3::new(libm::sin(angle), -libm::cos(angle), 0.0);
        let ball = Sphere::new(DVec3::new(0.0, 0.01, 0.0), radius)
            .with_velocity(velocity)
            .with_density(4000.0);
        let id = world.add_sphere(ball).unwrap();
        run(&mut world, 10);
        let ball = world.sphere(id).unwrap();
        let change = (2.0 / 7.0 * velocity.x).min(mu * (1.0 + e) * -velocity.y);
        assert_close(ball.velocity.y, -e * velocity.y, ROUNDING * speed);
        assert_close(ball.velocity.x, velocity.x - change, ROUNDING * speed);
        assert_close(ball.angular_velocity.z, -2.5 * change / radius, ROUNDING * speed / radius);
    }
}

#[test]
fn two_spinning_balls_exchange_what_friction_allows() {
    let mut world = world();
    let (mu, radius, speed) = (0.05, 0.03, 2.0);
    let cue = Sphere::new(DVec3::new(-0.2, 0.0, 0.0), radius)
        .with_velocity(speed * DVec3::X)
        .with_angular_velocity(100.0 * DVec3::Z)
        .with_friction(mu)
        .with_restitution(0.95);
    let object = Sphere::new(DVec3::ZERO, radius);
    let [cue, object] = [cue, object].map(|ball| world.add_sphere(ball).unwrap());
    let momenta = [world.momentum(), world.angular_momentum()];
    run(&mut world, 20);
    let [cue, object] = [cue, object].map(|id| world.sphere(id).unwrap());
    let normal = 0.5 * (1.0 + 0.95) * speed;
    assert_close(object.velocity.x, normal, ROUNDING);
    // It slides: both are pushed across by mu times the normal impulse, and turned alike.
    assert_close(object.velocity.y, mu * normal, ROUNDING);
    assert_close(cue.velocity.y, -mu * normal, ROUNDING);
    assert_close(object.angular_velocity.z, -2.5 * mu * normal / radius, ROUNDING / radius);
    assert_close(cue.angular_velocity.z, 100.0 - 2.5 * mu * normal / radius, ROUNDING / radius);
    for (before, after) in momenta.into_iter().zip([world.momentum(), world.angular_momentum()]) {
        assert!((after - before).length() < 1e-14, "{before} {after}");
    }
}

#[test]
fn a_ball_turns_by_its_angular_velocity_under_every_rule() {
    for settings in [
        Settings::default(),
        Settings::default().with_rule(Contact::default()),
        Settings::default().with_rule(carom::Discrete::default()),
        Settings::default().with_rule(carom::Bisect::default()),
    ] {
        let mut world = World::new(settings).unwrap();
        let turning = Sphere::new(DVec3::ZERO, 1.0).with_angular_velocity(3.0 * DVec3::Z);
        let id = world.add_sphere(turning).unwrap();
        run(&mut world, 60);
        let orientation = world.sphere(id).unwrap().orientation;
        let expected = DQuat::from_rotation_z(3.0);
        assert!(orientation.dot(expected).abs() > 1.0 - 1e-14, "{orientation}");
    }
}

#[test]
fn a_conveyor_belt_takes_a_ball_along() {
    let mut world = on_plane(0.0, 0.3);
    let (id, belt) = world.colliders().map(|(id, it)| (id, it.clone())).next().unwrap();
    // A floor that moves in its own plane.
    world.set_collider(id, belt.moving(2.0 * DVec3::X, DVec3::ZERO)).unwrap();
    let ball = world.add_sphere(Sphere::new(DVec3::new(0.0, 0.1, 0.0), 0.1)).unwrap();
    run(&mut world, 120);
    // As on a floor at rest, seen from the belt: 5/7 of the slip goes into rolling.
    let velocity = world.sphere(ball).unwrap().velocity;
    assert_close(velocity.x, 2.0 * 2.0 / 7.0, 1e-9);
}

#[test]
fn only_friction_or_a_turned_sphere_gives_a_world_spin() {
    assert!(on_plane(0.0, 0.5).has_spin());
    let mut smooth = on_plane(0.0, 0.0);
    let ball = Sphere::new(DVec3::new(0.0, 1.0, 0.0), 1.0);
    smooth.add_sphere(ball).unwrap();
    assert!(!smooth.has_spin());
    let mut rough = smooth.clone();
    rough.add_sphere(ball.with_position(4.0 * DVec3::Y).with_friction(0.5)).unwrap();
    assert!(rough.has_spin());
    rough.set_settings(Settings::default()).unwrap();
    assert!(rough.has_spin());
    rough.set_settings(Settings::default().with_rule(Discrete::default())).unwrap();
    assert!(!rough.has_spin(), "under `discrete` friction does not act");
    smooth.add_sphere(ball.with_position(4.0 * DVec3::Y).with_angular_velocity(DVec3::X)).unwrap();
    assert!(smooth.has_spin());
}
