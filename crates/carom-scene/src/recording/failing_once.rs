//! A writer that reports only its first error.

use std::io::{self, Seek, SeekFrom, Write};

/// Passes bytes on until writing fails; it discards later bytes without an error. The zip writer
/// completes its archive when it is dropped, and would print an error if it could not.
pub(super) struct FailingOnce<W> {
    inner: W,
    /// Position of the next byte.
    position: u64,
    /// End of the written bytes. After an error the position is set to it, because the parts that
    /// the zip writer completes must not start after they end.
    end: u64,
    has_failed: bool,
}

impl<W> FailingOnce<W> {
    /// Starts at position 0 of `inner`.
    pub fn new(inner: W) -> Self {
        Self { inner, position: 0, end: 0, has_failed: false }
    }

    fn noting<T>(&mut self, result: io::Result<T>) -> io::Result<T> {
        if result.is_err() && !self.has_failed {
            self.has_failed = true;
            self.position = self.end;
        }
        result
    }
}

impl<W: Write> Write for FailingOnce<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = if self.has_failed { Ok(bytes.len()) } else { self.inner.write(bytes) };
        let written = self.noting(written)?;
        self.position += written as u64;
        self.end = self.end.max(self.position);
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        let flushed = if self.has_failed { Ok(()) } else { self.inner.flush() };
        self.noting(flushed)
    }
}

impl<W: Seek> Seek for FailingOnce<W> {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        let sought = match to {
            _ if !self.has_failed => self.inner.seek(to),
            SeekFrom::Start(position) => Ok(position),
            SeekFrom::Current(by) => Ok(self.position.saturating_add_signed(by)),
            SeekFrom::End(_) => Ok(self.end),
        };
        self.position = self.noting(sought)?;
        Ok(self.position)
    }
}
