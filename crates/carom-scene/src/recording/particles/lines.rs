//! Lines of a file, with their numbers.

use std::io::{self, BufRead, BufReader, Read};

use crate::recording::short_lines::ShortLines;

/// Reads lines one by one and counts them.
pub(super) struct Lines<R> {
    inner: BufReader<ShortLines<R>>,
    /// Number of lines read.
    pub number: u64,
    /// Position after the last line \[bytes\].
    pub position: u64,
    /// Whether the last line had an end.
    pub has_end: bool,
}

impl<R: Read> Lines<R> {
    pub fn new(inner: R) -> Self {
        let inner = BufReader::new(ShortLines::new(inner));
        Self { inner, number: 0, position: 0, has_end: true }
    }

    /// Returns the next line without its end; `None` after the last one.
    ///
    /// # Errors
    /// [`io::Error`] if the file cannot be read, is no text, or has a line that is too long.
    pub fn next(&mut self) -> io::Result<Option<String>> {
        let mut line = String::new();
        let length = self.inner.read_line(&mut line)?;
        if length == 0 {
            return Ok(None);
        }
        self.number += 1;
        self.position += length as u64;
        self.has_end = line.ends_with('\n');
        line.truncate(line.trim_end_matches(['\r', '\n']).len());
        Ok(Some(line))
    }
}
