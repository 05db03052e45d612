//! Rays a second through 10,000 spheres, sorted once, and the time of sorting them.

#![allow(clippy::disallowed_methods, missing_docs)]

use carom::{DVec3, QueryFilter, Sphere, World};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};

const SPHERES: usize = 10_000;
const RAYS: usize = 1_000;
const EDGE: f64 = 40.0;

/// Numbers in [0, 1), the same in every run.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        let mixed = (self.0 ^ (self.0 >> 33)).wrapping_mul(0xff51afd7ed558ccd);
        ((mixed ^ (mixed >> 33)) >> 11) as f64 / (1u64 << 53) as f64
    }

    fn place(&mut self) -> DVec3 {
        EDGE * DVec3::new(self.next(), self.next(), self.next())
    }
}

fn rays(criterion: &mut Criterion) {
    let mut numbers = Numbers(1);
    let mut world = World::default();
    for _ in 0..SPHERES {
        let radius = 0.1 + 0.2 * numbers.next();
        world.add_sphere(Sphere::new(numbers.place(), radius)).expect("a good sphere");
    }
    let ends: Vec<[DVec3; 2]> = (0..RAYS).map(|_| [numbers.place(), numbers.place()]).collect();
    let mut group = criterion.benchmark_group("queries");
    group.bench_function("sort", |bencher| bencher.iter(|| world.queries()));
    group.throughput(Throughput::Elements(RAYS as u64));
    let queries = world.queries();
    let filter = QueryFilter::default();
    group.bench_function("rays", |bencher| {
        bencher.iter(|| {
            let is_hit = |[from, to]: &&[DVec3; 2]| {
                queries.cast_ray(*from, *to - *from, &filter).expect("a good ray").is_some()
            };
            ends.iter().filter(is_hit).count()
        });
    });
    group.finish();
}

criterion_group!(benches, rays);
criterion_main!(benches);
