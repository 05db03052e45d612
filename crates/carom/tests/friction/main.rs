//! The rule `exact` with friction: bounces with spin, and balls that slide, roll, spin and stop, against
//! closed forms.
//!
//! Where a closed form holds to its end, what is left is the rounding of some events.

#[path = "../common/mod.rs"]
mod common;
mod edges_and_seams;

use std::f64::consts::FRAC_PI_2;

use carom::{
    Boundary, Collider, DVec3, Emitter, Error, Exact, Friction, Gravity, Pose, Settings, Shape,
    Sphere, SphereId, World, Zones,
};
use common::{G, Numbers, vec, world};

/// Rounding of some events, relative.
const ROUNDING: f64 = 1e-12;

const RADIUS: f64 = 0.03;

fn assert_close(value: f64, expected: f64, tolerance: f64) {
    assert!((value - expected).abs() <= tolerance, "{value} instead of {expected}");
}

fn assert_vectors_close(value: DVec3, expected: DVec3, tolerance: f64) {
    assert!((value - expected).length() <= tolerance, "{value} instead of {expected}");
}

/// A level floor at y = 0 under gravity.
fn on_floor(friction: impl Into<Friction>) -> World {
    on_floor_under(vec(0.0, -G, 0.0), friction)
}

/// A floor at y = 0 under any gravity: an incline, seen from one that is tilted with it.
fn on_floor_under(gravity: DVec3, friction: impl Into<Friction>) -> World {
    let mut world = world(Exact::default());
    world.add_force(Gravity::new(gravity)).unwrap();
    let floor = Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO)).with_restitution(0.0);
    world.add_collider(floor.with_friction(friction)).unwrap();
    world
}

/// A ball that touches the floor.
fn ball(velocity: DVec3, angular_velocity: DVec3) -> Sphere {
    let sphere = Sphere::new(vec(0.0, RADIUS, 0.0), RADIUS).with_velocity(velocity);
    sphere.with_angular_velocity(angular_velocity)
}

/// The ball after a time \[s\].
fn after(world: &mut World, id: SphereId, time: f64) -> Sphere {
    world.step(time - world.time()).unwrap();
    assert!(!world.was_stepped(), "it was stepped");
    world.sphere(id).unwrap()
}

/// Velocity of the point of a ball that touches the floor.
fn slip(ball: &Sphere) -> DVec3 {
    ball.velocity.with_y(0.0) + ball.angular_velocity.cross(vec(0.0, -ball.radius, 0.0))
}

#[test]
fn a_sliding_ball_rolls_with_five_sevenths_of_its_speed_after_two_v_by_seven_mu_g() {
    // Coriolis, "Théorie mathématique des effets du jeu de billard" (1835).
    let (v0, mu) = (3.0, 0.2);
    let mut world = on_floor(mu);
    let id = world.add_sphere(ball(v0 * DVec3::X, DVec3::ZERO)).unwrap();
    let rolls_at = 2.0 * v0 / (7.0 * mu * G);
    let half = after(&mut world, id, 0.5 * rolls_at);
    let t = 0.5 * rolls_at;
    let expected = v0 * t - 0.5 * mu * G * t * t;
    assert_close(half.position.x, expected, ROUNDING);
    assert_close(half.velocity.x, v0 - mu * G * 0.5 * rolls_at, ROUNDING * v0);
    let rolling = after(&mut world, id, rolls_at + 1.0);
    assert_close(rolling.velocity.x, 5.0 / 7.0 * v0, ROUNDING * v0);
    assert_close(rolling.angular_velocity.z, -5.0 / 7.0 * v0 / RADIUS, ROUNDING * v0 / RADIUS);
    let slides_to = 12.0 * v0 * v0 / (49.0 * mu * G);
    assert_close(rolling.position.x, slides_to + 5.0 / 7.0 * v0, 4.0 * ROUNDING);
}

#[test]
fn a_draw_shot_comes_back_rolling() {
    // Angular momentum about the floor is kept: v = 5/7 v0 + 2/7 r w0.
    let (v0, w0, mu) = (1.0, 150.0, 0.2);
    let mut world = on_floor(mu);
    let id = world.add_sphere(ball(v0 * DVec3::X, w0 * DVec3::Z)).unwrap();
    let back = after(&mut world, id, 3.0);
    assert_close(back.velocity.x, 5.0 / 7.0 * v0 - 2.0 / 7.0 * RADIUS * w0, ROUNDING * v0);
    assert!(back.velocity.x < 0.0);
}

