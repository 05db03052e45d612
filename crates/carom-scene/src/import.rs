//! Common parts of imports from other formats: the report of omissions, names, numbers, and the
//! final check.

use std::fmt;
use std::path::Path;

use carom::DVec3;

use crate::error::SceneError;
use crate::legible::steers;
use crate::mesh_file;
use crate::scene::Scene;

/// One line of the report of an import: something that was ignored, replaced or not understood.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Omission {
    /// Path of the object from the root of the scene, such as `Maze/Wall`; the file if the line
    /// concerns no object.
    pub object: String,
    /// The part of the object.
    pub component: String,
    /// Why it was ignored, or what replaces it.
    pub reason: String,
    /// Number of objects to which the line applies; `object` is the first of them.
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

/// Adds a line to a report, or counts it if the report has a line with this component and reason.
pub fn omit(report: &mut Vec<Omission>, object: &str, component: &str, reason: impl Into<String>) {
    /// Most lines of a report; the last one counts all others.
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

/// Reads vertices and triangles of the only object of a Wavefront file (.obj), in the file's units and coordinates.
///
/// # Errors
/// What is wrong with the file, in words; several objects, too.
pub fn wavefront(path: &Path) -> Result<(Vec<DVec3>, Vec<[u32; 3]>), String> {
    mesh_file::read_one_object(path)
}

/// Replaces control characters in a name by spaces and cuts it after 200 characters.
pub fn plain_name(name: &str) -> String {
    name.chars().map(|it| if steers(it) { ' ' } else { it }).take(200).collect()
}

/// Rounds numbers to 9 significant digits, which distinguish any two 32-bit numbers:
/// 0.30000000000000004 becomes 0.3. Numbers below 1e-12 of the largest become 0.
pub fn shortened<const N: usize>(numbers: [f64; N]) -> [f64; N] {
    let largest = numbers.iter().fold(0.0_f64, |largest, number| largest.max(number.abs()));
    numbers.map(|number| {
        if number.abs() <= 1e-12 * largest {
            return 0.0;
        }
        format!("{number:.8e}").parse().unwrap_or(number)
    })
}

/// Checks that a scene can be simulated. If spheres overlap at the start, it sets `allow_overlap`
/// and adds a line to the report.
///
/// # Errors
/// The error of [`Scene::world`] if the scene remains invalid.
pub fn made_runnable(scene: &mut Scene, report: &mut Vec<Omission>) -> Result<(), SceneError> {
    let Err(refused) = scene.world() else { return Ok(()) };
    scene.simulation.allow_overlap = true;
    scene.world()?;
    omit(report, &scene.name, "start", format!("`allow_overlap` is set, for {refused}"));
    Ok(())
}
