//! The world that Python holds.

// Python shows these comments as docstrings: units in plain brackets, errors in Google's style.
#![allow(rustdoc::broken_intra_doc_links, rustdoc::invalid_rust_codeblocks)]

use std::sync::{Arc, Mutex, MutexGuard};

use carom::{ContactAccount, ZoneAccount};
use carom_scene::{Palette, part};
use numpy::PyArray1;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use pyo3::sync::MutexExt;
use pyo3::types::PyTuple;

use crate::arguments;
use crate::arrays;
use crate::failure::Failure;
use crate::inner::{Clock, Inner};
use crate::points;
use crate::properties::sphere_properties;
use crate::quantity::Quantity;
use crate::scenes;
use crate::setting;
use crate::snapshot::Snapshot;
use crate::stop;
use crate::tables::Table;

/// Base class of `carom.World`: a world, and the arrays that Python sees of it.
///
/// Several threads may use it; their calls wait for each other.
#[pyclass(frozen, subclass, module = "carom._carom")]
#[derive(Debug)]
pub struct Engine {
    inner: Mutex<Inner>,
    /// Start time of the frame that is being taken.
    clock: Arc<Clock>,
}

impl Engine {
    /// Waits for other threads, and applies values that a script wrote into the arrays.
    ///
    /// # Errors
    /// `CaromError` if the world refuses these values.
    pub fn lock(&self, py: Python<'_>) -> PyResult<MutexGuard<'_, Inner>> {
        let mut inner = self.lock_as_it_is(py)?;
        match inner.take_written(py) {
            Ok(()) => Ok(inner),
            Err(failure) => {
                // Making an exception runs Python, which may run a handler that waits for this
                // lock.
                drop(inner);
                Err(failure.into())
            }
        }
    }

    /// Waits for other threads. In a signal handler during a step of this world, returns an error
    /// instead, because waiting would never end.
    fn lock_as_it_is(&self, py: Python<'_>) -> PyResult<MutexGuard<'_, Inner>> {
        if stop::is_in_handler() {
            let at_work = |_| PyRuntimeError::new_err("this world is in the middle of a step");
            return self.inner.try_lock().map_err(at_work);
        }
        let broken = |_| PyRuntimeError::new_err("the engine of this world has failed before");
        self.inner.lock_py_attached(py).map_err(broken)
    }

    /// Returns the words that `push` writes of the world.
    fn words<'py>(
        &self,
        py: Python<'py>,
        push: impl FnOnce(&mut Table, &Inner),
    ) -> PyResult<Bound<'py, PyArray1<u64>>> {
        let inner = &*self.lock(py)?;
        let mut table = Table::default();
        push(&mut table, inner);
        Ok(PyArray1::from_vec(py, table.into_words()))
    }

    /// Changes the world and updates the arrays.
    pub fn change<T>(
        &self,
        py: Python<'_>,
        change: impl FnOnce(&mut Inner) -> Result<T, Failure>,
    ) -> PyResult<T> {
        let mut guard = self.lock(py)?;
        let inner = &mut *guard;
        let result = change(inner);
        if result.is_ok() {
            inner.arrays.write_all(py, inner.world.spheres());
        }
        drop(guard);
        Ok(result?)
    }
}

/// Constructor, steps and snapshots.
#[pymethods]
impl Engine {
    /// Makes the world of the scene that `text` describes in TOML. Spheres come from `points` if it
    /// is given; springs then come from the text `springs`.
    #[new]
    #[pyo3(signature = (text, points = None, springs = ""))]
    fn new(text: &str, points: Option<points::Given<'_>>, springs: &str) -> PyResult<Self> {
        let mut scene = scenes::in_code(text).map_err(Failure::of_part)?;
        if let Some(points) = points {
            scene.spheres = points::described(points::read(points)?);
            scene.springs = part::springs(springs).map_err(Failure::from)?;
        }
        let world = scene.world().map_err(Failure::of_part)?;
        let palette = Arc::new(Palette::new(&scene).map_err(Failure::from)?);
        scene.spheres.clear();
        scene.colliders = scene.all_colliders().into_owned();
        scene.generators.clear();
        scene.springs.clear();
        let inner = Inner::new(world, Arc::new(scene), palette);
        let clock = Arc::clone(&inner.clock);
        Ok(Self { inner: Mutex::new(inner), clock })
    }

