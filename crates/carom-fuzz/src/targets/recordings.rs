//! Tables of a run that are played again.

use std::fs;
use std::path::Path;

use carom_scene::recording::{Replay, ReplayError, Trajectory};
use carom_scene::{Library, Scene};
use proptest::prelude::*;

use crate::case::text;
use crate::fault::{Fault, check_error};
use crate::mutation::mutated;
use crate::target::{Answer, Target};

pub const TARGET: Target = Target {
    name: "recordings",
    about: "tables of a run with a few things wrong",
    campaign: 5_000,
    cases: || mutated(tables()).boxed(),
    check,
};

/// A scene with an emitter.
fn scene() -> Option<Scene> {
    Library::new().find("simtest3", &[]).ok().map(|(scene, _)| scene)
}

/// Returns tables of the scene's run: a short one, and one with balls that come later.
pub fn tables() -> Vec<Vec<u8>> {
    [2, 40].into_iter().filter_map(table).collect()
}

fn table(frames: usize) -> Option<Vec<u8>> {
    let (scene, folder) = (scene()?, tempfile::tempdir().ok()?);
    let path = folder.path().join("run.csv");
    let mut world = scene.world().ok()?;
    let mut table = Trajectory::create(&path).ok()?;
    for _ in 0..frames {
        world.step(scene.simulation.frame_time).ok()?;
        table.write(&world).ok()?;
    }
    table.finish().ok()?;
    fs::read(&path).ok()
}

fn check(case: &[u8]) -> Result<Answer, Fault> {
    let failed = |it: &dyn std::fmt::Display| Fault::Law(format!("cannot be tried: {it}"));
    let folder = tempfile::tempdir().map_err(|it| failed(&it))?;
    let path = folder.path().join("case.csv");
    fs::write(&path, text(case).as_bytes()).map_err(|it| failed(&it))?;
    let scene = scene().ok_or_else(|| failed(&"no scene"))?;
    match play(&path, &scene)? {
        Ok(()) => Ok(Answer::Accepted),
        Err(error) => {
            check_error(&error.to_string())?;
            Ok(Answer::Refused)
        }
    }
}

/// Plays a table to its end. Times must rise, and places of balls must be finite.
fn play(path: &Path, scene: &Scene) -> Result<Result<(), ReplayError>, Fault> {
    let mut replay = match Replay::open(path, scene) {
        Ok(replay) => replay,
        Err(error) => return Ok(Err(error)),
    };
    let mut last = f64::NEG_INFINITY;
    loop {
        let frame = match replay.next_frame() {
            Ok(Some(frame)) => frame,
            Ok(None) => return Ok(Ok(())),
            Err(error) => return Ok(Err(error)),
        };
        let is_there = frame.balls.iter().all(|it| it.position.is_finite() && it.radius > 0.0);
        if !(frame.time > last && frame.time.is_finite() && is_there) {
            return Err(Fault::Law(format!("plays an invalid frame at {} s", frame.time)));
        }
        last = frame.time;
    }
}
