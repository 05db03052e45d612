//! Episodes in a maze for the environments of `carom.gym`.

// Python shows these comments as docstrings, with units in plain brackets.
#![allow(rustdoc::broken_intra_doc_links)]

mod given;
mod results;
mod team;

use std::sync::{Mutex, MutexGuard};

use numpy::{PyArray1, PyArray2, PyArrayDyn, PyArrayMethods, PyUntypedArrayMethods};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use pyo3::sync::MutexExt;
use pyo3::types::PyDict;

use crate::arguments;
use crate::failure::Failure;
use crate::threads;
use given::Given;
use results::{Ended, Results};
use team::Team;

/// Episodes of many balls in one maze, used by the environments of `carom.gym`.
#[pyclass(frozen, module = "carom._carom")]
#[derive(Debug)]
pub struct MazeEpisodes(Mutex<Inner>);

#[derive(Debug)]
struct Inner {
    team: Team,
    actions: Vec<[f64; 2]>,
}

/// Number of collectibles that each ball has, and whether it won.
type StateArrays<'py> = (Bound<'py, PyArray1<i64>>, Bound<'py, PyArray1<bool>>);

/// Smallest and largest value of each number of an observation.
type Bounds<'py> = (Bound<'py, PyArray1<f32>>, Bound<'py, PyArray1<f32>>);

/// Observations, rewards, terminated, truncated, states; then the indices, last observations and
/// last states of episodes that ended and were restarted.
type Step<'py> = (
    Bound<'py, PyArray2<f32>>,
    Bound<'py, PyArray1<f64>>,
    Bound<'py, PyArray1<bool>>,
    Bound<'py, PyArray1<bool>>,
    StateArrays<'py>,
    Bound<'py, PyArray1<i64>>,
    Bound<'py, PyArray2<f32>>,
    StateArrays<'py>,
);

#[pymethods]
impl MazeEpisodes {
    /// Makes episodes of `num_envs` balls; `given` holds the arguments of `carom.gym.MazeEnv` by
    /// name.
    #[new]
    fn new(
        num_envs: &Bound<'_, PyAny>,
        threads: Option<&Bound<'_, PyAny>>,
        autoreset_mode: &str,
        start: &str,
        given: Bound<'_, PyDict>,
    ) -> PyResult<Self> {
        let count = arguments::count("num_envs", num_envs)? as usize;
        let threads = threads::wanted(threads)?;
        let manner = (given::autoreset(autoreset_mode)?, given::start(start)?);
        let arena = Given(given).arena()?;
        let team = Team::new(arena, count, threads, manner)?;
        Ok(Self(Mutex::new(Inner { team, actions: Vec::new() })))
    }

    /// Takes a step with the wanted tilts `actions`, shape (n, 2). Other threads run meanwhile.
    fn step<'py>(&self, py: Python<'py>, actions: &Bound<'py, PyAny>) -> PyResult<Step<'py>> {
        let mut guard = self.lock(py)?;
        let Inner { team, actions: wanted } = &mut *guard;
        read_actions(actions, team.len(), wanted)?;
        let length = team.arena().observation_length();
        let results = py.detach(|| team.step(wanted))?;
        arrays(py, results, length)
    }

    /// Starts new episodes of the marked balls, n booleans, and sets the seed of a ball that has
    /// one. Episodes start at the maze's start ("maze") or at random positions ("random").
    fn reset<'py>(
        &self,
        py: Python<'py>,
        marked: Vec<bool>,
        seeds: Vec<Option<u64>>,
        start: Option<&str>,
    ) -> PyResult<Step<'py>> {
        let start = start.map(given::start).transpose()?;
        let team = &mut self.lock(py)?.team;
        for (name, count) in [("reset_mask", marked.len()), ("seed", seeds.len())] {
            if count != team.len() {
                let problem = format_args!("must have {} entries, not {count}", team.len());
                return Err(Failure::value(name, problem).into());
            }
        }
        let results = team.reset(&marked, &seeds, start)?;
        arrays(py, results, team.arena().observation_length())
    }

    /// Smallest and largest value of each number of an observation.
    #[getter]
    fn bounds<'py>(&self, py: Python<'py>) -> PyResult<Bounds<'py>> {
        let guard = self.lock(py)?;
        let [low, high] = guard.team.arena().observation_bounds();
        Ok((PyArray1::from_slice(py, low), PyArray1::from_slice(py, high)))
    }

    /// Returns the scene as a ball sees it in TOML: the maze tilted, without the collectibles
    /// taken.
    fn scene_toml(&self, py: Python<'_>, ball: &Bound<'_, PyAny>) -> PyResult<String> {
        let ball = arguments::count("ball", ball)? as usize;
        let team = &self.lock(py)?.team;
        let Some((episodes, place)) = team.find(ball) else {
            return Err(Failure::unknown("ball", ball).into());
        };
        Ok(episodes.scene(place).to_toml())
    }

    /// Number of frames of single balls that the rule "exact" refused and "discrete" took.
    #[getter]
    fn rough_frames(&self, py: Python<'_>) -> PyResult<u64> {
        Ok(self.lock(py)?.team.rough_frames())
    }

    /// Time of all steps in the engine, without conversions from and to NumPy [s].
    #[getter(_seconds_in_engine)]
    fn seconds_in_engine(&self, py: Python<'_>) -> PyResult<f64> {
        Ok(self.lock(py)?.team.seconds())
    }
}

impl MazeEpisodes {
    fn lock(&self, py: Python<'_>) -> PyResult<MutexGuard<'_, Inner>> {
        let broken = |_| PyRuntimeError::new_err("the engine of these episodes has failed before");
        self.0.lock_py_attached(py).map_err(broken)
    }
}

/// Reads actions for `count` balls.
fn read_actions(
    given: &Bound<'_, PyAny>,
    count: usize,
    actions: &mut Vec<[f64; 2]>,
) -> PyResult<()> {
    actions.clear();
    // The type that agents pass; anything else is converted first.
    if let Ok(array) = given.cast::<PyArrayDyn<f32>>()
        && array.shape() == [count, 2]
        && let Ok(numbers) = array.try_readonly()
        && let Ok(numbers) = numbers.as_slice()
    {
        actions.extend(numbers.as_chunks().0.iter().map(|pair: &[f32; 2]| pair.map(f64::from)));
    } else {
        let numbers = arguments::array("actions", given, &[count, 2])?;
        actions.extend_from_slice(numbers.as_chunks().0);
    }
    match actions.iter().flatten().find(|number| !number.is_finite()) {
        None => Ok(()),
        Some(number) => {
            Err(Failure::value("actions", format_args!("must be finite, not {number}")).into())
        }
    }
}

fn arrays(py: Python<'_>, results: Results, length: usize) -> PyResult<Step<'_>> {
    let rows = |numbers: Vec<f32>| {
        let count = numbers.len() / length;
        PyArray1::from_vec(py, numbers).reshape([count, length])
    };
    let states = |collected, won| (PyArray1::from_vec(py, collected), PyArray1::from_vec(py, won));
    let Ended { balls, observations, collected, won } = results.ended;
    Ok((
        rows(results.observations)?,
        PyArray1::from_vec(py, results.rewards),
        PyArray1::from_vec(py, results.terminated),
        PyArray1::from_vec(py, results.truncated),
        states(results.collected, results.won),
        PyArray1::from_vec(py, balls),
        rows(observations)?,
        states(collected, won),
    ))
}
