//! Every check, in the order in which they fail fastest.

use std::fs;
use std::time::{Duration, Instant};

use crate::commands::{self, Programs};
use crate::shell::{Outcome, cargo, cargo_with, target_folder};
use crate::{
    architecture, c_interface, circles, dependencies, documents, js_package, python, release,
    setup, sizes, stages, web, words,
};

/// A part of the checks, for which one time is printed.
struct Part {
    name: &'static str,
    run: fn() -> Outcome,
}

impl Part {
    const fn new(name: &'static str, run: fn() -> Outcome) -> Self {
        Self { name, run }
    }
}

/// All parts; the last ones end with the summary of a test runner.
const PARTS: [Part; 12] = [
    Part::new("set-up", set_up),
    Part::new("lint", lint),
    Part::new("clippy and rustdoc", clippy_and_rustdoc),
    Part::new("builds with fewer features", small_builds),
    Part::new("tests", tests),
    Part::new("C interface", c_interface::test_built),
    Part::new("claims", claims),
    Part::new("commands of the documents", commands_of_documents),
    Part::new("hashes of optimised builds and threads", hashes),
    Part::new("JavaScript package", js_package::test),
    Part::new("Python package", python::test),
    Part::new("page in a browser", web::test),
];

/// Arguments that name the command line without pictures.
const PLAIN: [&str; 4] = ["--package", "carom-cli", "--no-default-features", "--quiet"];
/// Arguments that test a package, optimised.
const OPTIMISED: [&str; 4] = ["test", "--release", "--quiet", "--package"];

/// Runs every check but the tests that take minutes, and prints how long each part takes.
pub fn test() -> Outcome {
    let mut before: Option<(&str, Instant)> = None;
    for part in &PARTS {
        if let Some((name, start)) = before {
            eprintln!("\n-- {name}: {}", minutes(start.elapsed()));
        }
        before = Some((part.name, Instant::now()));
        (part.run)()?;
    }
    Ok(())
}

/// Runs the tests of the physics that take minutes, optimised.
pub fn long_tests() -> Outcome {
    for package in ["carom", "carom-scene"] {
        let heaps = [package, "--test", "heaps", "--", "--ignored"];
        cargo(&[&OPTIMISED[..], &heaps].concat())?;
    }
    cargo(&[&["run", "--release"], &PLAIN[..], &["--", "verify", "--full"]].concat())
}

/// Runs scenes for so many hours of simulated time, optimised, and keeps the states after each hour.
pub fn soak(hours: &str) -> Outcome {
    if !hours.parse::<u32>().is_ok_and(|hours| hours > 0) {
        return Err(format!("--hours takes a whole number of hours, not {hours:?}"));
    }
    soak_test("a_day_is_what_it_is_everywhere_and_takes_no_more_memory_than_an_hour", hours)
}

/// Runs each hour of a day once more, from the states that [`soak`] kept, optimised.
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

/// Tries hostile input; `options` are those of `carom-fuzz`.
pub fn fuzz(options: &[&str]) -> Outcome {
    cargo(&[&["build", "--release"], &PLAIN[..]].concat())?;
    cargo(&[&["run", "--release", "--package", "carom-fuzz", "--"], options].concat())
}

/// Kills runs that record, a hundred in each format, and as many that film.
pub fn kills() -> Outcome {
    let test = |features, name| {
        let test = ["--features", features, "--test", name, "--", "--nocapture"];
        cargo_with(&[&["test"], &PLAIN[..], &test].concat(), &[("KILLS", "100")])
    };
    test("rayon", "killed")?;
    test("rayon,pictures", "killed_films")
}

/// Checks what needs no build: formats, words, names in documents, the order of modules.
pub fn lint() -> Outcome {
    cargo(&["fmt", "--all", "--check"])?;
    architecture::check()?;
    dependencies::check()?;
    words::check()?;
    circles::check()?;
    sizes::check()?;
    stages::check()?;
    documents::check()?;
    release::check()
}

fn set_up() -> Outcome {
    setup::toolchain()?;
    setup::graphics()?;
    setup::film_tests()
}

fn clippy_and_rustdoc() -> Outcome {
    cargo(&["clippy", "--workspace", "--all-targets", "--quiet", "--", "--deny", "warnings"])?;
    let documents = ["doc", "--workspace", "--no-deps", "--document-private-items", "--quiet"];
    cargo_with(&documents, &[("RUSTDOCFLAGS", "--deny warnings")])
}

fn small_builds() -> Outcome {
    // The scene files can be read without the crates that only recordings need.
    cargo(&["check", "--package", "carom-scene", "--no-default-features", "--quiet"])?;
    // The command line is built without pictures, too, by those who work on the physics; the
    // Python package, by those who have no C++ compiler.
    cargo(&[&["check"], &PLAIN[..]].concat())?;
    cargo(&["check", "--package", "carom-py", "--no-default-features", "--quiet"])?;
    // The crate of the physics can be published: it builds from what its package holds.
    cargo(&["package", "--package", "carom", "--allow-dirty", "--offline", "--quiet"])
}

fn tests() -> Outcome {
    // Graphics libraries need this folder, and complain aloud where a system names none.
    let folder = std::env::var("XDG_RUNTIME_DIR").unwrap_or_else(|_| "/tmp".to_owned());
    let graphics = [("XDG_RUNTIME_DIR", folder.as_str())];
    cargo_with(&["test", "--workspace", "--quiet"], &graphics)
}

/// What the physics is held against.
fn claims() -> Outcome {
    cargo(&[&["run", "--release"], &PLAIN[..], &["--", "verify"]].concat())
}

fn commands_of_documents() -> Outcome {
    // The tests of the command line have left a program with pictures, the claims one without.
    let [plain, drawing] = ["release", "debug"].map(|folder| target_folder().join(folder));
    commands::check(&Programs { plain, drawing: Some(drawing) })
}

/// The same bits in every build, and on any number of threads.
fn hashes() -> Outcome {
    let tests = ["carom", "--test", "world", "--test", "exact", "--test", "contact_rule"];
    cargo(&[&OPTIMISED[..], &tests].concat())?;
    cargo(&[&OPTIMISED[..], &["carom-scene", "--test", "scenes"]].concat())?;
    for threads in ["1", "2"] {
        let threads = [("RAYON_NUM_THREADS", threads)];
        for (package, test) in [("carom", "exact"), ("carom-scene", "scenes")] {
            let threaded = [package, "--features", "rayon", "--test", test];
            cargo_with(&[&OPTIMISED[..], &threaded].concat(), &threads)?;
        }
    }
    for threads in ["1", "2", "3", "8"] {
        let threads = [("RAYON_NUM_THREADS", threads)];
        let threaded = ["carom", "--features", "rayon", "--test", "contact_rule", "bits"];
        cargo_with(&[&OPTIMISED[..], &threaded].concat(), &threads)?;
    }
    Ok(())
}

fn minutes(time: Duration) -> String {
    let seconds = time.as_secs();
    format!("{} min {:02} s", seconds / 60, seconds % 60)
}
