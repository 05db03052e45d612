//! Every check, in the order in which they fail fastest.

use crate::shell::{Outcome, cargo, cargo_with};
use crate::{architecture, setup};

/// Runs every check.
pub fn test() -> Outcome {
    setup::toolchain()?;
    cargo(&["fmt", "--all", "--check"])?;
    architecture::check()?;
    cargo(&["clippy", "--workspace", "--all-targets", "--quiet", "--", "--deny", "warnings"])?;
    let documents = ["doc", "--workspace", "--no-deps", "--document-private-items", "--quiet"];
    cargo_with(&documents, &[("RUSTDOCFLAGS", "--deny warnings")])?;
    // The scene files can be read without the crates that only recordings need.
    cargo(&["check", "--package", "carom-scene", "--no-default-features", "--quiet"])?;
    cargo(&["test", "--workspace", "--quiet"])?;
    // What the physics is held against; that needs neither pictures nor a window.
    let carom = ["run", "--release", "--quiet", "--package", "carom-cli", "--no-default-features"];
    cargo(&[&carom[..], &["--", "verify"]].concat())?;
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
    Ok(())
}
