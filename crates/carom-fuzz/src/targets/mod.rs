//! What is tested: every reader, and the engine.

mod gltf;
mod links;
mod mazes;
mod options;
mod overrides;
mod recordings;
mod scenes;
mod submissions;
mod unfinished;
mod unity;
mod worlds;

use crate::target::Target;

/// All targets.
pub const TARGETS: [Target; 11] = [
    scenes::TARGET,
    overrides::TARGET,
    links::TARGET,
    recordings::TARGET,
    unfinished::TARGET,
    mazes::TARGET,
    unity::TARGET,
    gltf::TARGET,
    submissions::TARGET,
    options::TARGET,
    worlds::TARGET,
];
