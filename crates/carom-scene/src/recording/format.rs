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

    /// Completes the file.
    ///
    /// # Errors
    /// [`io::Error`] if the disk is full or gone.
    fn finish(self: Box<Self>) -> io::Result<()>;
}
