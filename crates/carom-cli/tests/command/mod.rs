//! The command `carom`, run as a user runs it.
#![allow(dead_code, reason = "each file of tests uses some of it")]

use std::process::{Command, Output};

use tempfile::TempDir;

/// Path of the program.
pub const CAROM: &str = env!("CARGO_BIN_EXE_carom");

/// Creates the command in an environment without scenes, pages and configuration.
pub fn carom() -> Command {
    let mut command = Command::new(CAROM);
    command.env_remove("CAROM_SCENES").env_remove("CAROM_PAGE");
    command.env_remove("CAROM_CONFIG").env("XDG_CONFIG_HOME", "/nowhere");
    // Wayland's library prints an error if this is missing.
    command.env("XDG_RUNTIME_DIR", std::env::temp_dir());
    command
}

/// Runs the command with these arguments.
pub fn run(arguments: &[&str]) -> Output {
    carom().args(arguments).output().unwrap()
}

/// Returns the standard output of a run that succeeded and printed no error.
#[track_caller]
pub fn text_of(output: Output) -> String {
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{errors}");
    assert_eq!(errors, "", "a pipe sees no progress bar and no noise");
    String::from_utf8(output.stdout).unwrap()
}

/// Runs the command, which must succeed; returns the standard output.
#[track_caller]
pub fn good(arguments: &[&str]) -> String {
    text_of(run(arguments))
}

/// Runs the command, which must fail with this code; returns the standard error stream.
#[track_caller]
pub fn bad(arguments: &[&str], code: i32) -> String {
    let output = run(arguments);
    let errors = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(code), "{arguments:?}: {errors}");
    assert!(!errors.contains("panicked"), "{errors}");
    errors
}

/// Runs the command, which must fail with this code and one line of error; returns the line.
#[track_caller]
pub fn bad_line(arguments: &[&str], code: i32) -> String {
    let errors = bad(arguments, code);
    assert_eq!(errors.lines().count(), 1, "{errors}");
    errors
}

/// The path of a file in a folder, as an argument.
pub fn path(folder: &TempDir, name: &str) -> String {
    folder.path().join(name).to_str().unwrap().to_owned()
}

/// Number of runs that are killed for each format.
pub fn kills() -> u64 {
    std::env::var("KILLS").ok().and_then(|text| text.parse().ok()).unwrap_or(2)
}

/// Times at which runs are killed \[ms\], scattered over the first two seconds for any number of
/// kills: the first two are 1100 and 201.
pub fn moments() -> impl Iterator<Item = u64> {
    (1..=kills()).map(|k| k * 1100 % 1999)
}

/// Times \[s\] and positions \[m\] of all moving balls in an animation, after the start.
pub fn keys(animation: &str) -> Vec<(f64, Vec<f64>)> {
    let bytes = std::fs::read(animation).unwrap();
    let word = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap()) as usize;
    let json: serde_json::Value = serde_json::from_slice(&bytes[20..20 + word(12)]).unwrap();
    let binary = &bytes[28 + word(12)..];
    let numbers = |accessor: &serde_json::Value| -> Vec<f64> {
        let number = |it: &serde_json::Value| it.as_u64().unwrap_or(0) as usize;
        let accessor = &json["accessors"][number(accessor)];
        let view = &json["bufferViews"][number(&accessor["bufferView"])];
        let start = number(&view["byteOffset"]) + number(&accessor["byteOffset"]);
        let width = if accessor["type"] == "SCALAR" { 1 } else { 3 };
        let words = binary[start..].chunks(4).take(width * number(&accessor["count"]));
        words.map(|it| f64::from(f32::from_le_bytes(it.try_into().unwrap()))).collect()
    };
    let animation = &json["animations"][0];
    let mut frames: Vec<(f64, Vec<f64>)> = Vec::new();
    for channel in animation["channels"].as_array().into_iter().flatten() {
        let sampler = &animation["samplers"][channel["sampler"].as_u64().unwrap() as usize];
        if channel["target"]["path"] != "translation" {
            continue;
        }
        if frames.is_empty() {
            frames = numbers(&sampler["input"]).iter().map(|time| (*time, Vec::new())).collect();
        }
        let places = numbers(&sampler["output"]);
        assert_eq!(places.len(), 3 * frames.len());
        for (frame, place) in frames.iter_mut().zip(places.chunks(3)) {
            frame.1.extend(place);
        }
    }
    frames.into_iter().skip(1).collect()
}