    /// Advances the world by `frames` frames of `dt` [s], or of the scene's own frame time.
    ///
    /// Both are keyword arguments. Other threads run meanwhile. If a frame is refused, the world
    /// keeps its state before the call.
    ///
    /// Raises:
    ///     CaromError: If `dt` is not positive and finite, an emitter runs away, or a periodic box
    ///         is too small for the spheres.
    ///     StepError: If a number would overflow, or there are too many impacts.
    ///     KeyboardInterrupt: On Ctrl-C, within a tenth of a second; the world then keeps its state
    ///         before the call.
    #[pyo3(
        signature = (*unnamed, dt = None, frames = None),
        text_signature = "($self, *, dt=None, frames=1)"
    )]
    fn step(
        &self,
        py: Python<'_>,
        unnamed: &Bound<'_, PyTuple>,
        dt: Option<&Bound<'_, PyAny>>,
        frames: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<()> {
        arguments::none_unnamed("step", unnamed, "frames=10 or dt=0.01 [s]")?;
        let dt = arguments::optional_number("dt", dt)?;
        let frames = frames.map_or(Ok(1), |frames| arguments::count("frames", frames))?;
        let mut guard = self.lock(py)?;
        let inner = &mut *guard;
        let dt = inner.frame_time(dt);
        let taken = py.detach(|| step(inner, dt, frames));
        if taken.is_ok() {
            inner.arrays.write_motion(py, inner.world.spheres());
        }
        drop(guard);
        Ok(taken?)
    }

    /// Time since the start [s]. A signal handler that runs in the middle of a frame reads the time
    /// when this frame began.
    #[getter]
    fn time(&self, py: Python<'_>) -> PyResult<f64> {
        if stop::is_in_handler() {
            let free = self.inner.try_lock();
            return Ok(free.map_or_else(|_| self.clock.read(), |inner| inner.world.time()));
        }
        Ok(self.lock_as_it_is(py)?.world.time())
    }

    /// Frame time of the scene [s].
    #[getter]
    fn frame_time(&self, py: Python<'_>) -> PyResult<f64> {
        Ok(self.lock_as_it_is(py)?.frame_time(None))
    }

    /// Returns the number of spheres.
    fn __len__(&self, py: Python<'_>) -> PyResult<usize> {
        Ok(self.lock_as_it_is(py)?.world.spheres().len())
    }

    /// State hash in 16 hexadecimal digits, equal for equal states on every platform.
    ///
    /// It covers time, spheres, poses of colliders and emissions, but not settings, forces and
    /// shapes.
    #[getter]
    fn state_hash(&self, py: Python<'_>) -> PyResult<String> {
        Ok(self.lock(py)?.world.state_hash().to_string())
    }

    /// Returns a snapshot of everything that the future depends on.
    fn snapshot(&self, py: Python<'_>) -> PyResult<Snapshot> {
        Ok(self.lock(py)?.snapshot().into())
    }

    /// Takes a snapshot into the memory of an earlier one, which is overwritten: for a game that goes back, and takes
    /// one in each frame.
    fn snapshot_into(&self, py: Python<'_>, snapshot: &Snapshot) -> PyResult<()> {
        let inner = &*self.lock(py)?;
        snapshot.overwrite(|state| inner.snapshot_into(state));
        Ok(())
    }

    /// Restores a snapshot, bit for bit. The report of the last frame is removed.
    fn restore(&self, py: Python<'_>, snapshot: &Snapshot) -> PyResult<()> {
        // Values that a script wrote before are dropped, valid or not.
        let inner = &mut *self.lock_as_it_is(py)?;
        inner.restore(&snapshot.state());
        inner.arrays.write_all(py, inner.world.spheres());
        Ok(())
    }
}

/// Takes frames of `dt` \[s\]; if one of them is refused, the world keeps its state before the
/// first.
fn step(inner: &mut Inner, dt: f64, frames: u64) -> Result<(), Failure> {
    let watch = inner.heed_signals();
    // A single refused frame leaves the world unchanged without a snapshot.
    let before = (frames > 1).then(|| inner.snapshot());
    for _ in 0..frames {
        if let Err(error) = inner.take_frame(dt, &watch) {
            before.iter().for_each(|before| inner.restore(before));
            return Err(error.into());
        }
    }
    Ok(())
}

#[pymethods]
impl Engine {
    /// Removes the applied forces of all spheres.
    #[pyo3(name = "_release")]
    fn release(&self, py: Python<'_>) -> PyResult<()> {
        self.change(py, |inner| Ok(inner.world.set_applied_forces(&[])?))
    }
}

