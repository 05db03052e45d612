//! Scene files: read, written, made into a world, and stepped.

use carom_scene::{Budget, Scene, SceneError, SceneText};

use crate::case::{built_in, check_finite, soon, text};
use crate::fault::{Fault, check_error};
use crate::mutation::mutated;
use crate::target::{Answer, Target};
use proptest::prelude::*;

pub const TARGET: Target = Target {
    name: "scenes",
    about: "scene files with a few things wrong",
    campaign: 200_000,
    cases: || mutated(built_in()).boxed(),
    check,
};

/// Largest scene that a case may ask for: enough for every built-in scene.
const BUDGET: Budget =
    Budget { spheres: 5_000, colliders: 1_000, springs: 5_000, bytes: 1 << 20, opens_files: false };

/// Number of frames that a world takes.
const FRAMES: usize = 5;
const MOST_STEPPED: usize = 200;

fn check(case: &[u8]) -> Result<Answer, Fault> {
    let read = SceneText::new(&text(case), "case.toml").and_then(|it| it.within(BUDGET).scene(&[]));
    match read {
        Ok(scene) => {
            check_accepted(&scene)?;
            Ok(Answer::Accepted)
        }
        Err(error) => {
            check_refusal(&error)?;
            Ok(Answer::Refused)
        }
    }
}

/// Checks that a refusal is a readable error that names a line of the file.
fn check_refusal(error: &SceneError) -> Result<(), Fault> {
    let message = error.to_string();
    check_error(&message)?;
    match error {
        SceneError::Invalid(fault) if fault.line.is_none() => {
            Err(Fault::Error { problem: "without a line", error: message })
        }
        _ => Ok(()),
    }
}

/// Checks that an accepted scene is the same when written and read, makes a world, and can be
/// stepped.
pub fn check_accepted(scene: &Scene) -> Result<(), Fault> {
    let written = scene.to_toml();
    match Scene::from_toml(&written, "written.toml") {
        Ok(read) if read == *scene => {}
        Ok(_) => return Err(Fault::Law("is another scene when it is written and read".to_owned())),
        Err(error) => return Err(Fault::Law(format!("is refused once it is written: {error}"))),
    }
    let mut world = match scene.world() {
        Ok(world) => world,
        Err(error) => return Err(Fault::Law(format!("is accepted, but makes no world: {error}"))),
    };
    if world.spheres().len() > MOST_STEPPED {
        return Ok(());
    }
    world.set_stop_request(Some(soon()));
    for _ in 0..FRAMES {
        match world.step(scene.simulation.frame_time) {
            Ok(_) => check_finite(&world)?,
            Err(error) => return check_error(&error.to_string()),
        }
    }
    Ok(())
}
