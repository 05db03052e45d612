//! How what draws fails.

use carom_maze::{GameError, MazeError, PlanError};
use carom_render::{FilmError, GpuError, PictureError};
use carom_scene::recording::ReplayError;

use crate::failure::Failure;

impl From<GpuError> for Failure {
    fn from(error: GpuError) -> Self {
        let message = error.to_string();
        match error {
            GpuError::Size { .. } => Self::Usage(message),
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
