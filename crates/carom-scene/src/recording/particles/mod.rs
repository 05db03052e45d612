//! Particle files of molecular dynamics: extended XYZ, dumps of LAMMPS, and GSD. Runs write them; a
//! scene can begin with a frame of one.

mod columns;
mod dump;
mod error;
mod frame;
mod gsd;
mod import;
mod lines;
mod reader;
mod rows;
mod table;
mod xyz;

use std::path::Path;

pub use error::ParticleError;
pub use frame::ParticleFrame;
pub use import::{ParticleImport, ParticleOptions, import_particles};
pub use reader::{read_particles, recover_particles};
pub use table::ParticleTable;

/// A format of particle files.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ParticleFormat {
    /// Extended XYZ: per frame a line with the number of particles, one with names and box, then one
    /// per particle.
    Xyz,
    /// The text format of LAMMPS' command `dump custom`.
    Dump,
    /// GSD with the schema of HOOMD-blue.
    Gsd,
}

impl ParticleFormat {
    /// Returns the format that the ending of a file names: `.xyz` and `.extxyz`, `.lammpstrj` and
    /// `.dump`, or `.gsd`.
    pub fn of(path: &Path) -> Option<Self> {
        let ending = path.extension()?.to_string_lossy().to_lowercase();
        match ending.as_str() {
            "xyz" | "extxyz" => Some(Self::Xyz),
            "lammpstrj" | "dump" => Some(Self::Dump),
            "gsd" => Some(Self::Gsd),
            _ => None,
        }
    }
}
