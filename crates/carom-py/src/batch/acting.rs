//! Actions in worlds of a batch: changes of one collider or one sphere in many worlds at once.

// Python shows these comments as docstrings, with units in plain brackets.
#![allow(rustdoc::broken_intra_doc_links)]

use carom::{ColliderId, DVec3, Pose, SphereId};
use numpy::PyArrayDyn;
use pyo3::prelude::*;

use super::BatchEngine;
use super::colliders::{self, ColliderColumn, ColliderQuantity};
use super::selection::Given;
use super::stroke::Stroke;
use crate::arguments;
use crate::arrays::shaped;
use crate::editing::collider_of;
use crate::failure::Failure;
use crate::next_poses::{GivenPoses, NextPoses};
use crate::part::{self, only};

/// Positions and rotations of a collider in all worlds.
type Poses<'py> = (Bound<'py, PyArrayDyn<f64>>, Bound<'py, PyArrayDyn<f64>>);

#[pymethods]
impl BatchEngine {
    /// Sets quantities of a collider, by columns with a row for each of these worlds, and the motion of the collider
    /// that `motion` describes.
    #[pyo3(name = "_set_collider")]
    fn set_collider(
        &self,
        py: Python<'_>,
        id: &Bound<'_, PyAny>,
        worlds: Given<'_>,
        given: Vec<(String, Bound<'_, PyAny>)>,
        motion: Option<&str>,
    ) -> PyResult<()> {
        let id = ColliderId::from_number(arguments::id("collider", id)?);
        let worlds = self.selected(py, &worlds)?;
        let columns = given.iter().map(|(name, values)| column(name, values, worlds.len()));
        let columns: Vec<ColliderColumn> = columns.collect::<PyResult<_>>()?;
        let part = motion.map(part::read).transpose()?;
        let moving = part.as_ref().map(collider_of).transpose()?.map(|it| it.motion);
        self.change(py, |members| {
            members.set_colliders(&worlds, id, |world, row| {
                colliders::changed(world, id, (moving.as_ref(), &columns), row)
            })?;
            match &part {
                Some(part) => members.describe_motion(&worlds, id, &only(&part.colliders)?.motion),
                None => Ok(()),
            }
        })
    }

    /// Sets the velocities of a collider so that a step of `dt` [s], or of the scene's own frame time, takes it to
    /// poses, with a row for each of these worlds.
    #[pyo3(name = "_set_next_pose")]
    fn set_next_pose(
        &self,
        py: Python<'_>,
        worlds: Given<'_>,
        poses: GivenPoses<'_>,
        dt: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<()> {
        let worlds = self.selected(py, &worlds)?;
        let poses = NextPoses::read(&poses, &[worlds.len()])?;
        let dt = arguments::optional_number("dt", dt)?;
        self.change(py, |members| {
            let dt = dt.unwrap_or_else(|| members.frame_time());
            members.set_colliders(&worlds, poses.id(), |world, row| poses.collider(world, row, dt))
        })
    }

    /// Returns positions [m], shape (n, 3), and rotations (x, y, z, w), shape (n, 4), of a collider in all worlds.
    #[pyo3(name = "_collider_poses")]
    fn collider_poses<'py>(&self, py: Python<'py>, id: &Bound<'py, PyAny>) -> PyResult<Poses<'py>> {
        let id = ColliderId::from_number(arguments::id("collider", id)?);
        let guard = self.lock(py)?;
        let count = guard.members.len();
        let (mut positions, mut rotations) = (Vec::new(), Vec::new());
        for world in guard.members.worlds() {
            let Pose { position, rotation } = world.collider(id).map_err(Failure::from)?.pose;
            positions.extend(position.to_array());
            rotations.extend(rotation.to_array());
        }
        drop(guard);
        Ok((shaped(py, positions, vec![count, 3])?, shaped(py, rotations, vec![count, 4])?))
    }

    /// Changes the motion of one sphere in these worlds, which have a row of three numbers each: `change` is the name
    /// of the change.
    #[pyo3(name = "_move_sphere")]
    fn move_sphere(
        &self,
        py: Python<'_>,
        change: &str,
        id: &Bound<'_, PyAny>,
        rows: &Bound<'_, PyAny>,
        worlds: Given<'_>,
    ) -> PyResult<()> {
        let (stroke, id) = (Stroke::named(change)?, arguments::id("sphere", id)?);
        let worlds = self.selected(py, &worlds)?;
        let rows = arguments::array(stroke.argument(), rows, &[worlds.len(), 3])?;
        let rows: Vec<DVec3> = rows.chunks_exact(3).map(DVec3::from_slice).collect();
        self.change(py, |members| members.strike(&worlds, SphereId::from_number(id), stroke, &rows))
    }
}

/// Reads a column of `count` rows.
fn column(name: &str, values: &Bound<'_, PyAny>, count: usize) -> PyResult<ColliderColumn> {
    let quantity = ColliderQuantity::named(name)?;
    Ok((quantity, arguments::array(name, values, &quantity.shape(count))?))
}
