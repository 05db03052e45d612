//! Changes of the motion of single spheres, and the groups and data of all.

// Python shows these comments as docstrings: units in plain brackets, errors in Google's style.
#![allow(rustdoc::broken_intra_doc_links)]

use carom::{DVec3, SphereId};
use carom_scene::scene::Strike;
use numpy::{PyArray1, PyArrayMethods, PyReadonlyArray1};
use pyo3::prelude::*;

use crate::arguments;
use crate::engine::Engine;
use crate::failure::Failure;
use crate::setting::{Label, set_labels};

#[pymethods]
impl Engine {
    /// Applies an impulse [N s] to a sphere at its centre: its velocity changes by the impulse
    /// over its mass.
    ///
    /// Raises:
    ///     UnknownError: If the world does not (or no longer) contain it.
    ///     CaromError: If the new velocity is not finite.
    fn apply_impulse(&self, id: &Bound<'_, PyAny>, impulse: &Bound<'_, PyAny>) -> PyResult<()> {
        let (sphere, impulse) = (sphere(id)?, vector("impulse", impulse)?);
        self.change(id.py(), |inner| Ok(inner.world.apply_impulse(sphere, impulse)?))
    }

    /// Applies an impulse [N s] to a sphere at a point [m]: its velocity changes as by
    /// `apply_impulse`, its angular velocity by (point - centre) × impulse / (moment of inertia).
    ///
    /// Raises:
    ///     UnknownError: If the world does not (or no longer) contain it.
    ///     CaromError: If a new quantity is not finite.
    fn apply_impulse_at(
        &self,
        id: &Bound<'_, PyAny>,
        impulse: &Bound<'_, PyAny>,
        point: &Bound<'_, PyAny>,
    ) -> PyResult<()> {
        let (sphere, impulse) = (sphere(id)?, vector("impulse", impulse)?);
        let point = vector("point", point)?;
        self.change(id.py(), |inner| Ok(inner.world.apply_impulse_at(sphere, impulse, point)?))
    }

    /// Strikes a sphere with a cue: speed, azimuth and elevation in degrees, offset to the right
    /// and up, and the mass of the cue.
    #[pyo3(name = "_strike")]
    fn strike_with(&self, id: &Bound<'_, PyAny>, numbers: [f64; 6]) -> PyResult<()> {
        let number = sphere(id)?;
        let [speed, azimuth_degrees, elevation_degrees, right, up, cue_mass] = numbers;
        let offset = [right, up];
        let strike = Strike { speed, azimuth_degrees, elevation_degrees, offset, cue_mass };
        self.change(id.py(), |inner| {
            let strike = strike.on_radius(inner.world.sphere(number)?.radius);
            Ok(inner.world.strike(number, strike).map(drop)?)
        })
    }

    /// Sets the velocity of a sphere [m/s].
    ///
    /// Raises:
    ///     UnknownError: If the world does not (or no longer) contain it.
    ///     CaromError: If the velocity is not finite.
    fn set_velocity(&self, id: &Bound<'_, PyAny>, velocity: &Bound<'_, PyAny>) -> PyResult<()> {
        let (sphere, velocity) = (sphere(id)?, vector("velocity", velocity)?);
        self.change(id.py(), |inner| Ok(inner.world.set_velocity(sphere, velocity)?))
    }

    /// Sets the angular velocity of a sphere [rad/s].
    ///
    /// Raises:
    ///     UnknownError: If the world does not (or no longer) contain it.
    ///     CaromError: If the angular velocity is not finite.
    fn set_angular_velocity(
        &self,
        id: &Bound<'_, PyAny>,
        angular_velocity: &Bound<'_, PyAny>,
    ) -> PyResult<()> {
        let sphere = sphere(id)?;
        let spin = vector("angular_velocity", angular_velocity)?;
        self.change(id.py(), |inner| Ok(inner.world.set_angular_velocity(sphere, spin)?))
    }

    /// Returns the labels of all spheres with this name.
    #[pyo3(name = "_labels")]
    fn labels<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyArray1<u64>>> {
        let label = Label::named(name)?;
        let inner = &*self.lock(py)?;
        let spheres = inner.world.spheres();
        let labels = (0..spheres.len()).map(|index| label.of(&spheres.get(index)));
        Ok(PyArray1::from_iter(py, labels))
    }

    /// Sets the labels of all spheres with this name.
    #[pyo3(name = "_set_labels")]
    fn set_labels(
        &self,
        py: Python<'_>,
        name: &str,
        labels: PyReadonlyArray1<'_, u64>,
    ) -> PyResult<()> {
        let (label, labels) = (Label::named(name)?, labels.to_vec()?);
        self.change(py, |inner| {
            if inner.world.spheres().len() != labels.len() {
                let problem = "spheres came or went in another thread meanwhile";
                return Err(Failure::value(name, problem));
            }
            set_labels(&mut inner.world, label, &labels)
        })
    }
}

fn sphere(id: &Bound<'_, PyAny>) -> PyResult<SphereId> {
    arguments::id("sphere", id).map(SphereId::from_number)
}

fn vector(name: &str, values: &Bound<'_, PyAny>) -> PyResult<DVec3> {
    Ok(DVec3::from_slice(&arguments::array(name, values, &[3])?))
}
