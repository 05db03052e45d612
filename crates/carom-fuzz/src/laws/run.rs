//! Running a world of a scene.

use carom::{StopRequest, World};
use carom_scene::{Checkpoint, Palette, Scene};

use super::keeps::Keeps;
use super::trace::{Frame, Trace};
use crate::fault::Fault;
use crate::stopwatch::Stopwatch;
use crate::target::PATIENCE;

/// Number of frames that a world takes.
pub const FRAMES: usize = 64;

pub fn law(holds: bool, broken: impl FnOnce() -> String) -> Result<(), Fault> {
    if holds { Ok(()) } else { Err(Fault::Law(broken())) }
}

pub fn world(scene: &Scene) -> Result<World, Fault> {
    let mut world = scene.world().map_err(|it| Fault::Law(format!("makes no world: {it}")))?;
    let stopwatch = Stopwatch::start();
    world.set_stop_request(Some(StopRequest::new(move || stopwatch.is_over(PATIENCE))));
    Ok(world)
}

pub fn checkpoint(scene: &Scene, world: &World) -> Result<Vec<u8>, Fault> {
    let palette = Palette::new(scene).map_err(|it| Fault::Law(format!("has no colours: {it}")))?;
    let bytes = Checkpoint::bytes_of(&world.snapshot(), scene, &palette);
    bytes.map_err(|it| Fault::Law(format!("has no bytes: {it}")))
}

/// Steps a world some frames, and checks after each what its rule keeps; adds the frames to the
/// trace.
pub fn run(
    scene: &Scene,
    world: &mut World,
    frames: usize,
    keeps: &mut Keeps,
    trace: &mut Trace,
) -> Result<(), Fault> {
    for _ in 0..frames {
        step(scene, world)?;
        keeps.check(world)?;
        trace.frames.push(Frame::after_step(world));
    }
    Ok(())
}

/// Returns whether spheres of a scene grow until they have no room left, which ends its run.
pub fn jams(scene: &Scene) -> Result<bool, Fault> {
    if scene.spheres.iter().all(|it| it.growth_speed == 0.0) {
        return Ok(false);
    }
    let mut world = world(scene)?;
    let mut ends = (0..FRAMES).map(|_| world.step(scene.simulation.frame_time).err());
    Ok(ends.any(|it| matches!(it, Some(carom::Error::NoRoomToGrow { .. }))))
}

/// Steps a world by a frame of its scene.
pub fn step(scene: &Scene, world: &mut World) -> Result<(), Fault> {
    match world.step(scene.simulation.frame_time) {
        Ok(_) => Ok(()),
        Err(carom::Error::Stopped { .. }) => Err(Fault::Slow(PATIENCE)),
        Err(error) => Err(Fault::Law(format!("stops: {error}"))),
    }
}
