//! Time of a frame of an elastic gas in a box, per sphere, as the number of spheres grows.
//!
//! Volume fraction 0.05, unit spheres, mean speed about 1; a frame moves a sphere by about a
//! twentieth of its radius. `cargo bench -p carom` prints the time of one frame; divide by the
//! number of spheres.

#![allow(clippy::disallowed_methods, missing_docs)]

use carom::{
    Bisect, Collider, DQuat, DVec3, Discrete, MotionPart, Pose, Rule, Settings, Shape, Sphere,
    World,
};
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};

const RADIUS: f64 = 0.5;
const VOLUME_FRACTION: f64 = 0.05;
const FRAME_TIME: f64 = 0.025;
/// Enough for the lattice at the start to be forgotten.
const FRAMES_OF_MIXING: usize = 200;

/// Numbers in [-1, 1), the same in every run.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        let mixed = (self.0 ^ (self.0 >> 33)).wrapping_mul(0xff51afd7ed558ccd);
        ((mixed ^ (mixed >> 33)) >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    fn vector(&mut self) -> DVec3 {
        DVec3::new(self.next(), self.next(), self.next())
    }
}

/// A wall that oscillates by a hundredth of a radius, so that it heats the gas by little.
fn shaking(wall: Collider) -> Collider {
    let (axis, amplitude) = (DVec3::X, 0.01 * RADIUS);
    wall.with_motion([MotionPart::Oscillate { axis, amplitude, frequency: 1.0, phase: 0.0 }])
}

/// A box of `count` spheres, its walls six half-spaces; the first one moves as `first` says.
fn gas(count: usize, rule: Rule, first: impl FnOnce(Collider) -> Collider) -> World {
    let mut world = World::new(Settings::default().with_rule(rule)).expect("good settings");
    let edge = (count as f64 * carom::volume(RADIUS) / VOLUME_FRACTION).cbrt();
    let (center, half) = (DVec3::splat(0.5 * edge), 0.5 * edge);
    let mut first = Some(first);
    for normal in [DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::NEG_Y, DVec3::Z, DVec3::NEG_Z] {
        let pose =
            Pose::at(center - half * normal).rotated(DQuat::from_rotation_arc(DVec3::Y, normal));
        let wall = Collider::new(Shape::HalfSpace, pose);
        let wall = first.take().map_or(wall.clone(), |first| first(wall));
        world.add_collider(wall).expect("a good wall");
    }
    let per_side = (count as f64).cbrt().ceil() as usize;
    let mut numbers = Numbers(1);
    for i in 0..count {
        let cell = [i % per_side, i / per_side % per_side, i / (per_side * per_side)];
        let cell = DVec3::from_array(cell.map(|k| k as f64 + 0.5));
        let sphere = Sphere::new(cell * (edge / per_side as f64), RADIUS);
        world.add_sphere(sphere.with_velocity(numbers.vector())).expect("a good sphere");
    }
    for _ in 0..FRAMES_OF_MIXING {
        world.step(FRAME_TIME).expect("a step");
    }
    world
}

fn frames(criterion: &mut Criterion) {
    let rules = [
        ("discrete", Rule::Discrete(Discrete::default())),
        ("bisect", Rule::Bisect(Bisect::default())),
        ("exact", Rule::default()),
    ];
    for (name, rule) in rules {
        let mut group = criterion.benchmark_group(format!("gas/{name}"));
        group.sample_size(20);
        for count in [1_000, 10_000, 100_000] {
            let world = gas(count, rule, |wall| wall);
            group.throughput(Throughput::Elements(count as u64));
            group.bench_with_input(BenchmarkId::from_parameter(count), &count, |bencher, _| {
                let mut world = world.clone();
                bencher.iter(|| world.step(FRAME_TIME).expect("a step").impacts.len());
            });
        }
        group.finish();
    }
}

fn frames_with_a_wall_that_moves(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("gas/walls");
    group.sample_size(20);
    let walls = [("fixed", false), ("one moves", true)];
    for (name, moves) in walls {
        let first = |wall| if moves { shaking(wall) } else { wall };
        let world = gas(10_000, Rule::default(), first);
        group.bench_function(name, |bencher| {
            let mut world = world.clone();
            bencher.iter(|| world.step(FRAME_TIME).expect("a step").impacts.len());
        });
    }
    group.finish();
}

criterion_group!(benches, frames, frames_with_a_wall_that_moves);
criterion_main!(benches);
