//! Changes of a world.

// Python shows these comments as docstrings: units in plain brackets, errors in Google's style.
#![allow(rustdoc::broken_intra_doc_links, rustdoc::invalid_rust_codeblocks)]

use std::sync::Arc;

use carom::{
    BodyPair, Collider, ColliderId, Emitter, EmitterId, ForceId, Overlap, Sphere, SphereId, World,
};
use carom_scene::{Paint, Scene};
use numpy::PyArray1;
use pyo3::prelude::*;

use crate::arguments;
use crate::arrays;

use crate::engine::Engine;
use crate::failure::Failure;
use crate::inner::Inner;
use crate::next_poses::{GivenPoses, NextPoses};
use crate::part::{self, only};
use crate::points;

/// Additions. A refused one leaves the world unchanged.
#[pymethods]
impl Engine {
    /// Adds the spheres that `text` describes. Returns their ids.
    #[pyo3(name = "_add_described_spheres")]
    fn add_spheres_of<'py>(
        &self,
        py: Python<'py>,
        text: &str,
        may_overlap: bool,
    ) -> PyResult<Bound<'py, PyArray1<u64>>> {
        let part = self.part(py, text)?;
        let paints = part.spheres.iter().map(Paint::from).collect();
        self.add_all(py, spheres_of(&part)?, paints, may_overlap)
    }

    /// Adds spheres from arrays. Returns their ids.
    #[pyo3(name = "_add_spheres")]
    fn add_spheres_by_arrays<'py>(
        &self,
        py: Python<'py>,
        given: points::Given<'py>,
        may_overlap: bool,
    ) -> PyResult<Bound<'py, PyArray1<u64>>> {
        let (spheres, paints) = points::read(given)?;
        self.add_all(py, spheres, paints, may_overlap)
    }

    /// Adds the force that `text` describes. Returns its id.
    #[pyo3(name = "_add_force")]
    fn add_force_of(&self, py: Python<'_>, text: &str) -> PyResult<u64> {
        let part = part::read(text)?;
        let force = only(&part.forces)?;
        self.change(py, |inner| {
            let id = force.add_to(&mut inner.world)?;
            inner.described_mut().forces.push(force.clone());
            Ok(id.number())
        })
    }

    /// Adds the collider that `text` describes. Returns its id.
    #[pyo3(name = "_add_collider")]
    fn add_collider_of(&self, py: Python<'_>, text: &str) -> PyResult<u64> {
        let part = self.part(py, text)?;
        let collider = collider_of(&part)?;
        self.change(py, |inner| {
            let id = inner.world.add_collider(collider)?;
            inner.described_mut().colliders.extend(part.colliders);
            inner.color_colliders();
            Ok(id.number())
        })
    }

    /// Adds the emitter that `text` describes. Returns its id.
    #[pyo3(name = "_add_emitter")]
    fn add_emitter_of(&self, py: Python<'_>, text: &str) -> PyResult<u64> {
        let part = self.part(py, text)?;
        let emitter = emitter_of(&part)?;
        self.change(py, |inner| {
            let id = inner.world.add_emitter(emitter)?;
            let time = inner.world.time();
            part.emitters.iter().for_each(|it| inner.palette_mut().add_emitter(it, time));
            inner.described_mut().emitters.extend(part.emitters);
            Ok(id.number())
        })
    }
}

impl Engine {
    /// Reads spheres, colliders and emitters, which may be of the materials of the world's scene.
    fn part(&self, py: Python<'_>, text: &str) -> PyResult<Scene> {
        let described = Arc::clone(&self.lock(py)?.described);
        Ok(part::read_for(text, &described)?)
    }

