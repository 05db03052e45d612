//! What the native engine makes of the built-in scenes: the bits that every other build must have.

use carom_scene::{Library, Scene};

use crate::shell::Outcome;

/// How long each scene runs \[s\].
const DURATION: f64 = 10.0;

/// The state hash of every built-in scene after 10 s, by name, as a JSON object.
pub fn json() -> Outcome<String> {
    let mut rows = Vec::new();
    for entry in Library::new().entries().map_err(|error| error.to_string())? {
        let scene = entry.scene.map_err(|error| error.to_string())?;
        rows.push(format!("  \"{}\": \"{}\"", scene.name, hash(&scene)?));
    }
    Ok(format!("{{\n{}\n}}\n", rows.join(",\n")))
}

/// The state hash of a scene after that time, in whole frames as `carom run --seconds` takes them.
fn hash(scene: &Scene) -> Outcome<String> {
    let mut world = scene.world().map_err(|error| error.to_string())?;
    let frame_time = scene.simulation.frame_time;
    // A billionth of a frame is rounding.
    let frames = (DURATION / frame_time - 1e-9).ceil() as u64;
    for _ in 0..frames {
        world.step(frame_time).map_err(|error| error.to_string())?;
    }
    Ok(world.state_hash().to_string())
}
