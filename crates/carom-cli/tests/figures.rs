//! The commands that print figures: `verify`, `compare`, `bench`. This tests their output for users
//! and scripts; `carom verify` itself tests the physics.

mod command;

use command::{bad, run};
use serde_json::Value;

/// Parses the JSON output of a command that ends with this code.
#[track_caller]
fn json(arguments: &[&str], code: i32) -> Value {
    let output = run(&[arguments, &["--json"]].concat());
    let errors = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(code), "{arguments:?}: {errors}");
    serde_json::from_slice(&output.stdout).unwrap()
}

#[test]
fn verify_tells_of_each_claim_what_was_expected_measured_and_allowed() {
    let report = json(&["verify", "--filter", "head-on, equal"], 0);
    let [claim] = report["claims"].as_array().unwrap().as_slice() else { panic!("{report}") };
    for number in ["expected", "measured", "error", "tolerance", "wall_time"] {
        assert!(claim[number].is_number(), "{number}: {claim}");
    }
    for text in ["claim", "source", "reason", "state_hash"] {
        assert!(!claim[text].as_str().unwrap().is_empty(), "{text}: {claim}");
    }
    assert_eq!(claim["verdict"], "pass");
    assert_eq!(report["machine"]["carom"], env!("CARGO_PKG_VERSION"));
    assert!(report["machine"]["cores"].as_u64().unwrap() >= 1);
}

#[test]
fn the_filter_of_verify_keeps_claims_whose_name_holds_it_in_order() {
    let report = json(&["verify", "--filter", "cradle of 5"], 0);
    let names: Vec<&str> = report["claims"]
        .as_array()
        .unwrap()
        .iter()
        .map(|it| it["claim"].as_str().unwrap())
        .collect();
    assert_eq!(names.len(), 4);
    assert!(names.iter().zip(1..).all(|(name, k)| name.contains(&format!("{k} in: {k} out"))));
    let refusal = bad(&["verify", "--filter", "perpetuum"], 2);
    assert!(refusal.contains("no claim has") && refusal.contains("silo"), "{refusal}");
}

#[test]
fn the_filter_of_verify_takes_a_topic() {
    let report = json(&["verify", "--filter", "motion"], 0);
    let claims = report["claims"].as_array().unwrap();
    assert!(!claims.is_empty());
    let other = json(&["verify", "--filter", "forces"], 0);
    assert!(other["claims"].as_array().unwrap().iter().all(|claim| !claims.contains(claim)));
}

#[test]
fn verify_shows_what_the_rule_discrete_misses_and_ends_with_code_1() {
    let filter = ["verify", "--filter", "free flight under gravity", "--rule", "discrete"];
    let report = json(&filter, 1);
    let claim = &report["claims"][0];
    assert_eq!((&claim["verdict"], &report["missed"]), (&"miss".into(), &1.into()));
    // Under the semi-implicit scheme, the fall is too long by g h t/2.
    let expected = 0.5 * 9.81 / 60.0 * 10.0;
    assert!((claim["measured"].as_f64().unwrap() - expected).abs() < 1e-9, "{claim}");
    let output = run(&filter);
    assert!(String::from_utf8(output.stdout).unwrap().contains("MISS"));
    assert!(bad(&filter, 1).contains("1 of 1 claims are missed"));
}

#[test]
fn claims_about_a_scheme_hold_whatever_rule_is_asked_for() {
    assert_eq!(json(&["verify", "--filter", "Euler", "--rule", "bisect"], 0)["missed"], 0);
}

#[test]
fn a_claim_has_the_same_end_state_in_every_run() {
    let state = || json(&["verify", "--filter", "100^2"], 0)["claims"][0]["state_hash"].clone();
    assert_eq!(state(), state());
}

#[test]
fn compare_measures_distances_from_the_first_rule() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("rows.csv");
    let file = file.to_str().unwrap();
    let arguments = ["compare", "simtest2", "--rules", "exact,discrete,bisect", "--seconds", "3"];
    let figures = json(&[&arguments[..], &["--out", file]].concat(), 0);
    let rules = figures["runs"].as_array().unwrap();
    assert_eq!((rules.len(), &figures["reference"]), (3, &"exact".into()));
    assert_eq!(rules[0]["largest_distance"]["max"], 0.0);
    assert_eq!(rules[0]["energy_error"], 0.0);
    for rule in &rules[1..] {
        let (final_distance, largest) = (&rule["final_distance"], &rule["largest_distance"]);
        assert!(largest["rms"].as_f64().unwrap() > 0.01, "{rule}");
        assert!(largest["rms"].as_f64() >= final_distance["rms"].as_f64());
        assert!(largest["max"].as_f64() >= largest["rms"].as_f64());
    }
    let mut reader = csv::Reader::from_path(file).unwrap();
    assert_eq!(reader.headers().unwrap().len(), 1 + 3 * 4);
    let rows: Vec<csv::StringRecord> = reader.records().map(Result::unwrap).collect();
    assert_eq!(rows.len(), 150);
    let impacts: u64 = rows[149][8].parse().unwrap();
    assert_eq!(Some(impacts), rules[1]["impacts"].as_u64());
}

