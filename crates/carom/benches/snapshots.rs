//! Times and bytes of a snapshot of 800 balls, new and into memory used before, and of restoring it.

#![allow(clippy::disallowed_methods, missing_docs)]

use allocation_counter::measure;
use carom::{Collider, Contact, DVec3, Exact, Gravity, Pose, Rule, Settings, Shape, Sphere, World};
use criterion::{Criterion, criterion_group, criterion_main};

const BALLS: u64 = 800;

/// Balls that have fallen for a second onto a floor, in ten layers.
fn fallen(rule: Rule) -> World {
    let settings = Settings::default().with_rule(rule);
    let mut world = World::new(settings).expect("good settings");
    world.add_force(Gravity::new(-9.81 * DVec3::Y)).expect("a good force");
    world.add_collider(Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO))).expect("a floor");
    for number in 0..BALLS as u32 {
        let [x, y, z] = [number % 10, number / 80, number / 10 % 8].map(f64::from);
        let place = DVec3::new(1.1 * x + 0.01 * y, 0.6 + 1.1 * y, 1.1 * z + 0.01 * y);
        world.add_sphere(Sphere::new(place, 0.5).with_restitution(0.5)).expect("a good ball");
    }
    for _ in 0..60 {
        world.step(1.0 / 60.0).expect("a good step");
    }
    world
}

fn snapshots(criterion: &mut Criterion) {
    let rules = [("exact", Rule::from(Exact::default())), ("contact", Contact::default().into())];
    for (name, rule) in rules {
        let mut world = fallen(rule);
        let mut group = criterion.benchmark_group(name);
        group.bench_function("snapshot", |bencher| bencher.iter(|| world.snapshot()));
        let mut snapshot = world.snapshot();
        group.bench_function("snapshot_into", |bencher| {
            bencher.iter(|| world.snapshot_into(&mut snapshot));
        });
        group.bench_function("restore", |bencher| bencher.iter(|| world.restore(&snapshot)));
        group.finish();
        let bytes = measure(|| drop(world.snapshot())).bytes_total;
        println!("{name}: {} bytes per ball", bytes / BALLS);
    }
}

criterion_group!(benches, snapshots);
criterion_main!(benches);
