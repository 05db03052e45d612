//! Runs tests under Miri: those of code with `unsafe`, both our own and the processor vectors that
//! ours uses.

use std::process::Command;

use crate::shell::{Outcome, finish};

/// Tests of the C interface that take minutes under Miri, by file and name; the others take hours.
const OF_C: [(&str, &[&str]); 2] = [
    (
        "springs",
        &["a_snapshot_has_the_springs", "a_spring_", "springs_are_read_as_they_were_added"],
    ),
    ("edits", &["spheres_are_read_as_they_were_added", "no_rows_are_no_pointer"]),
];

/// Installs nightly Rust with Miri, and runs the tests under it.
pub fn test() -> Outcome {
    let install = ["toolchain", "install", "nightly", "--profile", "minimal"];
    let mut rustup = Command::new("rustup");
    finish("rustup", rustup.args(install).args(["--component", "miri,rust-src"]))?;
    // libm's square root is an instruction that Miri does not know; this feature selects its other
    // form.
    miri(&["--package", "carom", "--lib", "--features", "libm/force-soft-floats"], &["lanes::"])?;
    // Here the target processor has no such instruction.
    let target = ["--target", "riscv64gc-unknown-linux-gnu", "--package", "carom-c", "--test"];
    OF_C.iter().try_for_each(|(file, names)| miri(&[&target[..], &[file]].concat(), names))
}

fn miri(what: &[&str], names: &[&str]) -> Outcome {
    let mut command = Command::new("rustup");
    command.args(["run", "nightly", "cargo", "miri", "test"]).args(what).arg("--").args(names);
    // Tests need temporary files and the clock.
    finish("miri", command.env("MIRIFLAGS", "-Zmiri-disable-isolation"))
}
