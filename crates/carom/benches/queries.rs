//! Rays a second through 10,000 spheres, alone and with a sheet of 100,000 triangles, sorted once, and the time of
//! sorting them.

#![allow(clippy::disallowed_methods, missing_docs)]

use carom::{Collider, DVec3, Mesh, Pose, QueryFilter, Shape, Sphere, World};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};

const SPHERES: usize = 10_000;
const RAYS: usize = 1_000;
const EDGE: f64 = 40.0;
/// Cells of the sheet along an edge, of two triangles each.
const CELLS: usize = 224;

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
    let row = |_| (0..=CELLS).map(|_| 4.0 * numbers.next()).collect::<Vec<f64>>();
    let rows: Vec<Vec<f64>> = (0..=CELLS).map(row).collect();
    let mut with_sheet = world.clone();
    let sheet = Mesh::from_heights([EDGE, EDGE], &rows).expect("a good sheet");
    let middle = Pose::at(DVec3::splat(0.5 * EDGE));
    with_sheet.add_collider(Collider::new(Shape::Mesh(sheet), middle)).expect("a good collider");
    let mut group = criterion.benchmark_group("queries");
    group.bench_function("sort", |bencher| bencher.iter(|| world.queries()));
    group.throughput(Throughput::Elements(RAYS as u64));
    let filter = QueryFilter::default();
    for (name, world) in [("rays", &world), ("rays and triangles", &with_sheet)] {
        let queries = world.queries();
        group.bench_function(name, |bencher| {
            bencher.iter(|| {
                let is_hit = |[from, to]: &&[DVec3; 2]| {
                    queries.cast_ray(*from, *to - *from, &filter).expect("a good ray").is_some()
                };
                ends.iter().filter(is_hit).count()
            });
        });
    }
    group.finish();
}

criterion_group!(benches, rays);
criterion_main!(benches);
