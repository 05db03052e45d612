//! How long each frame of a scene takes natively: the other half of what
//! `web/package/bench/frame_times.mjs` measures of the package.
//!
//! `frame_times FILE RUNS [PATH=VALUE ...]` prints a JSON list of milliseconds, of each frame the
//! least of all runs: what the machine did besides is no part of it.

use std::error::Error;
use std::path::Path;
use std::time::Instant;

use carom_scene::{Override, Scene};

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [file, runs, overrides @ ..] = &arguments[..] else {
        return Err("usage: frame_times FILE RUNS [PATH=VALUE ...]".into());
    };
    let overrides: Result<Vec<Override>, _> = overrides.iter().map(|it| it.parse()).collect();
    let scene = Scene::from_file(Path::new(file), &overrides?)?;
    let mut least: Vec<f64> = Vec::new();
    for _ in 0..runs.parse::<u32>()? {
        let times = frame_times(&scene)?;
        least.resize(times.len(), f64::INFINITY);
        least.iter_mut().zip(times).for_each(|(least, time)| *least = least.min(time));
    }
    println!("{}", serde_json::to_string(&least)?);
    Ok(())
}

/// Times of the frames of a scene \[ms\], until its duration is over.
fn frame_times(scene: &Scene) -> Result<Vec<f64>, Box<dyn Error>> {
    let mut world = scene.world()?;
    let mut times = Vec::new();
    while world.time() < scene.simulation.duration {
        let began = Instant::now();
        world.step(scene.simulation.frame_time)?;
        times.push(1e3 * began.elapsed().as_secs_f64());
    }
    Ok(times)
}
