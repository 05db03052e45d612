//! The growing form of NPZ files: frame after frame, each with its checksum. What is whole of it can
//! be read whenever its writer stops.
//!
//! All numbers are little-endian words of 64 bits. After [`MAGIC`], a frame is a head - time \[s\], number of spheres,
//! [`ROTATION`] and [`BODIES`] as bits, and the checksum of these three -, its columns one after the other, and
//! their checksum.

use std::fs::File;
use std::io::{self, BufReader, Read, Seek, SeekFrom, Write};

use carom::World;
use xxhash_rust::xxh3::{Xxh3, xxh3_64};

use super::rotation::{angular_velocity, orientation};

/// What a journal begins with.
pub(super) const MAGIC: &[u8; 16] = b"carom npz 1\x1a\r\n\0\0";
/// Bit of a frame with the columns of rotation.
const ROTATION: u64 = 1;
/// Bit of a frame with radii and masses: those before do not hold any longer.
const BODIES: u64 = 2;
/// A word \[byte\].
const WORD: u64 = 8;
/// The head of a frame \[byte\].
const HEAD: u64 = 4 * WORD;
/// So much is gathered before it is written: most frames are written at once, and none needs more memory \[byte\].
const CHUNK: usize = 1 << 16;

/// What a frame has of every sphere.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Column {
    Ball,
    Position,
    Velocity,
    Orientation,
    AngularVelocity,
    Radius,
    Mass,
}

impl Column {
    /// In the order of the file.
    const ALL: [Self; 7] = [
        Self::Ball,
        Self::Position,
        Self::Velocity,
        Self::Orientation,
        Self::AngularVelocity,
        Self::Radius,
        Self::Mass,
    ];

    /// Numbers of a sphere.
    pub const fn width(self) -> u64 {
        match self {
            Self::Ball | Self::Radius | Self::Mass => 1,
            Self::Position | Self::Velocity | Self::AngularVelocity => 3,
            Self::Orientation => 4,
        }
    }

    const fn is_in(self, bits: u64) -> bool {
        match self {
            Self::Ball | Self::Position | Self::Velocity => true,
            Self::Orientation | Self::AngularVelocity => bits & ROTATION != 0,
            Self::Radius | Self::Mass => bits & BODIES != 0,
        }
    }
}

/// Writes a journal; each frame is with the operating system when [`Self::write`] returns.
#[derive(Debug)]
pub(super) struct JournalWriter {
    /// Whether spheres turn; known from the first frame on.
    has_rotation: Option<bool>,
    /// Numbers, radii \[m\] and masses \[kg\] of the last frame.
    bodies: (Vec<u64>, Vec<f64>, Vec<f64>),
    chunk: Vec<u8>,
}

impl JournalWriter {
    pub fn begin(out: &mut impl Write) -> io::Result<Self> {
        out.write_all(MAGIC)?;
        let bodies = (Vec::new(), Vec::new(), Vec::new());
        Ok(Self { has_rotation: None, bodies, chunk: Vec::new() })
    }

    /// Appends the spheres as they are now.
    pub fn write(&mut self, world: &World, out: &mut impl Write) -> io::Result<()> {
        let has_rotation = *self.has_rotation.get_or_insert_with(|| world.has_spin());
        let bits = u64::from(has_rotation) * ROTATION + u64::from(self.renew(world)) * BODIES;
        let spheres = world.spheres();
        self.chunk.clear();
        for word in [world.time().to_bits(), spheres.len() as u64, bits] {
            self.chunk.extend(word.to_le_bytes());
        }
        self.chunk.extend(xxh3_64(&self.chunk).to_le_bytes());
        let mut body =
            Body { chunk: &mut self.chunk, out, sum: Xxh3::new(), summed: HEAD as usize };
        for column in Column::ALL.into_iter().filter(|it| it.is_in(bits)) {
            body.column(column, world)?;
        }
        body.end()
    }

