//! Trajectories as NPZ, for NumPy: one array per quantity, one row per sphere and frame.
//!
//! Arrays: `t` and `ball` (rows), `position` and `velocity` (rows, 3), and `frame_start` (frames +
//! 1): the rows of frame k are `frame_start[k] .. frame_start[k + 1]`. If spheres can rotate, also
//! `orientation` (rows, 4; x, y, z, w) and `angular_velocity` (rows, 3). Then `time` (frames), and
//! `id`, `radius` and `mass` with the last values of every sphere of any frame, and `box` (3) with
//! the sides of the periodic box, if there is one, infinite along open axes, and under shear how far the box above slid
//! in each frame.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{self, Seek, Write};
use std::path::Path;

use carom::World;

use super::archive::{self, Zip, append_all, begin};
use super::format::Format;
use super::npz_journal::{Column, Extent, Head, Journal, JournalWriter};
use super::records;
use super::recovered::{Recovered, complete};
use crate::unfinished::Unfinished;

/// An NPZ file stores array after array, but frames arrive one by one. They go to a journal beside
/// the file, from which the file is created at the end.
pub(super) struct Npz {
    unfinished: Unfinished,
    journal: JournalWriter,
    /// Number of frames in the journal.
    frames: u64,
}

impl Npz {
    pub fn create(path: &Path) -> io::Result<Self> {
        let (unfinished, journal) = Unfinished::begin(path, JournalWriter::begin)?;
        Ok(Self { unfinished, journal, frames: 0 })
    }
}

impl Format for Npz {
    fn write(&mut self, world: &World) -> io::Result<()> {
        self.journal.write(world, self.unfinished.file())?;
        self.frames += 1;
        Ok(())
    }

    fn finish(self: Box<Self>) -> io::Result<()> {
        let Self { unfinished, frames, .. } = *self;
        complete(unfinished, frames, close)
    }
}

/// Writes the archive of the complete frames of a journal. Returns `None` if `source` is no
/// journal.
pub(super) fn close(source: &mut File, target: File) -> io::Result<Option<Recovered>> {
    let Some(mut journal) = Journal::open(source)? else { return Ok(None) };
    archive(&mut journal, target)?;
    let Extent { whole, last, .. } = journal.extent;
    let records::Extent { records: frames, rest: left_out, is_damaged, .. } = whole;
    Ok(Some(Recovered { frames, last, left_out, is_damaged }))
}

fn archive(journal: &mut Journal, file: impl Write + Seek) -> io::Result<()> {
    archive::archive(file, |zip| add_arrays(journal, zip))
}

fn add_arrays<W: Write + Seek>(journal: &mut Journal, zip: &mut Zip<W>) -> io::Result<()> {
    let rows = journal.extent.rows;
    let real = f64::from_le_bytes;
    per_frame(zip, journal, "t", rows, |head| (head.time, head.count))?;
    column(zip, journal, "position", Column::Position, real)?;
    column(zip, journal, "velocity", Column::Velocity, real)?;
    if journal.extent.has_rotation {
        column(zip, journal, "orientation", Column::Orientation, real)?;
        column(zip, journal, "angular_velocity", Column::AngularVelocity, real)?;
    }
    column(zip, journal, "ball", Column::Ball, i64::from_le_bytes)?;
    frame_starts(zip, journal)?;
    let frames = journal.extent.whole.records;
    per_frame(zip, journal, "time", frames, |head| (head.time, 1))?;
    let known = bodies(journal)?;
    append_all(zip, "id", known.keys().map(|&id| id as i64))?;
    append_all(zip, "radius", known.values().map(|[radius, _]| *radius))?;
    append_all(zip, "mass", known.values().map(|[_, mass]| *mass))?;
    if let Some(sides) = sides(journal)? {
        append_all(zip, "box", sides.into_iter())?;
    }
    if journal.extent.is_sheared { slides(zip, journal) } else { Ok(()) }
}

/// Last radius \[m\] and mass \[kg\] of each sphere, by number.
fn bodies(journal: &mut Journal) -> io::Result<BTreeMap<u64, [f64; 2]>> {
    let mut known = BTreeMap::new();
    let mut ids = Vec::new();
    journal.frames(|head, columns| {
        if !head.has_bodies() {
            return Ok(());
        }
        ids.clear();
        columns.words(Column::Ball, |word| {
            ids.push(u64::from_le_bytes(word));
            Ok(())
        })?;
        for (place, column) in [Column::Radius, Column::Mass].into_iter().enumerate() {
            let mut next = ids.iter();
            columns.words(column, |word| {
                let body = next.next().map(|id| known.entry(*id).or_insert([0.0; 2]));
                body.into_iter().for_each(|body| body[place] = f64::from_le_bytes(word));
                Ok(())
            })?;
        }
        Ok(())
    })?;
    Ok(known)
}

