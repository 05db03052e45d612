//! Every check: parts that run side by side or one by one, and how long each takes.

mod changes;
mod part;
mod parts;
pub mod programs;
mod schedule;
mod summary;
mod times;

use changes::Changes;
use part::Part;
use parts::PARTS;

use crate::shell::Outcome;

pub use parts::lint;

/// Runs every part, prints how long each takes, and how many tests passed.
pub fn all() -> Outcome {
    // What is built from nothing can be held against what that takes elsewhere.
    let is_cold = !times::folder().exists();
    let parts: Vec<&Part> = PARTS.iter().collect();
    let done = run(&parts, &[])?;
    if is_cold { times::check(&done.times) } else { Ok(()) }
}

/// Runs the parts that the changes since a commit can reach; without one, since the last commit that
/// the branch on the server has.
pub fn changed(base: Option<&str>) -> Outcome {
    let changes = Changes::since(base)?;
    let parts: Vec<&Part> = PARTS.iter().filter(|part| changes.reach(part)).collect();
    let packages = changes.packages();
    let variables = packages.map(|names| (parts::PACKAGES, names));
    run(&parts, variables.as_slice()).map(drop)
}

/// Runs one part, in this process.
pub fn part(name: &str) -> Outcome {
    let part = PARTS.iter().find(|part| part.name == name).ok_or_else(|| {
        let names: Vec<&str> = PARTS.iter().map(|part| part.name).collect();
        format!("there is no part {name:?}; the parts are: {}", names.join(", "))
    })?;
    times::timed(part.name, part.run)
}

fn run(parts: &[&'static Part], variables: &[(&str, String)]) -> Outcome<schedule::Done> {
    let done = schedule::run(parts, variables)?;
    eprintln!("\n{}", times::table(&done.times));
    let summary::Counts { passed, failed, skipped } = done.tests;
    eprintln!("{passed} passed, {failed} failed, {skipped} skipped");
    Ok(done)
}
