//! Closed boxes that move and turn, under the rule `contact` and in the stepped zones of `exact`: whatever the
//! walls do, no ball leaves.

mod common;

use std::ops::Range;

use carom::{
    Collider, Contact, DQuat, DVec3, Exact, Friction, Gravity, Pose, Rule, Settings, Shape, Sides,
    Sphere, World,
};
use common::{G, Numbers, vec};

const FRAME: f64 = 1.0 / 60.0;

fn world(rule: Rule) -> World {
    World::new(Settings::default().with_rule(rule)).unwrap()
}

fn contact() -> Rule {
    Rule::Contact(Contact::default())
}

fn exact() -> Rule {
    Rule::Exact(Exact::default())
}

fn container(size: DVec3) -> Collider {
    let shape = Shape::Container { size, open: Sides::default() };
    Collider::new(shape, Pose::at(DVec3::ZERO))
}

/// The balls whose centres are not in the only collider, a container.
fn outside(world: &World) -> Vec<usize> {
    let container = *world.colliders().next().unwrap().1;
    let Shape::Container { size, .. } = container.shape else { panic!("{container:?}") };
    let back = container.pose.rotation.normalize().inverse();
    let is_out = |center: &DVec3| {
        let local = back * (*center - container.pose.position);
        (local.abs() - 0.5 * size).max_element() > 0.0
    };
    let centers = world.spheres().positions().iter().enumerate();
    centers.filter(|(_, center)| is_out(center)).map(|(number, _)| number).collect()
}

/// The largest overlap, as a part of the smallest radius.
fn overlap(world: &World) -> f64 {
    let deepest = world.overlaps(0.0).iter().map(|it| it.depth).fold(0.0, f64::max);
    deepest / world.spheres().radii().iter().copied().fold(f64::INFINITY, f64::min)
}

#[test]
fn a_ball_stays_in_a_box_that_moves_in_any_direction() {
    let mut numbers = Numbers(11);
    for case in 0..40 {
        let direction = if case == 0 { vec(1.0, 0.0, 1.0) } else { numbers.unit_vector() };
        for speed in [1.0, 10.0, 50.0, 100.0] {
            let mut world = world(contact());
            let moving = container(DVec3::splat(0.08)).moving(speed * direction, DVec3::ZERO);
            world.add_collider(moving.with_restitution(0.5)).unwrap();
            world.add_sphere(Sphere::new(DVec3::ZERO, 0.01)).unwrap();
            for _ in 0..60 {
                world.step(FRAME).unwrap();
                assert!(outside(&world).is_empty(), "{case}, {speed} m/s, {} s", world.time());
            }
        }
    }
}

#[test]
fn balls_in_a_zone_stay_in_a_box_that_moves() {
    for speed in [10.0, 40.0, 50.0, 100.0] {
        let mut world = world(exact());
        world.add_force(Gravity::new(vec(0.0, -G, 0.0))).unwrap();
        let velocity = speed * vec(1.0, 0.0, 1.0);
        let moving = container(DVec3::splat(0.08)).moving(velocity, DVec3::ZERO);
        world.add_collider(moving.with_restitution(0.5)).unwrap();
        for place in [vec(0.0, -0.0299999999, 0.0), vec(0.0, -0.00999999, 0.0005)] {
            let ball = Sphere::new(place, 0.01).with_restitution(0.5);
            world.add_sphere(ball.with_friction(Friction::sliding(0.5))).unwrap();
        }
        let mut joined = 0;
        for _ in 0..60 {
            joined += world.step(FRAME).unwrap().zone_account.joined;
            assert!(outside(&world).is_empty(), "{speed} m/s, {} s", world.time());
        }
        assert!(joined > 0, "{speed} m/s");
    }
}

/// A square drum of 48 balls that turns about a level axis at this rate \[rad/s\].
fn drum(rule: Rule, rate: f64) -> World {
    let mut world = world(rule);
    world.add_force(Gravity::new(vec(0.0, -G, 0.0))).unwrap();
    let drum = container(vec(0.2, 0.2, 0.1)).with_friction(0.5).with_restitution(0.3);
    world.add_collider(drum.moving(DVec3::ZERO, vec(0.0, 0.0, rate))).unwrap();
    for place in 0..48u32 {
        let [i, j, k] = [place % 4, place / 4 % 4, place / 16].map(f64::from);
        let center = vec(0.03 * i - 0.045, 0.03 * j - 0.045, 0.025 * k - 0.025);
        let ball = Sphere::new(center, 0.01).with_restitution(0.3);
        world.add_sphere(ball.with_friction(Friction::sliding(0.5))).unwrap();
    }
    world
}

