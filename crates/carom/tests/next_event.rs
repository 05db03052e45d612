//! Steps that end at the next impact: proves that they take the same way as steps by frames, that the
//! clock shows the time of the impact, and what becomes of other rules; nothing about speed.

use carom::{
    Bisect, Collider, DVec3, Emitter, Error, Gravity, Pose, Settings, Shape, Sphere, World,
};

const G: f64 = 8.0;

/// A ball of radius 1 above an elastic floor, its lowest point at a height \[m\].
fn ball_above_floor(height: f64) -> World {
    let mut world = World::new(Settings::default()).unwrap();
    world.add_force(Gravity::new(DVec3::new(0.0, -G, 0.0))).unwrap();
    world.add_collider(Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO))).unwrap();
    world.add_sphere(Sphere::new(DVec3::new(0.0, 1.0 + height, 0.0), 1.0)).unwrap();
    world
}

#[test]
fn impacts_of_a_bouncing_ball_come_at_odd_multiples_of_its_fall() {
    let mut world = ball_above_floor(1.0);
    let fall = (2.0 / G).sqrt();
    for bounce in 0..100u32 {
        let report = world.step_to_next_event(10.0).unwrap();
        assert_eq!(report.impacts.len(), 1);
        let time = fall * f64::from(2 * bounce + 1);
        // Each flight rounds its duration and the clock, a few units in the last place.
        assert!((world.time() - time).abs() <= f64::from(bounce + 1) * 8.0 * f64::EPSILON * time);
        assert!(world.spheres().velocities()[0].y > 0.0);
    }
}

#[test]
fn the_time_that_is_foretold_is_the_time_of_the_impact() {
    let mut world = ball_above_floor(1.0);
    let foretold = world.next_event_time(10.0).unwrap();
    let hash = world.state_hash();
    assert_eq!(world.next_event_time(0.25).unwrap(), None);
    assert_eq!(world.state_hash(), hash, "to look ahead changes nothing");
    world.step_to_next_event(10.0).unwrap();
    assert_eq!(Some(world.time()), foretold);
}

#[test]
fn without_an_impact_the_step_is_as_long_as_it_may_be() {
    let mut world = ball_above_floor(1.0);
    let mut by_frame = ball_above_floor(1.0);
    assert!(world.step_to_next_event(0.25).unwrap().impacts.is_empty());
    by_frame.step(0.25).unwrap();
    assert_eq!(world.state_hash(), by_frame.state_hash());
}

#[test]
fn impacts_at_one_instant_are_answered_in_one_step() {
    let mut world = ball_above_floor(1.0);
    for x in [10.0, 20.0] {
        world.add_sphere(Sphere::new(DVec3::new(x, 2.0, 0.0), 1.0)).unwrap();
    }
    assert_eq!(world.step_to_next_event(10.0).unwrap().impacts.len(), 3);
}

#[test]
fn event_by_event_a_gas_takes_the_same_way_as_frame_by_frame() {
    let gas = || {
        let mut world = World::new(Settings::default()).unwrap();
        for (place, velocity) in [(-6.0, 1.0), (-2.0, -0.5), (2.0, 0.25), (6.0, -1.5)] {
            let sphere = Sphere::new(DVec3::new(place, 0.1 * place, 0.0), 1.0);
            world.add_sphere(sphere.with_velocity(DVec3::X * velocity)).unwrap();
        }
        world
    };
    let (mut by_event, mut by_frame) = (gas(), gas());
    let mut impacts = Vec::new();
    while !by_event.step_to_next_event(100.0).unwrap().impacts.is_empty() {
        impacts.push(by_event.time());
    }
    let end = by_event.time();
    let expected: Vec<f64> =
        by_frame.step(end).unwrap().impacts.iter().map(|impact| impact.time).collect();
    // Flights go on over the ends of steps, so nothing rounds differently.
    assert_eq!(impacts, expected);
    assert_eq!(by_event.spheres().velocities(), by_frame.spheres().velocities());
    assert!(!impacts.is_empty());
}

#[test]
fn what_is_due_before_the_impact_is_emitted() {
    let mut world = ball_above_floor(1.0);
    let sphere = Sphere::new(DVec3::new(50.0, 50.0, 0.0), 1.0);
    world.add_emitter(Emitter::new(sphere, 0.2)).unwrap();
    let report = world.step_to_next_event(10.0).unwrap();
    // At 0, 0.2 and 0.4 s; the ball meets the floor at 0.5 s.
    assert_eq!((report.emitted.len(), report.impacts.len()), (3, 1));
}

#[test]
fn rules_that_know_frames_only_refuse() {
    let mut world = World::new(Settings::default().with_rule(Bisect::default())).unwrap();
    let hash = world.state_hash();
    let error = world.step_to_next_event(1.0).unwrap_err();
    assert!(matches!(error, Error::Invalid { .. }), "{error}");
    assert!(error.to_string().contains("exact"), "{error}");
    assert_eq!(world.state_hash(), hash);
    for within in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(ball_above_floor(1.0).step_to_next_event(within).is_err(), "{within}");
    }
}
