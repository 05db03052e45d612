//! Many worlds that step together, for Python.

// Python shows these comments as docstrings, with units in plain brackets.
#![allow(rustdoc::broken_intra_doc_links)]

mod acting;
mod arrays;
mod colliders;
mod measures;
mod members;
mod observed;
mod selection;
mod stroke;

use std::sync::{Mutex, MutexGuard};

use carom::{StepReport, World};
use numpy::PyArray1;
use pyo3::exceptions::{PyIndexError, PyKeyboardInterrupt, PyRuntimeError};
use pyo3::prelude::*;
use pyo3::sync::MutexExt;

use crate::arguments;
use crate::failure::Failure;
use crate::next_poses::{GivenPoses, NextPoses};
use crate::properties::sphere_properties;
use crate::quantity::Quantity;
use crate::snapshot::Snapshot;
use crate::stop;
use crate::tables::Table;
use crate::threads;
use arrays::BatchArrays;
use members::{Members, Progress};
use observed::{Columns, Out};
use selection::Given;

/// Base class of `carom.Batch`: worlds, and the arrays that Python sees of all of them.
///
/// Several threads may use it; their calls wait for each other.
#[pyclass(frozen, subclass, module = "carom._carom")]
#[derive(Debug)]
pub struct BatchEngine(Mutex<Inner>);

#[derive(Debug)]
struct Inner {
    members: Members,
    arrays: BatchArrays,
}

/// Rows of all worlds as 64-bit words, and the number of rows of each world.
type Words<'py> = (Bound<'py, PyArray1<u64>>, Vec<usize>);

impl BatchEngine {
    /// Waits for other threads, and applies values that a script wrote into the arrays.
    fn lock(&self, py: Python<'_>) -> PyResult<MutexGuard<'_, Inner>> {
        let mut guard = self.lock_as_it_is(py)?;
        let Inner { members, arrays } = &mut *guard;
        let written = arrays.written(py, members);
        if !written.is_empty() {
            let taken = members.take_over(&written);
            arrays.write_all(py, members);
            if let Err(failure) = taken {
                // Making an exception runs Python, which may run a handler that waits for this
                // lock.
                drop(guard);
                return Err(failure.into());
            }
        }
        Ok(guard)
    }

    /// Waits for other threads. In a signal handler during a step of these worlds, returns an error
    /// instead, because waiting would never end.
    fn lock_as_it_is(&self, py: Python<'_>) -> PyResult<MutexGuard<'_, Inner>> {
        if stop::is_in_handler() {
            let at_work = |_| PyRuntimeError::new_err("this batch is in the middle of a step");
            return self.0.try_lock().map_err(at_work);
        }
        let broken = |_| PyRuntimeError::new_err("the engine of this batch has failed before");
        self.0.lock_py_attached(py).map_err(broken)
    }

    /// Changes worlds and updates the arrays.
    fn change<T>(
        &self,
        py: Python<'_>,
        change: impl FnOnce(&mut Members) -> Result<T, Failure>,
    ) -> PyResult<T> {
        let mut guard = self.lock(py)?;
        let Inner { members, arrays } = &mut *guard;
        let result = change(members);
        if result.is_ok() {
            arrays.write_all(py, members);
        }
        drop(guard);
        Ok(result?)
    }

    /// Returns the indices of the given worlds.
    ///
    /// # Errors
    /// `CaromError` for an index without a world.
    fn selected(&self, py: Python<'_>, worlds: &Given<'_>) -> PyResult<Vec<usize>> {
        let count = self.lock_as_it_is(py)?.members.len();
        Ok(selection::selected(worlds, count)?)
    }

    fn quantity(&self, py: Python<'_>, quantity: Quantity) -> PyResult<Py<PyAny>> {
        let Inner { members, arrays } = &mut *self.lock_as_it_is(py)?;
        arrays.get(py, quantity, members)
    }

    fn set_quantity(&self, quantity: Quantity, values: &Bound<'_, PyAny>) -> PyResult<()> {
        let py = values.py();
        // Reading arguments can run any Python code, so the lock is not held.
        let shape = self.lock_as_it_is(py)?.members.shape_of(quantity);
        let values = arguments::array(quantity.name(), values, &shape)?;
        self.change(py, |members| members.set(quantity, &values))
    }
}

impl BatchEngine {
    /// Returns the rows that `push` writes for the last frame of each world. `push` gets the start
    /// time of the frame \[s\] and returns its number of rows.
    fn words<'py>(
        &self,
        py: Python<'py>,
        push: impl Fn(&mut Table, f64, &StepReport) -> usize,
    ) -> PyResult<Words<'py>> {
        let guard = self.lock(py)?;
        let mut table = Table::default();
        let reports = guard.members.reports();
        let counts = reports.map(|(start, report)| push(&mut table, start, report)).collect();
        Ok((PyArray1::from_vec(py, table.into_words()), counts))
    }
}

