//! The rule `exact` through what it does to spheres. Proves that frames, cells and insertion order
//! leave no trace, that contacts last and end as mechanics says, and that walls move, boxes repeat
//! and forces act as they say. It proves nothing about speed.

#[path = "../common/mod.rs"]
mod common;
mod moving_colliders;
mod periodic_box;

use carom::{
    BodyPair, Boundary, Collider, DQuat, DVec3, Emitter, Error, Exact, Force, Gravity, Pose, Rule,
    Settings, Shape, Sphere, SphereId, SphereState, ViscousDrag, World, Zones,
};
use common::{G, Numbers, assert_close, assert_close_vec, vec, world};

fn exact() -> World {
    world(Rule::default())
}

fn under_gravity() -> World {
    let mut world = exact();
    world.add_force(Gravity::new(vec(0.0, -G, 0.0))).unwrap();
    world
}

fn half_space(world: &mut World, point: DVec3, normal: DVec3, restitution: f64) {
    let pose = Pose::at(point).rotated(DQuat::from_rotation_arc(DVec3::Y, normal));
    let wall = Collider::new(Shape::HalfSpace, pose).with_restitution(restitution);
    world.add_collider(wall).unwrap();
}

/// Forty balls of many sizes fall through pegs onto a floor.
fn bustle(order: &[usize]) -> World {
    let mut numbers = Numbers(5);
    let mut world = under_gravity();
    half_space(&mut world, DVec3::ZERO, DVec3::Y, 0.8);
    for x in -2..=2 {
        let peg = Shape::Sphere { radius: 0.3 };
        let pose = Pose::at(vec(x.into(), 2.0, 0.1 * f64::from(x)));
        world.add_collider(Collider::new(peg, pose).with_restitution(0.9)).unwrap();
    }
    let balls: Vec<Sphere> = (0..40u32)
        .map(|i| {
            let place =
                vec(f64::from(i % 8) - 3.5, 3.5 + f64::from(i / 8), numbers.between(-0.1, 0.1));
            let ball = Sphere::new(place, numbers.between(0.1, 0.45)).with_density(1000.0);
            ball.with_velocity(numbers.vector()).with_restitution(0.95)
        })
        .collect();
    for &i in order {
        world.add_sphere(balls[i]).unwrap();
    }
    world
}

fn run(world: &mut World, frame: f64, frames: usize) -> usize {
    (0..frames).map(|_| world.step(frame).unwrap().impacts.len()).sum()
}

#[test]
fn frames_leave_no_trace_in_a_single_bit() {
    let order: Vec<usize> = (0..40).collect();
    // Powers of two, so that the clock adds up without rounding.
    let [coarse, fine, single] = [(1.0 / 32.0, 96), (1.0 / 256.0, 768), (3.0, 1)].map(|(h, n)| {
        let mut world = bustle(&order);
        let impacts = run(&mut world, h, n);
        (impacts, world.state_hash())
    });
    assert!(coarse.0 > 100, "{}", coarse.0);
    assert_eq!(coarse, fine);
    assert_eq!(coarse, single);
}

#[test]
fn the_order_in_which_spheres_came_leaves_no_trace() {
    let order: Vec<usize> = (0..40).collect();
    // 27 and 40 have no common factor: every ball comes once.
    let shuffled: Vec<usize> = (0..40).map(|i| i * 27 % 40).collect();
    let (mut first, mut second) = (bustle(&order), bustle(&shuffled));
    assert_eq!(run(&mut first, 1.0 / 64.0, 128), run(&mut second, 1.0 / 64.0, 128));
    for (place, &i) in shuffled.iter().enumerate() {
        assert_eq!(first.spheres().positions()[i], second.spheres().positions()[place]);
        assert_eq!(first.spheres().velocities()[i], second.spheres().velocities()[place]);
    }
}

