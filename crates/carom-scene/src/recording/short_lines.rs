//! A reader that limits the length of lines.

use std::io::{self, Read};

use thiserror::Error;

/// Most bytes of a line: many times the length of a row of a recording, even with some added
/// columns.
pub(super) const LONGEST_LINE: usize = 1 << 16;

/// A line is longer than [`LONGEST_LINE`].
#[derive(Debug, Error)]
#[error("line {line} is too long")]
pub(super) struct TooLong {
    /// Number of the line, from 1.
    pub line: u64,
}

/// Passes bytes on and returns an error if a line is too long: a file without line ends would fill
/// the memory.
#[derive(Debug)]
pub(super) struct ShortLines<R> {
    inner: R,
    /// Number of line ends so far.
    lines: u64,
    /// Number of bytes since the last line end.
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
