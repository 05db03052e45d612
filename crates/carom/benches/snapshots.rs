//! Times and bytes of a snapshot of 800 balls, new and into memory used before, and of restoring it. `bench/rapier` has
//! the same balls under Rapier.

#![allow(clippy::disallowed_methods, clippy::print_stdout, missing_docs)]

use std::hint::black_box;
use std::time::Instant;

use allocation_counter::measure;
use carom::{Collider, Contact, DVec3, Exact, Gravity, Pose, Rule, Settings, Shape, Sphere, World};

const BALLS: u32 = 800;
const RUNS: u32 = 1000;

fn main() {
    let rules = [("exact", Rule::from(Exact::default())), ("contact", Contact::default().into())];
    for (name, rule) in rules {
        let mut world = fallen(rule);
        let bytes = measure(|| drop(world.snapshot())).bytes_total / u64::from(BALLS);
        let new = median_microseconds(|| drop(black_box(world.snapshot())));
        let mut snapshot = world.snapshot();
        let into = median_microseconds(|| world.snapshot_into(&mut snapshot));
        let restore = median_microseconds(|| world.restore(&snapshot));
        println!(
            "{name}: {bytes} bytes for a ball; snapshot {new:.1} us, snapshot_into {into:.1} us, restore {restore:.1} us"
        );
    }
}

/// Median of many runs, each timed by itself, so that other programs on the machine disturb few of them.
fn median_microseconds(mut task: impl FnMut()) -> f64 {
    let mut times: Vec<f64> = (0..RUNS)
        .map(|_| {
            let began = Instant::now();
            task();
            1e6 * began.elapsed().as_secs_f64()
        })
        .collect();
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

/// Balls that have fallen for a second onto a floor, in ten layers.
fn fallen(rule: Rule) -> World {
    let settings = Settings::default().with_rule(rule);
    let mut world = World::new(settings).expect("good settings");
    world.add_force(Gravity::new(-9.81 * DVec3::Y)).expect("a good force");
    world.add_collider(Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO))).expect("a floor");
    for number in 0..BALLS {
        let [x, y, z] = [number % 10, number / 80, number / 10 % 8].map(f64::from);
        let place = DVec3::new(1.1 * x + 0.01 * y, 0.6 + 1.1 * y, 1.1 * z + 0.01 * y);
        world.add_sphere(Sphere::new(place, 0.5).with_restitution(0.5)).expect("a good ball");
    }
    for _ in 0..60 {
        world.step(1.0 / 60.0).expect("a good step");
    }
    world
}