#[test]
fn a_bouncing_ball_comes_to_rest_at_the_sum_of_its_flights() {
    for e in [0.3, 0.8, 0.95] {
        let mut world = under_gravity();
        half_space(&mut world, DVec3::ZERO, DVec3::Y, e);
        let ball = world.add_sphere(Sphere::new(vec(0.0, 2.5, 0.0), 0.5)).unwrap();
        let rest = (2.0 * 2.0 / G).sqrt() * (1.0 + e) / (1.0 - e);
        let mut last = 0.0;
        while world.time() < rest + 1.0 {
            let start = world.time();
            let report = world.step(0.25).unwrap();
            last = report.impacts.last().map_or(last, |impact| start + impact.time);
        }
        // The bounces shorter than the duration of a contact are left out: those no higher than 256
        // roundings of the coordinates, half a metre, and the radius.
        let contact_duration = (8.0 * 256.0 * f64::EPSILON * (0.5 + 0.5) / G).sqrt();
        assert_close(last, rest, 1.1 * contact_duration / (1.0 - e));
        assert_eq!(world.sphere(ball).unwrap().velocity, DVec3::ZERO);
        assert_close(world.sphere(ball).unwrap().position.y, 0.5, 1e-14);
    }
}

#[test]
fn a_ball_slides_down_a_ramp_as_if_there_were_no_third_dimension() {
    let angle: f64 = 0.3;
    let (sine, cosine) = (libm::sin(angle), libm::cos(angle));
    let mut world = under_gravity();
    let normal = vec(sine, cosine, 0.0);
    half_space(&mut world, DVec3::ZERO, normal, 0.5);
    let ball = world.add_sphere(Sphere::new(0.25 * normal, 0.25)).unwrap();
    assert_eq!(run(&mut world, 0.1, 20), 0);
    // g sin a along the ramp, to the rounding of some hundred operations on tens of metres.
    let along = 0.5 * G * sine * 4.0;
    let end = world.sphere(ball).unwrap();
    assert_close_vec(end.position, 0.25 * normal + along * vec(cosine, -sine, 0.0), 1e-13);
    assert_close(end.velocity.length(), G * sine * 2.0, 1e-13);
}

#[test]
fn a_ball_that_slides_off_a_plate_flies_on_and_lands_where_a_parabola_does() {
    let mut world = under_gravity();
    let plate = Shape::Rectangle { size_x: 2.0, size_z: 2.0 };
    world.add_collider(Collider::new(plate, Pose::at(vec(0.0, 5.0, 0.0)))).unwrap();
    half_space(&mut world, DVec3::ZERO, DVec3::Y, 0.0);
    let (radius, speed) = (0.1, 3.0);
    let ball = Sphere::new(vec(0.0, 5.0 + radius, 0.0), radius).with_velocity(vec(speed, 0.0, 0.0));
    let ball = world.add_sphere(ball).unwrap();
    // Faster than sqrt(g r), it leaves the edge at once.
    let fall = (2.0 * 5.0 / G).sqrt();
    let landing = 1.0 / speed + fall;
    run(&mut world, landing / 100.0, 101);
    let end = world.sphere(ball).unwrap();
    assert_close(end.position.y, radius, 1e-12);
    assert_close(end.velocity.x, speed, 1e-12);
    assert_close(end.position.x, speed * world.time(), 1e-12);
}

#[test]
fn a_ball_leaves_a_fixed_sphere_two_thirds_of_the_way_down() {
    let (radius, ball_radius, start): (f64, f64, f64) = (1.0, 0.2, 0.05);
    let mut world = under_gravity();
    let dome = Collider::new(Shape::Sphere { radius }, Pose::at(DVec3::ZERO));
    world.add_collider(dome.with_restitution(0.0)).unwrap();
    let distance = radius + ball_radius;
    let place = distance * vec(libm::sin(start), libm::cos(start), 0.0);
    let ball = world.add_sphere(Sphere::new(place, ball_radius)).unwrap();
    // In flight the horizontal velocity is constant: it tells the height at which it left, for
    // v² = 2 g d (cos a - y) with v_x = v y and y = 2/3 cos a.
    run(&mut world, 0.01, 400);
    let y = 2.0 / 3.0 * libm::cos(start);
    let expected = y * (2.0 * G * distance * (libm::cos(start) - y)).sqrt();
    // Forces are computed every 1e-3 rad: errors of the second order in it, over one radian.
    assert_close(world.sphere(ball).unwrap().velocity.x, expected, 1e-5 * expected);
}

