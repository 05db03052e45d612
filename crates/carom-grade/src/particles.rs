//! Reads particle files of molecular dynamics as tables.

use std::fmt::Write;
use std::path::Path;

use carom_scene::recording::{ParticleError, ParticleFormat, read_particles};

use crate::error::GradeError;

/// Returns the table of a particle file: a row for each particle of each frame, in the columns that
/// runs write.
///
/// # Errors
/// [`GradeError`] if the file cannot be read, a line is wrong, or a frame has no time.
pub(crate) fn table(path: &Path, format: ParticleFormat) -> Result<String, GradeError> {
    let frames = read_particles(path, format).map_err(|error| match error {
        ParticleError::Unreadable { path, source } => GradeError::Unreadable { path, source },
        ParticleError::Line { path, line, problem } => {
            GradeError::Malformed { path, line, problem }
        }
        ParticleError::Binary { path, problem } => GradeError::Refused { path, problem },
        _ => refused(path, "has no whole frame"),
    })?;
    let has_velocities = frames.iter().all(|frame| frame.velocities.is_some());
    let mut text = "t,ball,x,y,z".to_owned();
    text.push_str(if has_velocities { ",vx,vy,vz\n" } else { "\n" });
    for (number, frame) in frames.iter().enumerate() {
        let time =
            frame.time.ok_or_else(|| refused(path, &format!("frame {number} has no time")))?;
        for (index, id) in frame.ids.iter().enumerate() {
            let velocity = frame.velocities.as_ref().filter(|_| has_velocities);
            let velocity = velocity.map(|all| all[index]);
            // Writing to a string cannot fail.
            write!(text, "{time:.16e},{id}").ok();
            for value in frame.positions[index].iter().chain(velocity.iter().flatten()) {
                write!(text, ",{value:.16e}").ok();
            }
            text.push('\n');
        }
    }
    Ok(text)
}

fn refused(path: &Path, problem: &str) -> GradeError {
    GradeError::Refused { path: path.to_owned(), problem: problem.to_owned() }
}