/// Last sides of the periodic box \[m\].
fn sides(journal: &mut Journal) -> io::Result<Option<[f64; 3]>> {
    let mut words = Vec::new();
    journal.frames(|_, columns| {
        columns.words(Column::Box, |word| {
            words.push(f64::from_le_bytes(word));
            Ok(())
        })
    })?;
    Ok(words.last_chunk().copied())
}

/// Writes how far the box above has slid \[m\] in each frame: 0 without shear.
fn slides<W: Write + Seek>(zip: &mut Zip<W>, journal: &mut Journal) -> io::Result<()> {
    let mut array = begin(zip, "slide", &[journal.extent.whole.records])?;
    journal.frames(|_, columns| {
        let mut slide = 0.0;
        columns.words(Column::Slide, |word| {
            slide = f64::from_le_bytes(word);
            Ok(())
        })?;
        array.push(&slide)
    })?;
    array.finish()
}

/// Writes an array with one value per frame, repeated. `value` returns the value and how often it
/// is written; `length` is the total.
fn per_frame<W: Write + Seek>(
    zip: &mut Zip<W>,
    journal: &mut Journal,
    name: &str,
    length: u64,
    value: impl Fn(Head) -> (f64, u64),
) -> io::Result<()> {
    let mut array = begin(zip, name, &[length])?;
    journal.frames(|head, _| {
        let (value, times) = value(head);
        (0..times).try_for_each(|_| array.push(&value))
    })?;
    array.finish()
}

/// Writes the array of the first row of each frame, followed by the total number of rows.
fn frame_starts<W: Write + Seek>(zip: &mut Zip<W>, journal: &mut Journal) -> io::Result<()> {
    let mut array = begin(zip, "frame_start", &[journal.extent.whole.records + 1])?;
    let mut row = 0_i64;
    array.push(&row)?;
    journal.frames(|head, _| {
        row += head.count as i64;
        array.push(&row)
    })?;
    array.finish()
}

/// Writes a column of all frames as an array; `value` converts a word.
fn column<T: npyz::AutoSerialize, W: Write + Seek>(
    zip: &mut Zip<W>,
    journal: &mut Journal,
    name: &str,
    column: Column,
    value: impl Fn([u8; 8]) -> T,
) -> io::Result<()> {
    let shape = [journal.extent.rows, column.width()];
    let shape = if column.width() == 1 { &shape[..1] } else { &shape[..] };
    let mut array = begin(zip, name, shape)?;
    journal.frames(|_, columns| columns.words(column, |word| array.push(&value(word))))?;
    array.finish()
}

#[cfg(test)]
mod tests {
    use std::io::{Cursor, SeekFrom};

    use carom::{DVec3, Sphere};

    use super::*;

    /// A disk that becomes full.
    struct Full {
        content: Cursor<Vec<u8>>,
        /// Number of writes that succeed.
        left: usize,
    }

    impl Write for Full {
        fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
            self.left = self.left.checked_sub(1).ok_or(io::ErrorKind::StorageFull)?;
            self.content.write(bytes)
        }

        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }

    impl Seek for Full {
        fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
            self.content.seek(to)
        }
    }

    #[test]
    fn an_archive_fails_in_order_at_whichever_write_the_disk_is_full() {
        let mut world = World::default();
        world.add_sphere(Sphere::new(DVec3::ZERO, 0.5).with_velocity(DVec3::X)).unwrap();
        let mut file = tempfile::tempfile().unwrap();
        let mut writer = JournalWriter::begin(&mut file).unwrap();
        for _ in 0..3 {
            world.step(0.5).unwrap();
            writer.write(&world, &mut file).unwrap();
        }
        let mut journal = Journal::open(&mut file).unwrap().unwrap();
        let mut fill = |left| {
            let mut full = Full { content: Cursor::default(), left };
            (archive(&mut journal, &mut full), full.content.into_inner())
        };
        let failing = (0..).take_while(|writes| {
            let (written, _) = fill(*writes);
            written
                .inspect_err(|error| assert_eq!(error.kind(), io::ErrorKind::StorageFull))
                .is_err()
        });
        let writes = failing.count();
        assert!(writes > 10, "{writes}");
        let (written, content) = fill(writes);
        written.unwrap();
        assert!(zip::ZipArchive::new(Cursor::new(content)).unwrap().len() > 5);
    }
}
