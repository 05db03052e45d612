//! Sensors: every passage of a sphere through a trigger is an event, with its time. Under `exact` against closed
//! forms, under all rules against the triggers reported at the end of each frame.

mod common;

use std::collections::BTreeSet;

use carom::{
    Boundary, Collider, ColliderId, Contact, DQuat, DVec3, Gravity, Pose, QuadraticDrag, Rule,
    SensorEvent, Settings, Shape, Sides, Sphere, SphereId, ViscousDrag, World,
};
use common::{Numbers, assert_close, assert_close_vec, bisect, discrete, vec};

fn rules() -> [Rule; 4] {
    [Rule::default(), Rule::Contact(Contact::default()), bisect(), discrete()]
}

fn world(rule: Rule) -> World {
    World::new(Settings::default().with_rule(rule)).unwrap()
}

fn sensor(shape: Shape, position: DVec3) -> Collider {
    Collider::new(shape, Pose::at(position)).as_trigger()
}

fn cube(edge: f64) -> Shape {
    Shape::Box { size: DVec3::splat(edge) }
}

/// The events of frames of `dt` \[s\], with times since the beginning.
fn events(world: &mut World, frames: usize, dt: f64) -> Vec<SensorEvent> {
    let mut events = Vec::new();
    for _ in 0..frames {
        let start = world.time();
        let seen = world.step(dt).unwrap().sensor_events.clone();
        events.extend(seen.into_iter().map(|event| {
            let mut event = event;
            event.time += start;
            event
        }));
    }
    events
}

#[test]
fn ten_thousand_passes_through_a_centimetre_are_all_reported_to_the_picosecond() {
    let (radius, reach, count) = (0.001, 0.006, 10_000);
    let mut numbers = Numbers(1);
    let settings = Settings::default().with_spheres_collide(false);
    let mut world = World::new(settings).unwrap();
    world.add_collider(sensor(Shape::Sphere { radius: reach - radius }, DVec3::ZERO)).unwrap();
    let mut expected = Vec::new();
    for _ in 0..count {
        // As many slow as fast ones, by their logarithm.
        let speed = libm::pow(10.0, numbers.between(0.0, 3.0));
        let along = numbers.unit_vector();
        let beside = along.cross(numbers.unit_vector()).normalize_or_zero();
        let (offset, middle) = (numbers.between(0.0, 0.9 * reach), numbers.between(0.05, 0.95));
        let start = offset * beside - middle * speed * along;
        world.add_sphere(Sphere::new(start, radius).with_velocity(speed * along)).unwrap();
        let half = (reach * reach - offset * offset).sqrt() / speed;
        expected.push((middle - half, middle + half, speed));
    }
    let seen = events(&mut world, 10, 0.1);
    assert_eq!(seen.len(), 2 * count);
    for event in seen {
        let (enters, leaves, speed) = expected[event.sphere.number() as usize];
        assert_close(event.time, if event.enters { enters } else { leaves }, 1e-12);
        assert_close(event.speed, speed, 1e-12 * speed);
        assert_close(event.point.length(), reach - radius, 1e-12);
    }
}

#[test]
fn a_thrown_ball_crosses_a_box_up_and_down_at_the_times_of_the_parabola() {
    let (g, up, radius) = (10.0, 12.0, 0.1);
    let mut world = World::default();
    world.add_force(Gravity::new(vec(0.0, -g, 0.0))).unwrap();
    world.add_collider(sensor(cube(1.0), vec(0.0, 5.0, 0.0))).unwrap();
    world.add_sphere(Sphere::new(DVec3::ZERO, radius).with_velocity(vec(0.0, up, 0.0))).unwrap();
    let seen = events(&mut world, 30, 0.1);
    // Heights at which the ball touches the lower and the upper side.
    let times = |height: f64| {
        let root = (up * up - 2.0 * g * height).sqrt();
        [(up - root) / g, (up + root) / g]
    };
    let ([lower_up, lower_down], [upper_up, upper_down]) = (times(4.4), times(5.6));
    let found: Vec<(bool, f64)> = seen.iter().map(|event| (event.enters, event.time)).collect();
    let expected = [(true, lower_up), (false, upper_up), (true, upper_down), (false, lower_down)];
    assert_eq!(found.len(), 4, "{found:?}");
    for ((enters, time), (expected_enters, expected_time)) in found.into_iter().zip(expected) {
        assert_eq!(enters, expected_enters);
        assert_close(time, expected_time, 1e-13);
    }
    assert_close_vec(seen[0].point, vec(0.0, 4.5, 0.0), 1e-14);
    assert_close_vec(seen[1].normal, DVec3::Y, 0.0);
}

#[test]
fn all_rules_report_a_ball_that_passes_within_a_frame() {
    for rule in rules() {
        let mut world = world(rule);
        let gate = world.add_collider(sensor(cube(0.01), vec(1.0, 0.0, 0.0))).unwrap();
        let fast = Sphere::new(DVec3::ZERO, 0.001).with_velocity(vec(300.0, 0.0, 0.0));
        let fast = world.add_sphere(fast).unwrap();
        let seen = events(&mut world, 1, 1.0 / 60.0);
        assert_eq!(seen.iter().map(|it| it.enters).collect::<Vec<_>>(), [true, false]);
        assert!(seen.iter().all(|it| (it.collider, it.sphere) == (gate, fast)));
        assert_close(seen[0].time, 0.994 / 300.0, 1e-15);
        assert_close(seen[1].time, 1.006 / 300.0, 1e-15);
        assert!(world.report().triggers.is_empty());
    }
}

