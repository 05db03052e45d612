//! Writes particle files.

use std::io::{self, BufWriter, Write};
use std::path::Path;

use carom::World;

use super::frame::{FrameBox, ParticleFrame};
use super::gsd::GsdWriter;
use super::{ParticleFormat, dump, rows, xyz};
use crate::recording::error::{RecordingError, unwritable};
use crate::recording::format::Format;
use crate::recording::table_file::TableFile;

/// A particle file that is written frame by frame. Every frame can be read as soon as it is written.
#[derive(Debug)]
pub struct ParticleTable(Target);

#[derive(Debug)]
enum Target {
    Text(TextTable),
    Gsd(GsdWriter),
}

impl ParticleTable {
    /// Creates the file, and missing folders above it.
    ///
    /// # Errors
    /// [`RecordingError::Unwritable`] if the file cannot be written.
    pub fn create(path: &Path, format: ParticleFormat) -> Result<Self, RecordingError> {
        Self::new(path, format).map_err(|source| unwritable(path, source))
    }

    pub(in crate::recording) fn new(path: &Path, format: ParticleFormat) -> io::Result<Self> {
        Ok(Self(match format {
            ParticleFormat::Gsd => Target::Gsd(GsdWriter::create(path)?),
            _ => Target::Text(TextTable::create(path, format)?),
        }))
    }

    /// Appends a frame.
    ///
    /// # Errors
    /// [`io::Error`] if the disk is full or gone.
    pub fn push(&mut self, frame: &ParticleFrame) -> io::Result<()> {
        match &mut self.0 {
            Target::Text(table) => table.push(frame),
            Target::Gsd(writer) => writer.push(frame),
        }
    }
}

impl Format for ParticleTable {
    fn write(&mut self, world: &World) -> io::Result<()> {
        self.push(&ParticleFrame::of(world, world.has_spin()))
    }

    fn finish(self: Box<Self>) -> io::Result<()> {
        Ok(())
    }
}

/// A particle file in text.
#[derive(Debug)]
struct TextTable {
    format: ParticleFormat,
    out: BufWriter<TableFile>,
    frames: u64,
}

impl TextTable {
    fn create(path: &Path, format: ParticleFormat) -> io::Result<Self> {
        Ok(Self { format, out: BufWriter::new(TableFile::create(path)?), frames: 0 })
    }

    fn push(&mut self, frame: &ParticleFrame) -> io::Result<()> {
        let cell = FrameBox::of(frame);
        match self.format {
            ParticleFormat::Dump => dump::write_header(&mut self.out, frame, &cell, self.frames)?,
            _ => xyz::write_header(&mut self.out, frame, &cell)?,
        }
        for (i, id) in frame.ids.iter().enumerate() {
            let number = id + rows::first_number(self.format);
            let position = &frame.positions[i];
            match self.format {
                ParticleFormat::Dump => {
                    write!(self.out, "{number} 1")?;
                    self.numbers(position)?;
                }
                _ => {
                    write!(self.out, "{}", xyz::SPECIES)?;
                    self.numbers(position)?;
                    write!(self.out, " {number}")?;
                }
            }
            self.numbers(of(frame.radii.as_deref(), i))?;
            self.numbers(of(frame.masses.as_deref(), i))?;
            self.numbers(of(frame.velocities.as_deref(), i).as_flattened())?;
            self.numbers(of(frame.angular_velocities.as_deref(), i).as_flattened())?;
            if let Some(orientations) = &frame.orientations {
                let [x, y, z, w] = orientations[i];
                match self.format {
                    ParticleFormat::Dump => self.numbers(&[w, x, y, z])?,
                    _ => self.numbers(&[x, y, z, w])?,
                }
            }
            self.out.write_all(b"\n")?;
        }
        self.frames += 1;
        self.out.flush()
    }

    /// Writes numbers, each after a space, in the fewest digits that give the same bits when read.
    fn numbers(&mut self, values: &[f64]) -> io::Result<()> {
        values.iter().try_for_each(|value| write!(self.out, " {value:?}"))
    }
}

/// The value of a particle, or nothing.
fn of<T>(values: Option<&[T]>, index: usize) -> &[T] {
    values.map_or(&[], |values| &values[index..=index])
}
