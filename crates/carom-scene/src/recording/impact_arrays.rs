//! Impacts as NPZ, for NumPy: one array per quantity, one row per impact.
//!
//! Rows go to a journal beside the file, a record for each step with impacts, from which the file is created at the end;
//! so memory does not grow with the number of impacts.

use std::fs::File;
use std::io::{self, BufReader, Read, Seek, SeekFrom, Write};
use std::path::Path;

use carom::{BodyPair, Impact};

use super::archive::{self, Zip, begin};
use super::records::{self, CHUNK, Extent, HEAD, Magic, RecordWriter, WORD, Words, parse_head};
use super::recovered::{Recovered, complete};
use crate::unfinished::Unfinished;

/// First bytes of a journal.
const MAGIC: &Magic = b"carom hits 1\x1a\r\n\0";

/// An array of the archive: its name, and its words in a row of the journal.
struct Array {
    name: &'static str,
    first: usize,
    width: usize,
    is_integer: bool,
}

impl Array {
    const fn numbers(name: &'static str, first: usize, width: usize) -> Self {
        Self { name, first, width, is_integer: false }
    }

    const fn id(name: &'static str, first: usize) -> Self {
        Self { name, first, width: 1, is_integer: true }
    }
}

/// The arrays, in the units of the engine; the ids of bodies that there are not are -1.
const ARRAYS: [Array; 10] = [
    Array::numbers("time", 0, 1),
    Array::id("collider", 1),
    Array::id("sphere_1", 2),
    Array::id("sphere_2", 3),
    Array::numbers("point", 4, 3),
    Array::numbers("normal", 7, 3),
    Array::numbers("approach_speed", 10, 1),
    Array::numbers("separation_speed", 11, 1),
    Array::numbers("impulse", 12, 1),
    Array::numbers("tangential_impulse", 13, 3),
];
/// Number of words of a row.
const WIDTH: usize = 16;

/// Writes impacts to an NPZ file.
#[derive(Debug)]
pub(super) struct ImpactArrays {
    unfinished: Unfinished,
    /// Number of records in the journal.
    records: u64,
    chunk: Vec<u8>,
}

impl ImpactArrays {
    pub fn create(path: &Path) -> io::Result<Self> {
        let (unfinished, ()) = Unfinished::begin(path, |file| file.write_all(MAGIC))?;
        Ok(Self { unfinished, records: 0, chunk: Vec::new() })
    }

    /// Writes the impacts of a step that started at `start` \[s\].
    pub fn write(&mut self, start: f64, impacts: &[Impact]) -> io::Result<()> {
        if impacts.is_empty() {
            return Ok(());
        }
        let words = [start.to_bits(), impacts.len() as u64, 0];
        let mut record = RecordWriter::begin(&mut self.chunk, self.unfinished.file(), words);
        for impact in impacts {
            row(start, impact).iter().try_for_each(|word| record.push(&word.to_le_bytes()))?;
        }
        self.records += 1;
        record.end()
    }

    pub fn finish(self) -> io::Result<()> {
        complete(self.unfinished, self.records, close)
    }
}

/// Words of an impact, in the order of [`ARRAYS`].
fn row(start: f64, impact: &Impact) -> [u64; WIDTH] {
    const NONE: u64 = u64::MAX;
    let bodies = match impact.between {
        BodyPair::Spheres(first, second) => [NONE, first.number(), second.number()],
        BodyPair::Collider { collider, sphere } => [collider.number(), NONE, sphere.number()],
    };
    let [x, y, z] = impact.point.to_array().map(f64::to_bits);
    let [nx, ny, nz] = impact.normal.to_array().map(f64::to_bits);
    let speeds = [impact.approach_speed, impact.separation_speed, impact.impulse];
    let [approach, separation, impulse] = speeds.map(f64::to_bits);
    let [tx, ty, tz] = impact.tangential_impulse.to_array().map(f64::to_bits);
    let time = (start + impact.time).to_bits();
    let [collider, first, second] = bodies;
    [time, collider, first, second, x, y, z, nx, ny, nz, approach, separation, impulse, tx, ty, tz]
}