    /// Notes numbers, radii and masses; tells whether they are others than before.
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

/// The columns of a frame on their way to the disk.
struct Body<'a, W> {
    chunk: &'a mut Vec<u8>,
    out: &'a mut W,
    sum: Xxh3,
    /// So much of the chunk is in the sum, or is not to be.
    summed: usize,
}

impl<W: Write> Body<'_, W> {
    fn column(&mut self, column: Column, world: &World) -> io::Result<()> {
        let spheres = world.spheres();
        for i in 0..spheres.len() {
            match column {
                Column::Ball => self.push(&[spheres.ids()[i].number()]),
                Column::Position => self.numbers(&spheres.positions()[i].to_array()),
                Column::Velocity => self.numbers(&spheres.velocities()[i].to_array()),
                Column::Orientation => self.numbers(&orientation(world, i)),
                Column::AngularVelocity => self.numbers(&angular_velocity(world, i)),
                Column::Radius => self.numbers(&[spheres.radii()[i]]),
                Column::Mass => self.numbers(&[spheres.masses()[i]]),
            }
            if self.chunk.len() >= CHUNK {
                self.sum.update(&self.chunk[self.summed..]);
                self.out.write_all(self.chunk)?;
                self.chunk.clear();
                self.summed = 0;
            }
        }
        Ok(())
    }

    fn push(&mut self, words: &[u64]) {
        self.chunk.extend(words.iter().flat_map(|word| word.to_le_bytes()));
    }

    fn numbers(&mut self, values: &[f64]) {
        self.chunk.extend(values.iter().flat_map(|value| value.to_le_bytes()));
    }

    fn end(mut self) -> io::Result<()> {
        self.sum.update(&self.chunk[self.summed..]);
        self.push(&[self.sum.digest()]);
        self.out.write_all(self.chunk)
    }
}

/// The head of a frame, and where its columns are.
#[derive(Debug, Clone, Copy)]
pub(super) struct Head {
    pub time: f64,
    /// Number of spheres.
    pub count: u64,
    bits: u64,
}

impl Head {
    fn parse(bytes: &[u8; HEAD as usize]) -> Option<Self> {
        let word = |i: usize| -> Option<u64> {
            Some(u64::from_le_bytes(bytes.get(8 * i..8 * i + 8)?.try_into().ok()?))
        };
        let is_whole = xxh3_64(&bytes[..3 * WORD as usize]) == word(3)?;
        is_whole.then_some(Self { time: f64::from_bits(word(0)?), count: word(1)?, bits: word(2)? })
    }

    /// Where a column begins after the head, and its bytes; `None` where the frame has none.
    fn place(self, column: Column) -> Option<(u64, u64)> {
        let before = Column::ALL.into_iter().take_while(|it| *it != column);
        let before = before.filter(|it| it.is_in(self.bits)).map(Column::width);
        let bytes = |width: u64| WORD * width * self.count;
        column.is_in(self.bits).then(|| (bytes(before.sum()), bytes(column.width())))
    }

    /// Bytes of all columns; `None` where that is more than any file has.
    fn body(self) -> Option<u64> {
        let columns = Column::ALL.into_iter().filter(|it| it.is_in(self.bits));
        self.count.checked_mul(WORD * columns.map(Column::width).sum::<u64>())
    }

    pub fn has_rotation(self) -> bool {
        self.bits & ROTATION != 0
    }

    pub fn has_bodies(self) -> bool {
        self.bits & BODIES != 0
    }
}

/// What is whole of a journal.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Extent {
    pub frames: u64,
    /// Spheres of all frames together.
    pub rows: u64,
    pub has_rotation: bool,
    /// Time of the last frame \[s\].
    pub last: Option<f64>,
    /// Bytes up to the end of the last whole frame.
    end: u64,
    /// Bytes after that.
    pub rest: u64,
    /// Whether what comes then is no frame that was cut short, but something else.
    pub is_damaged: bool,
}

