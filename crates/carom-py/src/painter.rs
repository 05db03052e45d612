//! Pictures of worlds.

// Python shows these comments as docstrings, with units in plain brackets.
#![allow(rustdoc::broken_intra_doc_links, rustdoc::invalid_rust_codeblocks)]

use std::path::PathBuf;
use std::sync::{Mutex, MutexGuard};

use carom_cli::pictures::{ShootError, Still, Studio};
use carom_render::{Camera, Picture};
use numpy::{PyArray1, PyArray3, PyArrayMethods};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use pyo3::sync::MutexExt;
use pyo3::types::PyBytes;

use crate::engine::Engine;
use crate::graphics_failure::raised;
use crate::inner::Inner;
use crate::picture_settings::{PictureSettings, View};

/// The renderer behind `carom.Renderer`: a graphics device that stays open, and a camera.
///
/// Several threads may use it; their calls wait for each other.
#[pyclass(frozen, module = "carom._carom")]
#[derive(Debug)]
pub struct Painter(Mutex<Easel>);

/// The data behind the lock.
#[derive(Debug)]
struct Easel {
    studio: Studio,
    camera: Camera,
}

#[pymethods]
impl Painter {
    /// Makes a renderer whose camera suits the present world.
    #[new]
    fn new(py: Python<'_>, world: &Engine, view: View<'_>) -> PyResult<Self> {
        let settings = PictureSettings::read(&view)?;
        let inner = &mut *world.lock(py)?;
        let easel = py.detach(|| Easel::new(&settings, inner)).map_err(raised)?;
        Ok(Self(Mutex::new(easel)))
    }

    /// Draws the present world: red, green and blue, shape (height, width, 3).
    fn paint<'py>(&self, py: Python<'py>, world: &Engine) -> PyResult<Bound<'py, PyArray3<u8>>> {
        let picture = self.picture(py, world)?;
        let shape = [picture.height as usize, picture.width as usize, 3];
        let colors = py.detach(|| without_opacity(&picture));
        PyArray1::from_vec(py, colors).reshape(shape)
    }

    /// Draws the present world as the content of a PNG file.
    fn png<'py>(&self, py: Python<'py>, world: &Engine) -> PyResult<Bound<'py, PyBytes>> {
        let picture = self.picture(py, world)?;
        let content = py.detach(|| picture.to_png()).map_err(|error| raised(error.into()))?;
        Ok(PyBytes::new(py, &content))
    }

    /// Writes a picture of the present world to a PNG file.
    fn save(&self, py: Python<'_>, world: &Engine, path: PathBuf) -> PyResult<()> {
        let picture = self.picture(py, world)?;
        py.detach(|| picture.save_png(&path)).map_err(|error| raised(error.into()))
    }
}

impl Painter {
    fn lock(&self, py: Python<'_>) -> PyResult<MutexGuard<'_, Easel>> {
        let broken = |_| PyRuntimeError::new_err("this renderer has failed before");
        self.0.lock_py_attached(py).map_err(broken)
    }

    fn picture(&self, py: Python<'_>, world: &Engine) -> PyResult<Picture> {
        let easel = &mut *self.lock(py)?;
        let inner = &mut *world.lock(py)?;
        py.detach(|| easel.paint(inner)).map_err(raised)
    }
}

impl Easel {
    fn new(settings: &PictureSettings, inner: &mut Inner) -> Result<Self, ShootError> {
        let mut studio = Studio::new(settings.look.clone())?;
        inner.follow_colors();
        let mut scene = (*inner.described).clone();
        settings.apply(&mut scene);
        let mut still = Still { scene: &scene, world: &inner.world, palette: &inner.palette };
        let camera = studio.camera(&mut still, inner.world.time())?;
        Ok(Self { studio, camera })
    }

    fn paint(&mut self, inner: &mut Inner) -> Result<Picture, ShootError> {
        inner.follow_colors();
        let Inner { described, world, palette, .. } = inner;
        let mut still = Still { scene: described, world, palette };
        self.studio.picture(&mut still, 0.0, &self.camera)
    }
}

/// Returns red, green and blue of every pixel; pictures of worlds are opaque.
fn without_opacity(picture: &Picture) -> Vec<u8> {
    picture.pixels.chunks_exact(4).flat_map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect()
}
