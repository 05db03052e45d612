//! Errors of pictures and films.

use carom_maze::GameError;
use carom_render::{FilmError, GpuError, PictureError};
use carom_scene::SceneError;
use carom_scene::recording::ReplayError;
use thiserror::Error;

/// Why a picture or a film cannot be made.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ShootError {
    /// The scene is invalid.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A step failed.
    #[error(transparent)]
    Physics(#[from] carom::Error),
    /// The recording cannot be played.
    #[error(transparent)]
    Replay(#[from] ReplayError),
    /// The game cannot continue.
    #[error(transparent)]
    Game(#[from] GameError),
    /// The graphics device failed.
    #[error(transparent)]
    Graphics(#[from] GpuError),
    /// The picture cannot be written.
    #[error(transparent)]
    Picture(#[from] PictureError),
    /// The film cannot be written.
    #[error(transparent)]
    Film(#[from] FilmError),
}