sphere_properties!(Engine, numbers "(n,)", vectors "(n, 3)", rotations "(n, 4)");

#[pymethods]
impl Engine {
    /// Ids, ascending, shape (n,), uint64. A world never reuses an id.
    #[getter]
    fn ids(&self, py: Python<'_>) -> PyResult<Py<PyArray1<u64>>> {
        let inner = &mut *self.lock_as_it_is(py)?;
        inner.arrays.ids(py, inner.world.spheres())
    }
}

impl Engine {
    fn quantity(&self, py: Python<'_>, quantity: Quantity) -> PyResult<Py<PyAny>> {
        let inner = &mut *self.lock_as_it_is(py)?;
        inner.arrays.get(py, quantity, inner.world.spheres())
    }

    fn set_quantity(&self, quantity: Quantity, values: &Bound<'_, PyAny>) -> PyResult<()> {
        let py = values.py();
        // Reading arguments can run any Python code, so the lock is not held.
        let count = self.lock_as_it_is(py)?.world.spheres().len();
        let values = arguments::array(quantity.name(), values, &quantity.shape(count))?;
        self.change(py, |inner| {
            if inner.world.spheres().len() != count {
                let problem = "spheres came or went in another thread meanwhile";
                return Err(Failure::value(quantity.name(), problem));
            }
            setting::set_all(&mut inner.world, quantity, &values)
        })
    }
}

/// Sums over all spheres.
#[pymethods]
impl Engine {
    /// Kinetic energy [J], the sum of m v² / 2 and, for rotating spheres, I ω² / 2.
    #[getter]
    fn kinetic_energy(&self, py: Python<'_>) -> PyResult<f64> {
        Ok(self.lock(py)?.world.kinetic_energy())
    }

    /// Energy of rotation [J], the sum of I ω² / 2.
    #[getter]
    fn rotational_energy(&self, py: Python<'_>) -> PyResult<f64> {
        Ok(self.lock(py)?.world.rotational_energy())
    }

    /// Potential energy [J] in all forces that have one.
    #[getter]
    fn potential_energy(&self, py: Python<'_>) -> PyResult<f64> {
        Ok(self.lock(py)?.world.potential_energy())
    }

    /// Kinetic and potential energy [J].
    #[getter]
    fn total_energy(&self, py: Python<'_>) -> PyResult<f64> {
        Ok(self.lock(py)?.world.total_energy())
    }

    /// Momentum [kg m/s], the sum of m v, shape (3,).
    #[getter]
    fn momentum<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let momentum = self.lock(py)?.world.momentum();
        Ok(PyArray1::from_slice(py, &momentum.to_array()))
    }

    /// Angular momentum about the origin [kg m²/s], the sum of m x × v and, for rotating spheres, I
    /// ω, shape (3,).
    #[getter]
    fn angular_momentum<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let momentum = self.lock(py)?.world.angular_momentum();
        Ok(PyArray1::from_slice(py, &momentum.to_array()))
    }
}

/// Report of the last frame.
#[pymethods]
impl Engine {
    /// Returns the impacts as words.
    #[pyo3(name = "_impact_words")]
    fn impact_words<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<u64>>> {
        self.words(py, |table, it| table.push_impacts(it.frame_start, &it.world.report().impacts))
    }

    /// Returns the ledger as words.
    #[pyo3(name = "_ledger_words")]
    fn ledger_words<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<u64>>> {
        self.words(py, |table, it| table.push_ledger(it.frame_start, it.world.report()))
    }

    /// Returns the spheres inside triggers as words.
    #[pyo3(name = "_trigger_words")]
    fn trigger_words<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<u64>>> {
        self.words(py, |table, it| table.push_triggers(&it.world.report().triggers))
    }

    /// Returns the events of sensors as words.
    #[pyo3(name = "_sensor_event_words")]
    fn sensor_event_words<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<u64>>> {
        self.words(py, |table, it| {
            table.push_sensor_events(it.frame_start, &it.world.report().sensor_events);
        })
    }

    /// Returns the events of wells as words.
    #[pyo3(name = "_well_event_words")]
    fn well_event_words<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<u64>>> {
        self.words(py, |table, it| {
            table.push_well_events(it.frame_start, &it.world.report().well_events);
        })
    }