#[test]
fn a_masse_shot_follows_a_parabola_and_then_a_straight_line() {
    let (velocity, spin, mu) = (vec(1.5, 0.0, 0.0), vec(60.0, 25.0, 90.0), 0.2);
    let mut world = on_floor(mu);
    let shot = ball(velocity, spin);
    let (s0, id) = (slip(&shot), world.add_sphere(shot).unwrap());
    let rolls_at = 2.0 * s0.length() / (7.0 * mu * G);
    let middle = after(&mut world, id, 0.4 * rolls_at);
    let t = 0.4 * rolls_at;
    let path = velocity * t - 0.5 * mu * G * t * t * s0.normalize();
    assert_vectors_close(middle.position - shot.position, path, ROUNDING);
    let rolling = after(&mut world, id, rolls_at + 0.5);
    let v = velocity - 2.0 / 7.0 * s0;
    assert_vectors_close(rolling.velocity, v, 10.0 * ROUNDING);
    let path = velocity * rolls_at - 0.5 * mu * G * rolls_at * rolls_at * s0.normalize();
    assert_vectors_close(rolling.position - shot.position, path + 0.5 * v, 10.0 * ROUNDING);
    assert_close(rolling.angular_velocity.y, 25.0, ROUNDING * 25.0);
    assert_close(slip(&rolling).length(), 0.0, ROUNDING);
}

#[test]
fn rolling_friction_stops_a_ball_where_its_energy_is_spent() {
    let (v0, rolling) = (1.0, 0.01);
    let mut world = on_floor(Friction::sliding(0.5).with_rolling(rolling));
    let id = world.add_sphere(ball(v0 * DVec3::X, -v0 / RADIUS * DVec3::Z)).unwrap();
    let deceleration = 5.0 / 7.0 * rolling * G;
    let moving = after(&mut world, id, 5.0);
    assert_close(moving.velocity.x, v0 - 5.0 * deceleration, ROUNDING);
    let resting = after(&mut world, id, 100.0);
    assert_eq!((resting.velocity, resting.angular_velocity), (DVec3::ZERO, DVec3::ZERO));
    assert_close(resting.position.x, v0 * v0 / (2.0 * deceleration), 10.0 * ROUNDING);
}

#[test]
fn spinning_friction_stops_a_ball_that_spins_on_the_spot() {
    let (w0, spinning) = (80.0, 0.04);
    let mut world = on_floor(Friction::sliding(0.3).with_spinning(spinning));
    let id = world.add_sphere(ball(DVec3::ZERO, w0 * DVec3::Y)).unwrap();
    let deceleration = 2.5 * spinning * G / RADIUS;
    let turning = after(&mut world, id, 1.0);
    assert_close(turning.angular_velocity.y, w0 - deceleration, ROUNDING * w0);
    assert_eq!(turning.position, vec(0.0, RADIUS, 0.0));
    let angle = w0 - 0.5 * deceleration;
    let (sine, cosine) = libm::sincos(0.5 * angle);
    let q = turning.orientation;
    assert_close((q.y * cosine - q.w * sine).abs(), 0.0, 1e-10);
    assert_eq!(after(&mut world, id, 10.0).angular_velocity, DVec3::ZERO);
}

#[test]
fn a_ball_on_an_incline_rolls_while_friction_suffices_and_slides_else() {
    for (mu, steepness) in [(0.5, 0.5), (0.16, 0.5), (0.1, 0.5)] {
        let (sine, cosine) = libm::sincos(steepness);
        let mut world = on_floor_under(vec(G * sine, -G * cosine, 0.0), mu);
        let id = world.add_sphere(ball(DVec3::ZERO, DVec3::ZERO)).unwrap();
        let down = after(&mut world, id, 2.0);
        let rolls = sine / cosine <= 3.5 * mu;
        let acceleration = if rolls { 5.0 / 7.0 * sine } else { sine - mu * cosine } * G;
        assert_close(down.velocity.x, 2.0 * acceleration, ROUNDING * down.velocity.x);
        assert_close(down.position.x, 2.0 * acceleration, ROUNDING * down.position.x);
    }
}

