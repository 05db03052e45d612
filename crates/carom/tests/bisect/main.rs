//! The rule `bisect`: contacts inside a frame are found, placed and answered at their own times.

// What is expected need not have the same bits everywhere.
#![allow(clippy::disallowed_methods)]

#[path = "../common/mod.rs"]
mod common;
mod winding_back;

use carom::contact_time::{self, Bisection, Probe};
use carom::{
    Bisect, Collider, DQuat, DVec3, Gravity, Integrator, Pose, Rule, Shape, Sphere, WindBack, World,
};
use common::{Numbers, assert_close, assert_close_vec, bisect, bisect_all, vec, world};

/// A unit-diameter sphere on the x axis.
fn on_axis(x: f64, velocity: f64) -> Sphere {
    Sphere::new(vec(x, 0.0, 0.0), 0.5).with_velocity(vec(velocity, 0.0, 0.0))
}

fn impact_times(world: &World) -> Vec<f64> {
    world.report().impacts.iter().map(|impact| impact.time).collect()
}

#[test]
fn halving_finds_a_time_on_a_binary_fraction_exactly() {
    for (contact, halvings) in [(0.5, 1), (0.75, 2), (0.625, 3), (1.0 / 256.0, 8)] {
        let mut probes = 0;
        let found = contact_time::bisect(1.0, 8, |t| {
            probes += 1;
            match t.total_cmp(&contact) {
                std::cmp::Ordering::Less => Probe::Before,
                std::cmp::Ordering::Equal => Probe::At,
                std::cmp::Ordering::Greater => Probe::After,
            }
        });
        assert_eq!(found, Bisection { time: contact, last: Probe::At });
        assert_eq!(probes, halvings);
    }
}

#[test]
fn halving_n_times_comes_within_h_over_two_to_the_n() {
    let mut numbers = Numbers(5);
    for _ in 0..1000 {
        let (h, halvings) = (numbers.between(0.001, 1.0), 1 + (20.0 * numbers.next()) as u32);
        let contact = h * numbers.next();
        let found = contact_time::bisect(h, halvings, |t| {
            if t < contact { Probe::Before } else { Probe::After }
        });
        assert_close(found.time, contact, h / 2f64.powi(halvings as i32));
    }
}

#[test]
fn contacts_at_a_half_and_at_three_quarters_of_a_frame_are_found_exactly() {
    for (gap, time) in [(0.5, 0.5), (0.75, 0.75)] {
        let mut world = world(bisect());
        let left = world.add_sphere(on_axis(0.0, 1.0)).unwrap();
        world.add_sphere(on_axis(1.0 + gap, 0.0)).unwrap();
        world.step(1.0).unwrap();
        assert_eq!(impact_times(&world), [time]);
        assert_eq!(world.sphere(left).unwrap().position.x, gap);
        assert_eq!(world.sphere(left).unwrap().velocity.x, 0.0);
    }
}

#[test]
fn contacts_that_no_halving_hits_are_found_within_h_over_256() {
    let mut numbers = Numbers(6);
    let h = 0.1;
    let mut checked = 0;
    while checked < 10_000 {
        let (r1, r2) = (numbers.between(0.05, 1.0), numbers.between(0.05, 1.0));
        let (m1, m2) = (numbers.between(0.1, 10.0), numbers.between(0.1, 10.0));
        // Touching at a random instant, at a random place, moving with random velocities.
        let contact_time = h * numbers.next();
        let normal = numbers.unit_vector();
        let x1 = numbers.vector();
        let x2 = x1 + (r1 + r2) * normal;
        let (v1, v2) = (numbers.vector(), numbers.vector());
        let closing = -(v2 - v1).dot(normal);
        // Spheres that overlap, and still close, at the end of the frame.
        let end = (x2 - x1) + (h - contact_time) * (v2 - v1);
        if closing <= 0.0 || end.length() >= r1 + r2 - 1e-9 || end.dot(v2 - v1) >= 0.0 {
            continue;
        }
        let mut world = world(bisect());
        let first = Sphere::new(x1 - contact_time * v1, r1).with_velocity(v1).with_mass(m1);
        let second = Sphere::new(x2 - contact_time * v2, r2).with_velocity(v2).with_mass(m2);
        world.add_sphere(first).unwrap();
        world.add_sphere(second).unwrap();
        let (energy, momentum) = (world.kinetic_energy(), world.momentum());
        world.step(h).unwrap();
        let [time] = impact_times(&world)[..] else { panic!("one impact: {:?}", world.report()) };
        assert_close(time, contact_time, h / 256.0);
        let size = m1 * v1.length() + m2 * v2.length();
        assert_close_vec(world.momentum(), momentum, 1e-13 * size);
        assert_close(world.kinetic_energy(), energy, 1e-13 * energy);
        checked += 1;
    }
}

