//! Stepped zones of the rule `exact`: heaps too large to be answered impact by impact come to rest, what is
//! outside stays exact, and the result depends neither on frames nor on how often a run was interrupted.

mod common;

use carom::{
    Collider, DQuat, DVec3, Emitter, Exact, Friction, Gravity, Pose, Settings, Shape, Sphere,
    Spring, World, Zones,
};
use common::{G, Numbers, vec};

const RADIUS: f64 = 0.5;
const FRAME: f64 = 1.0 / 60.0;

/// A world under gravity with a floor and walls about a square, under the rule `exact`.
fn box_of(width: f64, restitution: f64, exact: Exact) -> World {
    let mut world = World::new(Settings::default().with_rule(exact)).unwrap();
    world.add_force(Gravity::new(-G * DVec3::Y)).unwrap();
    let sides = [DVec3::X, DVec3::NEG_X, DVec3::Z, DVec3::NEG_Z];
    for normal in [DVec3::Y].into_iter().chain(sides) {
        let far = normal.element_sum() < 0.0;
        let position = if far { vec(width, 0.0, width) } else { DVec3::ZERO };
        let pose = Pose { position, rotation: DQuat::from_rotation_arc(DVec3::Y, normal) };
        let wall = Collider::new(Shape::HalfSpace, pose).with_restitution(restitution);
        world.add_collider(wall).unwrap();
    }
    world
}

fn ball(position: DVec3, restitution: f64) -> Sphere {
    Sphere::new(position, RADIUS).with_restitution(restitution)
}

/// Layers of five by five balls, somewhat shaken, over a box.
fn heap(layers: u32, restitution: f64, exact: Exact) -> World {
    let mut world = box_of(5.6, restitution, exact);
    let mut numbers = Numbers(11);
    for number in 0..25 * layers {
        let (x, y, z) = (number % 5, number / 25, number / 5 % 5);
        let shake = 0.02 * numbers.vector();
        let place =
            vec(0.6 + 1.08 * f64::from(x), 0.7 + 1.1 * f64::from(y), 0.6 + 1.08 * f64::from(z));
        world.add_sphere(ball(place + shake, restitution)).unwrap();
    }
    world
}

/// Takes frames until a time \[s\].
fn run_until(world: &mut World, seconds: f64, frame: f64) {
    while world.time() < seconds {
        world.step(frame).unwrap();
    }
}

fn deepest_overlap(world: &World) -> f64 {
    world.overlaps(0.0).iter().map(|overlap| overlap.depth / RADIUS).fold(0.0, f64::max)
}

#[test]
fn a_heap_comes_to_rest_and_gains_nothing_but_what_is_accounted_for() {
    for restitution in [0.0, 0.5, 0.8] {
        let mut world = heap(6, restitution, Exact::default());
        let mut most = 0;
        let mut energy = world.total_energy();
        let scale = energy;
        while world.time() < 15.0 {
            let report = world.step(FRAME).unwrap();
            let corrected = report.energy_account.correction;
            most = most.max(report.zone_account.spheres);
            let now = world.total_energy();
            // One that stops within a sub-step of h is off by up to h u / 2 from where it would have: for
            // some that stop at once from the speed of their fall.
            let scheme = 5.0 * G * 7.0 / (2.0 * 480.0);
            let gained = now - energy - corrected;
            assert!(gained <= scheme + 1e-12 * scale, "e = {restitution}: {gained} J");
            energy = now;
        }
        assert!(most >= 100, "e = {restitution}: {most} were stepped");
        // Without friction, a ball that lies loose in a layer goes on sliding.
        let moving = world.spheres().velocities().iter().filter(|it| it.length() > 1e-3).count();
        assert!(moving < 8, "e = {restitution}: {moving} move");
        assert!(deepest_overlap(&world) < 0.01, "e = {restitution}");
    }
}

#[test]
fn the_length_of_frames_does_not_matter_to_a_heap() {
    let mut worlds = [0.125, 0.03125, 0.0078125].map(|frame| {
        let mut world = heap(6, 0.5, Exact::default());
        run_until(&mut world, 2.0, frame);
        world
    });
    assert!(worlds[0].report().zone_account.spheres > 0);
    let [coarse, others @ ..] = worlds.each_mut();
    for other in others {
        assert!(coarse.spheres().positions() == other.spheres().positions());
        assert!(coarse.spheres().velocities() == other.spheres().velocities());
    }
}