/// Constructor, steps and snapshots.
#[pymethods]
impl BatchEngine {
    /// Makes worlds in the states of `snapshots`: one for all `count`, or one for each.
    #[new]
    fn new(
        snapshots: Vec<PyRef<'_, Snapshot>>,
        count: usize,
        threads: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let pool = threads::pool(threads::wanted(threads)?, count)?;
        let starts = snapshots.iter().map(|snapshot| snapshot.state().clone()).collect();
        let members = Members::new(starts, count, pool)?;
        Ok(Self(Mutex::new(Inner { members, arrays: BatchArrays::default() })))
    }

    /// Takes frames in these worlds; the first one takes a collider to `poses`. Writes observations of quantities into
    /// an array, and returns the worlds that refused a frame, with their errors. After Ctrl-C each world has taken whole
    /// frames, but not all the same number.
    #[pyo3(name = "_step")]
    fn step(
        &self,
        py: Python<'_>,
        dt: Option<&Bound<'_, PyAny>>,
        frames: &Bound<'_, PyAny>,
        worlds: Given<'_>,
        poses: Option<GivenPoses<'_>>,
        observed: Option<(Vec<String>, Bound<'_, PyAny>)>,
    ) -> PyResult<Vec<(usize, PyErr)>> {
        let dt = arguments::optional_number("dt", dt)?;
        let frames = arguments::count("frames", frames)?;
        let worlds = self.selected(py, &worlds)?;
        let poses = poses.map(|poses| NextPoses::read(&poses, &[worlds.len()])).transpose()?;
        let mut guard = self.lock(py)?;
        let Inner { members, arrays } = &mut *guard;
        let columns =
            observed.as_ref().map(|(names, _)| Columns::named(names, members.most_spheres()));
        let columns = columns.transpose()?;
        let mut out = match (&observed, &columns) {
            (Some((_, out)), Some(columns)) => Some(Out::of(out, members.len(), columns)?),
            _ => None,
        };
        let rows = match (&mut out, &columns) {
            (Some(out), Some(columns)) => Some((out.rows(members.len(), columns), columns)),
            _ => None,
        };
        let mut progress = vec![Progress::default(); members.len()];
        for (row, world) in worlds.into_iter().enumerate() {
            progress[world] = Progress { left: frames, row, refused: None };
        }
        py.detach(|| members.step((dt, poses.as_ref()), &mut progress, rows));
        arrays.write_motion(py, members);
        drop(guard);
        if progress.iter().any(Progress::is_stopped) {
            return Err(stop::raised().unwrap_or_else(|| PyKeyboardInterrupt::new_err(())));
        }
        let refused = progress.into_iter().map(|it| it.refused).enumerate();
        Ok(refused.filter_map(|(world, failure)| Some((world, failure?.into()))).collect())
    }

    /// Resets worlds to their start: those with these indices, or all.
    #[pyo3(name = "_reset")]
    fn reset(&self, py: Python<'_>, worlds: Given<'_>) -> PyResult<()> {
        let worlds = self.selected(py, &worlds)?;
        self.change(py, |members| {
            members.reset(&worlds);
            Ok(())
        })
    }

    /// Returns the state of a world.
    #[pyo3(name = "_snapshot")]
    fn snapshot(&self, py: Python<'_>, world: usize) -> PyResult<Snapshot> {
        let snapshot = self.lock(py)?.members.snapshot(world);
        let snapshot = snapshot.ok_or_else(|| PyIndexError::new_err("world: out of range"))?;
        Ok(snapshot.into())
    }

    /// Sets both the state and the start state of a world.
    #[pyo3(name = "_restore")]
    fn restore(&self, py: Python<'_>, world: usize, snapshot: &Snapshot) -> PyResult<()> {
        self.change(py, |members| members.restore(world, &snapshot.state()))
    }

    /// Returns the start states without repetition, and for each world the index of its start
    /// state.
    #[pyo3(name = "_starts")]
    fn starts(&self, py: Python<'_>) -> PyResult<(Vec<Snapshot>, Vec<usize>)> {
        let (starts, numbers) = self.lock(py)?.members.starts();
        Ok((starts.into_iter().map(Snapshot::from).collect(), numbers))
    }

    /// Sets the state of a world, but keeps its start state.
    #[pyo3(name = "_go_on_from")]
    fn go_on_from(&self, py: Python<'_>, world: usize, snapshot: &Snapshot) -> PyResult<()> {
        self.change(py, |members| members.go_on_from(world, &snapshot.state()))
    }

    /// Returns the number of worlds.
    fn __len__(&self, py: Python<'_>) -> PyResult<usize> {
        Ok(self.lock_as_it_is(py)?.members.len())
    }

    /// Frame time of the first world's scene [s].
    #[getter]
    fn frame_time(&self, py: Python<'_>) -> PyResult<f64> {
        Ok(self.lock_as_it_is(py)?.members.frame_time())
    }

    /// Time of each world since its start [s], shape (n,). A copy.
    #[getter]
    fn times<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let guard = self.lock(py)?;
        Ok(PyArray1::from_iter(py, guard.members.worlds().map(|world| world.time())))
    }

