//! Tests that Miri interprets: of the code with `unsafe`, our own and what the vectors of the processor stand on.

use std::process::Command;

use crate::shell::{Outcome, finish};

/// Tests of the C interface that take minutes there, by file and name; the others take hours.
const OF_C: [(&str, &[&str]); 2] = [
    (
        "springs",
        &["a_snapshot_has_the_springs", "a_spring_", "springs_are_read_as_they_were_added"],
    ),
    ("edits", &["spheres_are_read_as_they_were_added", "no_rows_are_no_pointer"]),
];

/// Installs nightly Rust with Miri, and has it interpret the tests.
pub fn test() -> Outcome {
    let install = ["toolchain", "install", "nightly", "--profile", "minimal"];
    let mut rustup = Command::new("rustup");
    finish("rustup", rustup.args(install).args(["--component", "miri,rust-src"]))?;
    // The square root of libm is an instruction written out, which Miri does not know: there its other form stands in.
    miri(&["--package", "carom", "--lib", "--features", "libm/force-soft-floats"], &["lanes::"])?;
    // And here a processor for which it has no such instruction.
    let target = ["--target", "riscv64gc-unknown-linux-gnu", "--package", "carom-c", "--test"];
    OF_C.iter().try_for_each(|(file, names)| miri(&[&target[..], &[file]].concat(), names))
}

fn miri(what: &[&str], names: &[&str]) -> Outcome {
    let mut command = Command::new("rustup");
    command.args(["run", "nightly", "cargo", "miri", "test"]).args(what).arg("--").args(names);
    // Temporary files, and the time.
    finish("miri", command.env("MIRIFLAGS", "-Zmiri-disable-isolation"))
}
