//! Trajectories as NPZ, for NumPy: one array per quantity, one row per sphere and frame.
//!
//! Arrays: `t` and `ball` (rows), `position` and `velocity` (rows, 3), and `frame_start`
//! (frames + 1): the rows of frame k are `frame_start[k] .. frame_start[k + 1]`. Where spheres turn,
//! `orientation` (rows, 4; x, y, z, w) and `angular_velocity` (rows, 3), too. Then `time` (frames), and of each
//! sphere of any frame `id`, `radius` and `mass`, as they were last.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{self, BufReader, BufWriter, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use carom::World;
use npyz::WriterBuilder;
use zip::write::SimpleFileOptions;

use super::failing_once::FailingOnce;
use super::format::Format;
use super::rotation::{angular_velocity, orientation};

/// An NPZ file holds one array after the other, frames come one after the other: columns wait in
/// temporary files (beside the result, where there is room for it) until all frames are known.
pub(super) struct Npz {
    file: File,
    time: Column,
    ball: Column,
    position: Column,
    velocity: Column,
    /// Where spheres turn.
    rotation: Option<Rotation>,
    /// For temporary files.
    folder: PathBuf,
    frame_start: Vec<u64>,
    /// \[s\]
    times: Vec<f64>,
    /// Radius \[m\] and mass \[kg\] of spheres by their numbers.
    known: BTreeMap<u64, [f64; 2]>,
}

struct Rotation {
    orientation: Column,
    angular_velocity: Column,
}

struct Column {
    name: &'static str,
    width: u64,
    file: BufWriter<File>,
}

impl Column {
    fn create(name: &'static str, width: u64, folder: &Path) -> io::Result<Self> {
        Ok(Self { name, width, file: BufWriter::new(tempfile::tempfile_in(folder)?) })
    }

    fn push(&mut self, word: u64) -> io::Result<()> {
        self.file.write_all(&word.to_le_bytes())
    }

    fn push_all(&mut self, values: &[f64]) -> io::Result<()> {
        values.iter().try_for_each(|value| self.push(value.to_bits()))
    }
}

impl Npz {
    pub fn create(path: &Path) -> io::Result<Self> {
        let file = File::create(path)?;
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
        let folder = folder.unwrap_or(Path::new("."));
        Ok(Self {
            file,
            time: Column::create("t", 1, folder)?,
            ball: Column::create("ball", 1, folder)?,
            position: Column::create("position", 3, folder)?,
            velocity: Column::create("velocity", 3, folder)?,
            rotation: None,
            folder: folder.to_owned(),
            frame_start: vec![0],
            times: Vec::new(),
            known: BTreeMap::new(),
        })
    }

    fn rows(&self) -> u64 {
        self.frame_start.last().copied().unwrap_or(0)
    }
}

impl Format for Npz {
    fn write(&mut self, world: &World) -> io::Result<()> {
        let spheres = world.spheres();
        if self.frame_start.len() == 1 && world.has_spin() {
            let orientation = Column::create("orientation", 4, &self.folder)?;
            let angular_velocity = Column::create("angular_velocity", 3, &self.folder)?;
            self.rotation = Some(Rotation { orientation, angular_velocity });
        }
        self.times.push(world.time());
        for (i, id) in spheres.ids().iter().enumerate() {
            self.known.insert(id.number(), [spheres.radii()[i], spheres.masses()[i]]);
            self.time.push(world.time().to_bits())?;
            self.ball.push(id.number())?;
            self.position.push_all(&spheres.positions()[i].to_array())?;
            self.velocity.push_all(&spheres.velocities()[i].to_array())?;
            if let Some(rotation) = &mut self.rotation {
                rotation.orientation.push_all(&orientation(world, i))?;
                rotation.angular_velocity.push_all(&angular_velocity(world, i))?;
            }
        }
        self.frame_start.push(self.rows() + spheres.len() as u64);
        Ok(())
    }

    fn flush(&mut self) -> io::Result<()> {
        // Its columns lie in files without names until the end.
        Ok(())
    }

    fn finish(self: Box<Self>) -> io::Result<()> {
        let rows = self.rows();
        let Self {
            file, time, ball, position, velocity, rotation, frame_start, times, known, ..
        } = *self;

        let mut zip = zip::ZipWriter::new(FailingOnce::new(BufWriter::new(file)));
        for column in [time, position, velocity] {
            append(&mut zip, column, rows, f64::from_le_bytes)?;
        }
        if let Some(Rotation { orientation, angular_velocity }) = rotation {
            append(&mut zip, orientation, rows, f64::from_le_bytes)?;
            append(&mut zip, angular_velocity, rows, f64::from_le_bytes)?;
        }
        append(&mut zip, ball, rows, |bytes| u64::from_le_bytes(bytes) as i64)?;
        append_all(&mut zip, "frame_start", frame_start.into_iter().map(|row| row as i64))?;
        append_all(&mut zip, "time", times.into_iter())?;
        append_all(&mut zip, "id", known.keys().map(|&id| id as i64))?;
        append_all(&mut zip, "radius", known.values().map(|[radius, _]| *radius))?;
        append_all(&mut zip, "mass", known.values().map(|[_, mass]| *mass))?;
        zip.finish()?.flush()
    }
}

fn start<W: Write + Seek>(zip: &mut zip::ZipWriter<W>, name: &str) -> io::Result<()> {
    let options = SimpleFileOptions::default().large_file(true);
    Ok(zip.start_file(npyz::npz::file_name_from_array_name(name), options)?)
}

/// Appends these values to the archive.
fn append_all<T: npyz::AutoSerialize, W: Write + Seek>(
    zip: &mut zip::ZipWriter<W>,
    name: &str,
    values: impl ExactSizeIterator<Item = T>,
) -> io::Result<()> {
    start(zip, name)?;
    let shape = [values.len() as u64];
    let mut array =
        npyz::WriteOptions::new().default_dtype().shape(&shape).writer(zip).begin_nd()?;
    array.extend(values)?;
    array.finish()
}

/// Appends a column to the archive, its words read as `T`.
fn append<T: npyz::AutoSerialize, W: Write + Seek>(
    zip: &mut zip::ZipWriter<W>,
    column: Column,
    rows: u64,
    value: impl Fn([u8; 8]) -> T,
) -> io::Result<()> {
    let Column { name, width, file } = column;
    start(zip, name)?;
    let shape = [rows, width];
    let shape = if width == 1 { &shape[..1] } else { &shape[..] };
    let mut array =
        npyz::WriteOptions::new().default_dtype().shape(shape).writer(zip).begin_nd()?;
    let mut file = file.into_inner().map_err(io::IntoInnerError::into_error)?;
    file.seek(SeekFrom::Start(0))?;
    let mut file = BufReader::new(file);
    let mut word = [0; 8];
    for _ in 0..rows * width {
        file.read_exact(&mut word)?;
        array.push(&value(word))?;
    }
    array.finish()
}
