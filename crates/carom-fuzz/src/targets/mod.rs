//! What is tested: every reader, and the engine.

mod links;
mod mazes;
mod options;
mod overrides;
mod recordings;
mod scenes;
mod unity;
mod worlds;

use crate::target::Target;

/// All targets.
pub const TARGETS: [Target; 8] = [
    scenes::TARGET,
    overrides::TARGET,
    links::TARGET,
    recordings::TARGET,
    mazes::TARGET,
    unity::TARGET,
    options::TARGET,
    worlds::TARGET,
];