/// The pairs that events leave in triggers, from those before.
fn follow(inside: &mut BTreeSet<(SphereId, ColliderId)>, events: &[SensorEvent]) {
    for event in events {
        let key = (event.sphere, event.collider);
        let is_change = if event.enters { inside.insert(key) } else { inside.remove(&key) };
        assert!(is_change, "{event:?} is no change");
    }
}

#[test]
fn events_lead_from_the_triggers_of_one_frame_to_those_of_the_next() {
    // Under air drag in its square, flights have no closed form.
    for (rule, has_air) in rules().into_iter().zip([false; 4]).chain([(Rule::default(), true)]) {
        let mut world = world(rule);
        let mut numbers = Numbers(7);
        if has_air {
            world.add_force(QuadraticDrag::new(1.2)).unwrap();
        }
        world.add_force(Gravity::new(vec(0.0, -9.81, 0.0))).unwrap();
        world.add_force(ViscousDrag::new(0.05)).unwrap();
        let shape = Shape::Container { size: DVec3::splat(4.0), open: Sides::NONE };
        world
            .add_collider(Collider::new(shape, Pose::at(DVec3::ZERO)).with_restitution(0.9))
            .unwrap();
        for number in 0..12 {
            let turned = DQuat::from_rotation_arc(DVec3::Y, numbers.unit_vector());
            let shape = match number % 4 {
                0 => Shape::Sphere { radius: 0.3 },
                1 => Shape::Rectangle { size_x: 0.8, size_z: 0.5 },
                2 => Shape::Box { size: vec(0.5, 0.3, 0.7) },
                _ => Shape::HalfSpace,
            };
            let shift = if shape == Shape::HalfSpace { 1.5 } else { 0.0 };
            let place = 1.5 * numbers.vector() - shift * (turned * DVec3::Y);
            world
                .add_collider(sensor(shape, place).with_pose(Pose::at(place).rotated(turned)))
                .unwrap();
        }
        for _ in 0..15 {
            let ball =
                Sphere::new(1.7 * numbers.vector(), 0.1).with_velocity(5.0 * numbers.vector());
            world.add_sphere(ball).unwrap();
        }
        let (mut inside, mut count) = (BTreeSet::new(), 0);
        for frame in 0..150 {
            let report = world.step(1.0 / 60.0).unwrap();
            follow(&mut inside, &report.sensor_events);
            count += report.sensor_events.len();
            let expected = report.triggers.iter().map(|it| (it.sphere, it.collider)).collect();
            if rule == Rule::default() || matches!(rule, Rule::Contact(_)) {
                assert_eq!(inside, expected, "{rule:?}, frame {frame}");
            }
        }
        assert!(count > 50, "{count}");
    }
}

#[test]
fn a_rectangle_is_entered_from_both_sides() {
    let plate = Shape::Rectangle { size_x: 2.0, size_z: 2.0 };
    let times = |from: f64, speed: f64| {
        let mut world = World::default();
        world.add_collider(sensor(plate.clone(), DVec3::ZERO)).unwrap();
        let ball = Sphere::new(vec(0.1, from, 0.0), 0.25).with_velocity(vec(0.0, speed, 0.0));
        world.add_sphere(ball).unwrap();
        let seen = events(&mut world, 4, 0.5);
        seen.into_iter().map(|it| (it.enters, it.time)).collect::<Vec<_>>()
    };
    // Its front is up: it is entered at the surface, and left where the centre passes.
    let down = times(1.0, -1.0);
    assert_eq!(down.iter().map(|it| it.0).collect::<Vec<_>>(), [true, false]);
    assert_close(down[0].1, 0.75, 1e-15);
    assert_close(down[1].1, 1.0, 1e-15);
    let up = times(-1.0, 1.0);
    assert_eq!(up.iter().map(|it| it.0).collect::<Vec<_>>(), [true, false]);
    assert_close(up[0].1, 1.0, 1e-15);
    assert_close(up[1].1, 1.25, 1e-15);
}