#[test]
fn a_ball_stays_on_an_incline_that_rolling_friction_holds() {
    let steepness: f64 = 0.01;
    let (sine, cosine) = libm::sincos(steepness);
    let friction = Friction::sliding(0.5).with_rolling(0.011);
    let mut world = on_floor_under(vec(G * sine, -G * cosine, 0.0), friction);
    let id = world.add_sphere(ball(DVec3::ZERO, DVec3::ZERO)).unwrap();
    assert_eq!(after(&mut world, id, 10.0).position, vec(0.0, RADIUS, 0.0));
    let rolled = world
        .add_sphere(ball(vec(0.0, 0.0, 0.2), DVec3::ZERO).with_position(vec(1.0, RADIUS, 0.0)))
        .unwrap();
    let stopped = after(&mut world, rolled, 60.0);
    assert_eq!(stopped.velocity, DVec3::ZERO);
    assert!(stopped.position.x > 1.0 && stopped.position.z > 0.0);
}

#[test]
fn a_ball_that_slides_across_an_incline_comes_to_roll_when_the_closed_form_says() {
    // The slip |s| (c + p cos) falls steadily, with the pull p and c = 7/2 mu g.
    let (mu, pull) = (0.3, 2.0);
    let mut world = on_floor_under(vec(pull, -G, 0.0), mu);
    let shot = ball(vec(-0.4, 0.0, 2.0), vec(10.0, 0.0, 5.0));
    let (s0, id) = (slip(&shot), world.add_sphere(shot).unwrap());
    let c = 3.5 * mu * G;
    let rolls_at = (c * s0.length() + s0.x * pull) / (c * c - pull * pull);
    let rolling = after(&mut world, id, rolls_at);
    assert_close(slip(&rolling).length(), 0.0, 1e-9);
    let q = shot.velocity - 2.0 / 7.0 * s0 + 5.0 / 7.0 * pull * rolls_at * DVec3::X;
    assert_vectors_close(rolling.velocity, q, 1e-9);
    assert_close(rolling.position.y, RADIUS, ROUNDING);
}

#[test]
fn a_superball_turns_its_slip_round_and_keeps_its_energy() {
    // Garwin, Am. J. Phys. 37, 88 (1969).
    let friction = Friction::sliding(100.0).with_tangential_restitution(1.0);
    let mut world = world(Exact::default());
    let floor = Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO)).with_friction(friction);
    world.add_collider(floor).unwrap();
    let shot = ball(vec(2.0, -3.0, 1.0), vec(4.0, 7.0, -20.0)).with_position(vec(0.0, 0.3, 0.0));
    let id = world.add_sphere(shot).unwrap();
    let energy = world.kinetic_energy();
    let report = world.step(0.5).unwrap();
    assert_eq!(report.impacts.len(), 1);
    assert!(report.groups[0].energy_error() < 1e-14 && report.groups[0].momentum_error() < 1e-14);
    let up = world.sphere(id).unwrap();
    assert_vectors_close(slip(&up), -slip(&shot), ROUNDING * slip(&shot).length());
    assert_close(world.kinetic_energy(), energy, ROUNDING * energy);
    assert_close(up.angular_velocity.y, 7.0, ROUNDING);
}

#[test]
fn an_oblique_bounce_is_that_of_a_rigid_ball() {
    // Chung and Ooi, Granular Matter 13, 643 (2011), test 4: e_t and spin of rigid Coulomb friction.
    for (degrees, tangential, spin) in
        [(45.0_f64, 0.8178, 502.3), (60.0, 0.8948, 355.2), (75.0, 0.9512, 183.9)]
    {
        let mut world = world(Exact::default());
        let plate = Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO)).with_restitution(0.98);
        world.add_collider(plate.with_friction(0.092)).unwrap();
        let (sine, cosine) = libm::sincos(degrees.to_radians());
        let ball = Sphere::new(vec(0.0, 0.01, 0.0), 0.0025)
            .with_density(4000.0)
            .with_velocity(3.9 * vec(sine, -cosine, 0.0));
        let id = world.add_sphere(ball).unwrap();
        let up = after(&mut world, id, 0.1);
        assert_close(up.velocity.x / ball.velocity.x, tangential, 5e-5);
        assert_close(up.angular_velocity.length(), spin, 0.05);
    }
}

