//! Formats of trajectories.

use std::io;

use carom::World;

/// One format of trajectories.
pub trait Format: Send {
    /// Writes the spheres as they are now.
    ///
    /// # Errors
    /// If the disk is full or gone, or the format has no room for more.
    fn write(&mut self, world: &World) -> io::Result<()>;

    /// Puts all frames up to now on the disk, readable where the format can be read before its end.
    ///
    /// # Errors
    /// If the disk is full or gone.
    fn flush(&mut self) -> io::Result<()>;

    /// Completes the file.
    ///
    /// # Errors
    /// If the disk is full or gone.
    fn finish(self: Box<Self>) -> io::Result<()>;
}
