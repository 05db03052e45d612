//! Why a picture or a film cannot be taken.

use carom_maze::GameError;
use carom_render::{FilmError, GpuError, PictureError};
use carom_scene::SceneError;
use carom_scene::recording::ReplayError;
use thiserror::Error;

/// Why a picture or a film cannot be taken.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ShootError {
    /// The scene makes no sense.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A step that cannot be taken.
    #[error(transparent)]
    Physics(#[from] carom::Error),
    /// The recording cannot be played.
    #[error(transparent)]
    Replay(#[from] ReplayError),
    /// The game cannot go on.
    #[error(transparent)]
    Game(#[from] GameError),
    /// Nothing can be drawn.
    #[error(transparent)]
    Graphics(#[from] GpuError),
    /// The picture cannot be written.
    #[error(transparent)]
    Picture(#[from] PictureError),
    /// The film cannot be written.
    #[error(transparent)]
    Film(#[from] FilmError),
}
