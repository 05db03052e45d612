//! Long runs: hour by hour the same states on every machine, and no more memory than in the first one.
#![allow(missing_docs)]

use std::collections::BTreeMap;

use carom_scene::{BUILT_IN_FILES, Scene};

/// What runs for a day: its name, and what is changed of the built-in scene of that name, or added to it.
const RUNS: [(&str, &str); 4] = [
    ("simtest3", ""),
    // Contained, for its balls would fly away.
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

/// Memory may grow by this part after the first hour, and by a little of which allocators give nothing back.
const GROWTH: f64 = 0.05;
const SLACK_BYTES: f64 = 1e6;

fn scene(name: &str, more: &str) -> Scene {
    let file = BUILT_IN_FILES.iter().find(|file| file.0.strip_suffix(".toml") == Some(name));
    let text = file.map_or(String::new(), |file| file.1.to_owned()) + "\n" + more;
    // Bounces without end are for `exact`; the course's scenes stay under the course's rule.
    let rule: &[&str] = if name == "tutorial4" { &["simulation.rule=exact"] } else { &[] };
    let rule: Vec<_> = rule.iter().map(|it| it.parse().unwrap()).collect();
    Scene::from_toml_with(&text, name, &rule).unwrap()
}

/// Memory of this process \[bytes\], where the system tells.
fn resident_bytes() -> Option<f64> {
    let pages = std::fs::read_to_string("/proc/self/statm").ok()?;
    let pages: f64 = pages.split_whitespace().nth(1)?.parse().ok()?;
    Some(pages * 4096.0)
}

/// Runs a scene for so many parts of `seconds` each, and returns the state hash after each.
fn run(name: &str, more: &str, parts: usize, seconds: f64) -> Vec<String> {
    let scene = scene(name, more);
    let frame_time = scene.simulation.frame_time;
    let mut world = scene.world().unwrap();
    let mut memory = Vec::new();
    let part = |number| {
        for _ in 0..(seconds / frame_time).round() as u64 {
            world.step(frame_time).unwrap();
        }
        memory.extend(resident_bytes());
        println!("{name} {number} {}", world.state_hash());
        world.state_hash().to_string()
    };
    let hashes = (1..=parts).map(part).collect();
    if let [first, .., last] = memory[..] {
        assert!(last <= first * (1.0 + GROWTH) + SLACK_BYTES, "{name}: {first} to {last} bytes");
        println!(
            "{name}: {:.1} MB after the first part, {:.1} MB at the end",
            first / 1e6,
            last / 1e6
        );
    }
    hashes
}

/// The pinned hashes of each run, hour by hour.
fn pinned() -> BTreeMap<&'static str, Vec<&'static str>> {
    let line = |line: &'static str| {
        let (name, hashes) = line.split_once(": ").unwrap();
        (name, hashes.split(' ').collect())
    };
    include_str!("soak_hashes.txt").lines().map(line).collect()
}

#[test]
fn an_hour_of_an_emitter_is_what_it_is_everywhere_and_takes_no_more_memory_than_minutes() {
    let hashes = run("simtest3", "", 6, 600.0);
    assert_eq!(hashes[5], pinned()["simtest3"][0]);
}

/// A day of each, or as many hours as `SOAK_HOURS` says.
#[test]
#[ignore = "takes an hour: `cargo xtask soak`"]
fn a_day_is_what_it_is_everywhere_and_takes_no_more_memory_than_an_hour() {
    let hours = std::env::var("SOAK_HOURS").map_or(24, |hours| hours.parse().unwrap());
    let mut wrong = Vec::new();
    for (name, more) in RUNS {
        let hashes = run(name, more, hours, 3600.0);
        let pinned = pinned().remove(name).unwrap();
        let other = hashes.iter().zip(pinned).position(|(one, other)| one != other);
        wrong.extend(other.map(|hour| format!("{name}: another state after hour {}", hour + 1)));
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
