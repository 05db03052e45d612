//! Closed boxes that move and turn, under the rule `contact` and in the stepped zones of `exact`: whatever the
//! walls do, no ball leaves.

// Powers as each machine has them: the worlds are to be hard, not the same.
#![allow(clippy::disallowed_methods)]

mod common;

use std::f64::consts::FRAC_PI_2;

use carom::{
    Collider, Contact, DQuat, DVec3, Exact, Friction, Gravity, MotionPart, Pose, Rule, Settings,
    Shape, Sides, Sphere, World,
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

fn run(world: &mut World, frames: usize) {
    for _ in 0..frames {
        world.step(FRAME).unwrap();
    }
}

fn container(size: DVec3) -> Collider {
    let shape = Shape::Container { size, open: Sides::default() };
    Collider::new(shape, Pose::at(DVec3::ZERO))
}

/// The balls whose centres are not in the only collider, a container.
fn outside(world: &World) -> Vec<usize> {
    let container = world.colliders().next().unwrap().1.clone();
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
            // What rolls with rolling friction on what moves is stepped.
            let friction = Friction::sliding(0.5).with_rolling(0.01);
            world.add_sphere(ball.with_friction(friction)).unwrap();
        }
        let mut joined = 0;
        for _ in 0..60 {
            joined += world.step(FRAME).unwrap().zone_account.joined;
            assert!(outside(&world).is_empty(), "{speed} m/s, {} s", world.time());
        }
        assert!(joined > 0, "{speed} m/s");
    }
}

/// A square drum of 48 balls that fly about, which turns at this rate \[rad/s\], without gravity.
fn drum(rule: Rule, rate: f64) -> World {
    let mut world = world(rule);
    let mut numbers = Numbers(7);
    let drum = container(vec(0.2, 0.2, 0.1)).with_friction(0.5).with_restitution(0.3);
    world.add_collider(drum.moving(DVec3::ZERO, vec(0.0, 0.0, rate))).unwrap();
    for place in 0..48u32 {
        let [i, j, k] = [place % 4, place / 4 % 4, place / 16].map(f64::from);
        let center = vec(0.03 * i - 0.045, 0.03 * j - 0.045, 0.025 * k - 0.025);
        let ball = Sphere::new(center, 0.01).with_velocity(numbers.vector());
        let ball = ball.with_restitution(0.3).with_friction(Friction::sliding(0.5));
        world.add_sphere(ball).unwrap();
    }
    world
}

#[test]
fn no_ball_leaves_a_drum_and_none_is_faster_than_its_walls_make_it() {
    for rule in [contact(), exact()] {
        // Two that others press together keep some of their way in a sub-step: at the highest rate that is three
        // radii, and one comes into another as far as may be.
        for (rate, deepest) in [(3.0, 0.1), (10.0, 0.1), (30.0, 0.25), (100.0, 0.6)] {
            let mut world = drum(rule, rate);
            world.add_force(Gravity::new(vec(0.0, -G, 0.0))).unwrap();
            // What a corner makes of a ball at rest, and what it had from the start and a fall over the diagonal.
            let diagonal = 0.2 * std::f64::consts::SQRT_2;
            let most = 1.3 * rate * 0.5 * diagonal + (3.0 + 2.0 * G * diagonal).sqrt();
            for _ in 0..120 {
                world.step(FRAME).unwrap();
                let place = format!("{rate} rad/s, {} s", world.time());
                assert!(outside(&world).is_empty(), "{place}");
                let mut speeds = world.spheres().velocities().iter().map(|it| it.length());
                assert!(speeds.all(|speed| speed < most), "{place}");
                assert!(overlap(&world) < deepest, "{place}: {}", overlap(&world));
            }
        }
    }
}

#[test]
fn the_work_of_walls_that_turn_closes_the_account() {
    // Without forces nothing else works, and what is left is rounding. In zones it is the work of the tick that has
    // begun: less than that of the frame in which there is most.
    for rule in [contact(), exact()] {
        let mut world = drum(rule, 30.0);
        let (mut walls, mut scale, mut accounted, mut most) = (0.0, 0.0, 0.0, 0.0_f64);
        let start = world.total_energy();
        for _ in 0..60 {
            let account = world.step(FRAME).unwrap().energy_account;
            walls += account.colliders;
            accounted += account.total();
            let work = account.colliders.abs() + account.contacts.abs();
            (scale, most) = (scale + work, most.max(work));
            let tolerance = if rule == contact() { 1e-12 * scale } else { 0.5 * most };
            let remainder = world.total_energy() - start - accounted;
            assert!(remainder.abs() <= tolerance, "{rule:?}: {remainder} J of {scale}");
        }
        assert!(walls > 0.1 * scale, "{rule:?}: {walls} of {scale}");
    }
}

#[test]
fn a_box_that_moves_steadily_is_a_box() {
    for speed in [1.0, 100.0] {
        let motion = speed * vec(0.6, -0.48, 0.64);
        let mut worlds = [DVec3::ZERO, motion].map(|motion| {
            let mut world = world(contact());
            let walls = container(DVec3::splat(0.5)).moving(motion, DVec3::ZERO);
            world.add_collider(walls.with_restitution(0.9)).unwrap();
            let own = vec(2.0, 1.3, -0.7);
            let ball = Sphere::new(DVec3::ZERO, 0.05).with_velocity(own + motion);
            world.add_sphere(ball.with_restitution(0.9)).unwrap();
            world
        });
        for _ in 0..120 {
            worlds.iter_mut().for_each(|world| run(world, 1));
            let [still, moving] = worlds.each_ref().map(|world| world.spheres().positions()[0]);
            let carried = still + worlds[0].time() * motion;
            // Rounding of coordinates, which bounces make no larger than so many times itself.
            assert!((moving - carried).length() < 1e-10, "{speed} m/s: {moving}, {carried}");
        }
    }
}