    /// Adds spheres with their colours. Returns their ids.
    fn add_all<'py>(
        &self,
        py: Python<'py>,
        spheres: Vec<Sphere>,
        paints: Vec<Paint>,
        may_overlap: bool,
    ) -> PyResult<Bound<'py, PyArray1<u64>>> {
        let ids = self.change(py, |inner| {
            let before = (!may_overlap).then(|| inner.world.snapshot());
            let ids = add_all(&mut inner.world, &spheres)?;
            if let Some(before) = before
                && let Some(failure) = overlap_of(&inner.world, &ids)
            {
                inner.world.restore(&before);
                return Err(failure);
            }
            for (id, paint) in ids.iter().zip(paints) {
                inner.palette_mut().add_sphere(id.number(), paint);
            }
            Ok(ids)
        })?;
        Ok(arrays::numbers(py, &ids))
    }
}

/// Changes and removals. An id that does not exist is refused.
#[pymethods]
impl Engine {
    /// Replaces the properties of a sphere by those in `text`.
    #[pyo3(name = "_set_sphere")]
    fn set_sphere_of(&self, py: Python<'_>, id: &Bound<'_, PyAny>, text: &str) -> PyResult<()> {
        let id = arguments::id("sphere", id)?;
        let part = self.part(py, text)?;
        let spheres = spheres_of(&part)?;
        let (sphere, paint) = (*only(&spheres)?, only(&part.spheres)?.into());
        self.change(py, |inner| {
            inner.world.set_sphere(SphereId::from_number(id), sphere)?;
            inner.palette_mut().paint(id, paint);
            Ok(())
        })
    }

    /// Removes a sphere. Later spheres move up in the arrays.
    ///
    /// Raises:
    ///     UnknownError: If the world does not (or no longer) contain it.
    fn remove_sphere(&self, py: Python<'_>, id: &Bound<'_, PyAny>) -> PyResult<()> {
        let id = arguments::id("sphere", id)?;
        self.change(py, |inner| {
            inner.world.remove_sphere(SphereId::from_number(id))?;
            Ok(())
        })
    }

    /// Removes the spheres with these ids, or those that n booleans mark. Later spheres move up in
    /// the arrays.
    ///
    /// Raises:
    ///     UnknownError: If the world does not (or no longer) contain one of them; then none is
    ///         removed.
    #[pyo3(name = "_remove_spheres")]
    fn remove_spheres(&self, py: Python<'_>, ids: Vec<u64>) -> PyResult<()> {
        let ids: Vec<SphereId> = ids.into_iter().map(SphereId::from_number).collect();
        self.change(py, |inner| Ok(inner.world.remove_spheres(&ids)?))
    }

    /// Replaces a force by the one in `text`; it keeps its id.
    #[pyo3(name = "_set_force")]
    fn set_force_of(&self, py: Python<'_>, id: &Bound<'_, PyAny>, text: &str) -> PyResult<()> {
        let id = arguments::id("force", id)?;
        let part = part::read(text)?;
        let force = only(&part.forces)?;
        self.change(py, |inner| {
            let (id, place) = find_force(&inner.world, id)?;
            force.replace_in(&mut inner.world, id)?;
            inner.described_mut().forces[place].clone_from(force);
            Ok(())
        })
    }

    /// Removes a force.
    ///
    /// Raises:
    ///     UnknownError: If the world does not (or no longer) contain it.
    fn remove_force(&self, py: Python<'_>, id: &Bound<'_, PyAny>) -> PyResult<()> {
        let id = arguments::id("force", id)?;
        self.change(py, |inner| {
            let (id, place) = find_force(&inner.world, id)?;
            inner.world.remove_force(id)?;
            inner.described_mut().forces.remove(place);
            Ok(())
        })
    }

    /// Replaces a collider by the one in `text`; it keeps its id.
    #[pyo3(name = "_set_collider")]
    fn set_collider_of(&self, py: Python<'_>, id: &Bound<'_, PyAny>, text: &str) -> PyResult<()> {
        let id = arguments::id("collider", id)?;
        let part = self.part(py, text)?;
        let collider = collider_of(&part)?;
        self.change(py, |inner| {
            let (id, place) = find_collider(&inner.world, id)?;
            inner.world.set_collider(id, collider)?;
            inner.described_mut().colliders[place].clone_from(only(&part.colliders)?);
            inner.color_colliders();
            Ok(())
        })
    }