#[test]
fn two_spinning_balls_keep_momentum_and_lose_what_walton_says() {
    let mut numbers = Numbers(7);
    for _ in 0..200 {
        let mut world = world(Exact::default());
        let friction = Friction::sliding(numbers.between(0.0, 1.0))
            .with_tangential_restitution(numbers.between(0.0, 1.0));
        let mut add = |x: f64, towards: f64| {
            let sphere = Sphere::new(vec(x, 0.0, 0.0), numbers.between(0.2, 0.6))
                .with_velocity(towards * DVec3::X + 0.1 * numbers.vector())
                .with_angular_velocity(9.0 * numbers.vector())
                .with_mass(numbers.between(0.1, 10.0))
                .with_restitution(numbers.next())
                .with_inertia_factor(numbers.between(0.1, 0.7))
                .with_friction(friction);
            world.add_sphere(sphere).unwrap()
        };
        let ids = [add(-1.0, 1.0), add(1.0, -1.0)];
        let (momentum, angular) = (world.momentum(), world.angular_momentum());
        let report = world.step(2.0).unwrap();
        assert_eq!(report.impacts.len(), 1);
        assert!(report.groups[0].energy_error() < 1e-13);
        assert!(report.groups[0].energy_demanded <= 0.0);
        assert!(ids.iter().all(|&id| world.sphere(id).is_ok()));
        assert_vectors_close(world.momentum(), momentum, 1e-13 * 20.0);
        assert_vectors_close(world.angular_momentum(), angular, 1e-13 * 100.0);
    }
}

#[test]
fn a_break_of_touching_balls_loses_energy_and_no_momentum() {
    let mut world = on_floor(Friction::sliding(0.2).with_rolling(0.01));
    let friction = Friction::sliding(0.05);
    let rack = |row: u32, place: u32| {
        let side = f64::from(place) - 0.5 * f64::from(row);
        vec(1.0 + f64::from(row) * RADIUS * 3f64.sqrt(), RADIUS, 2.0 * side * RADIUS)
    };
    for (row, place) in (0..5).flat_map(|row| (0..=row).map(move |place| (row, place))) {
        let ball = Sphere::new(rack(row, place), RADIUS).with_restitution(0.95);
        world.add_sphere(ball.with_friction(friction)).unwrap();
    }
    let cue = ball(8.0 * DVec3::X, -8.0 / RADIUS * DVec3::Z).with_friction(friction);
    world.add_sphere(cue.with_restitution(0.95)).unwrap();
    let mut last = world.kinetic_energy() + world.potential_energy();
    for _ in 0..600 {
        world.step(1.0 / 60.0).unwrap();
        let energy = world.kinetic_energy() + world.potential_energy();
        assert!(energy <= last * (1.0 + 1e-12), "energy went from {last} to {energy}");
        last = energy;
    }
    assert!(!world.was_stepped());
    assert!(world.overlaps(1e-12).is_empty());
    let fastest =
        |world: &World| world.spheres().velocities().iter().map(|v| v.length()).fold(0.0, f64::max);
    for _ in 0..100 {
        world.step(1.0).unwrap();
    }
    assert_eq!(fastest(&world), 0.0);
}

#[test]
fn what_friction_holds_in_a_corner_is_stepped_and_comes_to_rest() {
    let mut world = on_floor_under(vec(2.0, -G, 0.5), 0.3);
    let wall = Pose::at(vec(0.5, 0.0, 0.0)).rotated(carom::DQuat::from_rotation_z(FRAC_PI_2));
    world.add_collider(Collider::new(Shape::HalfSpace, wall).with_restitution(0.5)).unwrap();
    let id = world.add_sphere(ball(vec(1.0, 0.0, 0.3), DVec3::ZERO)).unwrap();
    for _ in 0..180 {
        world.step(1.0 / 60.0).unwrap();
    }
    assert!(world.was_stepped());
    let ball = world.sphere(id).unwrap();
    assert_close(ball.position.x, 0.5 - RADIUS, 1e-3 * RADIUS);
    assert_close(ball.position.y, RADIUS, 1e-3 * RADIUS);
}

#[test]
fn a_pyramid_of_balls_with_friction_stands() {
    let mut world = on_floor(0.5);
    for x in [-1.0, 1.0] {
        let place = vec(x * RADIUS, RADIUS, 0.0);
        world
            .add_sphere(Sphere::new(place, RADIUS).with_friction(0.5).with_restitution(0.0))
            .unwrap();
    }
    let top = vec(0.0, (1.0 + 3f64.sqrt()) * RADIUS, 0.0);
    let id = world
        .add_sphere(Sphere::new(top, RADIUS).with_friction(0.5).with_restitution(0.0))
        .unwrap();
    for _ in 0..180 {
        world.step(1.0 / 60.0).unwrap();
    }
    assert_vectors_close(world.sphere(id).unwrap().position, top, 0.01 * RADIUS);
}