#[test]
fn a_snapshot_goes_on_as_the_world_did() {
    let mut world = heap(6, 0.3, Exact::default());
    run_until(&mut world, 1.0, FRAME);
    assert!(world.report().zone_account.spheres > 0);
    let snapshot = world.snapshot();
    run_until(&mut world, 1.5, FRAME);
    let hash = world.state_hash();
    world.restore(&snapshot);
    run_until(&mut world, 1.5, FRAME);
    assert_eq!(world.state_hash(), hash);
}

#[test]
fn what_flies_beside_a_heap_flies_as_without_it() {
    let bouncing = ball(vec(60.0, 3.0, 60.0), 0.9).with_velocity(vec(0.3, 0.0, -0.2));
    let mut alone = World::new(Settings::default()).unwrap();
    alone.add_force(Gravity::new(-G * DVec3::Y)).unwrap();
    alone.add_collider(Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO))).unwrap();
    let lone = alone.add_sphere(bouncing).unwrap();
    let exact = Exact::default().with_zone_budget(300);
    let mut beside = World::new(Settings::default().with_rule(exact)).unwrap();
    beside.add_force(Gravity::new(-G * DVec3::Y)).unwrap();
    beside.add_collider(Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO))).unwrap();
    for number in 0..125 {
        let (x, y, z) = (number % 5, number / 25, number / 5 % 5);
        let place = vec(1.01 * f64::from(x), 0.6 + 1.01 * f64::from(y), 1.01 * f64::from(z));
        beside.add_sphere(ball(place, 0.3)).unwrap();
    }
    let other = beside.add_sphere(bouncing).unwrap();
    let mut stepped = 0;
    while alone.time() < 3.0 {
        alone.step(FRAME).unwrap();
        stepped = stepped.max(beside.step(FRAME).unwrap().zone_account.spheres);
        let [here, there] = [alone.sphere(lone).unwrap(), beside.sphere(other).unwrap()];
        assert_eq!((here.position, here.velocity), (there.position, there.velocity));
    }
    assert!(stepped > 50, "{stepped}");
}

#[test]
fn a_ball_wakes_a_heap_that_sleeps_and_all_that_comes_apart_is_exact_again() {
    let mut world = heap(6, 0.3, Exact::default());
    run_until(&mut world, 20.0, FRAME);
    let resting = world.spheres().positions().to_vec();
    world.step(FRAME).unwrap();
    assert_eq!(world.spheres().positions(), resting);
    assert!(world.report().impacts.is_empty());

    let shot = ball(vec(2.8, 30.0, 2.8), 0.3).with_velocity(vec(0.0, -30.0, 0.0)).with_mass(20.0);
    world.add_sphere(shot).unwrap();
    run_until(&mut world, 22.0, FRAME);
    let moved = world.spheres().positions().iter().zip(&resting).filter(|(a, b)| a != b).count();
    assert!(moved > 75, "{moved}");
}

#[test]
fn an_elastic_block_that_is_hit_keeps_its_momentum_and_leaves_its_zone() {
    let mut world =
        World::new(Settings::default().with_rule(Exact::default().with_zone_budget(100))).unwrap();
    for number in 0..27 {
        let place = vec((number % 3).into(), (number / 3 % 3).into(), (number / 9).into());
        world.add_sphere(ball(place, 1.0)).unwrap();
    }
    world.add_sphere(ball(vec(-3.0, 0.4, 0.7), 1.0).with_velocity(vec(8.0, 0.0, 0.0))).unwrap();
    let (momentum, energy) = (world.momentum(), world.total_energy());
    let mut stepped = 0;
    while world.time() < 5.0 {
        stepped = stepped.max(world.step(FRAME).unwrap().zone_account.spheres);
        // A sum of some hundred impulses of the rounding of 8 kg m/s each.
        assert!((world.momentum() - momentum).length() < 1e-12);
        assert!(world.total_energy() <= energy * (1.0 + 1e-14));
    }
    assert!(stepped > 20, "{stepped}");
    assert_eq!(world.report().zone_account.spheres, 0);
}

#[test]
fn without_zones_every_impact_is_answered() {
    let mut world = heap(1, 0.5, Exact::default().with_zone_budget(1).with_zones(Zones::Never));
    while world.time() < 1.0 {
        assert_eq!(world.step(FRAME).unwrap().zone_account.joined, 0);
    }
}