    /// Sets the velocities of a collider so that a step of `dt` [s], or of the scene's own frame time, takes it to a
    /// pose.
    #[pyo3(name = "_set_next_pose")]
    fn set_next_pose(
        &self,
        py: Python<'_>,
        pose: GivenPoses<'_>,
        dt: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<()> {
        let pose = NextPoses::read(&pose, &[])?;
        let dt = arguments::optional_number("dt", dt)?;
        self.change(py, |inner| {
            let dt = dt.unwrap_or(inner.described.simulation.frame_time);
            let collider = pose.collider(&inner.world, 0, dt)?;
            Ok(inner.world.set_collider(pose.id(), collider)?)
        })
    }

    /// Removes a collider.
    ///
    /// Raises:
    ///     UnknownError: If the world does not (or no longer) contain it.
    fn remove_collider(&self, py: Python<'_>, id: &Bound<'_, PyAny>) -> PyResult<()> {
        let id = arguments::id("collider", id)?;
        self.change(py, |inner| {
            let (id, place) = find_collider(&inner.world, id)?;
            inner.world.remove_collider(id)?;
            inner.described_mut().colliders.remove(place);
            inner.color_colliders();
            Ok(())
        })
    }

    /// Replaces an emitter by the one in `text`. If the period changes, it restarts at once.
    #[pyo3(name = "_set_emitter")]
    fn set_emitter_of(&self, py: Python<'_>, id: &Bound<'_, PyAny>, text: &str) -> PyResult<()> {
        let id = arguments::id("emitter", id)?;
        let part = self.part(py, text)?;
        let emitter = emitter_of(&part)?;
        self.change(py, |inner| {
            let (id, place) = find_emitter(&inner.world, id)?;
            inner.world.set_emitter(id, emitter)?;
            let (emitter, time) = (only(&part.emitters)?, inner.world.time());
            inner.palette_mut().set_emitter(place, emitter, time);
            inner.described_mut().emitters[place].clone_from(emitter);
            Ok(())
        })
    }

    /// Removes an emitter; its spheres stay.
    ///
    /// Raises:
    ///     UnknownError: If the world does not (or no longer) contain it.
    fn remove_emitter(&self, py: Python<'_>, id: &Bound<'_, PyAny>) -> PyResult<()> {
        let id = arguments::id("emitter", id)?;
        self.change(py, |inner| {
            let (id, place) = find_emitter(&inner.world, id)?;
            inner.world.remove_emitter(id)?;
            let time = inner.world.time();
            inner.palette_mut().remove_emitter(place, time);
            inner.described_mut().emitters.remove(place);
            Ok(())
        })
    }

    /// Sets the pairs of materials, which are those of the world's scene, from `text`.
    #[pyo3(name = "_set_material_pairs")]
    fn set_material_pairs_of(&self, py: Python<'_>, text: &str) -> PyResult<()> {
        let described = Arc::clone(&self.lock(py)?.described);
        let (described, pairs) = part::material_pairs(text, &described)?;
        self.change(py, |inner| {
            inner.world.set_material_pairs(pairs)?;
            inner.described_mut().material_pairs = described;
            Ok(())
        })
    }

    /// Sets the simulation settings from `text`.
    #[pyo3(name = "_set_simulation")]
    fn set_simulation_of(&self, py: Python<'_>, text: &str) -> PyResult<()> {
        let part = part::read_simulation(text)?;
        self.change(py, |inner: &mut Inner| {
            inner.world.set_settings(part.settings())?;
            inner.described_mut().simulation = part.simulation;
            Ok(())
        })
    }
}

impl Inner {
    /// Updates the colours of colliders from their descriptions.
    fn color_colliders(&mut self) {
        Arc::make_mut(&mut self.palette).set_colliders(&self.described.colliders);
    }
}

/// Adds spheres; if one is refused, none is added, and the error has its index.
fn add_all(world: &mut World, spheres: &[Sphere]) -> Result<Vec<SphereId>, Failure> {
    let before = world.snapshot();
    let add = |(number, sphere): (usize, &Sphere)| {
        let added = world.add_sphere(*sphere);
        added.map_err(|error| match spheres.len() {
            1 => Failure::from(error),
            _ => Failure::from(error).about(&format!("spheres[{number}]")),
        })
    };
    let added: Result<Vec<SphereId>, Failure> = spheres.iter().enumerate().map(add).collect();
    if added.is_err() {
        world.restore(&before);
    }
    added
}

/// Returns the error if one of these spheres, the last of a world, overlaps something.
fn overlap_of(world: &World, added: &[SphereId]) -> Option<Failure> {
    let first = added.first()?;
    let is_of_them = |overlap: &Overlap| match overlap.between {
        BodyPair::Spheres(one, other) => one >= *first || other >= *first,
        BodyPair::Collider { sphere, .. } => sphere >= *first,
    };
    let overlap = world.find_overlap(|overlap| overlap.depth > ROUNDING && is_of_them(overlap))?;
    let place = |id: SphereId| match id.number().checked_sub(first.number()) {
        Some(number) => format!("sphere {number} of these"),
        None => format!("the sphere with the id {}", id.number()),
    };
    let (sphere, other) = match overlap.between {
        BodyPair::Spheres(one, other) => (place(other), place(one)),
        BodyPair::Collider { collider, sphere } => {
            (place(sphere), format!("the collider with the id {}", collider.number()))
        }
    };
    let problem = format_args!("{sphere} overlaps {other} by {:.3e} m", overlap.depth);
    Some(Failure::value("positions", problem))
}

/// Overlaps up to this are rounding \[m\].
const ROUNDING: f64 = 1e-9;

fn spheres_of(part: &Scene) -> Result<Vec<Sphere>, Failure> {
    let world = part.world()?;
    let spheres = world.spheres();
    Ok((0..spheres.len()).map(|index| spheres.get(index)).collect())
}

/// Returns the only collider of a part.
///
/// # Errors
/// [`Failure`] for an invalid one, or another number of them.
pub fn collider_of(part: &Scene) -> Result<Collider, Failure> {
    let world = part.world()?;
    let colliders: Vec<Collider> =
        world.colliders().map(|(_, collider)| collider.clone()).collect();
    only(&colliders).cloned()
}

fn emitter_of(part: &Scene) -> Result<Emitter, Failure> {
    let world = part.world()?;
    let emitters: Vec<Emitter> = world.emitters().map(|(_, emitter)| *emitter).collect();
    only(&emitters).copied()
}

/// Returns the id of a force and its position in the order. It is looked up first, because removing
/// an unknown force would restart all flights.
fn find_force(world: &World, number: u64) -> Result<(ForceId, usize), Failure> {
    let place = world.forces().position(|(id, _)| id.number() == number);
    let found = place.map(|place| (ForceId::from_number(number), place));
    found.ok_or_else(|| Failure::unknown("force", number))
}

/// Returns the id of the collider with this number, and its position in the description.
///
/// # Errors
/// [`Failure`] if there is none.
pub fn find_collider(world: &World, number: u64) -> Result<(ColliderId, usize), Failure> {
    let place = world.colliders().position(|(id, _)| id.number() == number);
    let found = place.map(|place| (ColliderId::from_number(number), place));
    found.ok_or_else(|| Failure::unknown("collider", number))
}

/// Returns the id of the emitter with this number, and its position in the description.
fn find_emitter(world: &World, number: u64) -> Result<(EmitterId, usize), Failure> {
    let place = world.emitters().position(|(id, _)| id.number() == number);
    let found = place.map(|place| (EmitterId::from_number(number), place));
    found.ok_or_else(|| Failure::unknown("emitter", number))
}
