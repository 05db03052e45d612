//! Settings of pictures, read from Python.

use carom_cli::pictures::{PictureOptions, Viewpoint};
use carom_render::{Preset, Quality};
use carom_scene::Scene;
use carom_scene::scene::Camera;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;

use crate::failure::Failure;
use crate::part;

/// Settings of a picture as given by Python.
#[derive(Debug, FromPyObject)]
pub struct View<'py> {
    /// Width and height in pixels.
    size: Bound<'py, PyAny>,
    /// A camera as on the command line, or as TOML: `camera = { ... }`.
    camera: String,
    quality: String,
    stamp: bool,
}

/// Settings of a picture, checked.
pub struct PictureSettings {
    pub look: PictureOptions,
    /// Replaces the scene's own camera.
    camera: Option<Camera>,
}

impl PictureSettings {
    /// Checks the settings.
    ///
    /// # Errors
    /// `TypeError` for a size that is none, [`Failure`] for an invalid setting; both name the
    /// argument.
    pub fn read(view: &View) -> PyResult<Self> {
        let (camera, viewpoint) = viewpoint(&view.camera)?;
        let (size, quality) = (size(&view.size)?, quality(&view.quality)?);
        Ok(Self {
            look: PictureOptions { size, camera: viewpoint, no_stamp: !view.stamp, quality },
            camera,
        })
    }

    /// Sets the chosen camera in a scene.
    pub fn apply(&self, scene: &mut Scene) {
        if self.camera.is_some() {
            scene.camera.clone_from(&self.camera);
        }
    }
}

fn viewpoint(text: &str) -> Result<(Option<Camera>, Viewpoint), Failure> {
    if text.starts_with("camera = ") {
        let part = part::read(text)?;
        return Ok((part.camera, Viewpoint::Preset(Preset::Scene)));
    }
    let viewpoint = text.parse().map_err(|problem| Failure::value("camera", problem))?;
    Ok((None, viewpoint))
}

fn size(value: &Bound<'_, PyAny>) -> PyResult<[u32; 2]> {
    let Ok(sides) = value.extract::<[i64; 2]>() else {
        let message = format!("size: must be width and height in pixels, not {value}");
        return Err(PyTypeError::new_err(message));
    };
    let [Ok(width), Ok(height)] = sides.map(u32::try_from) else {
        let problem = format_args!("must be in [1, 2^32) each, not {value}");
        return Err(Failure::value("size", problem).into());
    };
    Ok([width, height])
}

fn quality(name: &str) -> Result<Quality, Failure> {
    match name {
        "fine" => Ok(Quality::FINE),
        "good" => Ok(Quality::GOOD),
        "draft" => Ok(Quality::DRAFT),
        _ => {
            Err(Failure::value("quality", format_args!("must be fine, good or draft, not {name}")))
        }
    }
}