/// Reads a journal, as often as is wanted.
pub(super) struct Journal<'a> {
    file: &'a mut File,
    pub extent: Extent,
}

impl<'a> Journal<'a> {
    /// Finds what is whole; `None` for a file that is no journal.
    pub fn open(file: &'a mut File) -> io::Result<Option<Self>> {
        let length = file.seek(SeekFrom::End(0))?;
        file.rewind()?;
        let mut reader = BufReader::with_capacity(CHUNK, &mut *file);
        let mut magic = [0; MAGIC.len()];
        if length < magic.len() as u64 {
            return Ok(None);
        }
        reader.read_exact(&mut magic)?;
        if magic != *MAGIC {
            return Ok(None);
        }
        let mut extent = Extent { end: magic.len() as u64, ..Extent::default() };
        while let Some(head) = whole_frame(&mut reader, length, &mut extent)? {
            extent.has_rotation = head.has_rotation();
            extent.frames += 1;
            extent.rows += head.count;
            extent.last = Some(head.time);
        }
        extent.rest = length - extent.end;
        Ok(Some(Self { file, extent }))
    }

    /// Gives every whole frame to `each`, with what reads a column of it.
    pub fn frames(
        &mut self,
        mut each: impl FnMut(Head, &mut Columns) -> io::Result<()>,
    ) -> io::Result<()> {
        let mut position = self.file.seek(SeekFrom::Start(MAGIC.len() as u64))?;
        let mut reader = BufReader::with_capacity(CHUNK, &mut *self.file);
        while position < self.extent.end {
            let mut head = [0; HEAD as usize];
            reader.read_exact(&mut head)?;
            let changed = || io::Error::new(io::ErrorKind::InvalidData, "the journal has changed");
            let head = Head::parse(&head).ok_or_else(changed)?;
            let mut columns = Columns { reader: &mut reader, head, at: 0 };
            each(head, &mut columns)?;
            let body = head.body().unwrap_or(0) + WORD;
            columns.go_to(body)?;
            position += HEAD + body;
        }
        Ok(())
    }
}

/// The columns of one frame.
pub(super) struct Columns<'a, 'b> {
    reader: &'a mut BufReader<&'b mut File>,
    head: Head,
    /// Bytes after the head.
    at: u64,
}

impl Columns<'_, '_> {
    fn go_to(&mut self, place: u64) -> io::Result<()> {
        self.reader.seek_relative(place as i64 - self.at as i64)?;
        self.at = place;
        Ok(())
    }

    /// The words of a column, one after the other; none where the frame has no such column.
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

/// Reads a frame that is whole, and moves the end of the extent behind it.
fn whole_frame(
    reader: &mut impl Read,
    length: u64,
    extent: &mut Extent,
) -> io::Result<Option<Head>> {
    let rest = length - extent.end;
    if rest < HEAD {
        return Ok(None);
    }
    let mut head = [0; HEAD as usize];
    reader.read_exact(&mut head)?;
    let head = Head::parse(&head)
        .filter(|head| extent.frames == 0 || head.has_rotation() == extent.has_rotation);
    let Some((head, body)) = head.and_then(|head| Some((head, head.body()?))) else {
        extent.is_damaged = true;
        return Ok(None);
    };
    if rest - HEAD < body.saturating_add(WORD) {
        return Ok(None);
    }
    let mut sum = Xxh3::new();
    let mut left = body;
    let mut chunk = vec![0; CHUNK.min(body as usize)];
    while left > 0 {
        let part = left.min(CHUNK as u64);
        reader.read_exact(&mut chunk[..part as usize])?;
        sum.update(&chunk[..part as usize]);
        left -= part;
    }
    let mut expected = [0; WORD as usize];
    reader.read_exact(&mut expected)?;
    if sum.digest() != u64::from_le_bytes(expected) {
        extent.is_damaged = true;
        return Ok(None);
    }
    extent.end += HEAD + body + WORD;
    Ok(Some(head))
}
