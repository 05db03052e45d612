//! Converts errors of drawing.

use carom_maze::{GameError, MazeError, PlanError};
use carom_render::{FilmError, GpuError, PictureError};
use carom_scene::recording::ReplayError;

use super::error::ShootError;
use crate::failure::Failure;

impl From<ShootError> for Failure {
    fn from(error: ShootError) -> Self {
        match error {
            ShootError::Scene(error) => error.into(),
            ShootError::Physics(error) => error.into(),
            ShootError::Replay(error) => error.into(),
            ShootError::Game(error) => error.into(),
            ShootError::Graphics(error) => error.into(),
            ShootError::Picture(error) => error.into(),
            ShootError::Film(error) => error.into(),
        }
    }
}

impl From<GpuError> for Failure {
    fn from(error: GpuError) -> Self {
        let message = error.to_string();
        match error {
            GpuError::Size { .. } | GpuError::Memory { .. } => Self::Usage(message),
            _ => Self::Fault(message),
        }
    }
}

impl From<PictureError> for Failure {
    fn from(error: PictureError) -> Self {
        Self::Fault(error.to_string())
    }
}

impl From<FilmError> for Failure {
    fn from(error: FilmError) -> Self {
        let message = error.to_string();
        match error {
            FilmError::Size { .. } | FilmError::Rate { .. } => Self::Usage(message),
            _ => Self::Fault(message),
        }
    }
}

impl From<ReplayError> for Failure {
    fn from(error: ReplayError) -> Self {
        match error {
            ReplayError::Scene(error) => error.into(),
            error => Self::Fault(error.to_string()),
        }
    }
}

impl From<MazeError> for Failure {
    fn from(error: MazeError) -> Self {
        match error {
            MazeError::Scene(error) => error.into(),
            MazeError::Size { .. } => Self::Usage(error.to_string()),
            error => Self::Fault(error.to_string()),
        }
    }
}

impl From<GameError> for Failure {
    fn from(error: GameError) -> Self {
        Self::Fault(error.to_string())
    }
}

impl From<PlanError> for Failure {
    fn from(error: PlanError) -> Self {
        Self::Fault(error.to_string())
    }
}