#[test]
fn no_ball_leaves_a_drum() {
    for rule in [contact(), exact()] {
        for rate in [3.0, 10.0, 30.0, 100.0] {
            let mut world = drum(rule, rate);
            let (mut deepest, mut squeezed, mut remainder, mut scale) = (0.0_f64, 0, 0.0, 0.0_f64);
            let mut fastest = 0.0_f64;
            let mut energy = world.total_energy();
            let start = std::time::Instant::now();
            for _ in 0..120 {
                let report = world.step(FRAME).unwrap();
                squeezed += report.contact_account.squeezed;
                let accounted = report.energy_account.total();
                let now = world.total_energy();
                remainder += now - energy - accounted;
                energy = now;
                scale = scale.max(world.kinetic_energy());
                deepest = deepest.max(overlap(&world));
                fastest = world
                    .spheres()
                    .velocities()
                    .iter()
                    .map(|it| it.length())
                    .fold(fastest, f64::max);
                assert!(outside(&world).is_empty(), "{rate} rad/s, {} s", world.time());
            }
            eprintln!(
                "{rule:?} {rate}: overlap {deepest:.3}, squeezed {squeezed}, remainder {:.2e}, fastest {fastest} {:?}",
                remainder / scale,
                start.elapsed()
            );
        }
    }
}

/// A box with balls of different sizes that moves and turns, its walls at up to 100 m/s.
fn adversarial(rule: Rule, seed: u64) -> World {
    let mut numbers = Numbers(seed.wrapping_mul(7919) + 29);
    let mut world = world(rule);
    if numbers.next() < 0.7 {
        world.add_force(Gravity::new(10.0 * numbers.vector())).unwrap();
    }
    let size = vec(numbers.between(0.3, 1.0), numbers.between(0.3, 1.0), numbers.between(0.3, 1.0));
    let fastest = 10f64.powf(numbers.between(-1.0, 2.0));
    let velocity = fastest * numbers.next() * numbers.unit_vector();
    let rate = (fastest - velocity.length()) / (0.5 * size.length());
    let turning = if numbers.next() < 0.3 { DVec3::ZERO } else { rate * numbers.unit_vector() };
    let restitution = [0.0, 0.3, 0.7, 1.0][(4.0 * numbers.next()) as usize];
    let rotation = DQuat::from_axis_angle(numbers.unit_vector(), numbers.between(0.0, 6.0));
    let walls = container(size).moving(velocity, turning).with_restitution(restitution);
    let walls = walls.with_pose(Pose { position: numbers.vector(), rotation });
    world.add_collider(walls.with_friction(numbers.next())).unwrap();
    let count = 1 + (12.0 * numbers.next()) as usize;
    for _ in 0..50 * count {
        if world.spheres().len() == count {
            break;
        }
        let radius = 0.1 * 10f64.powf(numbers.between(-1.5, 0.0));
        let inside = 0.5 * size - DVec3::splat(radius);
        // Some touch a wall, or lie in an edge or a corner.
        let mut place = inside * numbers.vector();
        for axis in 0..3 {
            if numbers.next() < 0.3 {
                place[axis] = inside[axis].copysign(place[axis]);
            }
        }
        let friction = Friction::sliding(numbers.next()).with_rolling(0.05 * numbers.next());
        let ball = Sphere::new(walls.pose.position + rotation * place, radius)
            .with_mass(radius.powi(3) * 10f64.powf(numbers.between(3.0, 5.0)))
            .with_restitution(restitution)
            .with_friction(friction)
            .with_velocity(10f64.powf(numbers.between(-1.0, 1.0)) * numbers.vector());
        let id = world.add_sphere(ball).unwrap();
        if world.overlaps(0.0).iter().any(|it| it.depth > 1e-12) {
            world.remove_sphere(id).unwrap();
        }
    }
    world
}

/// Says what is wrong with one of these worlds.
fn fault(rule: Rule, seed: u64) -> Option<String> {
    let mut world = adversarial(rule, seed);
    for _ in 0..60 {
        if let Err(error) = world.step(FRAME) {
            return Some(format!("{seed}: {error}"));
        }
        let out = outside(&world);
        if !out.is_empty() {
            return Some(format!("{seed}: {out:?} out at {:.3} s", world.time()));
        }
    }
    None
}

fn check(rule: Rule, seeds: Range<u64>) {
    let faults: Vec<_> = seeds.filter_map(|seed| fault(rule, seed)).collect();
    assert!(faults.is_empty(), "{}: {faults:#?}", faults.len());
}

#[test]
fn nobody_leaves_two_hundred_boxes() {
    check(contact(), 0..200);
}

#[test]
fn nobody_leaves_two_hundred_boxes_with_zones() {
    check(exact(), 0..200);
}

#[test]
#[ignore = "takes minutes"]
fn nobody_leaves_ten_thousand_boxes() {
    check(contact(), 0..10_000);
    check(exact(), 0..10_000);
}
