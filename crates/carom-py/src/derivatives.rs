//! Derivatives of a run by what it started with.

// Python shows these comments as docstrings: units in plain brackets.
#![allow(rustdoc::broken_intra_doc_links)]

use std::sync::Mutex;

use carom::{
    ColliderId, ColliderVariation, DVec3, Margin, SphereId, SphereTangent, SphereVariation,
    SpringId, SpringVariation, Variation, World,
};
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;

use crate::arguments;
use crate::engine::Engine;
use crate::failure::Failure;
use crate::in_use::lock;

type Numbers<'py> = PyReadonlyArray1<'py, f64>;
type Row<'py> = Bound<'py, PyArray1<f64>>;
/// Directness, interval and activity, each with the sphere and the time of that impact; -1 for no sphere.
type MarginNumbers = [(f64, i64, f64); 3];

/// The record of a run, behind `carom.Tape`.
#[pyclass(frozen, module = "carom._carom")]
#[derive(Debug)]
pub struct TapeEngine {
    record: Mutex<Record>,
    colliders: Vec<ColliderId>,
    springs: Vec<SpringId>,
}

#[derive(Debug)]
struct Record {
    tape: carom::Tape,
    /// The spheres now: those that emitters added come last.
    ids: Vec<SphereId>,
}

/// Directions beside a run, behind `carom.Tangents`.
#[pyclass(frozen, module = "carom._carom")]
#[derive(Debug)]
pub struct TangentsEngine(Mutex<carom::Tangents>);

#[pymethods]
impl TapeEngine {
    /// Begins with a world as it is.
    #[new]
    fn new(py: Python<'_>, world: &Engine) -> PyResult<Self> {
        let guard = world.lock(py)?;
        let world = &guard.world;
        let started = carom::Tape::start(world).map_err(Failure::from);
        let ids = world.spheres().ids().to_vec();
        let colliders = world.colliders().map(|(id, _)| id).collect();
        let springs = world.springs().map(|(id, _)| id).collect();
        drop(guard);
        Ok(Self { record: Mutex::new(Record { tape: started?, ids }), colliders, springs })
    }

    /// Advances the world, and records how.
    fn step(
        &self,
        py: Python<'_>,
        world: &Engine,
        dt: Option<&Bound<'_, PyAny>>,
        frames: &Bound<'_, PyAny>,
    ) -> PyResult<()> {
        let mut record = lock(&self.record)?;
        let Record { tape, ids } = &mut *record;
        world.follow(py, (dt, frames), |world, dt| {
            tape.step(world, dt)?;
            ids.clear();
            ids.extend(world.spheres().ids());
            Ok::<(), carom::DerivativeError>(())
        })
    }

    /// How many impacts are recorded.
    #[getter]
    fn impacts(&self) -> PyResult<usize> {
        Ok(lock(&self.record)?.tape.impacts())
    }

    /// How near the run came to where derivatives end.
    #[getter]
    fn margin(&self) -> PyResult<MarginNumbers> {
        Ok(numbers_of(lock(&self.record)?.tape.margin()))
    }

