//! The journal of an NPZ file: a file to which frames are appended.
//!
//! The head of a frame contains its time \[s\], the number of spheres, and the bits [`ROTATION`],
//! [`BODIES`], [`BOX`] and [`SLIDE`]. The body contains its columns one after the other.

use std::fs::File;
use std::io::{self, BufReader, Read, Seek, SeekFrom, Write};

use carom::{Boundary, World};

use super::records::{self, CHUNK, HEAD, Magic, RecordWriter, WORD, Words, parse_head};
use super::rotation::{angular_velocity, orientation};
use super::slide::slide;

/// First bytes of a journal.
const MAGIC: &Magic = b"carom npz 1\x1a\r\n\0\0";
/// Bit of a frame that has the columns of rotation.
const ROTATION: u64 = 1;
/// Bit of a frame that has radii and masses, which replace the earlier ones.
const BODIES: u64 = 2;
/// Bit of a frame that has the sides of a periodic box, which replace the earlier ones.
const BOX: u64 = 4;
/// Bit of a frame whose periodic box is in steady shear.
const SLIDE: u64 = 8;

/// A column of a frame, with values for every sphere or, of the box, for all of them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Column {
    Ball,
    Position,
    Velocity,
    Orientation,
    AngularVelocity,
    Radius,
    Mass,
    /// Sides of the periodic box.
    Box,
    /// How far the box above has slid.
    Slide,
}

impl Column {
    /// All columns, in the order of the file.
    const ALL: [Self; 9] = [
        Self::Ball,
        Self::Position,
        Self::Velocity,
        Self::Orientation,
        Self::AngularVelocity,
        Self::Radius,
        Self::Mass,
        Self::Box,
        Self::Slide,
    ];

    /// Number of values per sphere, or of all values of the box.
    pub const fn width(self) -> u64 {
        match self {
            Self::Ball | Self::Radius | Self::Mass | Self::Slide => 1,
            Self::Position | Self::Velocity | Self::AngularVelocity | Self::Box => 3,
            Self::Orientation => 4,
        }
    }

    const fn is_in(self, bits: u64) -> bool {
        match self {
            Self::Ball | Self::Position | Self::Velocity => true,
            Self::Orientation | Self::AngularVelocity => bits & ROTATION != 0,
            Self::Radius | Self::Mass => bits & BODIES != 0,
            Self::Box => bits & BOX != 0,
            Self::Slide => bits & SLIDE != 0,
        }
    }

    /// Length in a frame of `count` spheres \[bytes\]; `None` if it overflows.
    fn length(self, count: u64) -> Option<u64> {
        let rows = if matches!(self, Self::Box | Self::Slide) { 1 } else { count };
        rows.checked_mul(WORD * self.width())
    }
}

/// Writes a journal. When [`Self::write`] returns, the frame has been passed to the operating
/// system.
#[derive(Debug)]
pub(super) struct JournalWriter {
    /// Whether frames have rotations; the first frame decides.
    has_rotation: Option<bool>,
    /// Numbers, radii \[m\] and masses \[kg\] in the last frame.
    bodies: (Vec<u64>, Vec<f64>, Vec<f64>),
    /// Sides of the periodic box in the last frame \[m\].
    sides: Option<[f64; 3]>,
    chunk: Vec<u8>,
}

impl JournalWriter {
    pub fn begin(out: &mut impl Write) -> io::Result<Self> {
        out.write_all(MAGIC)?;
        let bodies = (Vec::new(), Vec::new(), Vec::new());
        Ok(Self { has_rotation: None, bodies, sides: None, chunk: Vec::new() })
    }

    /// Appends the current state of all spheres.
    pub fn write(&mut self, world: &World, out: &mut impl Write) -> io::Result<()> {
        let has_rotation = *self.has_rotation.get_or_insert_with(|| world.has_spin());
        let sides = sides(world);
        let has_box = sides.is_some() && sides != self.sides;
        self.sides = sides;
        let bits = u64::from(has_rotation) * ROTATION
            + u64::from(self.renew(world)) * BODIES
            + u64::from(has_box) * BOX
            + u64::from(slide(world.settings(), world.time()).is_some()) * SLIDE;
        let words = [world.time().to_bits(), world.spheres().len() as u64, bits];
        let mut record = RecordWriter::begin(&mut self.chunk, out, words);
        for column in Column::ALL.into_iter().filter(|it| it.is_in(bits)) {
            write_column(&mut record, column, world)?;
        }
        record.end()
    }

    /// Stores numbers, radii and masses; returns whether they changed since the last frame.
    fn renew(&mut self, world: &World) -> bool {
        let spheres = world.spheres();
        let (ids, radii, masses) = &mut self.bodies;
        let numbers = || spheres.ids().iter().map(|id| id.number());
        let same = ids.iter().copied().eq(numbers())
            && radii == spheres.radii()
            && masses == spheres.masses();
        if !same {
            ids.clear();
            ids.extend(numbers());
            spheres.radii().clone_into(radii);
            spheres.masses().clone_into(masses);
        }
        !same
    }
}

/// Sides of the periodic box of a world \[m\], infinite along open axes.
fn sides(world: &World) -> Option<[f64; 3]> {
    match world.settings().boundary {
        Boundary::Periodic { size } => Some(size.to_array()),
        _ => None,
    }
}

