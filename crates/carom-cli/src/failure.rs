//! How a command fails: one line on the standard error stream, and an exit code.

use std::io::{self, Write};

use carom_scene::SceneError;
use carom_scene::recording::RecordingError;
use carom_session::{LinkError, SessionError};

/// Why a command stops before its end.
#[derive(Debug)]
pub enum Failure {
    /// The command line names something that does not exist or makes no sense: code 2.
    Usage(String),
    /// Something went wrong on the way: code 1.
    Fault(String),
    /// What was compared is not the same, as the output says: code 1, silently.
    Differs,
    /// The reader of the output has closed it: code 0, silently.
    OutputClosed,
    /// Stopped by the user; what was written is complete: code 130, as shells expect.
    Interrupted,
}

/// The code of a command line that names what does not exist or makes no sense.
pub const USAGE: u8 = 2;

impl Failure {
    /// Says what went wrong and with which code to end.
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

/// Says why the command stops; in colour where a terminal shows it, unless `NO_COLOR` or another of
/// the usual variables says otherwise.
fn refuse(message: &str) {
    let red = clap::builder::styling::AnsiColor::Red.on_default().bold();
    let message = legible(message);
    writeln!(anstream::stderr(), "{red}carom:{red:#} {message}").ok();
}

/// Writes a line to the standard error stream. If that is gone too, the line is lost.
pub fn complain(line: &str) {
    writeln!(io::stderr(), "{}", legible(line)).ok();
}

/// A message in one line, as a terminal shows it.
pub fn legible(message: &str) -> String {
    /// In characters.
    const LONGEST: usize = 4000;
    carom_scene::legible(&message.trim_end().lines().collect::<Vec<_>>().join(" "), LONGEST)
}

/// Two results as one: if both failed, one line says so.
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
            // The command line knows one more.
            RecordingError::UnknownFormat { .. } => {
                Self::Usage(format!("{message}, or .glb (an animation in glTF)"))
            }
            // The reader of the standard output has seen enough.
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

/// Errors in writing to the standard output.
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