#[test]
fn spheres_are_added_and_taken_out_of_a_zone_and_emitters_fill_it() {
    let mut world = heap(4, 0.3, Exact::default().with_zone_budget(20_000));
    let drop = ball(vec(2.8, 9.0, 2.8), 0.3);
    let emitter = Emitter::new(drop, 0.5);
    world.add_emitter(emitter).unwrap();
    run_until(&mut world, 2.0, FRAME);
    assert!(world.report().zone_account.spheres > 50);
    let ids: Vec<_> = world.spheres().ids().iter().copied().step_by(3).collect();
    for id in ids {
        world.remove_sphere(id).unwrap();
    }
    run_until(&mut world, 3.0, FRAME);
    let first = world.spheres().ids()[0];
    world.set_sphere(first, ball(vec(2.8, 12.0, 1.0), 0.3)).unwrap();
    run_until(&mut world, 8.0, FRAME);
    for (place, velocity) in world.spheres().positions().iter().zip(world.spheres().velocities()) {
        let inside = place.cmpgt(vec(0.49, 0.49, 0.49)).all() && place.x < 5.11 && place.z < 5.11;
        assert!(inside, "{place}");
        assert!(velocity.is_finite());
    }
    let overlap = deepest_overlap(&world);
    assert!(overlap < 0.02, "{overlap}");
}

#[test]
fn a_moving_floor_lifts_a_heap_in_a_zone() {
    let mut world =
        World::new(Settings::default().with_rule(Exact::default().with_zone_budget(200))).unwrap();
    world.add_force(Gravity::new(-G * DVec3::Y)).unwrap();
    let lift =
        Collider::new(Shape::Box { size: vec(20.0, 1.0, 20.0) }, Pose::at(vec(0.0, -0.5, 0.0)));
    let lift = lift.moving(vec(0.0, 0.5, 0.0), DVec3::ZERO).with_restitution(0.3);
    world.add_collider(lift).unwrap();
    for number in 0..36 {
        let (x, y, z) = (number % 3, number / 9, number / 3 % 3);
        let place = vec(1.02 * f64::from(x), 0.6 + 1.02 * f64::from(y), 1.02 * f64::from(z));
        world.add_sphere(ball(place, 0.3)).unwrap();
    }
    let mut stepped = 0;
    while world.time() < 2.0 {
        stepped = stepped.max(world.step(FRAME).unwrap().zone_account.spheres);
    }
    assert!(stepped > 20, "{stepped}");
    let lowest =
        world.spheres().positions().iter().map(|place| place.y).fold(f64::INFINITY, f64::min);
    // The floor has risen by a metre.
    assert!(lowest > 1.0 + RADIUS * 0.99, "{lowest}");
}

/// A heap whose motion is so many times slower, with frames of that many times the length.
fn heap_in_slow_motion(times: f64) -> (World, f64) {
    let mut world = heap(3, 0.3, Exact::default().with_zone_budget(2000));
    let gravity = world.forces().next().unwrap().0;
    world.set_force(gravity, Gravity::new(-G / (times * times) * DVec3::Y)).unwrap();
    (world, FRAME * times)
}

#[test]
fn zones_take_as_few_ticks_in_slow_and_in_fast_motion() {
    for times in [1.0 / 1024.0, 1.0, 1024.0] {
        let (mut world, frame) = heap_in_slow_motion(times);
        let mut most = 0;
        while world.time() < 2.0 * times {
            most = most.max(world.step(frame).unwrap().zone_account.ticks);
        }
        // As many as a frame holds of them at most.
        assert!((1..=128).contains(&most), "{times}: {most} ticks in a frame");
        assert!(deepest_overlap(&world) < 0.02, "{times}: {}", deepest_overlap(&world));
    }
}

#[test]
fn a_heap_stands_while_its_frames_become_longer_and_shorter() {
    let (mut world, frame) = heap_in_slow_motion(1.0);
    run_until(&mut world, 4.0, frame);
    for frame in [FRAME / 1000.0, 4.0, FRAME, 60.0, FRAME / 100.0] {
        for _ in 0..5 {
            world.step(frame).unwrap();
            let overlap = deepest_overlap(&world);
            assert!(overlap < 0.02, "{frame}: {overlap}");
        }
    }
}

