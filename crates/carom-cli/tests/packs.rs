//! The command `carom pack`: packings that other commands read, and what it says of them.

mod command;

use command::{bad_line, good, path, run};
use tempfile::TempDir;

/// The number in the line of a summary that begins with a word.
fn number(summary: &str, begins: &str) -> f64 {
    let line = summary.lines().find(|line| line.starts_with(begins)).unwrap();
    line[begins.len()..].split_whitespace().next().unwrap().parse().unwrap()
}

#[test]
fn packing_is_written_as_a_scene_that_runs_and_as_a_particle_file() {
    let folder = TempDir::new().unwrap();
    for name in ["dense.toml", "dense.xyz"] {
        let file = path(&folder, name);
        let sizes = ["--sizes", "0.5:2,0.6-0.7:1", "--growth", "0.1"];
        let args = ["pack", "--spheres", "120", "--packing-fraction", "0.5", "--out", &file];
        let summary = good(&[&args[..], &sizes[..]].concat());
        assert_eq!(number(&summary, "packing fraction"), 0.5);
        // Denser than a gas, looser than a crystal.
        assert!((8.0..30.0).contains(&number(&summary, "reduced pressure")), "{summary}");
        assert_eq!(run(&args).status.code(), Some(2), "it is there");
    }
    let scene = path(&folder, "dense.toml");
    good(&["run", &scene, "--frames", "3", "--strict"]);
    let imported = path(&folder, "imported.toml");
    good(&["import", &path(&folder, "dense.xyz"), "--out", &imported]);
    let state = |scene: &str| {
        let table = good(&["run", scene, "--frames", "3", "--frame-time", "0.01"]);
        table.lines().find(|line| line.starts_with("state hash")).unwrap().to_owned()
    };
    assert_eq!(state(&scene), state(&imported));
}

#[test]
fn fluid_is_the_same_for_a_seed_and_another_for_another() {
    let hash = |seed: &str| {
        let args = ["pack", "--spheres", "64", "--packing-fraction", "0.4", "--growth", "0.1"];
        let summary = good(&[&args[..], &["--seed", seed, "--equilibrate", "5"]].concat());
        summary.lines().find(|line| line.starts_with("state hash")).unwrap().to_owned()
    };
    assert_eq!(hash("1"), hash("1"));
    assert_ne!(hash("1"), hash("2"));
}

#[test]
fn packing_counts_rattlers_or_says_that_it_jammed() {
    let jammed = ["pack", "--spheres", "100", "--growth", "0.05"];
    let summary = good(&[&jammed[..], &["--pressure", "1e6"]].concat());
    assert!((0.55..0.68).contains(&number(&summary, "packing fraction")), "{summary}");
    assert!(number(&summary, "rattlers") < 30.0, "{summary}");
    let line = bad_line(&[&jammed[..], &["--packing-fraction", "0.73"]].concat(), 1);
    assert!(line.contains("jammed at a packing fraction of 0.6"), "{line}");
}

#[test]
fn sizes_that_make_no_sense_are_one_line() {
    for sizes in ["0", "0.5:0", "0.7-0.5", "a", "", "0.5,,1"] {
        let output = run(&["pack", "--sizes", sizes]);
        assert_eq!(output.status.code(), Some(2), "{sizes}");
    }
    assert!(bad_line(&["pack", "--spheres", "2"], 2).contains("four times"));
}

#[test]
fn run_tells_the_stress_of_a_packing_and_its_pressure() {
    let folder = TempDir::new().unwrap();
    let file = path(&folder, "fluid.toml");
    let size = ["--spheres", "100", "--packing-fraction", "0.4", "--growth", "0.1"];
    good(&[&["pack", "--out", &file][..], &size[..]].concat());
    let summary = good(&["run", &file, "--frames", "200", "--stress"]);
    // N k T/V of 100 spheres with m = 1/8 kg and k T of about that, times 7 by Carnahan and Starling; growth may
    // have doubled the temperature.
    let pressure = number(&summary, "pressure");
    assert!((0.5..4.0).contains(&pressure), "{summary}");
    let rows: Vec<f64> = ["stress x", "stress y", "stress z"]
        .iter()
        .enumerate()
        .map(|(axis, name)| {
            let line = summary.lines().find(|line| line.starts_with(name)).unwrap();
            line[name.len()..].split_whitespace().nth(axis).unwrap().parse().unwrap()
        })
        .collect();
    // Seven digits are printed.
    assert!((rows.iter().sum::<f64>() / (3.0 * pressure) - 1.0).abs() < 1e-5, "{summary}");
    let json = good(&["run", &file, "--frames", "200", "--stress=1", "--json"]);
    let json: serde_json::Value = serde_json::from_str(&json).unwrap();
    let in_a_cubic_metre = json["stress"]["pressure"].as_f64().unwrap();
    // 100 spheres of radius 1/2 at 0.4 are in 131 m³.
    assert!((in_a_cubic_metre / pressure / 130.9 - 1.0).abs() < 1e-3, "{in_a_cubic_metre}");
    let refusal = bad_line(&["run", "bounce", "--frames", "2", "--stress"], 2);
    assert!(refusal.contains("--stress needs a volume"), "{refusal}");
}