/// Writes the archive of the complete records of a journal. Returns `None` if `source` is no journal.
pub(super) fn close(source: &mut File, target: File) -> io::Result<Option<Recovered>> {
    let (mut rows, mut last) = (0, None);
    let each = |_, words: &Words| (rows, last) = (rows + words[1], Some(f64::from_bits(words[0])));
    let Some(extent) = records::scan(source, MAGIC, length, each)? else { return Ok(None) };
    archive::archive(target, |zip| {
        ARRAYS.iter().try_for_each(|array| add(zip, array, rows, source, &extent))
    })?;
    let Extent { records, rest, is_damaged, .. } = extent;
    Ok(Some(Recovered { frames: records, last, left_out: rest, is_damaged }))
}

/// Length of the body of a record \[bytes\]; `None` if it overflows.
fn length(words: &Words) -> Option<u64> {
    words[1].checked_mul(WIDTH as u64 * WORD)
}

/// Adds an array with this number of rows to the archive.
fn add<W: Write + Seek>(
    zip: &mut Zip<W>,
    array: &Array,
    rows: u64,
    source: &mut File,
    extent: &Extent,
) -> io::Result<()> {
    let shape = [rows, array.width as u64];
    let shape = if array.width == 1 { &shape[..1] } else { &shape[..] };
    if array.is_integer {
        let mut ids = begin(zip, array.name, shape)?;
        words(source, extent, array, |word| ids.push(&(word as i64)))?;
        return ids.finish();
    }
    let mut numbers = begin(zip, array.name, shape)?;
    words(source, extent, array, |word| numbers.push(&f64::from_bits(word)))?;
    numbers.finish()
}

/// Calls `each` with the words of an array, row after row.
fn words(
    source: &mut File,
    extent: &Extent,
    array: &Array,
    mut each: impl FnMut(u64) -> io::Result<()>,
) -> io::Result<()> {
    source.seek(SeekFrom::Start(MAGIC.len() as u64))?;
    let mut reader = BufReader::with_capacity(CHUNK, source);
    let changed = || io::Error::new(io::ErrorKind::InvalidData, "the journal has changed");
    let (mut head, mut row, mut sum) = ([0; HEAD as usize], [0; 8 * WIDTH], [0; WORD as usize]);
    for _ in 0..extent.records {
        reader.read_exact(&mut head)?;
        let [_, count, _] = parse_head(&head).ok_or_else(changed)?;
        for _ in 0..count {
            reader.read_exact(&mut row)?;
            let words = row.as_chunks().0.iter().map(|word| u64::from_le_bytes(*word));
            words.skip(array.first).take(array.width).try_for_each(&mut each)?;
        }
        reader.read_exact(&mut sum)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use carom::{DVec3, Sphere, World};

    use super::super::recovery::recover;
    use super::*;

    /// Two spheres that meet at 1 s, and then no more.
    fn world() -> World {
        let mut world = World::default();
        for side in [-1.0, 1.0] {
            let sphere = Sphere::new(1.5 * side * DVec3::X, 0.5);
            world.add_sphere(sphere.with_velocity(-side * DVec3::X)).unwrap();
        }
        world
    }

    #[test]
    fn a_run_that_stops_leaves_the_impacts_of_all_its_steps() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("i.npz");
        let mut arrays = ImpactArrays::create(&path).unwrap();
        let mut world = world();
        for step in 0..4 {
            world.step(0.75).unwrap();
            arrays.write(0.75 * f64::from(step), &world.report().impacts).unwrap();
        }
        // Another record that is cut short.
        arrays.write(3.0, &world.report().impacts).unwrap();
        arrays.unfinished.file().write_all(&[1, 2, 3]).unwrap();
        let unfinished = arrays.unfinished.place().unwrap().to_owned();
        drop(arrays);
        let recovered = recover(&unfinished, &path).unwrap();
        assert_eq!((recovered.frames, recovered.last, recovered.left_out), (1, Some(0.75), 3));
        let mut zip = zip::ZipArchive::new(File::open(&path).unwrap()).unwrap();
        let mut bytes = Vec::new();
        zip.by_name("time.npy").unwrap().read_to_end(&mut bytes).unwrap();
        let times: Vec<f64> = npyz::NpyFile::new(&bytes[..]).unwrap().into_vec().unwrap();
        assert_eq!(times, [1.0]);
    }
}
