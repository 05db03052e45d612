//! Reads the standard input for commands whose argument is `-`.

use std::fmt::Display;
use std::io::{self, Read};
use std::path::Path;
use std::sync::OnceLock;

use carom_scene::{Budget, NotText, text_of};

use crate::failure::Failure;

/// Argument for the standard input or the standard output.
pub const STANDARD: &str = "-";

/// Name of the standard input in errors, and of a scene there that has no name.
pub const NAME: &str = "stdin";

/// Returns the whole text. It is read once and kept.
pub fn text() -> Result<&'static str, Failure> {
    static TEXT: OnceLock<String> = OnceLock::new();
    if let Some(text) = TEXT.get() {
        return Ok(text);
    }
    let most = Budget::FILE.bytes;
    let mut bytes = Vec::new();
    let read = io::stdin().lock().take(most + 1).read_to_end(&mut bytes);
    let refused =
        |error: &dyn Display| Failure::Fault(format!("cannot read the standard input: {error}"));
    read.map_err(|error| refused(&error))?;
    let is_longer = bytes.len() as u64 > most;
    let text = match text_of(bytes) {
        Err(NotText::Byte { .. }) | Ok(_) if is_longer => {
            return Err(Failure::Fault(format!("{NAME} is longer than {most} bytes")));
        }
        read => read.map_err(|error| refused(&error))?,
    };
    Ok(TEXT.get_or_init(|| text))
}

/// Whether the path is the standard output: `-`, or the name that the system has for it. A file
/// opened by that name would be overwritten from its start, with the summary on top.
pub fn is_standard(path: &Path) -> bool {
    let names: &[&str] =
        if cfg!(unix) { &["/dev/stdout", "/dev/fd/1", "/proc/self/fd/1"] } else { &[] };
    path.as_os_str() == STANDARD || names.iter().any(|name| path.as_os_str() == *name)
}
