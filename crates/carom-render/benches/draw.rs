//! The time to draw a picture: balls above a floor, 1280 x 720 pixels, read back into memory.

#![allow(missing_docs)]

use carom::{DQuat, DVec3, Pose, Shape};
use carom_render::{Ball, Camera, Drawing, Offscreen, Pattern, Quality};
use carom_scene::scene::Finish;
use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};

/// Returns a drawing of `count` balls in a cube above a floor.
fn balls(count: usize) -> Drawing {
    let mut drawing = Drawing::default();
    let edge = (count as f64).cbrt().ceil() as usize;
    for i in 0..count {
        let place = [i % edge, i / edge % edge, i / edge / edge].map(|it| it as f64 + 0.5);
        drawing.balls.push(Ball {
            center: DVec3::from_array(place),
            radius: 0.35,
            color: [0.2, 0.45, 0.8],
            rotation: DQuat::IDENTITY,
            pattern: Pattern::Plain,
            finish: Finish::default(),
        });
    }
    let size = 3.0 * edge as f64;
    let floor = Shape::Rectangle { size_x: size, size_z: size };
    let middle = DVec3::new(0.5, 0.0, 0.5) * edge as f64;
    drawing.add_collider(floor, Pose::at(middle), [0.86, 0.85, 0.82], false);
    drawing
}

fn draw(criterion: &mut Criterion) {
    let qualities = [("draft", Quality::DRAFT), ("good", Quality::GOOD), ("fine", Quality::FINE)];
    for (name, quality) in qualities {
        let mut offscreen = Offscreen::new([1280, 720], quality).expect("a graphics driver");
        let mut group = criterion.benchmark_group(name);
        group.sample_size(10);
        for count in [100, 10_000, 100_000] {
            let drawing = balls(count);
            let bounds = drawing.bounds().expect("there are balls");
            let camera = Camera::fitted(&bounds, DVec3::new(0.45, 0.5, 1.0), 16.0 / 9.0);
            group.bench_function(BenchmarkId::from_parameter(count), |bencher| {
                bencher.iter(|| offscreen.draw(&drawing, &camera).expect("a picture"));
            });
        }
    }
}

criterion_group!(benches, draw);
criterion_main!(benches);