#[test]
fn a_sensor_that_moves_or_turns_passes_over_a_ball_at_rest() {
    for rule in rules() {
        let mut world = world(rule);
        let moving = sensor(cube(0.2), vec(-1.0, 0.0, 0.0)).moving(vec(2.0, 0.0, 0.0), DVec3::ZERO);
        world.add_collider(moving).unwrap();
        let arm = Shape::Box { size: vec(8.0, 0.2, 0.2) };
        let arm = sensor(arm, vec(0.0, 0.0, 5.0)).moving(DVec3::ZERO, vec(0.0, 1.0, 0.0));
        let arm = world.add_collider(arm).unwrap();
        world.add_sphere(Sphere::new(DVec3::ZERO, 0.1)).unwrap();
        world.add_sphere(Sphere::new(vec(0.0, 0.0, 2.0), 0.1)).unwrap();
        let seen = events(&mut world, 30, 0.1);
        let passes: Vec<_> = seen.iter().filter(|it| it.collider != arm).collect();
        assert_eq!(passes.len(), 2, "{rule:?}: {seen:?}");
        // Poses are moved on frame by frame, and rounded there.
        assert_close(passes[0].time, 0.4, 1e-13);
        assert_close(passes[1].time, 0.6, 1e-13);
        assert_close(passes[0].speed, 2.0, 1e-15);
        // The arm comes round with both its ends.
        let turns: Vec<_> = seen.iter().filter(|it| it.collider == arm).collect();
        assert_eq!(turns.len(), 2, "{rule:?}: {turns:?}");
        let half = libm::asin(0.2 / 3.0);
        let quarter = std::f64::consts::FRAC_PI_2;
        assert_close(turns[0].time, quarter - half, 1e-12);
        assert_close(turns[1].time, quarter + half, 1e-12);
    }
}

#[test]
fn what_is_put_into_a_sensor_enters_at_once_and_what_is_taken_out_leaves() {
    for rule in rules() {
        let mut world = world(rule);
        world.add_collider(sensor(cube(1.0), DVec3::ZERO)).unwrap();
        let ball = world.add_sphere(Sphere::new(DVec3::ZERO, 0.1)).unwrap();
        let first = events(&mut world, 2, 0.1);
        assert_eq!(first.iter().map(|it| (it.enters, it.time)).collect::<Vec<_>>(), [(true, 0.0)]);
        let snapshot = world.snapshot();
        let mut moved = world.sphere(ball).unwrap();
        moved.position = vec(5.0, 0.0, 0.0);
        world.set_sphere(ball, moved).unwrap();
        let then = world.step(0.1).unwrap().sensor_events.clone();
        assert_eq!(then.iter().map(|it| (it.enters, it.time)).collect::<Vec<_>>(), [(false, 0.0)]);
        world.restore(&snapshot);
        assert!(world.step(0.1).unwrap().sensor_events.is_empty());
        // One that is no more leaves nothing.
        world.remove_sphere(ball).unwrap();
        assert!(world.step(0.1).unwrap().sensor_events.is_empty());
    }
}

#[test]
fn sensors_see_across_the_faces_of_a_periodic_box() {
    let size = DVec3::splat(2.0);
    let settings = Settings::default().with_boundary(Boundary::Periodic { size });
    let mut world = World::new(settings).unwrap();
    // It reaches across the face at x = 1.
    world.add_collider(sensor(cube(0.4), vec(0.9, 0.0, 0.0))).unwrap();
    let ball = Sphere::new(vec(0.0, 0.0, 0.0), 0.1).with_velocity(vec(4.0, 0.0, 0.0));
    world.add_sphere(ball).unwrap();
    let seen = events(&mut world, 1, 2.0);
    assert_eq!(seen.len(), 8, "{seen:?}");
    for (round, two) in (0..).map(f64::from).zip(seen.chunks(2)) {
        assert_close(two[0].time, round * 0.5 + 0.15, 1e-14);
        assert_close(two[1].time, round * 0.5 + 0.3, 1e-14);
    }
}

#[test]
fn sensors_change_no_bit_of_the_motion() {
    for rule in rules() {
        let run = |with_sensors: bool| {
            let mut world = world(rule);
            let mut numbers = Numbers(11);
            world.add_force(Gravity::new(vec(0.0, -9.81, 0.0))).unwrap();
            let shape = Shape::Container { size: DVec3::splat(3.0), open: Sides::NONE };
            world.add_collider(Collider::new(shape, Pose::at(DVec3::ZERO))).unwrap();
            for _ in 0..20 {
                let place = 1.3 * numbers.vector();
                if with_sensors {
                    world.add_collider(sensor(cube(0.3), place)).unwrap();
                }
                world.add_sphere(Sphere::new(place, 0.1).with_restitution(0.8)).unwrap();
            }
            for _ in 0..60 {
                world.step(1.0 / 60.0).unwrap();
            }
            world.spheres().positions().to_vec()
        };
        assert_eq!(run(true), run(false), "{rule:?}");
    }
}

#[test]
fn lengths_of_any_scale_give_the_same_times() {
    let times = |scale: f64| {
        let mut world = World::default();
        world.add_force(Gravity::new(scale * vec(0.0, -10.0, 0.0))).unwrap();
        world.add_collider(sensor(cube(scale), scale * vec(3.0, 1.0, 0.0))).unwrap();
        let velocity = scale * vec(4.0, 6.0, 0.0);
        world.add_sphere(Sphere::new(DVec3::ZERO, 0.1 * scale).with_velocity(velocity)).unwrap();
        events(&mut world, 5, 0.3).iter().map(|it| it.time).collect::<Vec<_>>()
    };
    assert_eq!(times(1.0).len(), 2);
    // Powers of two change no digit.
    assert_eq!(times(1.0 / 1_048_576.0), times(1.0));
    assert_eq!(times(1_048_576.0), times(1.0));
}
