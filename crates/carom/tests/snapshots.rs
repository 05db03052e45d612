//! Snapshots into memory that is used again.

mod common;

use allocation_counter::measure;
use carom::{
    Collider, Contact, DVec3, Exact, Gravity, PointAttractor, Pose, Rule, Shape, Sphere, World,
};
use common::{Numbers, bisect, discrete, vec, world};

/// Spheres that fall onto a floor, a sixtieth of a second a frame.
fn falling(rule: impl Into<Rule>, count: u32, frames: u32) -> World {
    let mut numbers = Numbers(count.into());
    let mut world = world(rule);
    world.add_force(Gravity::new(-9.81 * DVec3::Y)).unwrap();
    let floor = Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO)).with_friction(0.3);
    world.add_collider(floor).unwrap();
    for number in 0..count {
        let [x, y, z] = [number % 5, number / 25, number / 5 % 5].map(f64::from);
        let sphere = Sphere::new(1.1 * vec(x, y + 1.0, z), 0.5).with_restitution(0.5);
        world.add_sphere(sphere.with_velocity(numbers.vector()).with_friction(0.3)).unwrap();
    }
    advance(&mut world, frames);
    world
}

fn advance(world: &mut World, frames: u32) {
    for _ in 0..frames {
        world.step(1.0 / 60.0).unwrap();
    }
}

/// A gas on curved flights around an attractor.
fn curved() -> World {
    let mut world = world(Exact::default());
    world.add_force(PointAttractor::new(DVec3::ZERO, 20.0)).unwrap();
    for number in 0..100 {
        let [x, y, z] = [number % 5, number / 25, number / 5 % 5].map(f64::from);
        world.add_sphere(Sphere::new(vec(x + 3.0, y, z), 0.2)).unwrap();
    }
    advance(&mut world, 20);
    world
}

#[test]
fn a_snapshot_into_memory_of_its_size_allocates_nothing_and_neither_does_restoring_it() {
    let mut worlds = [
        falling(Contact::default(), 200, 60),
        falling(Exact::default(), 200, 10),
        falling(discrete(), 200, 60),
        falling(bisect(), 50, 10),
        curved(),
        World::default(),
    ];
    for (number, world) in worlds.iter_mut().enumerate() {
        let mut snapshot = world.snapshot();
        let allocations = measure(|| world.snapshot_into(&mut snapshot)).count_total;
        assert_eq!(allocations, 0, "snapshot of world {number}");
        let allocations = measure(|| world.restore(&snapshot)).count_total;
        assert_eq!(allocations, 0, "restoring world {number}");
    }
}

#[test]
fn a_snapshot_into_the_memory_of_any_other_continues_as_a_new_one() {
    let worlds = || {
        [
            falling(Contact::default(), 60, 90),
            falling(Contact::default(), 200, 30),
            falling(Exact::default(), 60, 90),
            falling(discrete(), 30, 30),
            falling(bisect(), 20, 30),
            curved(),
            World::default(),
        ]
    };
    let (firsts, mut seconds) = (worlds(), worlds());
    for first in firsts {
        let expected = first.snapshot();
        for second in &mut seconds {
            let mut snapshot = second.snapshot();
            first.snapshot_into(&mut snapshot);
            let mut new = World::default();
            new.restore(&expected);
            second.restore(&snapshot);
            assert_eq!(second.state_hash(), new.state_hash());
            advance(&mut new, 20);
            advance(second, 20);
            assert_eq!(second.state_hash(), new.state_hash());
            assert_eq!(second.report(), new.report());
        }
    }
}
