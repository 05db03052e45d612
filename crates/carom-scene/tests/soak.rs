//! Long runs: the same state after every hour on every machine, and no growth of memory after the
//! first.
#![allow(missing_docs)]

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use carom::World;
use carom_scene::{BUILT_IN_FILES, Checkpoint, Palette, Scene};

/// Runs of a day: the name of a built-in scene, and text that is added to it or replaces parts of
/// it.
const RUNS: [(&str, &str); 4] = [
    ("simtest3", ""),
    // A container keeps its balls, which would fly away.
    (
        "tutorial4",
        "[[colliders]]\nposition = [0.0, 3.0, 0.0]\nshape = { container = { size = [8.0, 14.0, 8.0] } }\n",
    ),
    (
        "gas of a thousand",
        "name = \"gas\"\n[simulation]\nrule = \"exact\"\nboundary = { periodic = { size = [10.0, 10.0, 10.0] } }\n\
         [[generators]]\nrandom = { count = 500, min = [-4.5, -4.5, -4.5], max = [4.5, 4.5, 4.5], seed = 7, \
         sphere = { radius = 0.1, velocity = [1.0, 0.7, 0.3] } }\n\
         [[generators]]\nrandom = { count = 500, min = [-4.5, -4.5, -4.5], max = [4.5, 4.5, 4.5], seed = 8, \
         sphere = { radius = 0.1, velocity = [-1.0, -0.7, -0.3] } }\n",
    ),
    ("pour", ""),
];

/// Largest relative growth of memory after the first hour, plus a little that allocators do not
/// return.
const GROWTH: f64 = 0.05;
const SLACK_BYTES: f64 = 1e6;

fn scene(name: &str, more: &str) -> Scene {
    let file = BUILT_IN_FILES.iter().find(|file| file.0.strip_suffix(".toml") == Some(name));
    let text = file.map_or(String::new(), |file| file.1.to_owned()) + "\n" + more;
    // Bounces without end need `exact`; the scenes of the course keep its rule.
    let rule: &[&str] = if name == "tutorial4" { &["simulation.rule=exact"] } else { &[] };
    let rule: Vec<_> = rule.iter().map(|it| it.parse().unwrap()).collect();
    Scene::from_toml_with(&text, name, &rule).unwrap()
}

/// Memory of this process \[bytes\], if the system reports it.
fn resident_bytes() -> Option<f64> {
    let pages = std::fs::read_to_string("/proc/self/statm").ok()?;
    let pages: f64 = pages.split_whitespace().nth(1)?.parse().ok()?;
    Some(pages * 4096.0)
}

/// Advances a world by `seconds`; returns its state hash.
fn advance(world: &mut World, scene: &Scene, seconds: f64) -> String {
    let frame_time = scene.simulation.frame_time;
    for _ in 0..(seconds / frame_time).round() as u64 {
        world.step(frame_time).unwrap();
    }
    world.state_hash().to_string()
}

/// File for the state after `hours`.
fn state_file(folder: &Path, name: &str, hours: usize) -> PathBuf {
    folder.join(format!("{}-{hours}", name.replace(' ', "-")))
}

/// Runs a scene for `parts` times `seconds`; returns the state hash after each part. Stores the
/// states in `folder`, if there is one.
fn run(name: &str, more: &str, parts: usize, seconds: f64, folder: Option<&Path>) -> Vec<String> {
    let scene = scene(name, more);
    let palette = Palette::new(&scene).unwrap();
    let mut world = scene.world().unwrap();
    let mut memory = Vec::new();
    let part = |number| {
        let hash = advance(&mut world, &scene, seconds);
        let now = resident_bytes();
        let megabytes = now.map_or(String::new(), |bytes| format!(" {:.1} MB", bytes / 1e6));
        println!("{name} {number} {hash}{megabytes}");
        memory.extend(now);
        if let Some(folder) = folder {
            let bytes = Checkpoint::bytes_of(&world.snapshot(), &scene, &palette).unwrap();
            fs::write(state_file(folder, name, number), bytes).unwrap();
        }
        hash
    };
    let hashes = (1..=parts).map(part).collect();
    if let [first, .., last] = memory[..] {
        assert!(last <= first * (1.0 + GROWTH) + SLACK_BYTES, "{name}: {first} to {last} bytes");
    }
    hashes
}

