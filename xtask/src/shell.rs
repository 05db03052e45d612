//! Runs other programs in the root of the repository.

use std::ffi::{OsStr, OsString};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Instant;

use serde_json::Value;

/// The result of a command, with an error message for people.
pub type Outcome<T = ()> = Result<T, String>;

/// Returns the root of the repository.
pub fn root() -> PathBuf {
    let own = Path::new(env!("CARGO_MANIFEST_DIR"));
    own.parent().unwrap_or(own).to_owned()
}

/// Returns cargo's target folder.
pub fn target_folder() -> PathBuf {
    match std::env::var_os("CARGO_TARGET_DIR") {
        Some(folder) => root().join(folder),
        None => root().join("target"),
    }
}

/// Name of the build profile for checks.
pub const CI: &str = "ci";

/// Returns the folder of programs built with the profile for checks.
pub fn ci_folder() -> PathBuf {
    target_folder().join(CI)
}

/// Returns the command of a program built with the profile for checks.
pub fn program(name: &str) -> Command {
    Command::new(ci_folder().join(format!("{name}{}", std::env::consts::EXE_SUFFIX)))
}

/// Returns the target triple of this machine, for example `x86_64-unknown-linux-gnu`.
pub fn host() -> Outcome<String> {
    let about = output("rustc", &["-vV"]).unwrap_or_default();
    let host = about.lines().find_map(|line| line.strip_prefix("host: "));
    host.map(str::to_owned).ok_or_else(|| "rustc does not say what it compiles for".to_owned())
}

/// Returns the cargo program that runs this one.
pub fn cargo_program() -> OsString {
    std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into())
}

/// Runs `cargo` with these arguments and prints the command.
pub fn cargo(arguments: &[&str]) -> Outcome {
    cargo_with(arguments, &[])
}

/// Runs `cargo` with these arguments and environment variables and prints the command.
pub fn cargo_with(arguments: &[&str], variables: &[(&str, &str)]) -> Outcome {
    let mut command = Command::new(cargo_program());
    command.args(arguments).envs(variables.iter().copied());
    finish("cargo", &mut command)
}

/// Runs `cargo` with these arguments and prints the command. Returns its standard output.
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

/// Returns the output of a program, which runs in the root of the repository by default. `name` is
/// its name in messages.
///
/// # Errors
/// The error output of the program, if it fails.
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

/// Returns cargo's metadata of the packages.
pub fn metadata(arguments: &[&str]) -> Outcome<Value> {
    let mut command = Command::new(cargo_program());
    command.args(["metadata", "--format-version", "1", "--locked"]).args(arguments);
    let described = printed("cargo metadata", &mut command)?;
    serde_json::from_str(&described).map_err(|error| format!("cargo metadata: {error}"))
}

/// Returns whether a program runs and succeeds; prints nothing.
pub fn succeeds(program: impl AsRef<OsStr>, arguments: &[&str]) -> bool {
    output(program, arguments).is_some()
}

/// Returns the output of a program, if it runs and succeeds; prints nothing.
pub fn output(program: impl AsRef<OsStr>, arguments: &[&str]) -> Option<String> {
    let mut command = Command::new(program);
    command.args(arguments).current_dir(root()).stdin(Stdio::null());
    let output = command.output().ok().filter(|output| output.status.success())?;
    String::from_utf8(output.stdout).ok()
}

/// Runs a program and prints the command.
pub fn run(program: &str, arguments: &[&str]) -> Outcome {
    finish(program, Command::new(program).args(arguments))
}

/// Runs a command, in the root of the repository by default, and prints it. `name` is the program's
/// name in messages.
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

/// Prints how long a command took, unless it was short.
fn say_duration(start: Instant) {
    let seconds = start.elapsed().as_secs();
    if seconds >= 5 {
        eprintln!("== {seconds} s");
    }
}
