//! Time of derivatives beside that of a plain run, and their memory, for a thousand balls and a hundred thousand
//! impacts.

#![allow(clippy::disallowed_methods, missing_docs)]

use std::time::Instant;

use carom::{Boundary, DVec3, Settings, Sphere, SphereTangent, Tangents, Tape, Variation, World};

/// Numbers in [-1, 1), the same in every run.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        let mixed = (self.0 ^ (self.0 >> 33)).wrapping_mul(0xff51afd7ed558ccd);
        2.0 * ((mixed ^ (mixed >> 33)) >> 11) as f64 / (1u64 << 53) as f64 - 1.0
    }

    fn vector(&mut self) -> DVec3 {
        DVec3::new(self.next(), self.next(), self.next())
    }
}

/// A gas of a thousand elastic balls in a periodic box, a fifth of it filled.
fn gas() -> World {
    let (side, spacing) = (10, 1.0);
    let radius = spacing * libm::cbrt(0.2 * 0.75 / std::f64::consts::PI);
    let size = DVec3::splat(f64::from(side) * spacing);
    let settings = Settings::default().with_boundary(Boundary::Periodic { size });
    let mut world = World::new(settings).expect("good settings");
    let mut numbers = Numbers(9);
    for number in 0..side * side * side {
        let (i, j, k) = (number % side, number / side % side, number / (side * side));
        let place = DVec3::new(f64::from(i), f64::from(j), f64::from(k)) * spacing;
        let velocity = numbers.vector();
        let ball = Sphere::new(place + 0.05 * numbers.vector(), radius).with_velocity(velocity);
        world.add_sphere(ball).expect("a good sphere");
    }
    world
}

/// Takes steps until there were 10⁵ impacts. Returns their number and the time \[s\].
fn timed(mut step: impl FnMut() -> usize) -> (usize, f64) {
    let (begun, mut impacts) = (Instant::now(), 0);
    while impacts < 100_000 {
        impacts += step();
    }
    (impacts, begun.elapsed().as_secs_f64())
}

/// Returns the largest memory of this process so far \[MB\], where the system says it.
fn most_memory() -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find(|line| line.starts_with("VmHWM"));
    let number = line.and_then(|line| line.split_whitespace().nth(1)?.parse::<f64>().ok());
    number.unwrap_or(0.0) / 1e3
}

fn main() {
    let dt = 0.5;
    let mut world = gas();
    let (impacts, plain) = timed(|| world.step(dt).expect("a step with derivatives").impacts.len());
    println!("plain: {impacts} impacts in {plain:.3} s");
    let first = world.spheres().ids()[0];
    for count in [1, 2, 4, 8] {
        let mut world = gas();
        let ids = world.spheres().ids().to_vec();
        let directions = ids.iter().take(count);
        let directions = directions.map(|&id| Variation::default().with_velocity(id, DVec3::X));
        let mut tangents =
            Tangents::new(&world, directions.collect()).expect("a step with derivatives");
        let (_, time) = timed(|| {
            tangents.step(&mut world, dt).expect("a step with derivatives");
            world.report().impacts.len()
        });
        println!("{count} directions: {:.2} plain runs", time / plain);
    }
    let mut world = gas();
    let before = most_memory();
    let mut tape = Tape::start(&world).expect("a step with derivatives");
    let (impacts, recorded) = timed(|| {
        tape.step(&mut world, dt).expect("a step with derivatives");
        world.report().impacts.len()
    });
    let begun = Instant::now();
    let along = SphereTangent { position: DVec3::X, ..SphereTangent::default() };
    let gradient = tape.gradient(&[(first, along)]).expect("a step with derivatives");
    let backwards = begun.elapsed().as_secs_f64();
    let memory = most_memory();
    println!("record: {:.2} plain runs, gradient {:.2}", recorded / plain, backwards / plain);
    println!(
        "{:.0} MB, {:.0} bytes for each impact",
        memory,
        (memory - before) * 1e6 / impacts as f64
    );
    println!("gradient by the first velocity: {}", gradient.sphere(first).velocity);
}