#[test]
fn collisions_of_different_pairs_in_one_frame_happen_at_their_own_times() {
    for rule in [bisect(), bisect_all()] {
        let mut world = world(rule);
        for (y, gap) in [(0.0, 0.25), (10.0, 0.75)] {
            let left = on_axis(0.0, 1.0);
            world.add_sphere(left.with_position(left.position + vec(0.0, y, 0.0))).unwrap();
            world.add_sphere(Sphere::new(vec(1.0 + gap, y, 0.0), 0.5)).unwrap();
        }
        world.step(1.0).unwrap();
        // With every sphere wound back, the second search halves what is left after the first
        // contact: 3/4 of the frame is two thirds of that, and no halving hits it.
        let error = if rule == bisect() { 0.0 } else { 1.0 / 256.0 };
        let times = impact_times(&world);
        assert_eq!((times.len(), times[0]), (2, 0.25));
        assert_close(times[1], 0.75, error);
        let x: Vec<f64> = world.spheres().positions().iter().map(|p| p.x).collect();
        assert_eq!((x[0], x[1]), (0.25, 2.0));
        assert_close(x[2], 0.75, error);
        assert_close(x[3], 2.0, error);
    }
}

/// A light ball on its way between two large, heavy spheres 1 m from surface to surface, 3/4 m
/// from the one it flies to at 1 m/s.
fn ball_between_walls(rule: Rule) -> World {
    let mut world = world(rule);
    world.add_sphere(on_axis(0.0, 1.0).with_mass(1e-9)).unwrap();
    for x in [0.5 + 0.75 + 50.0, -0.5 - 0.25 - 50.0] {
        world.add_sphere(Sphere::new(vec(x, 0.0, 0.0), 50.0).with_mass(1e9)).unwrap();
    }
    world
}

#[test]
fn three_frames_long_enough_for_four_collisions_of_one_sphere_keep_all_four() {
    for rule in [bisect(), bisect_all()] {
        let mut world = ball_between_walls(rule);
        let mut times = Vec::new();
        for frame in 0..3 {
            world.step(1.5).unwrap();
            times.extend(impact_times(&world).iter().map(|time| 1.5 * f64::from(frame) + time));
            assert_eq!(world.report().unfinished_islands, 0);
        }
        assert_eq!(times.len(), 4, "{times:?}");
        for (i, time) in times.iter().enumerate() {
            // Each impact is placed within h/256, and so is the one before it.
            assert_close(*time, 0.75 + i as f64, (i as f64 + 1.0) * 1.5 / 256.0);
        }
    }
}

#[test]
fn one_frame_keeps_four_successive_collisions_of_one_sphere() {
    for rule in [bisect(), bisect_all()] {
        let mut world = ball_between_walls(rule);
        world.step(4.0).unwrap();
        assert_eq!(world.report().impacts.len(), 4, "{:?}", world.report());
    }
}

#[test]
fn a_sphere_bounces_on_every_kind_of_collider_inside_the_frame() {
    let shapes = [
        Shape::HalfSpace,
        Shape::Rectangle { size_x: 2.0, size_z: 2.0 },
        Shape::Sphere { radius: 1.0 },
        Shape::Box { size: vec(2.0, 2.0, 2.0) },
    ];
    for shape in shapes {
        let top = match shape {
            Shape::Sphere { .. } | Shape::Box { .. } => -1.0,
            _ => 0.0,
        };
        let mut world = world(bisect());
        let collider =
            Collider::new(shape.clone(), Pose::at(vec(0.0, top, 0.0))).with_restitution(0.5);
        world.add_collider(collider).unwrap();
        let ball = Sphere::new(vec(0.0, 1.0, 0.0), 0.5).with_velocity(vec(0.0, -0.5 / 0.75, 0.0));
        let ball = world.add_sphere(ball).unwrap();
        world.step(1.0).unwrap();
        assert_eq!(impact_times(&world), [0.75], "{shape:?}");
        let after = world.sphere(ball).unwrap();
        assert_close(after.velocity.y, 0.25 / 0.75, 1e-15);
        assert_close(after.position.y, 0.5 + 0.25 * 0.25 / 0.75, 1e-12);
    }
}

