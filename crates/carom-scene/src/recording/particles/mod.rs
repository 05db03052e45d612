//! Particle files of molecular dynamics: extended XYZ and dumps of LAMMPS. Runs write them; a scene
//! can begin with the last frame of one.

mod columns;
mod dump;
mod error;
mod frame;
mod import;
mod lines;
mod reader;
mod table;
mod xyz;

use std::path::Path;

pub use error::ParticleError;
pub use import::{ParticleImport, ParticleOptions, import_particles};
pub(super) use table::ParticleTable;

pub use reader::recover_particles;

/// A format of particle files.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ParticleFormat {
    /// Extended XYZ: per frame a line with the number of particles, one with names and box, then one
    /// per particle.
    Xyz,
    /// The text format of LAMMPS' command `dump custom`.
    Dump,
}

impl ParticleFormat {
    /// Returns the format that the ending of a file names: `.xyz` and `.extxyz`, or `.lammpstrj` and
    /// `.dump`.
    pub fn of(path: &Path) -> Option<Self> {
        let ending = path.extension()?.to_string_lossy().to_lowercase();
        match ending.as_str() {
            "xyz" | "extxyz" => Some(Self::Xyz),
            "lammpstrj" | "dump" => Some(Self::Dump),
            _ => None,
        }
    }
}
