//! What a command reads from the standard input, where `-` names it.

use std::io;
use std::sync::OnceLock;

use crate::failure::Failure;

/// What stands for the standard input, or the standard output.
pub const STANDARD: &str = "-";

/// What errors call it, and a scene there that has no name.
pub const NAME: &str = "stdin";

/// The whole text, which is read once.
pub fn text() -> Result<&'static str, Failure> {
    static TEXT: OnceLock<String> = OnceLock::new();
    if let Some(text) = TEXT.get() {
        return Ok(text);
    }
    let text = io::read_to_string(io::stdin())
        .map_err(|error| Failure::Fault(format!("cannot read the standard input: {error}")))?;
    Ok(TEXT.get_or_init(|| text))
}
