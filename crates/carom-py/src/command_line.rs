//! `python -m carom`.

use std::ffi::OsString;

use pyo3::prelude::*;

use crate::failure::Failure;
use crate::scenes;

/// Does what the command `carom` does with these arguments, the name of the program first, and
/// answers with the code to end with. `registered` are the texts of scenes that are found by name
/// besides those on the disk.
#[pyfunction]
pub fn run_command(
    py: Python<'_>,
    arguments: Vec<OsString>,
    registered: Vec<String>,
) -> Result<u8, Failure> {
    let read = |text: &String| scenes::in_code(text);
    let registered = registered.iter().map(read).collect::<Result<_, _>>()?;
    Ok(py.detach(|| carom_cli::main(arguments, registered)))
}
