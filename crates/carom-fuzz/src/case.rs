//! What the targets do with their cases.

use std::borrow::Cow;
use std::time::Duration;

use carom::{StopRequest, World};
use carom_scene::BUILT_IN_FILES;

use crate::fault::Fault;
use crate::stopwatch::Stopwatch;

/// Processor time after which the frames of a case are stopped.
const FRAME_PATIENCE: Duration = Duration::from_secs(1);

/// Returns the texts of the built-in scenes.
pub fn built_in() -> Vec<Vec<u8>> {
    BUILT_IN_FILES.iter().map(|(_, text)| text.as_bytes().to_vec()).collect()
}

/// Returns a request that stops steps once [`FRAME_PATIENCE`] is over.
pub fn soon() -> StopRequest {
    let stopwatch = Stopwatch::start();
    StopRequest::new(move || stopwatch.is_over(FRAME_PATIENCE))
}

/// Checks that the motion of a world consists of numbers.
pub fn check_finite(world: &World) -> Result<(), Fault> {
    let spheres = world.spheres();
    let is_finite = spheres.positions().iter().chain(spheres.velocities()).all(|it| it.is_finite());
    if is_finite { Ok(()) } else { Err(Fault::Law("has motion that is no number".to_owned())) }
}

/// Converts bytes to text for readers that take text; invalid bytes become replacement characters.
pub fn text(case: &[u8]) -> Cow<'_, str> {
    String::from_utf8_lossy(case)
}
