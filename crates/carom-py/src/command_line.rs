//! The command line `python -m carom`.

use std::ffi::OsString;

use pyo3::prelude::*;

use crate::failure::Failure;
use crate::scenes;

/// Runs the command `carom` with these arguments, of which the first is the program's name. Returns
/// the exit code. `registered` are texts of scenes that can be found by name besides those on the
/// disk.
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
