//! Every check, in the order in which they fail fastest.

use crate::commands::{self, Programs};
use crate::shell::{Outcome, cargo, cargo_with, target_folder};
use crate::{architecture, documents, js_package, python, setup, stages, web, words};

/// Runs the tests of the physics that take minutes, optimised.
pub fn long_tests() -> Outcome {
    let heaps = ["--test", "heaps", "--", "--ignored"];
    for package in ["carom", "carom-scene"] {
        let test = ["test", "--release", "--quiet", "--package", package];
        cargo(&[&test[..], &heaps[..]].concat())?;
    }
    let verify = ["run", "--release", "--package", "carom-cli", "--no-default-features", "--quiet"];
    cargo(&[&verify[..], &["--", "verify", "--full"]].concat())
}

/// Runs every check but these.
pub fn test() -> Outcome {
    setup::toolchain()?;
    setup::graphics()?;
    setup::film_tests()?;
    cargo(&["fmt", "--all", "--check"])?;
    architecture::check()?;
    words::check()?;
    stages::check()?;
    documents::check()?;
    cargo(&["clippy", "--workspace", "--all-targets", "--quiet", "--", "--deny", "warnings"])?;
    let documents = ["doc", "--workspace", "--no-deps", "--document-private-items", "--quiet"];
    cargo_with(&documents, &[("RUSTDOCFLAGS", "--deny warnings")])?;
    // The scene files can be read without the crates that only recordings need.
    cargo(&["check", "--package", "carom-scene", "--no-default-features", "--quiet"])?;
    // The command line is built without pictures, too, by those who work on the physics; the
    // Python package, by those who have no C++ compiler.
    let plain = ["--package", "carom-cli", "--no-default-features", "--quiet"];
    cargo(&[&["check"], &plain[..]].concat())?;
    cargo(&["check", "--package", "carom-py", "--no-default-features", "--quiet"])?;
    // The crate of the physics can be published: it builds from what its package holds.
    cargo(&["package", "--package", "carom", "--allow-dirty", "--offline", "--quiet"])?;
    // Graphics libraries ask for this folder, and complain aloud where a system names none.
    let folder = std::env::var("XDG_RUNTIME_DIR").unwrap_or_else(|_| "/tmp".to_owned());
    let graphics = [("XDG_RUNTIME_DIR", folder.as_str())];
    cargo_with(&["test", "--workspace", "--quiet"], &graphics)?;
    // What the physics is held against.
    cargo(&[&["run", "--release"], &plain[..], &["--", "verify"]].concat())?;
    // The tests of the command line have left a program with pictures, the claims one without.
    let [plain, drawing] = ["release", "debug"].map(|folder| target_folder().join(folder));
    commands::check(&Programs { plain, drawing: Some(drawing) })?;
    // The same bits in every build: the tests that pin hashes, optimised.
    let optimised = ["test", "--release", "--quiet", "--package"];
    cargo(&[&optimised[..], &["carom", "--test", "world", "--test", "exact"]].concat())?;
    cargo(&[&optimised[..], &["carom-scene", "--test", "scenes"]].concat())?;
    // And on any number of threads.
    for threads in ["1", "2"] {
        let threads = [("RAYON_NUM_THREADS", threads)];
        let test = |package: &str, test: &str| {
            let threaded = [package, "--features", "rayon", "--test", test];
            cargo_with(&[&optimised[..], &threaded].concat(), &threads)
        };
        test("carom", "exact")?;
        test("carom-scene", "scenes")?;
    }
    // And in other languages and places.
    js_package::test()?;
    python::test()?;
    web::test()
}
