//! Changing a world from outside.

// What is said of methods here is read in Python: units in plain brackets, errors in Google's style.
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

use crate::engine::{Engine, Inner};
use crate::failure::Failure;
use crate::part::{self, only};
use crate::points;

/// Adding. What is refused leaves the world as it was.
#[pymethods]
impl Engine {
    /// Adds the spheres that `text` describes, and answers with their ids.
    #[pyo3(name = "_add_described_spheres")]
    fn add_spheres_of<'py>(
        &self,
        py: Python<'py>,
        text: &str,
        may_overlap: bool,
    ) -> PyResult<Bound<'py, PyArray1<u64>>> {
        let part = part::read(text)?;
        let paints = part.spheres.iter().map(Paint::from).collect();
        self.add_all(py, spheres_of(&part)?, paints, may_overlap)
    }

    /// Adds spheres by arrays, and answers with their ids.
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

    /// Adds the force that `text` describes, and answers with its id.
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

    /// Adds the collider that `text` describes, and answers with its id.
    #[pyo3(name = "_add_collider")]
    fn add_collider_of(&self, py: Python<'_>, text: &str) -> PyResult<u64> {
        let part = part::read(text)?;
        let collider = collider_of(&part)?;
        self.change(py, |inner| {
            let id = inner.world.add_collider(collider)?;
            inner.described_mut().colliders.extend(part.colliders);
            inner.color_colliders();
            Ok(id.number())
        })
    }

    /// Adds the emitter that `text` describes, and answers with its id.
    #[pyo3(name = "_add_emitter")]
    fn add_emitter_of(&self, py: Python<'_>, text: &str) -> PyResult<u64> {
        let part = part::read(text)?;
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
    /// Adds spheres with their colours, and answers with their ids.
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

/// Changing and removing. Ids are numbers as they were given; any other is refused.
#[pymethods]
impl Engine {
    /// Changes a sphere to the one that `text` describes.
    #[pyo3(name = "_set_sphere")]
    fn set_sphere_of(&self, py: Python<'_>, id: &Bound<'_, PyAny>, text: &str) -> PyResult<()> {
        let id = arguments::id("sphere", id)?;
        let part = part::read(text)?;
        let spheres = spheres_of(&part)?;
        let (sphere, paint) = (*only(&spheres)?, only(&part.spheres)?.into());
        self.change(py, |inner| {
            inner.world.set_sphere(SphereId::from_number(id), sphere)?;
            inner.palette_mut().paint(id, paint);
            Ok(())
        })
    }

    /// Takes a sphere out of the world. Those after it move up in the arrays.
    ///
    /// Raises:
    ///     UnknownError: If it is not in the world (any more).
    fn remove_sphere(&self, py: Python<'_>, id: &Bound<'_, PyAny>) -> PyResult<()> {
        let id = arguments::id("sphere", id)?;
        self.change(py, |inner| {
            inner.world.remove_sphere(SphereId::from_number(id))?;
            Ok(())
        })
    }

    /// Takes spheres out of the world, those of these ids, or those that n truth values mark. Those after
    /// them move up in the arrays.
    ///
    /// Raises:
    ///     UnknownError: If one of them is not in the world (any more); then none is taken out.
    #[pyo3(name = "_remove_spheres")]
    fn remove_spheres(&self, py: Python<'_>, ids: Vec<u64>) -> PyResult<()> {
        let ids: Vec<SphereId> = ids.into_iter().map(SphereId::from_number).collect();
        self.change(py, |inner| Ok(inner.world.remove_spheres(&ids)?))
    }

    /// Puts the force that `text` describes in the place of another.
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

    /// Takes a force out of the world.
    ///
    /// Raises:
    ///     UnknownError: If it is not in the world (any more).
    fn remove_force(&self, py: Python<'_>, id: &Bound<'_, PyAny>) -> PyResult<()> {
        let id = arguments::id("force", id)?;
        self.change(py, |inner| {
            let (id, place) = find_force(&inner.world, id)?;
            inner.world.remove_force(id)?;
            inner.described_mut().forces.remove(place);
            Ok(())
        })
    }

    /// Changes a collider to the one that `text` describes.
    #[pyo3(name = "_set_collider")]
    fn set_collider_of(&self, py: Python<'_>, id: &Bound<'_, PyAny>, text: &str) -> PyResult<()> {
        let id = arguments::id("collider", id)?;
        let part = part::read(text)?;
        let collider = collider_of(&part)?;
        self.change(py, |inner| {
            let (id, place) = find_collider(&inner.world, id)?;
            inner.world.set_collider(id, collider)?;
            inner.described_mut().colliders[place].clone_from(only(&part.colliders)?);
            inner.color_colliders();
            Ok(())
        })
    }

    /// Takes a collider out of the world.
    ///
    /// Raises:
    ///     UnknownError: If it is not in the world (any more).
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

    /// Changes an emitter to the one that `text` describes. With another period it starts anew, now.
    #[pyo3(name = "_set_emitter")]
    fn set_emitter_of(&self, py: Python<'_>, id: &Bound<'_, PyAny>, text: &str) -> PyResult<()> {
        let id = arguments::id("emitter", id)?;
        let part = part::read(text)?;
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

    /// Takes an emitter out of the world; its spheres stay.
    ///
    /// Raises:
    ///     UnknownError: If it is not in the world (any more).
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

    /// Steps the world as `text` says from now on.
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
    /// Draws the colliders in the colours of their descriptions from now on.
    fn color_colliders(&mut self) {
        Arc::make_mut(&mut self.palette).set_colliders(&self.described.colliders);
    }
}

/// Adds spheres; if one is refused, none is added, and the error tells its number among them.
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

/// What is wrong if one of these spheres, the last of a world, overlaps something.
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

/// Overlaps of so much \[m\] are rounding.
const ROUNDING: f64 = 1e-9;

fn spheres_of(part: &Scene) -> Result<Vec<Sphere>, Failure> {
    let world = part.world()?;
    let spheres = world.spheres();
    Ok((0..spheres.len()).map(|index| spheres.get(index)).collect())
}

fn collider_of(part: &Scene) -> Result<Collider, Failure> {
    let world = part.world()?;
    let colliders: Vec<Collider> = world.colliders().map(|(_, collider)| *collider).collect();
    only(&colliders).copied()
}

fn emitter_of(part: &Scene) -> Result<Emitter, Failure> {
    let world = part.world()?;
    let emitters: Vec<Emitter> = world.emitters().map(|(_, emitter)| *emitter).collect();
    only(&emitters).copied()
}

/// The id of a force, and its place in the order. Looked up first: to remove what is not there
/// would let all flights begin anew.
fn find_force(world: &World, number: u64) -> Result<(ForceId, usize), Failure> {
    let place = world.forces().position(|(id, _)| id.number() == number);
    let found = place.map(|place| (ForceId::from_number(number), place));
    found.ok_or_else(|| Failure::unknown("force", number))
}

/// The id of the collider with this number, and its place in the description.
fn find_collider(world: &World, number: u64) -> Result<(ColliderId, usize), Failure> {
    let place = world.colliders().position(|(id, _)| id.number() == number);
    let found = place.map(|place| (ColliderId::from_number(number), place));
    found.ok_or_else(|| Failure::unknown("collider", number))
}

/// The id of the emitter with this number, and its place in the description.
fn find_emitter(world: &World, number: u64) -> Result<(EmitterId, usize), Failure> {
    let place = world.emitters().position(|(id, _)| id.number() == number);
    let found = place.map(|place| (EmitterId::from_number(number), place));
    found.ok_or_else(|| Failure::unknown("emitter", number))
}
