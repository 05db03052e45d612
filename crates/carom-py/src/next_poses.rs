//! Poses to which a step takes a collider.

use carom::{Collider, ColliderId, DQuat, DVec3, Pose, World};
use pyo3::prelude::*;

use crate::arguments;
use crate::failure::Failure;

/// Poses of a collider at the end of a step, with a row for each world, or of a single world.
#[derive(Debug)]
pub struct NextPoses {
    id: ColliderId,
    /// \[m\]; `None` for the present ones.
    positions: Option<Vec<f64>>,
    /// x, y, z, w; `None` for the present ones.
    rotations: Option<Vec<f64>>,
}

/// Poses from Python: id of the collider, positions and rotations.
pub type GivenPoses<'py> =
    (Bound<'py, PyAny>, Option<Bound<'py, PyAny>>, Option<Bound<'py, PyAny>>);

impl NextPoses {
    /// Reads poses for worlds of this shape: of one axis for a batch, of none for a single world.
    ///
    /// # Errors
    /// As [`arguments::id`] and [`arguments::array`].
    pub fn read((id, positions, rotations): &GivenPoses<'_>, worlds: &[usize]) -> PyResult<Self> {
        let id = ColliderId::from_number(arguments::id("collider", id)?);
        let rows = |name, values: &Option<Bound<'_, PyAny>>, width| {
            values
                .as_ref()
                .map(|it| arguments::array(name, it, &[worlds, &[width]].concat()))
                .transpose()
        };
        let positions = rows("position", positions, 3)?;
        Ok(Self { id, positions, rotations: rows("rotation", rotations, 4)? })
    }

    pub fn id(&self) -> ColliderId {
        self.id
    }

    /// Returns the collider of a world with the velocities that take it in `dt` \[s\] to the pose in a row.
    ///
    /// # Errors
    /// [`Failure`] if there is no such collider, a motion moves it, or a number is invalid.
    pub fn collider(&self, world: &World, row: usize, dt: f64) -> Result<Collider, Failure> {
        let now = match (&self.positions, &self.rotations) {
            (Some(_), Some(_)) => Pose::at(DVec3::ZERO),
            _ => world.collider(self.id)?.pose,
        };
        let position =
            self.positions.as_ref().map_or(now.position, |it| DVec3::from_slice(&it[3 * row..]));
        let rotation =
            self.rotations.as_ref().map_or(now.rotation, |it| DQuat::from_slice(&it[4 * row..]));
        Ok(world.moving_to(self.id, Pose { position, rotation }, dt)?)
    }
}