/// A column of six balls of which a zone is soon made, over a rough floor.
fn column() -> World {
    let exact = Exact::default().with_max_impacts(50);
    let mut world = World::new(Settings::default().with_rule(exact)).unwrap();
    world.add_force(Gravity::new(-G * DVec3::Y)).unwrap();
    let floor = Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO)).with_restitution(0.0);
    // Friction against rolling needs a zone.
    let friction = Friction::sliding(0.5).with_rolling(1e-3);
    world.add_collider(floor.with_friction(friction)).unwrap();
    for number in 0..6 {
        let place = vec(1e-3 * f64::from(number), 0.5 + f64::from(number), 0.0);
        world.add_sphere(ball(place, 0.5)).unwrap();
    }
    world
}

/// Checks that a world with springs gains no energy in a number of frames, in which a zone is made.
fn assert_gains_nothing(mut world: World, frames: u32, what: &str) {
    let start = world.total_energy();
    let mut stepped = 0;
    for _ in 0..frames {
        stepped += world.step(FRAME).unwrap().zone_account.spheres;
        // Under the leapfrog scheme the energy of a spring swings by (w h)²/4, and w h is at most a half.
        let energy = world.total_energy();
        assert!(energy <= start * (1.0 + 1.0 / 16.0), "{what}: {energy} J of {start} J");
    }
    assert!(stepped > 0, "{what}");
}

#[test]
fn a_stiff_spring_to_a_point_gains_no_energy_in_a_zone() {
    for stiffness in [1e3, 3e5, 1.2e6, 7e6, 1e8, 1e9] {
        for place in [0, 5] {
            let mut world = column();
            let sphere = world.spheres().ids()[place];
            let anchor = vec(0.3, 0.6 + place as f64, 8.0);
            let spring = Spring::to_point(sphere, anchor, 8.0).with_stiffness(stiffness);
            world.add_spring(spring).unwrap();
            let frames = if stiffness > 1e8 { 5 } else { 20 };
            assert_gains_nothing(world, frames, &format!("{place}, {stiffness}"));
        }
    }
}

#[test]
fn stiff_springs_and_threads_out_of_a_zone_gain_no_energy() {
    for stiffness in [1e3, 1.2e6, 5e6, 1e8, 1e9] {
        for only_pulls in [false, true] {
            let mut world = column();
            let inside = world.spheres().ids()[2];
            let outside = world.add_sphere(ball(vec(3.0, 6.0, 0.0), 0.5)).unwrap();
            let spring = Spring::between(inside, outside, 2.5).with_stiffness(stiffness);
            world.add_spring(spring.with_only_pulls(only_pulls)).unwrap();
            let frames = if stiffness > 1e8 { 10 } else { 40 };
            assert_gains_nothing(world, frames, &format!("{only_pulls}, {stiffness}"));
        }
    }
}

#[test]
fn stiff_springs_between_balls_that_join_and_leave_a_zone_gain_no_energy() {
    for stiffness in [3e5, 2e6, 5e6] {
        let mut world = column();
        let balls = world.spheres().ids().to_vec();
        for (number, two) in balls.windows(2).enumerate() {
            let spring = Spring::between(two[0], two[1], 1.001).with_stiffness(stiffness);
            world.add_spring(spring.with_only_pulls(number % 2 == 0)).unwrap();
        }
        assert_gains_nothing(world, 40, &stiffness.to_string());
    }
}

#[test]
fn springs_too_stiff_for_the_ticks_of_zones_are_refused() {
    let tick_of = |zones: Zones| Exact::default().with_zone_tick(4.0).with_zones(zones);
    for (zones, is_refused) in [(Zones::Automatic, true), (Zones::Never, false)] {
        let mut world = World::new(Settings::default().with_rule(tick_of(zones))).unwrap();
        let ball = world.add_sphere(ball(DVec3::X, 0.5).with_mass(1.0)).unwrap();
        // A rate of 1e4 /s: force ticks of 1/240 s follow it, zone ticks of 4 s do not.
        let spring = Spring::to_point(ball, DVec3::ZERO, 0.9).with_stiffness(1e8);
        world.add_spring(spring).unwrap();
        // A frame of 1 s holds no more than a quarter of such a tick.
        let told = world.step(1.0).err().map(|error| error.to_string());
        let is_told = told.as_ref().is_some_and(|it| it.starts_with("step: `stiffness` must be"));
        assert_eq!((is_told, told.is_some()), (is_refused, is_refused), "{zones:?}: {told:?}");
    }
}
