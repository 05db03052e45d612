//! A reader that refuses lines without end.

use std::io::{self, Read};

use thiserror::Error;

/// Most bytes of a line: many times those of all columns of a recording, and of some that others add.
pub(super) const LONGEST_LINE: usize = 1 << 16;

/// A line is longer than [`LONGEST_LINE`].
#[derive(Debug, Error)]
#[error("line {line} is too long")]
pub(super) struct TooLong {
    /// From 1.
    pub line: u64,
}

/// Passes on what it reads, as long as no line is too long: a file without ends of lines would fill
/// the memory.
#[derive(Debug)]
pub(super) struct ShortLines<R> {
    inner: R,
    /// Ends of lines so far.
    lines: u64,
    /// Bytes since the last one.
    length: usize,
}

impl<R> ShortLines<R> {
    pub fn new(inner: R) -> Self {
        Self { inner, lines: 0, length: 0 }
    }
}

impl<R: Read> Read for ShortLines<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let count = self.inner.read(buffer)?;
        let mut pieces = buffer[..count].split(|byte| *byte == b'\n').peekable();
        while let Some(piece) = pieces.next() {
            self.length += piece.len();
            if self.length > LONGEST_LINE {
                let line = self.lines + 1;
                return Err(io::Error::new(io::ErrorKind::InvalidData, TooLong { line }));
            }
            if pieces.peek().is_some() {
                self.lines += 1;
                self.length = 0;
            }
        }
        Ok(count)
    }
}
