//! Recordings on disk: trajectories as CSV, NPZ, VTK, extended XYZ, dumps of LAMMPS or GSD, impacts
//! as CSV or NPZ. Trajectories in CSV can be played back; a scene can begin with a frame of a particle
//! file. If spheres rotate at the first frame, or friction can make them rotate,
//! trajectories also contain orientations and angular velocities.

mod archive;
mod csv_table;
mod each_second;
mod error;
mod failing_once;
mod format;
mod headed_table;
mod impact_arrays;
mod impacts;
mod ledger;
mod npz;
mod npz_journal;
mod particles;
mod playback;
pub mod records;
mod recovered;
mod recovery;
mod replay;
mod rotation;
mod short_lines;
mod slide;
mod table_file;
mod vtk;
mod wells;

use std::io;
use std::path::{Path, PathBuf};

use carom::World;

pub use error::RecordingError;
pub use format::Format;
pub use impacts::ImpactTable;
pub use ledger::LedgerTable;
pub use particles::{
    ParticleError, ParticleFormat, ParticleFrame, ParticleImport, ParticleOptions, ParticleTable,
    import_particles, read_particles, recover_particles,
};
pub use playback::Playback;
pub use recovered::{Recovered, RecoveryError, complete, recover_by};
pub use recovery::{recover, recover_table};
pub use replay::{LineProblem, Replay, ReplayBall, ReplayError, ReplayFrame};
pub use slide::slide;
pub use wells::WellTable;

use error::unwritable;

/// Writes the states of a world, frame by frame.
///
/// ```
/// use carom::{DVec3, Sphere, World};
/// use carom_scene::recording::Trajectory;
///
/// let folder = tempfile::tempdir()?;
/// let path = folder.path().join("fall.csv");
/// let mut world = World::default();
/// world.add_sphere(Sphere::new(DVec3::ZERO, 0.5).with_velocity(DVec3::X))?;
/// let mut trajectory = Trajectory::create(&path)?;
/// trajectory.write(&world)?;
/// world.step(0.5)?;
/// trajectory.write(&world)?;
/// trajectory.finish()?;
/// // A line of headings, and one for each sphere and time.
/// assert_eq!(std::fs::read_to_string(&path)?.lines().count(), 3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Trajectory {
    path: PathBuf,
    format: Box<dyn Format>,
    frames: u64,
}

impl std::fmt::Debug for Trajectory {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Trajectory").field("path", &self.path).finish_non_exhaustive()
    }
}

impl Trajectory {
    /// Creates the file, and missing folders above it. The ending selects the format: `.csv`,
    /// `.npz`, `.pvd` / `.vtp`, `.xyz` / `.extxyz`, `.lammpstrj` / `.dump`, or `.gsd`. A pipe or device
    /// with another ending gets CSV.
    ///
    /// # Errors
    /// [`RecordingError`] for another ending, or if the file cannot be written.
    pub fn create(path: &Path) -> Result<Self, RecordingError> {
        let ending = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
        let particles = ParticleFormat::of(path);
        let format: io::Result<Box<dyn Format>> = match (ending.as_str(), particles) {
            (_, Some(format)) => ParticleTable::new(path, format).map(|it| Box::new(it) as _),
            ("csv", _) => csv_table::CsvTable::create(path).map(|format| Box::new(format) as _),
            ("npz", _) => npz::Npz::create(path).map(|format| Box::new(format) as _),
            ("pvd" | "vtp", _) => vtk::Series::create(path).map(|format| Box::new(format) as _),
            // The system often names pipes and devices, without an ending.
            _ if is_stream(path) => csv_table::CsvTable::create(path).map(|it| Box::new(it) as _),
            _ => return Err(RecordingError::UnknownFormat { path: path.to_owned() }),
        };
        let format = format.map_err(|source| unwritable(path, source))?;
        Ok(Self { path: path.to_owned(), format, frames: 0 })
    }

    /// Writes to the file at `path` in the format of another crate.
    pub fn in_format(path: &Path, format: Box<dyn Format>) -> Self {
        Self { path: path.to_owned(), format, frames: 0 }
    }

    /// Writes CSV to `out`; errors call it `name`.
    pub fn csv(out: impl io::Write + Send + 'static, name: &str) -> Self {
        let format = Box::new(csv_table::CsvTable::new(Box::new(out)));
        Self { path: PathBuf::from(name), format, frames: 0 }
    }

    /// Adds columns of further numbers beside each sphere, before the first frame.
    ///
    /// # Errors
    /// [`RecordingError::NoFurtherColumns`] if the format is not CSV.
    pub fn with_columns(mut self, names: Vec<String>) -> Result<Self, RecordingError> {
        if self.format.add_columns(names) {
            return Ok(self);
        }
        Err(RecordingError::NoFurtherColumns { path: self.path })
    }

    /// Writes the current state of all spheres, by ascending number.
    ///
    /// # Errors
    /// [`RecordingError`] if the disk is full or gone.
    pub fn write(&mut self, world: &World) -> Result<(), RecordingError> {
        self.write_with(world, &[])
    }

    /// Writes the current state of all spheres, by ascending number, each with its row of the numbers for
    /// [added columns](Self::with_columns).
    ///
    /// # Errors
    /// [`RecordingError`] if the disk is full or gone.
    pub fn write_with(
        &mut self,
        world: &World,
        further: &[Vec<f64>],
    ) -> Result<(), RecordingError> {
        let written = self.format.write_with(world, further);
        written.map_err(|source| unwritable(&self.path, source))?;
        self.frames += 1;
        Ok(())
    }

    /// Number of frames written so far.
    pub fn frames(&self) -> u64 {
        self.frames
    }

    /// Completes the file. Before that, tables can be read, and a series except for its last
    /// second; an NPZ archive does not exist yet, but [`recover`] creates it after a crash.
    ///
    /// # Errors
    /// [`RecordingError`] if the disk is full or gone.
    pub fn finish(self) -> Result<(), RecordingError> {
        let Self { path, format, .. } = self;
        format.finish().map_err(|source| unwritable(&path, source))
    }
}

/// Whether the path leads to a pipe, a device or another file without a length.
fn is_stream(path: &Path) -> bool {
    std::fs::metadata(path).is_ok_and(|found| !found.is_file() && !found.is_dir())
}