    /// Returns the gradient of a number whose derivatives by the motion of each sphere at the end are given, three
    /// numbers for each: rows of the derivatives by all that the spheres, colliders and springs started with,
    /// and by the acceleration.
    fn gradient<'py>(&self, py: Python<'py>, motion: [Numbers<'py>; 3]) -> PyResult<Vec<Row<'py>>> {
        let [positions, velocities, spins] =
            [vectors(&motion[0])?, vectors(&motion[1])?, vectors(&motion[2])?];
        let record = lock(&self.record)?;
        let Record { tape, ids } = &*record;
        let derivatives: Vec<(SphereId, SphereTangent)> = (ids.iter().zip(positions))
            .zip(velocities.into_iter().zip(spins))
            .map(|((&id, position), (velocity, angular_velocity))| {
                (id, SphereTangent { position, velocity, angular_velocity })
            })
            .collect();
        let gradient = py.detach(|| tape.gradient(&derivatives)).map_err(Failure::from)?;
        Ok(self.rows(ids, &gradient).into_iter().map(|row| PyArray1::from_vec(py, row)).collect())
    }
}

impl TapeEngine {
    fn rows(&self, ids: &[SphereId], gradient: &Variation) -> Vec<Vec<f64>> {
        let sphere_rows = |part: fn(&SphereVariation) -> Vec<f64>| -> Vec<f64> {
            ids.iter().flat_map(|&id| part(&gradient.sphere(id))).collect()
        };
        let collider_rows = |part: fn(&ColliderVariation) -> Vec<f64>| -> Vec<f64> {
            self.colliders.iter().flat_map(|&id| part(&gradient.collider(id))).collect()
        };
        let spring_rows = |part: fn(&SpringVariation) -> f64| -> Vec<f64> {
            self.springs.iter().map(|&id| part(&gradient.spring(id))).collect()
        };
        vec![
            sphere_rows(|it| it.position.to_array().to_vec()),
            sphere_rows(|it| it.velocity.to_array().to_vec()),
            sphere_rows(|it| it.angular_velocity.to_array().to_vec()),
            sphere_rows(|it| vec![it.radius]),
            sphere_rows(|it| vec![it.mass]),
            sphere_rows(|it| vec![it.restitution]),
            sphere_rows(|it| vec![it.friction]),
            sphere_rows(|it| it.acceleration.to_array().to_vec()),
            collider_rows(|it| it.position.to_array().to_vec()),
            collider_rows(|it| it.rotation.to_array().to_vec()),
            collider_rows(|it| it.velocity.to_array().to_vec()),
            collider_rows(|it| vec![it.restitution]),
            collider_rows(|it| vec![it.friction]),
            spring_rows(|it| it.stiffness),
            spring_rows(|it| it.rest_length),
            spring_rows(|it| it.damping),
            gradient.acceleration.to_array().to_vec(),
        ]
    }
}

#[pymethods]
impl TangentsEngine {
    /// Begins with a world as it is, and `count` directions: changes of the motion of its spheres, three numbers for each
    /// sphere in each direction, and of the acceleration, three for each direction.
    #[new]
    fn new(
        py: Python<'_>,
        world: &Engine,
        count: usize,
        motion: [Numbers<'_>; 3],
        accelerations: Numbers<'_>,
    ) -> PyResult<Self> {
        let [positions, velocities, spins] =
            [vectors(&motion[0])?, vectors(&motion[1])?, vectors(&motion[2])?];
        let accelerations = vectors(&accelerations)?;
        let guard = world.lock(py)?;
        let ids = guard.world.spheres().ids();
        let direction = |number: usize| {
            let mut direction = Variation::default().with_acceleration(accelerations[number]);
            for (place, &id) in ids.iter().enumerate() {
                let row = number * ids.len() + place;
                let change = direction.sphere_mut(id);
                change.position = positions[row];
                change.velocity = velocities[row];
                change.angular_velocity = spins[row];
            }
            direction
        };
        let directions = (0..count).map(direction).collect();
        let started = carom::Tangents::new(&guard.world, directions).map_err(Failure::from);
        drop(guard);
        Ok(Self(Mutex::new(started?)))
    }

    /// Advances the world, and the directions with it.
    fn step(
        &self,
        py: Python<'_>,
        world: &Engine,
        dt: Option<&Bound<'_, PyAny>>,
        frames: &Bound<'_, PyAny>,
    ) -> PyResult<()> {
        let mut tangents = lock(&self.0)?;
        let tangents = &mut *tangents;
        world.follow(py, (dt, frames), |world, dt| tangents.step(world, dt))
    }

    /// Returns how centres, velocities and angular velocities change now, as rows of three numbers for each sphere in
    /// each direction.
    fn motion<'py>(&self, py: Python<'py>) -> PyResult<[Row<'py>; 3]> {
        let tangents = lock(&self.0)?;
        let row = |part: fn(&SphereTangent) -> DVec3| {
            let all = (0..tangents.len()).flat_map(|number| tangents.spheres(number));
            PyArray1::from_vec(py, all.flat_map(|tangent| part(tangent).to_array()).collect())
        };
        Ok([row(|it| it.position), row(|it| it.velocity), row(|it| it.angular_velocity)])
    }

    /// Makes the directions orthogonal and of length 1. Returns how long each was.
    fn orthonormalize<'py>(&self, py: Python<'py>, length: f64, speed: f64) -> PyResult<Row<'py>> {
        Ok(PyArray1::from_vec(py, lock(&self.0)?.orthonormalize(length, speed)))
    }

    /// How near the run came to where derivatives end.
    #[getter]
    fn margin(&self) -> PyResult<MarginNumbers> {
        Ok(numbers_of(lock(&self.0)?.margin()))
    }
}

impl Engine {
    /// Takes frames of `dt` \[s\], or of the scene's own, by a function that follows them, and updates the arrays.
    pub(crate) fn follow<E: Send>(
        &self,
        py: Python<'_>,
        (dt, frames): (Option<&Bound<'_, PyAny>>, &Bound<'_, PyAny>),
        mut step: impl FnMut(&mut World, f64) -> Result<(), E> + Send,
    ) -> PyResult<()>
    where
        Failure: From<E>,
    {
        let dt = arguments::optional_number("dt", dt)?;
        let frames = arguments::count("frames", frames)?;
        let mut guard = self.lock(py)?;
        let inner = &mut *guard;
        let dt = inner.frame_time(dt);
        inner.heed_signals();
        let taken = py.detach(|| {
            (0..frames).try_for_each(|_| {
                inner.frame_start = inner.world.time();
                step(&mut inner.world, dt)
            })
        });
        inner.arrays.write_motion(py, inner.world.spheres());
        drop(guard);
        Ok(taken.map_err(Failure::from)?)
    }
}

fn vectors(numbers: &Numbers<'_>) -> PyResult<Vec<DVec3>> {
    let numbers = numbers.as_slice()?;
    Ok(numbers.chunks_exact(3).map(DVec3::from_slice).collect())
}

fn numbers_of(margin: Margin) -> MarginNumbers {
    let numbers = |value: f64, event: Option<(SphereId, f64)>| match event {
        Some((sphere, time)) => (value, sphere.number() as i64, time),
        None => (value, -1, f64::NAN),
    };
    let Margin { directness, most_grazing, interval, closest, activity, least_active, .. } = margin;
    [numbers(directness, most_grazing), numbers(interval, closest), numbers(activity, least_active)]
}