#[test]
fn compare_measures_what_a_change_of_the_scene_does() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("rows.csv");
    let file = file.to_str().unwrap();
    let changes = ["--with", "spheres.0.velocity=[0,0,1]", "--with", "spheres.0.position.2=1e-9"];
    let scene = ["compare", "butterfly", "--seconds", "0.1", "--out", file];
    let figures = json(&[&scene[..], &changes].concat(), 0);
    let runs = figures["runs"].as_array().unwrap();
    assert_eq!((runs.len(), &figures["reference"]), (3, &"the scene".into()));
    let distance = |run: usize| runs[run]["largest_distance"]["max"].as_f64().unwrap();
    assert_eq!(distance(0), 0.0);
    // Before the rack, cue balls at -4 m/s and at 1 m/s part by 5 m/s; the other one starts 0.7 m away.
    assert!((distance(1) - 0.5).abs() < 1e-12, "{}", distance(1));
    assert!((distance(2) - 0.7).abs() < 1e-8, "{}", distance(2));
    let mut reader = csv::Reader::from_path(file).unwrap();
    let names = reader.headers().unwrap();
    assert_eq!(&names[5], "spheres.0.velocity=[0,0,1]_rms", "a name with commas is one cell");
}

#[test]
fn compare_refuses_what_it_cannot_do() {
    let frames = ["compare", "butterfly", "--with", "simulation.frame_time=0.01"];
    assert!(bad(&frames, 2).contains("frames of"));
    assert!(bad(&["compare", "butterfly", "--with", "magic=1"], 2).contains("magic"));
    let both = ["compare", "butterfly", "--rules", "exact,bisect", "--with", "spheres.0.radius=1"];
    bad(&both, 2);
    assert!(bad(&["compare", "simtest1", "--rules", "exact"], 2).contains("two rules"));
    bad(&["compare", "simtest1", "--rules", "exact,magic"], 2);
    let nowhere = ["compare", "simtest1", "--out", "/dev/null/at/all.csv"];
    assert!(bad(&nowhere, 1).contains("cannot write /dev/null/at/all.csv"));
}

#[test]
fn bench_measures_a_gas_of_any_number_and_packing_fraction() {
    let gas =
        ["bench", "--n", "50", "--packing-fraction", "0.3", "--impacts", "500", "--runs", "3"];
    let figures = json(&gas, 0);
    let row = &figures["gases"][0];
    assert_eq!(row["spheres"], 50);
    assert_eq!(row["runs"].as_array().unwrap().len(), 3);
    assert!(row["impacts_per_second"].as_f64().unwrap() > 0.0);
    assert!(figures["scenes"].as_array().unwrap().is_empty());
    let work = &row["work_per_impact"];
    let of = |stage: &str| work[stage].as_f64().unwrap();
    // After an impact, both spheres are predicted again, each against its neighbours.
    assert!(of("predictions") >= 2.0 && of("pair_tests") > of("predictions"), "{work}");
    assert!(of("events") >= 1.0 + of("cell_crossings"), "{work}");
    assert!(work["groups"].is_number() && work["solver_iterations"].is_number(), "{work}");
}

#[test]
fn the_table_of_bench_tells_the_work_of_an_impact() {
    let gas =
        ["bench", "--n", "50", "--packing-fraction", "0.3", "--impacts", "500", "--runs", "1"];
    let table = String::from_utf8(run(&gas).stdout).unwrap();
    for stage in ["predictions", "pair tests", "cell crossings"] {
        assert!(table.contains(&format!("{stage}/impact")), "{table}");
    }
}

#[test]
fn bench_refuses_a_gas_that_has_no_place() {
    let crowd = ["bench", "--n", "50", "--packing-fraction", "0.7"];
    assert!(bad(&crowd, 2).contains("no place on a lattice"));
    bad(&["bench", "--n", "50"], 2);
    bad(&["bench", "--set", "nothing"], 2);
}

#[test]
fn a_run_counts_the_events_of_its_wells_and_writes_them_to_a_table() {
    let folder = tempfile::tempdir().unwrap();
    let [scene, table] = ["gas.toml", "wells.csv"].map(|name| folder.path().join(name));
    // The centres come from 1.75 m at 1 m/s: captured at 1.5 m, the cores meet, and the pair parts again.
    let text = "name = 'gas'\n[simulation]\n\
                pair_potential = { square-well = { depth = 0.5, range_ratio = 1.5 } }\n\
                [[spheres]]\nradius = 0.5\nvelocity = [1, 0, 0]\n\
                [[spheres]]\nradius = 0.5\nposition = [1.75, 0, 0]\n";
    std::fs::write(&scene, text).unwrap();
    let [scene, file] = [&scene, &table].map(|path| path.to_str().unwrap());
    let summary = json(&["run", scene, "--seconds", "2", "--wells", file], 0);
    assert_eq!(summary["wells"]["captures"], 1);
    assert_eq!(summary["wells"]["dissociations"], 1);
    assert_eq!(summary["wells"]["bounces"], 0);
    assert_eq!(summary["impacts"], 1);
    let mut reader = csv::Reader::from_path(&table).unwrap();
    assert_eq!(
        reader.headers().unwrap(),
        ["t", "event", "ball1", "ball2", "nx", "ny", "nz", "distance", "impulse"].as_slice()
    );
    let rows: Vec<csv::StringRecord> = reader.records().map(Result::unwrap).collect();
    assert_eq!(rows.iter().map(|row| &row[1]).collect::<Vec<_>>(), ["capture", "dissociation"]);
    let number = |row: usize, column: usize| rows[row][column].parse::<f64>().unwrap();
    // The edge takes what it gave: both impulses draw the pair together, by the same amount to rounding.
    assert!((number(0, 0) - 0.25).abs() < 1e-15 && (number(0, 7) - 1.5).abs() < 1e-15);
    assert!(number(0, 8) < 0.0 && (number(0, 8) - number(1, 8)).abs() < 1e-13);
    assert!(json(&["run", "tutorial1", "--frames", "1"], 0).get("wells").is_none());
}
