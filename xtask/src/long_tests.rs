//! Long tests, outside of the usual checks: hours of simulated time, and hostile input.

use std::fs;

use crate::shell::{Outcome, cargo, cargo_with, target_folder};

/// Cargo arguments for the command line without pictures.
const PLAIN: [&str; 4] = ["--package", "carom-cli", "--no-default-features", "--quiet"];
/// Cargo arguments that test a package, optimised.
const OPTIMISED: [&str; 4] = ["test", "--release", "--quiet", "--package"];

/// Runs the long tests of the physics, optimised, and checks of what users get: the package of the
/// physics, and the bits of a release.
pub fn run() -> Outcome {
    for package in ["carom", "carom-scene"] {
        let heaps = [package, "--test", "heaps", "--", "--ignored"];
        cargo(&[&OPTIMISED[..], &heaps].concat())?;
    }
    for (package, test) in [("carom", "rough_meshes"), ("carom-scene", "scenes")] {
        cargo(&[&OPTIMISED[..], &[package, "--test", test, "--", "--ignored"]].concat())?;
    }
    let threads = ["--test", "gases_on_threads", "--features", "rayon", "--", "--ignored"];
    cargo(&[&OPTIMISED[..], &["carom"], &threads].concat())?;
    let pinball = ["carom-pinball", "--test", "game", "--", "--ignored"];
    cargo(&[&OPTIMISED[..], &pinball].concat())?;
    let grading = ["carom-grade", "--", "--ignored"];
    cargo(&[&OPTIMISED[..], &grading].concat())?;
    tests_of_releases()?;
    // The package of the physics must be complete for publishing: it is built from its content
    // alone.
    cargo(&["package", "--package", "carom", "--allow-dirty", "--offline", "--quiet"])?;
    cargo(&[&["run", "--release"], &PLAIN[..], &["--", "verify", "--full"]].concat())
}

/// Runs the tests of the physics as users build it: fully optimised, with threads.
fn tests_of_releases() -> Outcome {
    for package in ["carom", "carom-scene"] {
        let threads = format!("{package}/rayon");
        cargo(&[&OPTIMISED[..], &[package, "--lib", "--tests", "--features", &threads]].concat())?;
    }
    Ok(())
}

/// Simulates scenes for a number of hours, optimised, and keeps the state after each hour.
pub fn soak(hours: &str) -> Outcome {
    if !hours.parse::<u32>().is_ok_and(|hours| hours > 0) {
        return Err(format!("--hours takes a whole number of hours, not {hours:?}"));
    }
    soak_test("a_day_is_what_it_is_everywhere_and_takes_no_more_memory_than_an_hour", hours)
}

/// Repeats each hour of a day from the states that [`soak`] kept, optimised.
pub fn soak_again() -> Outcome {
    soak_test("every_hour_of_a_day_is_the_same_again_from_the_state_before_it", "24")
}

fn soak_test(name: &str, hours: &str) -> Outcome {
    let states = target_folder().join("soak");
    fs::create_dir_all(&states).map_err(|error| format!("{}: {error}", states.display()))?;
    let soak = ["carom-scene", "--test", "soak", "--", name, "--exact", "--ignored", "--nocapture"];
    let states = states.to_string_lossy();
    let set = [("SOAK_HOURS", hours), ("SOAK_STATES", &*states)];
    cargo_with(&[&OPTIMISED[..], &soak].concat(), &set)
}

/// Runs the program with hostile input; `options` are those of `carom-fuzz`.
pub fn fuzz(options: &[&str]) -> Outcome {
    cargo(&[&["build", "--release"], &PLAIN[..]].concat())?;
    cargo(&[&["run", "--release", "--package", "carom-fuzz", "--"], options].concat())
}

/// Kills recording runs, a hundred in each format, and as many filming runs.
pub fn kills() -> Outcome {
    let test = |features, name| {
        let test = ["--features", features, "--test", name, "--", "--nocapture"];
        cargo_with(&[&["test"], &PLAIN[..], &test].concat(), &[("KILLS", "100")])
    };
    test("rayon", "killed")?;
    test("rayon,pictures", "killed_films")
}
