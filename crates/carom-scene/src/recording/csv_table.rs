//! Trajectories as CSV: one row per sphere and frame.

use std::io::{self, Write};
use std::path::Path;

use carom::World;

use super::format::Format;
use super::rotation;
use super::table_file::{TableFile, digits};

/// Columns: time at the end of the frame \[s\], number of the sphere in order of appearance,
/// position \[m\], velocity \[m/s\].
pub(super) const HEADER: [&str; 8] = ["t", "ball", "x", "y", "z", "vx", "vy", "vz"];

/// Additional columns if spheres can rotate: orientation as a quaternion.
pub(super) const ORIENTATION: [&str; 4] = ["qx", "qy", "qz", "qw"];

/// Columns after the orientation: angular velocity \[rad/s\].
pub(super) const ANGULAR_VELOCITY: [&str; 3] = ["wx", "wy", "wz"];

pub(super) struct CsvTable {
    writer: csv::Writer<TableFile>,
    /// Names of the columns of further numbers.
    further: Vec<String>,
    /// Whether the table has the columns of rotation; `None` before the first frame.
    has_rotation: Option<bool>,
}

impl CsvTable {
    pub fn create(path: &Path) -> io::Result<Self> {
        Ok(Self::of(TableFile::create(path)?))
    }

    pub fn new(out: Box<dyn Write + Send>) -> Self {
        Self::of(TableFile::new(out))
    }

    fn of(file: TableFile) -> Self {
        Self { writer: csv::Writer::from_writer(file), further: Vec::new(), has_rotation: None }
    }

    /// Writes the header if it is not yet written. Returns whether the table has the columns of
    /// rotation.
    fn begin(&mut self, has_rotation: impl FnOnce() -> bool) -> io::Result<bool> {
        if let Some(has_rotation) = self.has_rotation {
            return Ok(has_rotation);
        }
        let has_rotation = *self.has_rotation.insert(has_rotation());
        let rotation = ORIENTATION.iter().chain(&ANGULAR_VELOCITY);
        let more = rotation.filter(|_| has_rotation);
        let further = self.further.iter().map(String::as_str);
        self.writer.write_record(HEADER.iter().chain(more).copied().chain(further))?;
        Ok(has_rotation)
    }

    fn write_numbers(&mut self, values: &[f64]) -> io::Result<()> {
        values.iter().try_for_each(|&value| Ok(self.writer.write_field(digits(value))?))
    }
}

impl Format for CsvTable {
    fn write(&mut self, world: &World) -> io::Result<()> {
        self.write_with(world, &[])
    }

    fn add_columns(&mut self, names: Vec<String>) -> bool {
        self.further = names;
        true
    }

    fn write_with(&mut self, world: &World, further: &[Vec<f64>]) -> io::Result<()> {
        let has_rotation = self.begin(|| world.has_spin())?;
        let spheres = world.spheres();
        let time = digits(world.time());
        for (i, id) in spheres.ids().iter().enumerate() {
            self.writer.write_field(&time)?;
            self.writer.write_field(id.number().to_string())?;
            self.write_numbers(&spheres.positions()[i].to_array())?;
            self.write_numbers(&spheres.velocities()[i].to_array())?;
            if has_rotation {
                self.write_numbers(&rotation::orientation(world, i))?;
                self.write_numbers(&rotation::angular_velocity(world, i))?;
            }
            if let Some(numbers) = further.get(i) {
                self.write_numbers(numbers)?;
            }
            self.writer.write_record(None::<&[u8]>)?;
        }
        self.writer.flush()
    }

    fn finish(mut self: Box<Self>) -> io::Result<()> {
        // Without a frame the header is still missing.
        self.begin(|| false)?;
        self.writer.flush()
    }
}