#[test]
fn stacks_rest_without_any_speed_whatever_their_restitution() {
    for e in [0.0, 0.4, 1.0] {
        let mut world = under_gravity();
        half_space(&mut world, DVec3::ZERO, DVec3::Y, e);
        for i in 0..12 {
            let ball = Sphere::new(vec(0.0, 0.5 + f64::from(i), 0.0), 0.5);
            world.add_sphere(ball.with_restitution(e).with_mass(1.0 + f64::from(i % 3))).unwrap();
        }
        assert_eq!(run(&mut world, 0.02, 500), 0);
        assert!(world.spheres().velocities().iter().all(|&v| v == DVec3::ZERO));
        assert_close(world.spheres().positions()[11].y, 11.5, 1e-13);
    }
}

#[test]
fn a_shot_stack_falls_apart_and_keeps_its_momentum_across() {
    let mut world = under_gravity();
    half_space(&mut world, DVec3::ZERO, DVec3::Y, 0.0);
    for i in 0..5 {
        world.add_sphere(Sphere::new(vec(0.0, 0.5 + f64::from(i), 0.0), 0.5)).unwrap();
    }
    let shot = Sphere::new(vec(-5.0, 2.6, 0.0), 0.5).with_velocity(vec(20.0, 3.0, 0.0));
    world.add_sphere(shot).unwrap();
    assert!(run(&mut world, 1.0 / 60.0, 300) > 1);
    // Nothing but the shot moves along x, and no force acts that way.
    assert_close(world.momentum().x, 20.0, 1e-11);
    assert_eq!(world.overlaps(1e-9), []);
}

#[test]
fn a_ball_shot_into_a_block_at_rest_keeps_the_clock_going_and_the_momentum_across() {
    // Spheres that roll on each other lean, open and close by next to nothing: the bound is far above
    // what they need, and far below events that come one rounding of the clock after another.
    let rule = Rule::Exact(Exact::default().with_max_impacts(20_000));
    let mut world = World::new(Settings::default().with_rule(rule)).unwrap();
    world.add_force(Gravity::new(vec(0.0, -G, 0.0))).unwrap();
    half_space(&mut world, DVec3::ZERO, DVec3::Y, 0.5);
    let ball = |place: DVec3| Sphere::new(place, 0.5).with_mass(1.0).with_restitution(0.5);
    for n in 0..8u8 {
        let corner = vec(f64::from(n & 1), f64::from(n >> 1 & 1), f64::from(n >> 2));
        world.add_sphere(ball(corner + vec(0.0, 0.5, 0.0))).unwrap();
    }
    world.add_sphere(ball(vec(-3.0, 1.1, 1.3)).with_velocity(vec(5.0, 0.0, 0.0))).unwrap();
    run(&mut world, 1.0 / 60.0, 120);
    let momentum: DVec3 = world.spheres().velocities().iter().sum();
    // Corrections of persistent contacts push both bodies alike, each time to a rounding.
    assert!((momentum.x - 5.0).abs() < 1e-9 && momentum.z.abs() < 1e-9, "{momentum}");
}

#[test]
fn spheres_a_thousand_times_as_large_meet_the_small_ones() {
    let mut numbers = Numbers(3);
    let mut world = exact();
    for normal in [DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::NEG_Y, DVec3::Z, DVec3::NEG_Z] {
        half_space(&mut world, -3.0 * normal, normal, 1.0);
    }
    world.add_sphere(Sphere::new(DVec3::ZERO, 1.0).with_mass(1e6)).unwrap();
    for i in 0..300u32 {
        let cell = vec((i % 8).into(), (i / 8 % 8).into(), (i / 64).into());
        let place = vec(-2.5, -2.5, 1.5) + cell * vec(0.6, 0.6, 0.25);
        let radius = [0.001, 0.01, 0.1][i as usize % 3];
        let ball = Sphere::new(place, radius).with_density(1000.0);
        world.add_sphere(ball.with_velocity(30.0 * numbers.vector())).unwrap();
    }
    let energy = world.kinetic_energy();
    let mut with_large = 0;
    for _ in 0..120 {
        let report = world.step(1.0 / 60.0).unwrap();
        let is_with_large = |between: &BodyPair| match between {
            BodyPair::Spheres(first, _) => first.number() == 0,
            BodyPair::Collider { .. } => false,
        };
        with_large += report.impacts.iter().filter(|it| is_with_large(&it.between)).count();
        assert_eq!(world.overlaps(1e-12), []);
    }
    assert!(with_large > 200, "{with_large}");
    assert_close(world.kinetic_energy() / energy, 1.0, 1e-12);
}

