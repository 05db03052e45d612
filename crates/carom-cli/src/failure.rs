//! Failures of commands: a line on the standard error stream, and an exit code.

use std::io::{self, Write};
use std::path::Path;

use carom::DerivativeError;
use carom_scene::SceneError;
use carom_scene::recording::RecordingError;
use carom_session::{LinkError, SessionError};

/// Why a command failed.
#[derive(Debug)]
pub enum Failure {
    /// The command line names something that does not exist or is invalid: code 2.
    Usage(String),
    /// Another error: code 1.
    Fault(String),
    /// Compared results differ, and the output says so: code 1, without a message.
    Differs,
    /// The reader of the output closed it: code 0, without a message.
    OutputClosed,
    /// The user interrupted the command; written files are complete: code 130, as shells expect.
    Interrupted,
}

/// Exit code of a command line that names something that does not exist or is invalid.
pub const USAGE: u8 = 2;

impl Failure {
    /// Prints the error; returns the exit code.
    pub fn report(self) -> u8 {
        match self {
            Self::Usage(message) => {
                refuse(&message);
                USAGE
            }
            Self::Fault(message) => {
                refuse(&message);
                1
            }
            Self::Differs => 1,
            Self::OutputClosed => 0,
            Self::Interrupted => 130,
        }
    }
}

/// Converts an error of writing a file or the standard output.
pub fn unwritable(path: &Path, error: &io::Error) -> Failure {
    if error.kind() == io::ErrorKind::BrokenPipe {
        return Failure::OutputClosed;
    }
    Failure::Fault(format!("cannot write {}: {error}", path.display()))
}

/// Converts an error of writing a table.
pub fn unwritable_table(path: &Path, error: csv::Error) -> Failure {
    // Its conversion to an `io::Error` hides the kind of the error.
    match error.into_kind() {
        csv::ErrorKind::Io(error) => unwritable(path, &error),
        kind => Failure::Fault(format!("cannot write {}: {kind:?}", path.display())),
    }
}

/// Prints an error; in colour if the terminal supports it and `NO_COLOR` or a similar variable does
/// not forbid it.
fn refuse(message: &str) {
    let red = clap::builder::styling::AnsiColor::Red.on_default().bold();
    let message = legible(message);
    writeln!(anstream::stderr(), "{red}carom:{red:#} {message}").ok();
}

/// Writes a line to the standard error stream. If the stream is closed, the line is lost.
pub fn complain(line: &str) {
    writeln!(io::stderr(), "{}", legible(line)).ok();
}

/// Converts a message to one line that is safe for a terminal.
pub fn legible(message: &str) -> String {
    /// Most characters.
    const LONGEST: usize = 4000;
    carom_scene::legible(&message.trim_end().lines().collect::<Vec<_>>().join(" "), LONGEST)
}

/// Combines two results; if both failed, into one line.
pub fn both(first: Result<(), Failure>, second: Result<(), Failure>) -> Result<(), Failure> {
    match (first, second) {
        (Err(Failure::Fault(first)), Err(Failure::Fault(second))) => {
            Err(Failure::Fault(format!("{first}; {second}")))
        }
        (Ok(()), second) => second,
        (first, _) => first,
    }
}

impl From<SceneError> for Failure {
    fn from(error: SceneError) -> Self {
        let message = error.to_string();
        match error {
            SceneError::Unknown { .. } => {
                Self::Usage(format!("{message} (`carom scenes` lists them all)"))
            }
            SceneError::BadOverride { .. } | SceneError::Overridden { .. } => Self::Usage(message),
            _ => Self::Fault(message),
        }
    }
}

impl From<RecordingError> for Failure {
    fn from(error: RecordingError) -> Self {
        let message = error.to_string();
        match error {
            // The command line supports one format more.
            RecordingError::UnknownFormat { .. } => {
                Self::Usage(format!("{message}, or .glb (an animation in glTF)"))
            }
            RecordingError::NoFurtherColumns { .. } => Self::Usage(message),
            // The reader of the standard output closed it.
            RecordingError::Unwritable { source, .. }
                if source.kind() == io::ErrorKind::BrokenPipe =>
            {
                Self::OutputClosed
            }
            _ => Self::Fault(message),
        }
    }
}

impl From<SessionError> for Failure {
    fn from(error: SessionError) -> Self {
        match error {
            SessionError::Scene(error) => error.into(),
            SessionError::Time { .. } | SessionError::TooFar { .. } => {
                Self::Usage(error.to_string())
            }
            SessionError::World(error) => error.into(),
            _ => Self::Fault(error.to_string()),
        }
    }
}

impl From<LinkError> for Failure {
    fn from(error: LinkError) -> Self {
        match error {
            LinkError::Scene(error) => error.into(),
            _ => Self::Usage(error.to_string()),
        }
    }
}

impl From<carom::Error> for Failure {
    fn from(error: carom::Error) -> Self {
        match error {
            carom::Error::Stopped { .. } => Self::Interrupted,
            error => Self::Fault(error.to_string()),
        }
    }
}

impl From<DerivativeError> for Failure {
    fn from(error: DerivativeError) -> Self {
        match error {
            DerivativeError::Step(error) => error.into(),
            error => Self::Fault(error.to_string()),
        }
    }
}

/// Converts errors of writing to the standard output.
impl From<io::Error> for Failure {
    fn from(error: io::Error) -> Self {
        if error.kind() == io::ErrorKind::BrokenPipe {
            Self::OutputClosed
        } else {
            Self::Fault(format!("cannot write the output: {error}"))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_would_steer_a_terminal_is_written_out_and_what_is_long_is_cut() {
        assert_eq!(legible("a\u{1b}[31mb\u{9b}2J\nc"), "a\\u{1b}[31mb\\u{9b}2J c");
        assert_eq!(legible("a\u{202e}b"), "a\\u{202e}b");
        let long = legible(&"x".repeat(200_000));
        assert!(long.ends_with("x...") && long.len() < 4100);
    }
}