    /// Returns the overlaps deeper than `tolerance` [m] as words.
    #[pyo3(name = "_overlap_words")]
    fn overlap_words<'py>(
        &self,
        py: Python<'py>,
        tolerance: f64,
    ) -> PyResult<Bound<'py, PyArray1<u64>>> {
        self.words(py, |table, it| {
            table.push_overlaps(&py.detach(|| it.world.overlaps(tolerance)));
        })
    }

    /// Returns the persistent contacts as words.
    #[pyo3(name = "_contact_words")]
    fn contact_words<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<u64>>> {
        self.words(py, |table, it| table.push_contacts(&py.detach(|| it.world.contacts())))
    }

    /// Returns the work by stage: predictions, pair tests, events, cell crossings, groups, solver
    /// iterations, searches, sweeps, contacts.
    #[pyo3(name = "_work")]
    fn work(&self, py: Python<'_>) -> PyResult<[u64; 9]> {
        let work = self.lock(py)?.world.report().work;
        Ok([
            work.predictions,
            work.pair_tests,
            work.events,
            work.cell_crossings,
            work.groups,
            work.solver_iterations,
            work.searches,
            work.sweeps,
            work.contacts,
        ])
    }

    /// Returns the entries of the energy account [J] in the order of `carom.EnergyAccount`.
    #[pyo3(name = "_energy_account")]
    fn energy_account(&self, py: Python<'_>) -> PyResult<Vec<f64>> {
        let account = self.lock(py)?.world.report().energy_account;
        let of_bodies = [account.contacts, account.colliders, account.kicks, account.growth];
        let driven = [account.shear, account.thermostat];
        let others = [account.forces, account.applied, account.correction, account.emission];
        Ok([&of_bodies[..], &driven, &others, &[account.integration]].concat())
    }

    /// Returns the quality of the solutions of the rule `contact`: sub-steps with limited impulses,
    /// residual, largest overlap, sleeping spheres, and how often a sphere was squeezed.
    #[pyo3(name = "_contact_account")]
    fn contact_account(&self, py: Python<'_>) -> PyResult<(u32, f64, f64, u32, u32)> {
        let ContactAccount {
            limited_sub_steps, residual, largest_overlap, asleep, squeezed, ..
        } = self.lock(py)?.world.report().contact_account;
        Ok((limited_sub_steps, residual, largest_overlap, asleep, squeezed))
    }

    /// Returns the account of zones under the rule `exact`: spheres in zones, their total time
    /// there [s], ticks, spheres that joined, and spheres that left.
    #[pyo3(name = "_zone_account")]
    fn zone_account(&self, py: Python<'_>) -> PyResult<(u32, f64, u32, u32, u32)> {
        let ZoneAccount { spheres, sphere_seconds, ticks, joined, left, .. } =
            self.lock(py)?.world.report().zone_account;
        Ok((spheres, sphere_seconds, ticks, joined, left))
    }

    /// Groups in which two bodies met as often as a frame allows, under the rule ``bisect``.
    #[getter]
    fn unfinished_islands(&self, py: Python<'_>) -> PyResult<u32> {
        Ok(self.lock(py)?.world.report().unfinished_islands)
    }

    /// Whether spheres are rotated or rotate, or may start to by friction.
    #[getter]
    fn has_spin(&self, py: Python<'_>) -> PyResult<bool> {
        Ok(self.lock(py)?.world.has_spin())
    }

    /// The longest frame [s] in which motion on springs is certainly stable.
    ///
    /// Infinite without springs, and under the rule ``exact``. The other rules refuse longer frames.
    #[getter]
    fn longest_stable_frame(&self, py: Python<'_>) -> PyResult<f64> {
        Ok(self.lock(py)?.world.longest_stable_frame())
    }

    /// Whether any sphere was ever in a zone.
    #[getter]
    fn was_stepped(&self, py: Python<'_>) -> PyResult<bool> {
        Ok(self.lock(py)?.world.was_stepped())
    }

    /// Ids of the spheres that emitters added in the last frame, ascending.
    #[getter]
    fn emitted<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<u64>>> {
        Ok(arrays::numbers(py, &self.lock(py)?.world.report().emitted))
    }

    /// Ids of the spheres that emitters removed in the last frame.
    #[getter]
    fn retired<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<u64>>> {
        Ok(arrays::numbers(py, &self.lock(py)?.world.report().retired))
    }

    /// Ids of the spheres that emitters left out in the last frame for lack of space; no sphere
    /// ever has them.
    #[getter]
    fn left_out<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<u64>>> {
        Ok(arrays::numbers(py, &self.lock(py)?.world.report().left_out))
    }
}
