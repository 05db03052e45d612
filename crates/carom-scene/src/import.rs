//! What imports from other formats have in common: the report of what they do not understand, names, numbers,
//! and the check at the end.

use crate::legible::steers;
use std::fmt;

use crate::error::SceneError;
use crate::scene::Scene;

/// What of a scene was not understood, or has no counterpart: one line of the report.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Omission {
    /// The object, by the names from the root of the scene, like `Maze/Wall`; the file where the line is
    /// about no object.
    pub object: String,
    /// Which part of it.
    pub component: String,
    /// Why it is left out, or what it is taken for.
    pub reason: String,
    /// How many objects this holds for; `object` is the first of them.
    pub count: usize,
}

impl fmt::Display for Omission {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { object, component, reason, count } = self;
        match count {
            1 => write!(f, "{object}: {component}: {reason}"),
            _ => write!(f, "{object} and {} more: {component}: {reason}", count - 1),
        }
    }
}

/// Adds a line to a report, or counts it where the like is there.
pub fn omit(report: &mut Vec<Omission>, object: &str, component: &str, reason: impl Into<String>) {
    /// Lines of a report. What is beyond is counted in the last one.
    const MOST: usize = 1000;
    let reason = reason.into();
    let same = report.iter_mut().find(|it| it.component == component && it.reason == reason);
    if let Some(same) = same {
        same.count += 1;
    } else if report.len() < MOST {
        let (object, component) = (object.to_owned(), component.to_owned());
        report.push(Omission { object, component, reason, count: 1 });
    } else if report.len() == MOST {
        let reason = "the report is cut here".to_owned();
        let (object, component) = (object.to_owned(), "more".to_owned());
        report.push(Omission { object, component, reason, count: 1 });
    } else if let Some(last) = report.last_mut() {
        last.count += 1;
    }
}

/// A name without characters that steer a terminal, of 200 characters at most.
pub fn plain_name(name: &str) -> String {
    name.chars().map(|it| if steers(it) { ' ' } else { it }).take(200).collect()
}

/// Numbers with the 9 digits that tell any two 32-bit numbers apart, which the other programs compute
/// with: 0.3 for 0.30000000000000004. What is nothing beside the largest of them becomes 0.
pub fn shortened<const N: usize>(numbers: [f64; N]) -> [f64; N] {
    let largest = numbers.iter().fold(0.0_f64, |largest, number| largest.max(number.abs()));
    numbers.map(|number| {
        if number.abs() <= 1e-12 * largest {
            return 0.0;
        }
        format!("{number:.8e}").parse().unwrap_or(number)
    })
}

/// Makes sure that a scene makes a world. Spheres that overlap at the start may from now on, as they may in other
/// programs, and go to the report.
///
/// # Errors
/// Why the scene makes none.
pub fn made_runnable(scene: &mut Scene, report: &mut Vec<Omission>) -> Result<(), SceneError> {
    let Err(refused) = scene.world() else { return Ok(()) };
    scene.simulation.allow_overlap = true;
    scene.world()?;
    omit(report, &scene.name, "start", format!("`allow_overlap` is set, for {refused}"));
    Ok(())
}
