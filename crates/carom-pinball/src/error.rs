//! Errors of tables and games, with messages that say how to fix them.

use carom_scene::SceneError;
use thiserror::Error;

/// Why a scene is no pinball table.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum TableError {
    /// The scene has no sphere, or generators or emitters.
    #[error("scene \"{scene}\": a pinball table has its balls as single spheres, one at least")]
    Balls {
        /// Name of the scene.
        scene: String,
    },
    /// A collider that the game needs is missing.
    #[error("scene \"{scene}\": no {kind} is named \"{name}\"")]
    Missing {
        /// Name of the scene.
        scene: String,
        /// Name of the missing collider.
        name: &'static str,
        /// What it has to be.
        kind: &'static str,
    },
    /// A flipper or plunger does not move by keyframes that say how far and how fast it is pressed.
    #[error(
        "scene \"{scene}\": the motion of \"{name}\" has to be keyframes that begin at rest, where the collider stands: at \
         rest, pressed, and back"
    )]
    Stroke {
        /// Name of the scene.
        scene: String,
        /// Name of the collider.
        name: String,
    },
    /// The scene is invalid.
    #[error(transparent)]
    Scene(#[from] SceneError),
}

/// Why a game cannot begin or go on.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum GameError {
    /// The physics refused a change or a frame.
    #[error(transparent)]
    Physics(#[from] carom::Error),
    /// The scene of the table is invalid.
    #[error(transparent)]
    Scene(#[from] SceneError),
}