/// Pinned hashes of each run, one per hour.
fn pinned() -> BTreeMap<&'static str, Vec<&'static str>> {
    let line = |line: &'static str| {
        let (name, hashes) = line.split_once(": ").unwrap();
        (name, hashes.split(' ').collect())
    };
    include_str!("soak_hashes.txt").lines().map(line).collect()
}

#[test]
fn an_hour_of_an_emitter_is_what_it_is_everywhere_and_takes_no_more_memory_than_minutes() {
    let hashes = run("simtest3", "", 6, 600.0, None);
    assert_eq!(hashes[5], pinned()["simtest3"][0]);
}

/// Number of hours: the variable `SOAK_HOURS`, or 24.
fn hours() -> usize {
    std::env::var("SOAK_HOURS").map_or(24, |hours| hours.parse().unwrap())
}

/// Folder for states: the variable `SOAK_STATES`.
fn folder() -> Option<PathBuf> {
    std::env::var_os("SOAK_STATES").map(PathBuf::from)
}

/// Runs each scene for a day, or `SOAK_HOURS` hours; stores the state after each hour in the folder
/// `SOAK_STATES`.
#[test]
#[ignore = "takes an hour: `cargo xtask soak`"]
fn a_day_is_what_it_is_everywhere_and_takes_no_more_memory_than_an_hour() {
    let folder = folder();
    let mut wrong = Vec::new();
    for (name, more) in RUNS {
        let hashes = run(name, more, hours(), 3600.0, folder.as_deref());
        let pinned = pinned().remove(name).unwrap();
        let other = hashes.iter().zip(pinned).position(|(one, other)| one != other);
        wrong.extend(other.map(|hour| format!("{name}: another state after hour {}", hour + 1)));
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// Runs one hour from the stored state before it; returns the difference from the pinned hash.
fn repeat(folder: &Path, name: &str, more: &str, hour: usize, pinned: &str) -> Option<String> {
    let scene = scene(name, more);
    let mut world = scene.world().unwrap();
    if hour > 1 {
        let file = state_file(folder, name, hour - 1);
        let Ok(bytes) = fs::read(&file) else {
            let (file, before) = (file.display(), hour - 1);
            return Some(format!("{file} is not there: run a soak of {before} hours before"));
        };
        world.restore(&Checkpoint::from_bytes(&bytes).unwrap().snapshot);
    }
    let hash = advance(&mut world, &scene, 3600.0);
    (hash != pinned).then(|| format!("{name}: {hash} after hour {hour}, not {pinned}"))
}

/// Repeats every hour from the stored state before it, with all hours in parallel on all
/// processors.
#[test]
#[ignore = "needs the states of a day: `cargo xtask soak --again`"]
fn every_hour_of_a_day_is_the_same_again_from_the_state_before_it() {
    let folder = folder().unwrap();
    let pinned = pinned();
    let hours: Vec<_> = RUNS
        .iter()
        .flat_map(|&(name, more)| {
            let hours = pinned[name].iter().take(hours()).enumerate();
            hours.map(move |(hour, pinned)| (name, more, hour + 1, pinned))
        })
        .collect();
    let (next, wrong) = (AtomicUsize::new(0), Mutex::new(Vec::new()));
    let work = || {
        while let Some(&(name, more, hour, pinned)) =
            hours.get(next.fetch_add(1, Ordering::Relaxed))
        {
            let fault = repeat(&folder, name, more, hour, pinned);
            wrong.lock().unwrap().extend(fault);
        }
    };
    std::thread::scope(|threads| {
        for _ in 0..std::thread::available_parallelism().unwrap().get() {
            threads.spawn(work);
        }
    });
    let wrong = wrong.into_inner().unwrap();
    println!("{} hours repeated", hours.len());
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