#[test]
fn three_balls_in_line_collapse_and_time_goes_on() {
    let mut world = exact();
    for (x, v) in [(-2.0, 1.0), (0.0, 0.0), (1.5, -1.0)] {
        let ball = Sphere::new(vec(x, 0.0, 0.0), 0.5).with_velocity(vec(v, 0.0, 0.0));
        world.add_sphere(ball.with_restitution(0.2)).unwrap();
    }
    let momentum = world.momentum();
    let impacts = run(&mut world, 0.1, 100);
    assert!((3..200).contains(&impacts), "{impacts}");
    assert_close_vec(world.momentum(), momentum, 1e-15);
    assert_eq!(world.overlaps(1e-12), []);
}

#[test]
fn the_ledger_accounts_for_every_impact() {
    let mut world = bustle(&(0..40).collect::<Vec<_>>());
    let mut entries = 0;
    for _ in 0..180 {
        let report = world.step(1.0 / 60.0).unwrap();
        assert_eq!(report.ledger().count(), report.impacts.len());
        for entry in report.ledger() {
            // Sums over the few bodies of a group, each term rounded once or twice.
            assert!(entry.group.momentum_error() <= 1e-14, "{entry:?}");
            assert!(entry.group.energy_error() <= 1e-13, "{entry:?}");
            assert!(entry.group.energy_after <= entry.group.energy_before * (1.0 + 1e-14));
            entries += 1;
        }
    }
    assert!(entries > 100);
}

#[test]
fn emitters_emit_within_a_frame_at_their_own_time() {
    let sphere = Sphere::new(DVec3::ZERO, 0.1).with_velocity(vec(2.0, 0.0, 0.0));
    let mut world = under_gravity();
    world.add_emitter(Emitter::new(sphere, 0.3).with_max_spheres(3)).unwrap();
    let report = world.step(1.0).unwrap();
    assert_eq!((report.emitted.len(), report.retired.len()), (4, 1));
    for (place, due) in world.spheres().positions().iter().zip([0.3, 0.6, 0.9]) {
        let age = 1.0 - due;
        assert_close_vec(*place, vec(2.0 * age, -0.5 * G * age * age, 0.0), 1e-15);
    }
}

#[test]
fn more_impacts_than_allowed_are_an_error_that_changes_nothing() {
    let rule = Rule::Exact(Exact::default().with_max_impacts(50).with_zones(Zones::Never));
    let mut world = world(rule);
    half_space(&mut world, DVec3::ZERO, DVec3::X, 1.0);
    half_space(&mut world, vec(1.0, 0.0, 0.0), DVec3::NEG_X, 1.0);
    let ball = Sphere::new(vec(0.5, 0.0, 0.0), 0.1).with_velocity(vec(1e3, 0.0, 0.0));
    let ball = world.add_sphere(ball).unwrap();
    world.step(0.01).unwrap();
    let before = (world.sphere(ball).unwrap(), world.time());
    let error = world.step(1.0).unwrap_err();
    assert!(matches!(error, Error::TooManyImpacts { limit: 50, .. }), "{error}");
    assert_eq!((world.sphere(ball).unwrap(), world.time()), before);
    assert!(world.report().impacts.is_empty());
    world.step(0.01).unwrap();
}

/// A spring of 1 N/m to the origin.
#[derive(Debug)]
struct Spring;

impl Force for Spring {
    fn on(&self, sphere: &SphereState, _time: f64) -> DVec3 {
        -sphere.position
    }
}

/// A world with a ball that the spring lets swing from 1 m.
fn on_spring() -> (World, SphereId) {
    let mut world = exact();
    world.add_force(Spring).unwrap();
    let ball = world.add_sphere(Sphere::new(DVec3::X, 0.1)).unwrap();
    (world, ball)
}

#[test]
fn a_force_of_its_own_is_followed_to_rounding() {
    let (mut world, ball) = on_spring();
    run(&mut world, 0.01, 100);
    // A few steps, with a few roundings each.
    let position = world.sphere(ball).unwrap().position;
    assert_close_vec(position, vec(libm::cos(1.0), 0.0, 0.0), 1e-14);
}

