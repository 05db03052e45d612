//! Formats of trajectories.

use std::io;

use carom::World;

/// One format of trajectories.
pub trait Format: Send {
    /// Writes the spheres as they are now: what a killed process has written can be read, where the format can be
    /// read before its end.
    ///
    /// # Errors
    /// If the disk is full or gone, or the format has no room for more.
    fn write(&mut self, world: &World) -> io::Result<()>;

    /// Completes the file.
    ///
    /// # Errors
    /// If the disk is full or gone.
    fn finish(self: Box<Self>) -> io::Result<()>;
}