/// A hundred balls of this radius \[m\] that fall into a box open at its top, twenty radii wide.
fn powder(radius: f64) -> World {
    let mut world = world(contact());
    world.add_force(Gravity::new(vec(0.0, -G, 0.0))).unwrap();
    let shape = Shape::Container {
        size: DVec3::splat(20.0 * radius),
        open: Sides { top: true, ..Sides::NONE },
    };
    world.add_collider(Collider::new(shape, Pose::at(vec(0.0, 10.0 * radius, 0.0)))).unwrap();
    let mut numbers = Numbers(17);
    for place in 0..100u32 {
        let [i, j, k] = [place % 5, place / 25, place / 5 % 5].map(f64::from);
        let place = vec(3.4 * i - 6.8, 3.4 * j + 3.0, 3.4 * k - 6.8) + 0.15 * numbers.vector();
        world.add_sphere(Sphere::new(radius * place, radius)).unwrap();
    }
    world
}

/// The mean height of the centres above the floor, in radii.
fn height(world: &World) -> f64 {
    let spheres = world.spheres();
    let heights = spheres.positions().iter().zip(spheres.radii()).map(|(at, r)| at.y / r);
    heights.sum::<f64>() / spheres.len() as f64
}

#[test]
fn powder_rests_as_the_same_of_a_thousand_times_the_size() {
    // A second of the small one is, in units of √(r/g), as long as 31.6 of the large one.
    let (mut small, mut large) = (powder(5e-6), powder(5e-3));
    run(&mut small, 60);
    run(&mut large, 1900);
    for world in [&small, &large] {
        let radius = world.spheres().radii()[0];
        // On the floor in one layer, sunk by what a correction leaves.
        assert!((height(world) - 1.0).abs() < 1e-3, "{}", height(world));
        assert!(overlap(world) < 2e-3, "{}", overlap(world));
        let slow = 1e-2 * (G * radius).sqrt();
        assert!(world.spheres().velocities().iter().all(|it| it.length() < slow));
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
    world.add_collider(walls.clone().with_friction(numbers.next())).unwrap();
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

fn check(rule: Rule, seeds: impl Iterator<Item = u64>) {
    let faults: Vec<_> = seeds.filter_map(|seed| fault(rule, seed)).collect();
    assert!(faults.is_empty(), "{}: {faults:#?}", faults.len());
}

#[test]
fn nobody_leaves_two_hundred_boxes() {
    // The last ones bounce off one wall and would have passed another one before.
    check(contact(), (0..200).chain([493, 711, 1884, 9783]));
}

#[test]
fn nobody_leaves_two_hundred_boxes_with_zones() {
    // The last one bounces off one wall and would have passed another one before.
    check(exact(), (0..200).chain([662]));
}

#[test]
#[ignore = "takes minutes"]
fn nobody_leaves_ten_thousand_boxes() {
    check(contact(), 0..10_000);
    check(exact(), 0..10_000);
}

/// Impulses are answered together: too large ones to start from, between a heavy ball, light ones and a wall, would add
/// energy.
#[test]
fn a_heavy_ball_on_light_ones_in_a_swinging_bowl_gains_only_the_work_of_the_bowl() {
    for (rule, restitution) in
        [contact(), exact()].into_iter().flat_map(|it| [(it, 0.0), (it, 0.2)])
    {
        let mut world = world(rule);
        world.add_force(Gravity::new(-G * DVec3::Y)).unwrap();
        let bowl = Shape::Bowl { radius: 1.0, opening: FRAC_PI_2 };
        let swing = MotionPart::Swing {
            axis: DVec3::Z,
            pivot: DVec3::ZERO,
            amplitude: 0.35,
            frequency: 0.3,
            phase: 0.0,
        };
        let bowl = Collider::new(bowl, Pose::at(DVec3::ZERO)).with_motion([swing]);
        world.add_collider(bowl.with_friction(0.4).with_restitution(restitution)).unwrap();
        let ball = |place, radius, density| {
            let ball = Sphere::new(place, radius).with_density(density);
            ball.with_friction(0.4).with_restitution(restitution)
        };
        world.add_sphere(ball(0.6 * DVec3::Y, 0.3, 7800.0)).unwrap();
        let mut numbers = Numbers(3);
        for number in 0..18 {
            let column =
                DVec3::new(f64::from(number % 3), f64::from(number / 9), f64::from(number / 3 % 3));
            let place = 0.15 * (column - DVec3::new(1.0, 2.0, 1.0)) + 0.01 * numbers.vector();
            world.add_sphere(ball(place, 0.06, 1000.0)).unwrap();
        }
        let (start, mut given) = (world.total_energy(), 0.0);
        for _ in 0..90 {
            let account = world.step(FRAME).unwrap().energy_account;
            given += account.colliders + account.correction;
        }
        let gained = world.total_energy() - start - given;
        // The heavy ball loses its fall.
        assert!(gained < -5e3, "{rule:?}, restitution {restitution}: {gained} J");
    }
}