#[test]
fn a_trigger_reports_and_deflects_nothing() {
    let mut world = world(bisect());
    let trigger = Collider::new(Shape::Sphere { radius: 1.0 }, Pose::at(DVec3::ZERO)).as_trigger();
    world.add_collider(trigger).unwrap();
    let ball = Sphere::new(vec(0.0, 2.0, 0.0), 0.5).with_velocity(vec(0.0, -1.0, 0.0));
    let ball = world.add_sphere(ball).unwrap();
    world.step(0.25).unwrap();
    assert!(world.report().triggers.is_empty());
    world.step(0.5).unwrap();
    assert_eq!(world.report().triggers[0].sphere, ball);
    assert_eq!(world.sphere(ball).unwrap().velocity.y, -1.0);
}

#[test]
fn newtons_cradle_passes_the_motion_of_the_balls_in_on_to_as_many_out() {
    for balls_in in 1..=4 {
        let mut world = world(bisect());
        for i in 0..5 {
            let moving = i < balls_in;
            let gap = if moving { -0.3 } else { 0.0 };
            world.add_sphere(on_axis(f64::from(i) + gap, if moving { 1.0 } else { 0.0 })).unwrap();
        }
        for _ in 0..60 {
            world.step(1.0 / 60.0).unwrap();
        }
        for (i, velocity) in world.spheres().velocities().iter().enumerate() {
            let out = i >= 5 - balls_in as usize;
            assert_close(velocity.x, if out { 1.0 } else { 0.0 }, 1e-12);
        }
    }
}

#[test]
fn reaching_the_bound_of_impacts_is_reported_and_nothing_sinks_through() {
    let mut world = world(bisect());
    world.add_force(Gravity::new(vec(0.0, -9.81, 0.0))).unwrap();
    let floor = Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO)).with_restitution(0.0);
    world.add_collider(floor).unwrap();
    let ball = world.add_sphere(Sphere::new(vec(0.0, 0.5, 0.0), 0.5)).unwrap();
    let mut unfinished = 0;
    for _ in 0..600 {
        world.step(1.0 / 60.0).unwrap();
        unfinished += world.report().unfinished_islands;
        assert_close(world.sphere(ball).unwrap().position.y, 0.5, 1e-3);
    }
    assert!(unfinished > 0);
}

#[test]
fn a_bouncing_ball_comes_to_rest_when_its_bounces_end() {
    let (g, e, drop) = (9.81, 0.7, 1.0);
    // Exact under gravity, and contact times to rounding: the bounces themselves are exact.
    let verlet = Bisect::default().with_integrator(Integrator::VelocityVerlet);
    let mut world = common::world(verlet.with_max_halvings(60));
    world.add_force(Gravity::new(vec(0.0, -g, 0.0))).unwrap();
    let floor = Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO)).with_restitution(e);
    world.add_collider(floor).unwrap();
    let ball = world.add_sphere(Sphere::new(vec(0.0, 0.5 + drop, 0.0), 0.5)).unwrap();
    let end = (2.0 * drop / g).sqrt() * (1.0 + e) / (1.0 - e);
    let mut came_to_rest = None;
    while world.time() < 2.0 * end {
        world.step(1.0 / 240.0).unwrap();
        let speed = world.sphere(ball).unwrap().velocity.length();
        if speed == 0.0 {
            came_to_rest.get_or_insert(world.time());
        } else {
            assert_eq!(came_to_rest, None, "it moves again at {}", world.time());
        }
    }
    // Seen at the end of a frame; what happens after the last bounce that is distinguished, of a
    // period of 1/32 of a frame, is over within another.
    assert_close(came_to_rest.unwrap(), end, 2.0 / 240.0);
    assert_close(world.sphere(ball).unwrap().position.y, 0.5, 1e-9);
}