    /// Ids of the spheres of each world, ascending, shape (n, s), int64; -1 where there is no sphere. A copy.
    #[getter]
    fn ids<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        arrays::ids(py, &self.lock(py)?.members)
    }

    /// Number of spheres of each world, shape (n,), int64. A copy.
    #[getter]
    fn counts<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<i64>>> {
        let guard = self.lock(py)?;
        let count = |world: &World| world.spheres().len() as i64;
        Ok(PyArray1::from_iter(py, guard.members.worlds().map(count)))
    }

    /// State hash of each world as a number, shape (n,), uint64, equal to `int(world.state_hash,
    /// 16)` of that world. A copy.
    #[getter]
    fn state_hashes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<u64>>> {
        let guard = self.lock(py)?;
        Ok(PyArray1::from_iter(py, guard.members.worlds().map(|world| world.state_hash().0)))
    }

    /// Returns the impacts of the last frame of all worlds as words, and their number for each
    /// world.
    fn _impact_words<'py>(&self, py: Python<'py>) -> PyResult<Words<'py>> {
        self.words(py, |table, start, report| {
            table.push_impacts(start, &report.impacts);
            report.impacts.len()
        })
    }

    /// Returns the spheres inside triggers as words, and their number for each world.
    fn _trigger_words<'py>(&self, py: Python<'py>) -> PyResult<Words<'py>> {
        self.words(py, |table, _, report| {
            table.push_triggers(&report.triggers);
            report.triggers.len()
        })
    }

    /// Returns the events of sensors in the last frame of all worlds as words, and their number
    /// for each world.
    fn _sensor_event_words<'py>(&self, py: Python<'py>) -> PyResult<Words<'py>> {
        self.words(py, |table, start, report| {
            table.push_sensor_events(start, &report.sensor_events);
            report.sensor_events.len()
        })
    }

    /// Returns the events of wells in the last frame of all worlds as words, and their number for each world.
    fn _well_event_words<'py>(&self, py: Python<'py>) -> PyResult<Words<'py>> {
        self.words(py, |table, start, report| {
            table.push_well_events(start, &report.well_events);
            report.well_events.len()
        })
    }
}

sphere_properties!(BatchEngine, numbers "(n, s)", vectors "(n, s, 3)", rotations "(n, s, 4)");
