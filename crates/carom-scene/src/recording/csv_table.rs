//! Trajectories as CSV: one row per sphere and frame.

use std::fs::File;
use std::io;
use std::path::Path;

use carom::World;

use super::csv_file::{csv_file, digits};
use super::format::Format;

/// Columns: time at the end of the frame \[s\], number of the sphere in order of appearance,
/// position \[m\], velocity \[m/s\].
pub(super) const HEADER: [&str; 8] = ["t", "ball", "x", "y", "z", "vx", "vy", "vz"];

pub(super) struct CsvTable(csv::Writer<File>);

impl CsvTable {
    pub fn create(path: &Path) -> io::Result<Self> {
        Ok(Self(csv_file(path, &HEADER)?))
    }
}

impl Format for CsvTable {
    fn write(&mut self, world: &World) -> io::Result<()> {
        let spheres = world.spheres();
        let time = digits(world.time());
        for (i, id) in spheres.ids().iter().enumerate() {
            self.0.write_field(&time)?;
            self.0.write_field(id.number().to_string())?;
            for value in [spheres.positions()[i], spheres.velocities()[i]] {
                for part in value.to_array() {
                    self.0.write_field(digits(part))?;
                }
            }
            self.0.write_record(None::<&[u8]>)?;
        }
        Ok(())
    }

    fn finish(mut self: Box<Self>) -> io::Result<()> {
        self.0.flush()
    }
}
