//! Reads GSD files.

use std::fs::File;
use std::path::{Path, PathBuf};

use super::chunks::{Chunks, Fault};
use super::hoomd;
use crate::recording::particles::error::{ParticleError, Problem};
use crate::recording::particles::frame::ParticleFrame;

/// A GSD file with the schema of HOOMD-blue.
#[derive(Debug)]
pub(in crate::recording::particles) struct GsdReader {
    path: PathBuf,
    chunks: Chunks,
    frames: u64,
}

impl GsdReader {
    /// Opens a file and reads its index.
    pub fn open(path: &Path) -> Result<Self, ParticleError> {
        let opened = File::open(path).map_err(Fault::Io).and_then(Chunks::open);
        let chunks = opened.map_err(|fault| refused(path, fault))?;
        let frames = chunks.frames();
        Ok(Self { path: path.to_owned(), chunks, frames })
    }

    /// Number of frames.
    pub fn frames(&self) -> u64 {
        self.frames
    }

    /// Reads a frame.
    pub fn frame(&mut self, number: u64) -> Result<ParticleFrame, ParticleError> {
        hoomd::frame(&mut self.chunks, number).map_err(|fault| {
            let in_frame = match fault {
                Fault::Problem(Problem(text)) => format!("frame {number}: {text}").into(),
                fault => fault,
            };
            refused(&self.path, in_frame)
        })
    }
}

fn refused(path: &Path, fault: Fault) -> ParticleError {
    let path = path.to_owned();
    match fault {
        Fault::Io(source) => ParticleError::Unreadable { path, source },
        Fault::Problem(Problem(problem)) => ParticleError::Binary { path, problem },
    }
}
