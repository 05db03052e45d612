//! Runs parts of the checks side by side, each in a process of its own that writes into a log.

use std::fs::{self, File};
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};
use std::thread;
use std::time::Duration;

use super::part::Part;
use super::summary::{Counts, counts};
use super::times::{self, Times};
use crate::files::{made, said};
use crate::shell::Outcome;

/// How many parts run at a time. Builds use every processor anyway; a second part fills the gaps in
/// which a first one waits for a single compiler, a browser or a test.
const AT_A_TIME: usize = 2;
/// How often parts are looked at.
const LOOK: Duration = Duration::from_millis(100);

/// A part that runs.
struct Running<'a> {
    part: &'a Part,
    child: Child,
    log: PathBuf,
}

/// What became of all parts.
#[derive(Default)]
pub struct Done {
    pub times: Vec<(&'static str, Times)>,
    pub tests: Counts,
}

/// Runs parts, each as soon as those that it needs have passed; prints the log of each at its end.
/// `variables` are those of the environment of every part.
///
/// # Errors
/// Names the parts that failed; parts that had not begun by then do not run.
pub fn run(parts: &[&'static Part], variables: &[(&str, String)]) -> Outcome<Done> {
    let mut waiting = parts.to_vec();
    let mut running: Vec<Running<'static>> = Vec::new();
    let mut done = Done::default();
    let mut failed: Vec<&str> = Vec::new();
    made(times::folder())?;
    loop {
        while failed.is_empty() && running.len() < AT_A_TIME {
            let unfinished: Vec<&str> = waiting
                .iter()
                .copied()
                .chain(running.iter().map(|it| it.part))
                .map(|it| it.name)
                .collect();
            let is_ready = |part: &&Part| !part.after.iter().any(|it| unfinished.contains(it));
            let Some(next) = waiting.iter().position(is_ready) else { break };
            let next = waiting.remove(next);
            match start(next, variables) {
                Ok(part) => running.push(part),
                // Those that run are waited for.
                Err(fault) => {
                    eprintln!("{}: {fault}", next.name);
                    failed.push(next.name);
                }
            }
        }
        if running.is_empty() {
            break;
        }
        thread::sleep(LOOK);
        for place in (0..running.len()).rev() {
            let status = running[place].child.try_wait().map_err(|error| error.to_string())?;
            if let Some(status) = status {
                let Running { part, log, .. } = running.swap_remove(place);
                let text = fs::read(&log).map_err(|error| said(&log, &error))?;
                let text = String::from_utf8_lossy(&text);
                eprintln!("\n==== {} ====\n{}", part.name, text.trim());
                done.tests.add(counts(&text));
                done.times.extend(times::read(part.name).map(|times| (part.name, times)));
                if !status.success() {
                    failed.push(part.name);
                }
            }
        }
    }
    if failed.is_empty() { Ok(done) } else { Err(format!("failed: {}", failed.join(", "))) }
}

fn start<'a>(part: &'a Part, variables: &[(&str, String)]) -> Outcome<Running<'a>> {
    let log = times::folder().join(format!("{}.log", part.name));
    let file = File::create(&log).map_err(|error| said(&log, &error))?;
    let errors = file.try_clone().map_err(|error| said(&log, &error))?;
    let program = std::env::current_exe().map_err(|error| error.to_string())?;
    eprintln!("-- {} begins", part.name);
    let mut command = Command::new(program);
    command.args(["test", "--part", part.name]).envs(variables.iter().map(|(a, b)| (a, b)));
    command.stdin(Stdio::null()).stdout(file).stderr(errors);
    let child = command.spawn().map_err(|error| format!("{}: {error}", part.name))?;
    Ok(Running { part, child, log })
}
