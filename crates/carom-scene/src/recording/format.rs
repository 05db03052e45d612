//! Formats of trajectories.

use std::io;

use carom::World;

/// One format of trajectories.
pub(super) trait Format: Send {
    /// Writes the spheres as they are now: what a killed process has written can be read.
    fn write(&mut self, world: &World) -> io::Result<()>;

    /// Completes the file.
    fn finish(self: Box<Self>) -> io::Result<()>;
}
