//! Formats of trajectories.

use std::io;

use carom::World;

/// Writer of one file format for trajectories.
pub trait Format: Send {
    /// Writes the current state of all spheres. If the format can be read before its end, the frame
    /// can be read even when the process is killed afterwards.
    ///
    /// # Errors
    /// [`io::Error`] if the disk is full or gone, or if the format has no room for more.
    fn write(&mut self, world: &World) -> io::Result<()>;

    /// Adds columns of further numbers beside each sphere, before the first frame. Returns whether the format
    /// has such columns; [`Self::write_with`] fills them.
    fn add_columns(&mut self, _names: Vec<String>) -> bool {
        false
    }

    /// Writes the current state of all spheres, and a row of further numbers for each.
    ///
    /// # Errors
    /// Those of [`Self::write`].
    fn write_with(&mut self, world: &World, _further: &[Vec<f64>]) -> io::Result<()> {
        self.write(world)
    }

    /// Completes the file.
    ///
    /// # Errors
    /// [`io::Error`] if the disk is full or gone.
    fn finish(self: Box<Self>) -> io::Result<()>;
}
