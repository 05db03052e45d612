//! Files of records with checksums. Complete records can be read even if the writer was stopped at
//! any moment.
//!
//! All numbers are little-endian words of 64 bits. A file starts with [`Magic`] bytes that identify
//! its kind. A record consists of a head (three words and their checksum), a body, whose length
//! follows from the head, and the checksum of the body.

use std::fs::File;
use std::io::{self, BufReader, Read, Seek, Write};

use xxhash_rust::xxh3::{Xxh3, xxh3_64};

/// First bytes of a file, which identify its kind.
pub type Magic = [u8; 16];

/// Content of the head of a record.
pub type Words = [u64; 3];

/// Length of a word \[byte\].
pub(super) const WORD: u64 = 8;
/// Length of the head of a record \[byte\].
pub const HEAD: u64 = 4 * WORD;
/// Length of the buffer of a record \[byte\]: most records are written in one piece, and none needs
/// more memory.
pub(super) const CHUNK: usize = 1 << 16;

/// Writes a record. When [`Self::end`] returns, the record has been passed to the operating system.
pub struct RecordWriter<'a, W> {
    chunk: &'a mut Vec<u8>,
    out: &'a mut W,
    sum: Xxh3,
    /// Number of bytes at the start of the buffer that the checksum of the body excludes: the head.
    summed: usize,
}

impl<W> std::fmt::Debug for RecordWriter<'_, W> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("RecordWriter").field("summed", &self.summed).finish_non_exhaustive()
    }
}

impl<'a, W: Write> RecordWriter<'a, W> {
    /// Starts a record with this head. `chunk` is a buffer that is reused.
    pub fn begin(chunk: &'a mut Vec<u8>, out: &'a mut W, words: Words) -> Self {
        chunk.clear();
        chunk.extend(words.iter().flat_map(|word| word.to_le_bytes()));
        let head_sum = xxh3_64(chunk);
        chunk.extend(head_sum.to_le_bytes());
        Self { chunk, out, sum: Xxh3::new(), summed: HEAD as usize }
    }

    /// Appends bytes to the body.
    ///
    /// # Errors
    /// [`io::Error`] if the disk is full or gone.
    pub fn push(&mut self, bytes: &[u8]) -> io::Result<()> {
        if self.chunk.len() + bytes.len() > CHUNK {
            self.sum.update(&self.chunk[self.summed..]);
            self.out.write_all(self.chunk)?;
            self.chunk.clear();
            self.summed = 0;
        }
        if bytes.len() > CHUNK {
            self.sum.update(bytes);
            return self.out.write_all(bytes);
        }
        self.chunk.extend(bytes);
        Ok(())
    }

    /// Writes the rest of the record and its checksum.
    ///
    /// # Errors
    /// [`io::Error`] if the disk is full or gone.
    pub fn end(mut self) -> io::Result<()> {
        self.sum.update(&self.chunk[self.summed..]);
        self.chunk.extend(self.sum.digest().to_le_bytes());
        self.out.write_all(self.chunk)
    }
}

/// Reads the head of a record; `None` if its checksum is wrong.
pub(super) fn parse_head(bytes: &[u8; HEAD as usize]) -> Option<Words> {
    let (words, sum) = bytes.split_last_chunk()?;
    let is_whole = xxh3_64(words) == u64::from_le_bytes(*sum);
    let mut words =
        words.chunks_exact(WORD as usize).map(|it| it.try_into().map(u64::from_le_bytes));
    let mut next = || words.next()?.ok();
    is_whole.then_some([next()?, next()?, next()?])
}

/// The complete part of a file.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Extent {
    /// Number of complete records.
    pub records: u64,
    /// End of the last complete record \[bytes\].
    pub end: u64,
    /// Number of bytes after that.
    pub rest: u64,
    /// Whether those bytes are damaged, as opposed to a record that was cut short.
    pub is_damaged: bool,
}

/// Reads a file from its start and finds its complete part. Returns `None` if it does not start
/// with `magic`.
///
/// `length` returns the length of the body after a head \[byte\], or `None` if the head is invalid.
/// `each` is called with the position and the head of every complete record.
///
/// # Errors
/// [`io::Error`] if the file cannot be read.
pub fn scan(
    file: &mut File,
    magic: &Magic,
    mut length: impl FnMut(&Words) -> Option<u64>,
    mut each: impl FnMut(u64, &Words),
) -> io::Result<Option<Extent>> {
    let whole = file.seek(io::SeekFrom::End(0))?;
    file.rewind()?;
    let mut reader = BufReader::with_capacity(CHUNK, file);
    let mut found = Magic::default();
    if whole < found.len() as u64 {
        return Ok(None);
    }
    reader.read_exact(&mut found)?;
    if found != *magic {
        return Ok(None);
    }
    let mut extent = Extent { end: magic.len() as u64, ..Extent::default() };
    while let Some((words, size)) = record(&mut reader, whole, &mut extent, &mut length)? {
        each(extent.end, &words);
        extent.records += 1;
        extent.end += size;
    }
    extent.rest = whole - extent.end;
    Ok(Some(extent))
}

/// Reads a record; returns its head and its length, or `None` if it is not complete.
fn record(
    reader: &mut impl Read,
    whole: u64,
    extent: &mut Extent,
    length: &mut impl FnMut(&Words) -> Option<u64>,
) -> io::Result<Option<(Words, u64)>> {
    let rest = whole - extent.end;
    if rest < HEAD {
        return Ok(None);
    }
    let mut head = [0; HEAD as usize];
    reader.read_exact(&mut head)?;
    let head = parse_head(&head);
    let Some((words, body)) = head.and_then(|words| Some((words, length(&words)?))) else {
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
    Ok(Some((words, HEAD + body + WORD)))
}
