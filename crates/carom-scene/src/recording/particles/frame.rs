//! One frame of a particle file.

use carom::{Boundary, DVec3, World};

use super::columns::Columns;
use super::error::Problem;

/// The box of a frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct FrameBox {
    /// Lowest corner \[m\].
    pub low: DVec3,
    /// Highest corner \[m\].
    pub high: DVec3,
    /// Whether space repeats itself along each axis.
    pub is_periodic: [bool; 3],
}

impl FrameBox {
    /// Returns the box of a world: the periodic box, and along open axes what all spheres fill.
    pub fn of(world: &World) -> Self {
        let spheres = world.spheres();
        let radii = spheres.radii().iter().map(|&radius| DVec3::splat(radius));
        let reaches = || spheres.positions().iter().zip(radii.clone());
        let low = reaches().map(|(center, radius)| center - radius).reduce(DVec3::min);
        let high = reaches().map(|(center, radius)| center + radius).reduce(DVec3::max);
        let size = match world.settings().boundary {
            Boundary::Periodic { size } => size,
            _ => DVec3::INFINITY,
        };
        let is_finite = size.is_finite_mask();
        let is_periodic = [0, 1, 2].map(|axis| size[axis].is_finite());
        let low = DVec3::select(is_finite, -0.5 * size, low.unwrap_or_default());
        let high = DVec3::select(is_finite, 0.5 * size, high.unwrap_or_default());
        Self { low, high, is_periodic }
    }

    /// Returns whether any axis is periodic.
    pub fn repeats(&self) -> bool {
        self.is_periodic.contains(&true)
    }

    /// Returns the edges \[m\], infinite along open axes.
    pub fn period(&self) -> DVec3 {
        let size = (self.high - self.low).to_array();
        let periods =
            [0, 1, 2].map(|axis| if self.is_periodic[axis] { size[axis] } else { f64::INFINITY });
        DVec3::from_array(periods)
    }

    /// Returns the vector from the middle of the box to the origin \[m\], 0 along open axes.
    pub fn shift_to_origin(&self) -> DVec3 {
        let middle = (0.5 * (self.low + self.high)).to_array();
        DVec3::from_array(
            [0, 1, 2].map(|axis| if self.is_periodic[axis] { -middle[axis] } else { 0.0 }),
        )
    }

    /// Checks that the corners are finite and the periodic edges positive.
    pub fn check(&self) -> Result<(), Problem> {
        if !(self.low.is_finite() && self.high.is_finite()) {
            return Err("the corners of the box must be finite".into());
        }
        if (0..3).any(|axis| self.is_periodic[axis] && self.high[axis] <= self.low[axis]) {
            return Err("a periodic edge of the box must be longer than 0".into());
        }
        Ok(())
    }
}

/// What the lines before the particles say.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Header {
    /// Number of particles.
    pub count: u64,
    /// Time \[s\], if the file has it.
    pub time: Option<f64>,
    /// The box, if the file has one.
    pub cell: Option<FrameBox>,
    /// What the columns of particles hold.
    pub columns: Columns,
}

/// A frame whose lines of particles are not yet read.
#[derive(Debug)]
pub(super) struct RawFrame {
    pub header: Header,
    /// Lines of the particles, as they stand in the file.
    pub rows: Vec<String>,
    /// Number of the first of them in the file.
    pub first_row: u64,
    /// Position in the file after the last of them \[bytes\].
    pub end: u64,
    /// Whether the last of them ends with a line end.
    pub has_end: bool,
}
