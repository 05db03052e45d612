//! The time of a frame of the interface without drawing the picture: panels, plots and transport,
//! with nothing new to show, and while a scene with little physics plays.

#![allow(missing_docs)]

use carom_render::Quality;
use carom_scene::scene::{Generator, Lattice, Scene, Sphere};
use carom_scene::{Budget, Library, Source};
use carom_session::Command;
use carom_view::{Action, App, Desktop, Setup, Start};
use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use egui_kittest::Harness;

/// Returns a scene with `count` spheres in a lattice, all with the same velocity.
fn lattice(count: u32) -> Scene {
    let mut scene = Scene::new("lattice");
    let edge = f64::from(count).cbrt().ceil() as u32;
    let sphere = Sphere { velocity: [0.1, 0.0, 0.0], ..Sphere::at([0.0; 3], 0.35) };
    scene.generators.push(Generator::Lattice(Box::new(Lattice {
        counts: [edge, edge, count.div_ceil(edge * edge)],
        start: [0.0; 3],
        spacing: [1.0; 3],
        sphere: Some(sphere),
        collider: None,
    })));
    scene
}

fn frame(criterion: &mut Criterion) {
    for playing in [false, true] {
        let name = if playing { "playing" } else { "nothing new" };
        let mut group = criterion.benchmark_group(name);
        group.sample_size(10);
        for count in [100, 10_000, 100_000] {
            let scene = Box::new(lattice(count));
            let setup = Setup {
                library: Library::new(),
                start: Some(Start::Scene(scene, Source::Registered)),
                host: Box::new(Desktop::default()),
                quality: Quality::DRAFT,
                inline_budget: None,
                link_budget: Budget::LINK,
            };
            let builder = Harness::builder().with_size([1360.0, 800.0]).wgpu();
            let mut window =
                builder.build_eframe(|host| App::new(host, setup).expect("wgpu is there"));
            window.state_mut().act(Action::Plots);
            if playing {
                window.state_mut().command(Command::Play);
            }
            window.run_steps(10);
            group.bench_function(BenchmarkId::from_parameter(count), |bencher| {
                bencher.iter(|| window.run_steps(1));
            });
        }
    }
}

criterion_group!(benches, frame);
criterion_main!(benches);