#[test]
fn a_force_of_its_own_acts_on_while_others_come() {
    let (mut world, ball) = on_spring();
    let far = vec(0.0, 50.0, 0.0);
    let emitter = Emitter::new(Sphere::new(DVec3::ZERO, 0.1), 0.003).with_position(far);
    world.add_emitter(emitter.with_max_spheres(1)).unwrap();
    run(&mut world, 0.01, 100);
    // As without the emitter.
    let position = world.sphere(ball).unwrap().position;
    assert_close_vec(position, vec(libm::cos(1.0), 0.0, 0.0), 1e-14);
}

#[test]
fn restitution_is_that_of_the_first_impact_under_a_force_of_its_own_too() {
    let mut world = exact();
    world.add_force(Spring).unwrap();
    half_space(&mut world, vec(0.0, -1e-12, 0.0), DVec3::Y, 0.5);
    let ball = Sphere::new(vec(0.0, 0.1, 0.0), 0.1).with_velocity(vec(0.0, -1.0, 0.0));
    let ball = world.add_sphere(ball).unwrap();
    world.step(1e-6).unwrap();
    // The spring changes the speed by some 1e-7 m/s.
    assert_close(world.sphere(ball).unwrap().velocity.y, 0.5, 1e-6);
}

#[test]
fn plastic_impacts_far_from_the_origin_do_not_repeat_without_end() {
    let mut numbers = Numbers(11);
    for _ in 0..200 {
        let rule = Rule::Exact(Exact::default().with_max_impacts(100));
        let mut world = world(rule);
        let (place, way) = (10.0 * numbers.vector(), numbers.vector().normalize());
        let drift = numbers.vector();
        for side in [-1.0, 1.0] {
            let ball = Sphere::new(place + 0.02 * side * way, 0.01).with_restitution(0.0);
            world.add_sphere(ball.with_velocity(drift - side * way)).unwrap();
        }
        let impacts = run(&mut world, 0.1, 2);
        assert!((1..10).contains(&impacts), "{impacts}");
        let [a, b] = [0, 1].map(|index| world.spheres().velocities()[index]);
        assert_close_vec(a, b, 1e-12);
    }
}

#[test]
fn spheres_as_far_apart_as_numbers_go_do_no_harm() {
    let mut world = exact();
    for i in 0..40 {
        world.add_sphere(Sphere::new(vec(f64::from(i), 0.0, 0.0), 0.1)).unwrap();
    }
    for side in [-1.5e308, 1.5e308] {
        world.add_sphere(Sphere::new(vec(side, 0.0, 0.0), 0.1)).unwrap();
    }
    assert_eq!(run(&mut world, 0.1, 3), 0);
}

/// Three thousand spheres in a periodic box drawn to its middle: as many as threads share.
#[test]
fn the_state_is_the_same_to_the_last_bit_on_any_number_of_threads() {
    let size = DVec3::splat(16.0);
    let boundary = Boundary::Periodic { size };
    let rule = Exact::default().with_force_tick(1.0 / 16.0);
    let settings = Settings::default().with_boundary(boundary).with_rule(rule);
    let mut world = World::new(settings).unwrap();
    world.add_force(Spring).unwrap();
    let mut numbers = Numbers(3);
    for i in 0..3375 {
        let cell = vec(f64::from(i % 15), f64::from(i / 15 % 15), f64::from(i / 225));
        let place = (cell - 7.0) * (16.0 / 15.0);
        world.add_sphere(Sphere::new(place, 0.5).with_velocity(numbers.vector())).unwrap();
    }
    assert!(run(&mut world, 1.0 / 16.0, 8) > 500);
    assert_eq!(world.state_hash().to_string(), "b2c56f69a7efa737");
}

#[test]
fn with_drag_frames_leave_no_trace_either() {
    let [coarse, single] = [(1.0 / 32.0, 64), (2.0, 1)].map(|(frame, frames)| {
        let mut world = bustle(&(0..40).collect::<Vec<_>>());
        world.add_force(ViscousDrag::new(3.0)).unwrap();
        (run(&mut world, frame, frames), world.state_hash())
    });
    assert!(coarse.0 > 50, "{}", coarse.0);
    assert_eq!(coarse, single);
}
