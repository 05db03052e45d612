//! What is tested: every reader, and the engine.

mod gltf;
mod links;
mod mazes;
mod options;
mod overrides;
mod particles;
mod recordings;
mod scenes;
mod spreadsheets;
mod submissions;
mod unfinished;
mod unity;
mod worlds;

use crate::target::Target;

/// All targets.
pub const TARGETS: [Target; 13] = [
    scenes::TARGET,
    overrides::TARGET,
    links::TARGET,
    recordings::TARGET,
    particles::TARGET,
    unfinished::TARGET,
    mazes::TARGET,
    unity::TARGET,
    gltf::TARGET,
    submissions::TARGET,
    spreadsheets::TARGET,
    options::TARGET,
    worlds::TARGET,
];