#[test]
fn frames_do_not_change_what_rolls() {
    let run = |frames: u32| {
        let mut world =
            on_floor_under(vec(1.0, -G, 0.2), Friction::sliding(0.2).with_rolling(0.02));
        let mut numbers = Numbers(3);
        for i in 0..6 {
            let place = vec(0.2 * f64::from(i), RADIUS + 0.1 * numbers.next(), 0.0);
            let sphere = ball(numbers.vector(), 40.0 * numbers.vector()).with_position(place);
            world.add_sphere(sphere.with_friction(0.1).with_restitution(0.8)).unwrap();
        }
        (0..frames).for_each(|_| world.step(2.0 / f64::from(frames)).map(|_| ()).unwrap());
        let spheres = world.spheres();
        (spheres.positions().to_vec(), spheres.angular_velocities().to_vec())
    };
    assert!(run(1) == run(16) && run(16) == run(256));
}

#[test]
fn without_zones_what_has_no_closed_form_is_an_error() {
    let settings = Settings::default().with_rule(Exact::default().with_zones(Zones::Never));
    let mut world = World::new(settings).unwrap();
    world.add_force(Gravity::new(vec(0.0, -G, 0.0))).unwrap();
    let floor = Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO)).with_friction(0.5);
    world.add_collider(floor.with_restitution(0.0)).unwrap();
    let lower = ball(DVec3::ZERO, DVec3::ZERO);
    world.add_sphere(lower.with_restitution(0.0)).unwrap();
    let upper = lower.with_position(vec(0.001, 0.2, 0.0)).with_restitution(0.0);
    world.add_sphere(upper.with_friction(0.5)).unwrap();
    let before = world.time();
    let refused = (0..100).find_map(|_| world.step(0.1).err());
    assert!(matches!(refused, Some(Error::NeedsZone { .. })), "{refused:?}");
    assert!(world.time() > before);
}

#[test]
fn in_a_periodic_box_what_has_no_closed_form_is_stepped() {
    // A ball on another one, across a face: it rolls off and comes to rest on the floor.
    let boundary = Boundary::Periodic { size: vec(0.6, f64::INFINITY, 0.6) };
    let mut world = World::new(Settings::default().with_boundary(boundary)).unwrap();
    world.add_force(Gravity::new(vec(0.0, -G, 0.0))).unwrap();
    let floor = Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO)).with_friction(0.5);
    world.add_collider(floor.with_restitution(0.0)).unwrap();
    let lower = ball(DVec3::ZERO, DVec3::ZERO).with_friction(0.5).with_restitution(0.0);
    world.add_sphere(lower.with_position(vec(0.3, RADIUS, 0.3))).unwrap();
    world.add_sphere(lower.with_position(vec(-0.299, 3.0 * RADIUS, 0.3))).unwrap();
    (0..40).for_each(|_| world.step(0.1).map(|_| ()).unwrap());
    assert!(world.was_stepped());
    for position in world.spheres().positions() {
        // The slop that is left of an overlap.
        assert_close(position.y, RADIUS, 1e-3 * RADIUS);
    }
}

#[test]
fn a_snapshot_goes_on_with_the_same_bits() {
    let mut world = on_floor(Friction::sliding(0.2).with_rolling(0.01).with_spinning(0.04));
    world.add_sphere(ball(vec(1.0, 0.0, 0.5), vec(30.0, 40.0, 60.0))).unwrap();
    let other = ball(vec(-1.0, 0.0, 0.0), DVec3::ZERO).with_position(vec(1.5, RADIUS, 0.2));
    world.add_sphere(other.with_friction(0.1)).unwrap();
    let run = |world: &mut World| {
        (0..50).for_each(|_| world.step(0.013).map(|_| ()).unwrap());
        world.state_hash()
    };
    world.step(0.1).unwrap();
    let snapshot = world.snapshot();
    let first = run(&mut world);
    world.restore(&snapshot);
    assert_eq!(run(&mut world), first);
}

