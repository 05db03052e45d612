//! Large meshes: time and memory to load one, and time of a frame of balls on height fields.

#![allow(clippy::disallowed_methods, clippy::print_stdout, missing_docs)]

use allocation_counter::measure;
use carom::{Collider, Contact, DVec3, Gravity, Mesh, Pose, Settings, Shape, Sphere, World};
use std::f64::consts::TAU;

const FRAME: f64 = 1.0 / 60.0;
const FRAMES: u32 = 300;
/// Balls along each of x and z.
const BALLS: u32 = 32;
const RADIUS: f64 = 0.3;

fn main() {
    load("mesh of 100,352 triangles", || {
        let Shape::Mesh(field) = field(225, 1.0) else { unreachable!("a mesh") };
        let triangles = field.triangles().to_vec();
        Shape::Mesh(Mesh::new(field.vertices().to_vec(), triangles).expect("a good mesh"))
    });
    for (count, cell) in [(300, 1.0), (300, 0.3), (1000, 1.0)] {
        let name = format!("{count} x {count} heights, cells of {cell:.2} m");
        let mut world = load(&name, || field(count, cell));
        add_balls(&mut world);
        let began = processor_seconds();
        for _ in 0..FRAMES {
            world.step(FRAME).expect("a good step");
        }
        let time = 1e3 * (processor_seconds() - began) / f64::from(FRAMES);
        let least = world.spheres().positions().iter().map(|it| it.y).fold(f64::INFINITY, f64::min);
        println!(
            "  {} balls, {FRAMES} frames: {time:.2} ms a frame; lowest {least:.2} m",
            BALLS * BALLS
        );
    }
}

/// Processor time of this program \[s\], in hundredths of a second; 0 where Linux does not say it.
fn processor_seconds() -> f64 {
    let stat = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    let fields = stat.rsplit(')').next().unwrap_or_default().split_whitespace();
    fields.skip(11).take(2).filter_map(|it| it.parse::<f64>().ok()).sum::<f64>() / 100.0
}

/// Makes a world of a surface, with its first step, and prints the time and the memory.
fn load(name: &str, shape: impl FnOnce() -> Shape) -> World {
    let began = processor_seconds();
    let mut settings = Settings::default();
    settings.rule = Contact::default().into();
    let mut world = World::new(settings).expect("good settings");
    let used = measure(|| {
        let collider = Collider::new(shape(), Pose::at(DVec3::ZERO)).with_restitution(0.3);
        world.add_collider(collider.with_friction(0.4)).expect("a good collider");
        world.add_force(Gravity::new(DVec3::new(0.0, -9.81, 0.0))).expect("a good force");
        world.add_sphere(Sphere::new(DVec3::new(0.1, 5.0, 0.1), RADIUS)).expect("a good sphere");
        world.step(FRAME).expect("a good step");
    });
    let megabytes = |bytes: f64| bytes / 1e6;
    println!(
        "{name}: {:.2} s, {:.0} MB, {:.0} MB at most",
        processor_seconds() - began,
        megabytes(used.bytes_current as f64),
        megabytes(used.bytes_max as f64),
    );
    world
}

/// Hills of some metres, with a roughness of a hundredth of a cell \[m\].
fn field(count: usize, cell: f64) -> Shape {
    let mut state: u64 = 1;
    let mut noise = || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 33) as f64 / (1u64 << 31) as f64 - 0.5
    };
    let place = |number: usize| cell * (number as f64 - 0.5 * (count - 1) as f64);
    let wave = |place: f64, length: f64| libm::sin(TAU * place / length);
    let mut height =
        |x: f64, z: f64| wave(x, 25.0) * wave(z, 31.0) + 0.2 * wave(x, 7.0) + 0.02 * cell * noise();
    let rows: Vec<Vec<f64>> = (0..count)
        .map(|row| (0..count).map(|column| height(place(column), place(row))).collect())
        .collect();
    let size = cell * (count - 1) as f64;
    Shape::Mesh(Mesh::from_heights([size, size], &rows).expect("a good field"))
}

/// Adds a lattice of balls, which fall onto 60 m x 60 m of the field.
fn add_balls(world: &mut World) {
    for number in 0..BALLS * BALLS {
        let place = |it: u32| 1.9 * (f64::from(it) - 0.5 * f64::from(BALLS - 1));
        let (x, z) = (place(number % BALLS), place(number / BALLS));
        let center = DVec3::new(x, 2.5 + 0.1 * f64::from(number % 7), z);
        let ball = Sphere::new(center, RADIUS).with_restitution(0.3).with_friction(0.4);
        world.add_sphere(ball).expect("a good sphere");
    }
}