fn write_column(
    record: &mut RecordWriter<impl Write>,
    column: Column,
    world: &World,
) -> io::Result<()> {
    let spheres = world.spheres();
    match column {
        Column::Box => {
            return push_numbers(record, &sides(world).unwrap_or([f64::INFINITY; 3]));
        }
        Column::Slide => {
            return push_numbers(record, &[slide(world.settings(), world.time()).unwrap_or(0.0)]);
        }
        _ => {}
    }
    for i in 0..spheres.len() {
        match column {
            Column::Ball => record.push(&spheres.ids()[i].number().to_le_bytes())?,
            Column::Position => push_numbers(record, &spheres.positions()[i].to_array())?,
            Column::Velocity => push_numbers(record, &spheres.velocities()[i].to_array())?,
            Column::Orientation => push_numbers(record, &orientation(world, i))?,
            Column::AngularVelocity => push_numbers(record, &angular_velocity(world, i))?,
            Column::Radius => push_numbers(record, &[spheres.radii()[i]])?,
            Column::Mass => push_numbers(record, &[spheres.masses()[i]])?,
            Column::Box | Column::Slide => {}
        }
    }
    Ok(())
}

fn push_numbers(record: &mut RecordWriter<impl Write>, numbers: &[f64]) -> io::Result<()> {
    numbers.iter().try_for_each(|number| record.push(&number.to_le_bytes()))
}

/// The head of a frame; it determines the positions of the columns.
#[derive(Debug, Clone, Copy)]
pub(super) struct Head {
    pub time: f64,
    /// Number of spheres.
    pub count: u64,
    bits: u64,
}

impl Head {
    fn of(words: &Words) -> Self {
        let [time, count, bits] = *words;
        Self { time: f64::from_bits(time), count, bits }
    }

    /// Offset of a column after the head, and its length \[bytes\]; `None` if the frame does not
    /// have the column.
    fn place(self, column: Column) -> Option<(u64, u64)> {
        let before = Column::ALL.into_iter().take_while(|it| *it != column);
        let mut before = before.filter(|it| it.is_in(self.bits));
        let start = before.try_fold(0_u64, |sum, it| sum.checked_add(it.length(self.count)?))?;
        column.is_in(self.bits).then_some((start, column.length(self.count)?))
    }

    /// Length of all columns \[bytes\]; `None` if it overflows.
    fn body(self) -> Option<u64> {
        let mut columns = Column::ALL.into_iter().filter(|it| it.is_in(self.bits));
        columns.try_fold(0_u64, |sum, it| sum.checked_add(it.length(self.count)?))
    }

    pub fn has_rotation(self) -> bool {
        self.bits & ROTATION != 0
    }

    pub fn is_sheared(self) -> bool {
        self.bits & SLIDE != 0
    }

    pub fn has_bodies(self) -> bool {
        self.bits & BODIES != 0
    }
}

/// The complete part of a journal.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Extent {
    pub whole: records::Extent,
    /// Number of spheres, summed over all frames.
    pub rows: u64,
    pub has_rotation: bool,
    /// Whether the periodic box is in steady shear in any frame.
    pub is_sheared: bool,
    /// Time of the last frame \[s\].
    pub last: Option<f64>,
}

/// Reads a journal, any number of times.
pub(super) struct Journal<'a> {
    file: &'a mut File,
    pub extent: Extent,
}

impl<'a> Journal<'a> {
    /// Finds the complete part of a journal; `None` if the file is no journal.
    pub fn open(file: &'a mut File) -> io::Result<Option<Self>> {
        let mut extent = Extent::default();
        // Either all frames have rotations, or none has.
        let mut turning = None;
        let length = |words: &Words| {
            let head = Head::of(words);
            let is_alike = head.has_rotation() == *turning.get_or_insert(head.has_rotation());
            if is_alike { head.body() } else { None }
        };
        let each = |_, words: &Words| {
            let head = Head::of(words);
            extent.has_rotation = head.has_rotation();
            extent.is_sheared |= head.is_sheared();
            extent.rows += head.count;
            extent.last = Some(head.time);
        };
        let whole = records::scan(file, MAGIC, length, each)?;
        Ok(whole.map(|whole| Self { file, extent: Extent { whole, ..extent } }))
    }

    /// Calls `each` with every complete frame and a reader of its columns.
    pub fn frames(
        &mut self,
        mut each: impl FnMut(Head, &mut Columns) -> io::Result<()>,
    ) -> io::Result<()> {
        let mut position = self.file.seek(SeekFrom::Start(MAGIC.len() as u64))?;
        let mut reader = BufReader::with_capacity(CHUNK, &mut *self.file);
        while position < self.extent.whole.end {
            let mut head = [0; HEAD as usize];
            reader.read_exact(&mut head)?;
            let changed = || io::Error::new(io::ErrorKind::InvalidData, "the journal has changed");
            let head = Head::of(&parse_head(&head).ok_or_else(changed)?);
            let mut columns = Columns { reader: &mut reader, head, at: 0 };
            each(head, &mut columns)?;
            let body = head.body().unwrap_or(0) + WORD;
            columns.go_to(body)?;
            position += HEAD + body;
        }
        Ok(())
    }
}

/// Reads the columns of one frame.
pub(super) struct Columns<'a, 'b> {
    reader: &'a mut BufReader<&'b mut File>,
    head: Head,
    /// Position after the head \[bytes\].
    at: u64,
}

impl Columns<'_, '_> {
    fn go_to(&mut self, place: u64) -> io::Result<()> {
        self.reader.seek_relative(place as i64 - self.at as i64)?;
        self.at = place;
        Ok(())
    }

    /// Calls `each` with the words of a column; with none if the frame does not have the column.
    pub fn words(
        &mut self,
        column: Column,
        mut each: impl FnMut([u8; 8]) -> io::Result<()>,
    ) -> io::Result<()> {
        let Some((place, bytes)) = self.head.place(column) else { return Ok(()) };
        self.go_to(place)?;
        let mut word = [0; WORD as usize];
        for _ in 0..bytes / WORD {
            self.reader.read_exact(&mut word)?;
            each(word)?;
        }
        self.at += bytes;
        Ok(())
    }
}
