//! The growing form of an animation: frame after frame, in the unfinished file.
//!
//! The head of a frame has the lengths of the three parts of its body \[byte\]: JSON of what it changes and adds; arrays that
//! are new; rows of all colliders, and then of all balls.

use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom, Write};

use carom_scene::recording::records::{self, Extent, HEAD, Magic, RecordWriter, Words};
use serde::{Deserialize, Serialize};

use super::tracks::Changes;
use crate::document::Document;

/// What the file begins with.
const MAGIC: &Magic = b"carom glb 1\x1a\r\n\0\0";

/// What a frame changes and adds.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Frame {
    /// \[s\]
    pub time: f64,
    #[serde(default)]
    pub balls: Changes,
    #[serde(default)]
    pub colliders: Changes,
    /// What is new of the file.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub added: Option<Document>,
}

/// Begins a file.
pub(super) fn begin(file: &mut File) -> io::Result<()> {
    file.write_all(MAGIC)
}

/// Appends a frame with these arrays and rows; it is with the operating system thereafter.
///
/// # Errors
/// If the disk is full or gone, and for numbers that are not finite.
pub(super) fn append(
    file: &mut File,
    chunk: &mut Vec<u8>,
    frame: &Frame,
    arrays: &[u8],
    rows: &[u8],
) -> io::Result<()> {
    let json = serde_json::to_vec(frame)?;
    // What is infinite has no form in JSON.
    if frame.added.is_some() && serde_json::from_slice::<Frame>(&json).is_err() {
        let text = "a number of this scene is too large for an animation";
        return Err(io::Error::new(io::ErrorKind::InvalidInput, text));
    }
    let parts = [&json[..], arrays, rows];
    let mut record = RecordWriter::begin(chunk, file, parts.map(|part| part.len() as u64));
    parts.into_iter().try_for_each(|part| record.push(part))?;
    record.end()
}

/// A whole frame in a file.
#[derive(Debug, Clone, Copy)]
pub(super) struct Place {
    /// Where it begins \[byte\].
    start: u64,
    /// \[byte\]
    lengths: Words,
}

impl Place {
    /// Where its rows begin, and their length \[byte\].
    pub fn rows(&self) -> (u64, u64) {
        let [json, arrays, rows] = self.lengths;
        (self.start + HEAD + json + arrays, rows)
    }

    /// Reads it, and appends its arrays to others. The file is before its rows then.
    pub fn read(&self, file: &mut File, arrays: &mut Vec<u8>) -> io::Result<Frame> {
        let [json_length, arrays_length, _] = self.lengths;
        file.seek(SeekFrom::Start(self.start + HEAD))?;
        let mut json = vec![0; json_length as usize];
        file.read_exact(&mut json)?;
        file.take(arrays_length).read_to_end(arrays)?;
        Ok(serde_json::from_slice(&json)?)
    }
}

/// The whole frames of a file, and how far it is whole; `None` for a file that is no unfinished animation.
pub(super) fn scan(file: &mut File) -> io::Result<Option<(Vec<Place>, Extent)>> {
    let mut places = Vec::new();
    let length = |[json, arrays, rows]: &Words| json.checked_add(*arrays)?.checked_add(*rows);
    let each = |start, words: &Words| places.push(Place { start, lengths: *words });
    let extent = records::scan(file, MAGIC, length, each)?;
    Ok(extent.map(|extent| (places, extent)))
}
