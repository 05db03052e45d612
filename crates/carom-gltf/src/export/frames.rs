//! The unfinished file of an animation, to which frames are appended.
//!
//! The head of a frame contains the lengths of the three parts of its body \[byte\]: JSON of its
//! changes and additions; new arrays; rows of all colliders, then of all balls.

use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom, Write};

use carom_scene::recording::records::{self, Extent, HEAD, Magic, RecordWriter, Words};
use serde::{Deserialize, Serialize};

use super::tracks::Changes;
use crate::document::Document;

/// First bytes of the file.
const MAGIC: &Magic = b"carom glb 1\x1a\r\n\0\0";

/// Changes and additions of a frame.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Frame {
    /// Time \[s\].
    pub time: f64,
    #[serde(default)]
    pub balls: Changes,
    #[serde(default)]
    pub colliders: Changes,
    /// Additions to the document.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub added: Option<Document>,
}

/// Starts a file.
pub(super) fn begin(file: &mut File) -> io::Result<()> {
    file.write_all(MAGIC)
}

/// Appends a frame with these arrays and rows. On return, it has been passed to the operating
/// system.
///
/// # Errors
/// [`io::Error`] if the disk is full or gone, or if a number is not finite.
pub(super) fn append(
    file: &mut File,
    chunk: &mut Vec<u8>,
    frame: &Frame,
    arrays: &[u8],
    rows: &[u8],
) -> io::Result<()> {
    let json = serde_json::to_vec(frame)?;
    // JSON cannot represent infinity.
    if frame.added.is_some() && serde_json::from_slice::<Frame>(&json).is_err() {
        let text = "a number of this scene is too large for an animation";
        return Err(io::Error::new(io::ErrorKind::InvalidInput, text));
    }
    let parts = [&json[..], arrays, rows];
    let mut record = RecordWriter::begin(chunk, file, parts.map(|part| part.len() as u64));
    parts.into_iter().try_for_each(|part| record.push(part))?;
    record.end()
}

/// A complete frame in a file.
#[derive(Debug, Clone, Copy)]
pub(super) struct Place {
    /// Start of the frame \[byte\].
    start: u64,
    /// Lengths of its parts \[byte\].
    lengths: Words,
}

impl Place {
    /// Start and length of its rows \[byte\].
    pub fn rows(&self) -> (u64, u64) {
        let [json, arrays, rows] = self.lengths;
        (self.start + HEAD + json + arrays, rows)
    }

    /// Reads the frame and appends its arrays to `arrays`. Afterwards, the file is positioned at
    /// its rows.
    pub fn read(&self, file: &mut File, arrays: &mut Vec<u8>) -> io::Result<Frame> {
        let [json_length, arrays_length, _] = self.lengths;
        file.seek(SeekFrom::Start(self.start + HEAD))?;
        let mut json = vec![0; json_length as usize];
        file.read_exact(&mut json)?;
        file.take(arrays_length).read_to_end(arrays)?;
        Ok(serde_json::from_slice(&json)?)
    }
}

/// Finds the complete frames of a file; `None` if it is no unfinished animation.
pub(super) fn scan(file: &mut File) -> io::Result<Option<(Vec<Place>, Extent)>> {
    let mut places = Vec::new();
    let length = |[json, arrays, rows]: &Words| json.checked_add(*arrays)?.checked_add(*rows);
    let each = |start, words: &Words| places.push(Place { start, lengths: *words });
    let extent = records::scan(file, MAGIC, length, each)?;
    Ok(extent.map(|extent| (places, extent)))
}
