//! Converts errors of pictures and films into Python exceptions.

use std::io;

use carom_cli::pictures::ShootError;
use carom_render::{FilmError, GpuError, PictureError};
use pyo3::PyErr;

use crate::failure::Failure;

/// Returns the exception: about an argument, of the operating system, or of graphics.
pub fn raised(error: ShootError) -> PyErr {
    let message = error.to_string();
    match error {
        ShootError::Scene(error) => Failure::from(error).into(),
        ShootError::Physics(error) => Failure::from(error).into(),
        ShootError::Graphics(GpuError::Size { .. } | GpuError::Memory { .. })
        | ShootError::Film(FilmError::Size { .. }) => Failure::value("size", message).into(),
        ShootError::Film(FilmError::Rate { .. }) => Failure::value("frame_rate", message).into(),
        ShootError::Picture(PictureError::Unwritable { source, .. })
        | ShootError::Film(FilmError::Unwritable { source, .. }) => {
            io::Error::new(source.kind(), format!("path: {message}")).into()
        }
        _ => Failure::graphics(message).into(),
    }
}