#[test]
fn a_resting_pile_meets_a_bounded_number_of_times() {
    // Two touching layers on a floor: everything rests on everything.
    let mut world = world(bisect());
    world.add_force(Gravity::new(vec(0.0, -9.81, 0.0))).unwrap();
    world.add_collider(Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO))).unwrap();
    for i in 0..50u32 {
        let (layer, x, z) = (f64::from(i / 25), f64::from(i % 5), f64::from(i / 5 % 5));
        let place = vec(x + 0.5 * layer, 0.5 + layer * 0.5f64.sqrt(), z + 0.5 * layer);
        world.add_sphere(Sphere::new(place, 0.5).with_restitution(0.5)).unwrap();
    }
    for _ in 0..5 {
        let report = world.step(1.0 / 60.0).unwrap();
        // 32 times each of at most 6 contacts per sphere (12 neighbours, shared), and the floor.
        assert!(report.impacts.len() <= 33 * (6 * 50 + 25), "{}", report.impacts.len());
    }
}

#[test]
fn halving_stops_where_numbers_are_not_dense_enough() {
    let mut probes = 0;
    let found = contact_time::bisect(1.0, u32::MAX, |t| {
        probes += 1;
        if t < 0.3 { Probe::Before } else { Probe::After }
    });
    assert!(probes < 60);
    assert_close(found.time, 0.3, f64::EPSILON);
}

#[test]
fn a_ball_that_rests_in_a_corner_stays_outside_of_both_walls() {
    let mut world = world(bisect());
    world.add_force(Gravity::new(vec(-3.0, -9.0, 0.0))).unwrap();
    let wall = DQuat::from_rotation_arc(DVec3::Y, DVec3::X);
    for pose in [Pose::at(DVec3::ZERO), Pose::at(DVec3::ZERO).rotated(wall)] {
        world.add_collider(Collider::new(Shape::HalfSpace, pose).with_restitution(0.2)).unwrap();
    }
    let ball = world.add_sphere(Sphere::new(vec(0.5, 0.5, 0.0), 0.5)).unwrap();
    for _ in 0..600 {
        world.step(0.02).unwrap();
        // What gravity does in a frame: g h^2.
        assert_close_vec(world.sphere(ball).unwrap().position, vec(0.5, 0.5, 0.0), 0.004);
    }
}

#[test]
fn an_overlap_that_closes_at_the_start_is_answered_within_the_first_halving() {
    let mut world = world(bisect());
    world.add_sphere(on_axis(0.0, 1.0)).unwrap();
    world.add_sphere(on_axis(0.9, -1.0)).unwrap();
    world.step(0.1).unwrap();
    assert_eq!(impact_times(&world).len(), 1);
    assert!(impact_times(&world)[0] <= 0.1 / 256.0);
    assert!(world.spheres().velocities()[0].x < 0.0);
}

#[test]
fn every_integrator_drives_the_rule() {
    for integrator in [
        Integrator::SemiImplicitEuler,
        Integrator::ExplicitEuler,
        Integrator::VelocityVerlet,
        Integrator::RungeKutta4,
    ] {
        for wind_back in [WindBack::Touched, WindBack::All] {
            let rule = Bisect::default().with_wind_back(wind_back).with_max_halvings(40);
            let mut world = common::world(rule.with_integrator(integrator));
            world.add_force(Gravity::new(vec(0.0, -9.81, 0.0))).unwrap();
            world.add_collider(Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO))).unwrap();
            world.add_sphere(Sphere::new(vec(0.0, 1.0, 0.0), 0.5)).unwrap();
            for _ in 0..600 {
                world.step(0.001).unwrap();
            }
            // One bounce. The first-order schemes are off by g h times the speed of 3 m/s; an
            // engine that missed or doubled the impulse would be off by joules.
            let energy = world.total_energy() - 9.81 * 1.0;
            assert_close(energy, 0.0, 9.81 * 0.001 * 4.0);
            assert!(world.spheres().velocities()[0].y > 0.0);
        }
    }
}
