//! Formats of trajectories.

use std::io;

use carom::World;

/// One format of trajectories.
pub(super) trait Format: Send {
    /// Writes the spheres as they are now.
    fn write(&mut self, world: &World) -> io::Result<()>;

    /// Puts all frames up to now on the disk, readable where the format can be read before its end.
    fn flush(&mut self) -> io::Result<()>;

    /// Completes the file.
    fn finish(self: Box<Self>) -> io::Result<()>;
}
