//! Writes particle files.

use std::io::{self, BufWriter, Write};
use std::path::Path;

use carom::World;

use super::frame::FrameBox;
use super::{ParticleFormat, dump, xyz};
use crate::recording::format::Format;
use crate::recording::rotation;
use crate::recording::table_file::{TableFile, digits};

/// A particle file that a run writes, frame by frame.
pub(in crate::recording) struct ParticleTable {
    format: ParticleFormat,
    out: BufWriter<TableFile>,
    frames: u64,
}

impl ParticleTable {
    pub fn create(path: &Path, format: ParticleFormat) -> io::Result<Self> {
        Ok(Self { format, out: BufWriter::new(TableFile::create(path)?), frames: 0 })
    }
}

impl Format for ParticleTable {
    fn write(&mut self, world: &World) -> io::Result<()> {
        let cell = FrameBox::of(world);
        match self.format {
            ParticleFormat::Xyz => xyz::write_header(&mut self.out, world, &cell)?,
            ParticleFormat::Dump => dump::write_header(&mut self.out, world, &cell, self.frames)?,
        }
        let (spheres, has_rotation) = (world.spheres(), world.has_spin());
        for (i, id) in spheres.ids().iter().enumerate() {
            let names = match self.format {
                ParticleFormat::Xyz => format!("{} {}", xyz::SPECIES, id.number()),
                // Numbers of atoms begin with 1.
                ParticleFormat::Dump => format!("{} 1", id.number() + 1),
            };
            self.out.write_all(names.as_bytes())?;
            let center = spheres.positions()[i].to_array();
            write_numbers(&mut self.out, &center)?;
            write_numbers(&mut self.out, &[spheres.radii()[i], spheres.masses()[i]])?;
            write_numbers(&mut self.out, &spheres.velocities()[i].to_array())?;
            if has_rotation {
                let [x, y, z, w] = rotation::orientation(world, i);
                let quaternion = match self.format {
                    ParticleFormat::Xyz => [x, y, z, w],
                    ParticleFormat::Dump => [w, x, y, z],
                };
                write_numbers(&mut self.out, &rotation::angular_velocity(world, i))?;
                write_numbers(&mut self.out, &quaternion)?;
            }
            self.out.write_all(b"\n")?;
        }
        self.frames += 1;
        self.out.flush()
    }

    fn finish(mut self: Box<Self>) -> io::Result<()> {
        self.out.flush()
    }
}

/// Writes numbers, each after a space.
pub(super) fn write_numbers(out: &mut impl Write, values: &[f64]) -> io::Result<()> {
    values.iter().try_for_each(|&value| write!(out, " {}", digits(value)))
}
