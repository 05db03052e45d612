//! The test programs of the workspace: built, and run side by side.
//!
//! cargo runs one after another, and most have a last test that keeps one processor busy alone.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Mutex;
use std::thread;

use serde_json::Value;

use crate::setup;
use crate::shell::{CI, Outcome, cargo_output};

/// A program made of tests.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Program {
    pub package: String,
    /// The name of its file of tests, or that of the package.
    pub name: String,
    file: PathBuf,
    /// The folder of the package.
    folder: PathBuf,
}

/// How many programs run at a time: one fills the gaps of the other.
const AT_A_TIME: usize = 2;
/// How many of the slowest tests are named.
const SLOWEST: usize = 30;

/// The tests of the physics that run on several numbers of threads.
const ON_THREADS: [&str; 5] =
    ["contact_rule", "contact_shear", "exact", "gases_on_threads", "non_additive"];

/// Builds what tests run, but for most programs of the physics, which a part of its own builds: the
/// programs of tests, which it returns, examples, the command, the libraries for C and Python.
///
/// Both builds name the whole workspace: cargo chooses the features of a crate by what is built together,
/// and builds a crate again if they differ.
pub fn build() -> Outcome<Vec<Program>> {
    setup::graphics()?;
    // Not all programs: xtask would be written over while it runs. Those that tests run come along.
    let mut programs = built(&["--exclude", "carom", "--lib", "--examples", "--tests"])?;
    let named: Vec<&str> = ON_THREADS.iter().flat_map(|name| ["--test", name]).collect();
    programs.extend(built(&named)?.into_iter().filter(|program| program.package == "carom"));
    Ok(programs)
}

fn built(targets: &[&str]) -> Outcome<Vec<Program>> {
    let arguments = ["build", "--workspace", "--profile", CI, "--quiet"];
    let format = ["--message-format", "json-render-diagnostics"];
    let output = cargo_output(&[&arguments[..], targets, &format].concat())?;
    Ok(output.lines().filter_map(program).collect())
}

/// Returns the test program that a message of cargo describes.
fn program(message: &str) -> Option<Program> {
    let message: Value = serde_json::from_str(message).ok()?;
    let is_test = message["profile"]["test"].as_bool()?;
    let file = message["executable"].as_str().filter(|_| is_test)?;
    let manifest = Path::new(message["manifest_path"].as_str()?);
    let folder = manifest.parent()?.to_owned();
    let package = folder.file_name()?.to_string_lossy().into_owned();
    let name = message["target"]["name"].as_str()?.to_owned();
    Some(Program { package, name, file: file.into(), folder })
}

/// Runs programs with these variables of the environment, the largest first; prints a line of each,
/// all of what one prints that fails, and the slowest tests.
pub fn run(programs: &[Program], arguments: &[&str], variables: &[(&str, &str)]) -> Outcome {
    let size = |program: &Program| program.file.metadata().map_or(0, |it| it.len());
    let mut waiting = programs.to_vec();
    waiting.sort_by_key(size);
    let waiting = Mutex::new(waiting);
    let ran = Mutex::new(Vec::new());
    thread::scope(|scope| {
        for _ in 0..AT_A_TIME {
            scope.spawn(|| {
                loop {
                    let next = waiting.lock().map(|mut waiting| waiting.pop());
                    let Ok(Some(program)) = next else { break };
                    let result = run_one(&program, arguments, variables);
                    if let Ok(mut ran) = ran.lock() {
                        ran.push(result);
                    }
                }
            });
        }
    });
    let mut tests = Vec::new();
    let mut faults = Vec::new();
    for result in ran.into_inner().map_err(|error| error.to_string())? {
        match result {
            Ok(printed) => tests.extend(durations(&printed)),
            Err(fault) => faults.push(fault),
        }
    }
    print_slowest(tests);
    if faults.is_empty() { Ok(()) } else { Err(faults.join("\n")) }
}

/// Runs a program as cargo does. Returns what it prints; prints it, where it fails.
fn run_one(program: &Program, arguments: &[&str], variables: &[(&str, &str)]) -> Outcome<String> {
    let title = format!("{} {}", program.package, program.name);
    let threads = thread::available_parallelism().map_or(1, |it| (it.get() / AT_A_TIME).max(1));
    let mut command = Command::new(&program.file);
    command.args(arguments).args(["-Z", "unstable-options", "--report-time"]);
    command.current_dir(&program.folder).env("CARGO_MANIFEST_DIR", &program.folder);
    // The test runner reports times to nightly compilers, or where this is set.
    command.env("RUSTC_BOOTSTRAP", "1").env("RUST_TEST_THREADS", threads.to_string());
    command.envs(variables.iter().copied());
    let output = command.output().map_err(|error| format!("{title}: {error}"))?;
    let printed = String::from_utf8_lossy(&output.stdout).into_owned();
    if !output.status.success() {
        let errors = String::from_utf8_lossy(&output.stderr);
        eprintln!("\n== {title}\n{printed}{errors}");
        return Err(format!("the tests of {title} failed"));
    }
    let summary = printed.lines().rfind(|line| line.starts_with("test result: "));
    eprintln!("{title:40} {}", summary.unwrap_or_default());
    Ok(printed)
}

/// The names of tests, each with its duration \[s\].
fn durations(printed: &str) -> Vec<(f64, String)> {
    let test = |line: &str| {
        let (name, rest) = line.strip_prefix("test ")?.split_once(" ... ")?;
        let seconds = rest.rsplit_once('<')?.1.strip_suffix("s>")?.parse().ok()?;
        Some((seconds, name.to_owned()))
    };
    printed.lines().filter_map(test).collect()
}

fn print_slowest(mut tests: Vec<(f64, String)>) {
    tests.sort_by(|one, other| other.0.total_cmp(&one.0));
    eprintln!("\nslowest tests [s]");
    for (seconds, name) in tests.iter().take(SLOWEST) {
        eprintln!("{seconds:8.2}  {name}");
    }
}

/// The test programs of a name in a package.
pub fn named(programs: &[Program], package: &str, name: &str) -> Outcome<Vec<Program>> {
    let is_it = |program: &&Program| program.package == package && program.name == name;
    let found: Vec<Program> = programs.iter().filter(is_it).cloned().collect();
    if found.is_empty() { Err(format!("{package} has no tests {name}")) } else { Ok(found) }
}

#[cfg(test)]
mod tests {
    use super::{Program, durations, program};

    #[test]
    fn programs_and_times_are_read_from_what_cargo_and_tests_print() {
        let message = r#"{"reason":"compiler-artifact","manifest_path":"/a/crates/carom/Cargo.toml",
            "target":{"name":"exact"},"profile":{"test":true},"executable":"/a/target/ci/exact-1"}"#;
        let expected = Program {
            package: "carom".to_owned(),
            name: "exact".to_owned(),
            file: "/a/target/ci/exact-1".into(),
            folder: "/a/crates/carom".into(),
        };
        assert_eq!(program(message), Some(expected));
        assert_eq!(program(&message.replace("\"test\":true", "\"test\":false")), None);
        let printed = "test a::b ... ok <1.250s>\ntest c ... ignored\ntest result: ok.";
        assert_eq!(durations(printed), [(1.25, "a::b".to_owned())]);
    }
}
