//! Measures the native frame times of a scene, for comparison with those of the JavaScript package
//! in `web/package/bench/frame_times.mjs`.
//!
//! `frame_times FILE RUNS [PATH=VALUE ...]` prints a JSON list of milliseconds: for each frame the
//! least of all runs, which leaves out most of the machine's other work.

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

/// Returns the times of all frames until the scene's duration is over \[ms\].
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
