//! Running other programs, in the root of the repository.

use std::ffi::{OsStr, OsString};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Instant;

use serde_json::Value;

/// What went wrong, for people.
pub type Outcome<T = ()> = Result<T, String>;

/// The root of the repository.
pub fn root() -> PathBuf {
    let own = Path::new(env!("CARGO_MANIFEST_DIR"));
    own.parent().unwrap_or(own).to_owned()
}

/// Where cargo puts what it builds.
pub fn target_folder() -> PathBuf {
    match std::env::var_os("CARGO_TARGET_DIR") {
        Some(folder) => root().join(folder),
        None => root().join("target"),
    }
}

/// The profile of what is built to be tried.
pub const CI: &str = "ci";

/// Where programs lie that are built to be tried.
pub fn ci_folder() -> PathBuf {
    target_folder().join(CI)
}

/// A program that was built to be tried.
pub fn program(name: &str) -> Command {
    Command::new(ci_folder().join(format!("{name}{}", std::env::consts::EXE_SUFFIX)))
}

/// What this machine is to compilers, as in `x86_64-unknown-linux-gnu`.
pub fn host() -> Outcome<String> {
    let about = output("rustc", &["-vV"]).unwrap_or_default();
    let host = about.lines().find_map(|line| line.strip_prefix("host: "));
    host.map(str::to_owned).ok_or_else(|| "rustc does not say what it compiles for".to_owned())
}

/// The cargo that runs this.
pub fn cargo_program() -> OsString {
    std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into())
}

/// Runs `cargo` with these arguments, and says so.
pub fn cargo(arguments: &[&str]) -> Outcome {
    cargo_with(arguments, &[])
}

/// Runs `cargo` with these arguments and environment variables, and says so.
pub fn cargo_with(arguments: &[&str], variables: &[(&str, &str)]) -> Outcome {
    let mut command = Command::new(cargo_program());
    command.args(arguments).envs(variables.iter().copied());
    finish("cargo", &mut command)
}

/// Runs `cargo` with these arguments, and says so. Returns what it prints, but for errors.
pub fn cargo_output(arguments: &[&str]) -> Outcome<String> {
    let line = format!("cargo {}", arguments.join(" "));
    eprintln!("\n== {line}");
    let mut command = Command::new(cargo_program());
    command.args(arguments).current_dir(root()).stderr(Stdio::inherit());
    let start = Instant::now();
    let output = command.output().map_err(|error| format!("{line}: {error}"))?;
    say_duration(start);
    if output.status.success() {
        Ok(String::from_utf8_lossy(&output.stdout).into_owned())
    } else {
        Err(format!("{line} failed"))
    }
}

/// What a program prints, run in the root of the repository unless it is to run elsewhere; `name` is
/// what people call it.
///
/// # Errors
/// What it prints as errors, where it fails.
pub fn printed(name: &str, command: &mut Command) -> Outcome<String> {
    if command.get_current_dir().is_none() {
        command.current_dir(root());
    }
    let output = command.output().map_err(|error| format!("{name}: {error}"))?;
    if !output.status.success() {
        return Err(String::from_utf8_lossy(&output.stderr).into_owned());
    }
    Ok(String::from_utf8_lossy(&output.stdout).into_owned())
}

/// What cargo says of the packages that it knows.
pub fn metadata(arguments: &[&str]) -> Outcome<Value> {
    let mut command = Command::new(cargo_program());
    command.args(["metadata", "--format-version", "1", "--locked"]).args(arguments);
    let described = printed("cargo metadata", &mut command)?;
    serde_json::from_str(&described).map_err(|error| format!("cargo metadata: {error}"))
}

/// Whether a program runs and succeeds; says nothing.
pub fn succeeds(program: impl AsRef<OsStr>, arguments: &[&str]) -> bool {
    output(program, arguments).is_some()
}

/// What a program prints, if it runs and succeeds; says nothing.
pub fn output(program: impl AsRef<OsStr>, arguments: &[&str]) -> Option<String> {
    let mut command = Command::new(program);
    command.args(arguments).current_dir(root()).stdin(Stdio::null());
    let output = command.output().ok().filter(|output| output.status.success())?;
    String::from_utf8(output.stdout).ok()
}

/// Runs a program, and says so.
pub fn run(program: &str, arguments: &[&str]) -> Outcome {
    finish(program, Command::new(program).args(arguments))
}

/// Runs a command in the root of the repository unless it is to run elsewhere, and says so; `name`
/// is what people call its program.
pub fn finish(name: &str, command: &mut Command) -> Outcome {
    let arguments: Vec<_> = command.get_args().map(OsStr::to_string_lossy).collect();
    let line = format!("{name} {}", arguments.join(" "));
    eprintln!("\n== {line}");
    if command.get_current_dir().is_none() {
        command.current_dir(root());
    }
    let start = Instant::now();
    let status = command.status().map_err(|error| format!("{line}: {error}"))?;
    say_duration(start);
    if status.success() { Ok(()) } else { Err(format!("{line} failed")) }
}

/// Says how long a command took, if somebody waited for it.
fn say_duration(start: Instant) {
    let seconds = start.elapsed().as_secs();
    if seconds >= 5 {
        eprintln!("== {seconds} s");
    }
}