#[test]
fn what_is_emitted_rolls_and_leaves_the_others_as_they_are() {
    let hash = |frames: u32| {
        let mut world = on_floor(Friction::sliding(0.2).with_rolling(0.01));
        world.add_sphere(ball(vec(1.0, 0.0, 0.5), vec(30.0, 40.0, 60.0))).unwrap();
        let emitted = ball(vec(0.0, 0.0, 1.0), 20.0 * DVec3::X).with_position(vec(-1.0, 0.2, 0.0));
        let emitter = Emitter::new(emitted.with_restitution(0.0), 0.3).with_max_spheres(Some(4));
        world.add_emitter(emitter).unwrap();
        (0..frames).for_each(|_| world.step(2.0 / f64::from(frames)).map(|_| ()).unwrap());
        let spheres = world.spheres();
        let first = spheres.get(0);
        assert!(spheres.angular_velocities().iter().all(|spin| spin.length() > 1.0));
        ([first.position, first.velocity, first.angular_velocity], spheres.positions().to_vec())
    };
    let alone = {
        let mut world = on_floor(Friction::sliding(0.2).with_rolling(0.01));
        let id = world.add_sphere(ball(vec(1.0, 0.0, 0.5), vec(30.0, 40.0, 60.0))).unwrap();
        after(&mut world, id, 2.0)
    };
    let [position, velocity, spin] = hash(8).0;
    assert_vectors_close(position, alone.position, 1e-9);
    assert_vectors_close(velocity, alone.velocity, 1e-9);
    assert_vectors_close(spin, alone.angular_velocity, 1e-7);
    assert!(hash(8) == hash(128));
}

#[test]
fn a_contact_tells_its_friction() {
    let mu = 0.2;
    let mut world = on_floor(mu);
    let id = world.add_sphere(ball(DVec3::X, DVec3::ZERO)).unwrap();
    world.step(1e-3).unwrap();
    let contact = world.contacts()[0];
    assert!(contact.is_sliding);
    assert_close(contact.normal_force, G, ROUNDING);
    assert_vectors_close(contact.tangential_force, -mu * G * DVec3::X, ROUNDING);
    after(&mut world, id, 1.0);
    let contact = world.contacts()[0];
    assert!(!contact.is_sliding && contact.tangential_force == DVec3::ZERO);
}

#[test]
fn friction_in_a_group_of_impacts_takes_energy_and_keeps_momentum() {
    let mut numbers = Numbers(11);
    for _ in 0..100 {
        let mut world = world(Exact::default());
        let mu = numbers.between(0.0, 1.0);
        let beta = numbers.next();
        // A ball hits four that touch it at once, each spinning.
        for place in [vec(1.0, 1.0, 0.0), vec(1.0, -1.0, 0.0), vec(1.0, 0.0, 1.0)] {
            let sphere = Sphere::new(place.normalize() * 0.4, 0.2)
                .with_angular_velocity(10.0 * numbers.vector())
                .with_velocity(-0.2 * place)
                .with_mass(numbers.between(0.5, 2.0))
                .with_restitution(numbers.next())
                .with_friction(Friction::sliding(mu).with_tangential_restitution(beta));
            world.add_sphere(sphere).unwrap();
        }
        let hit = Sphere::new(DVec3::ZERO, 0.2).with_velocity(2.0 * DVec3::X);
        world.add_sphere(hit.with_angular_velocity(20.0 * numbers.vector())).unwrap();
        let (momentum, angular) = (world.momentum(), world.angular_momentum());
        let energy = world.kinetic_energy();
        let report = world.step(0.01).unwrap();
        assert!(report.groups[0].count >= 3);
        assert!(report.groups.iter().all(|group| group.energy_error() < 1e-12));
        assert!(world.kinetic_energy() <= energy * (1.0 + 1e-13));
        assert_vectors_close(world.momentum(), momentum, 1e-12);
        assert_vectors_close(world.angular_momentum(), angular, 1e-12);
    }
}

#[test]
fn what_friction_presses_together_is_stepped_at_once() {
    let mut world = on_floor(0.3);
    let shape = Shape::Box { size: vec(0.1, 1.0, 2.0) };
    let pusher = Collider::new(shape, Pose::at(vec(-0.3, 0.5, 0.0))).with_restitution(0.0);
    world.add_collider(pusher.moving(vec(0.5, 0.0, 0.0), DVec3::ZERO)).unwrap();
    let id = world.add_sphere(ball(DVec3::ZERO, DVec3::ZERO)).unwrap();
    let mut impacts = 0;
    while world.time() < 3.0 {
        impacts += world.step(1.0 / 60.0).unwrap().impacts.len();
    }
    assert!(impacts < 10, "{impacts} impacts");
    let ball = world.sphere(id).unwrap();
    assert_close(ball.velocity.x, 0.5, 1e-3);
    assert_close(ball.angular_velocity.z, -0.5 / RADIUS, 1e-2 / RADIUS);
}
