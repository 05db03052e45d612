//! Writes GSD files.

use std::fs::{File, OpenOptions};
use std::io::{self, Seek, SeekFrom, Write};
use std::path::Path;

use super::hoomd;
use super::layout::{ENTRY, Entry, HEADER, Header, SEGMENT, version};
use crate::recording::particles::frame::ParticleFrame;
use crate::unfinished::create_folders_of;
#[cfg(unix)]
use crate::unfinished::lock;

/// Number of entries that the first index has room for.
const FIRST_ENTRIES: u64 = 128;

/// A GSD file that grows frame by frame. The entries of a frame are written after its data, so that
/// the index always has whole frames.
#[derive(Debug)]
pub(in crate::recording::particles) struct GsdWriter {
    file: File,
    header: Header,
    entries: Vec<u8>,
    /// Position after the last data \[byte\].
    end: u64,
    frames: u64,
    /// Whether frames have rotations; the first frame decides.
    has_rotation: bool,
    /// Places in [`hoomd::NAMES`] of the chunks of the first frame, in the order of their numbers.
    places: Vec<usize>,
}

impl GsdWriter {
    /// Creates the file, and missing folders above it.
    pub fn create(path: &Path) -> io::Result<Self> {
        create_folders_of(path)?;
        // The old content stays until the lock shows that no other run writes the file.
        let mut file = OpenOptions::new().write(true).create(true).truncate(false).open(path)?;
        #[cfg(unix)]
        if file.metadata()?.is_file() {
            lock(&file)?;
        }
        file.set_len(0)?;
        // A name that begins with 0 ends the list, which is empty until the first frame.
        let names = (hoomd::NAMES.join("\0").len() + 2).next_multiple_of(SEGMENT);
        let index = HEADER as u64;
        let names_at = index + FIRST_ENTRIES * ENTRY as u64;
        let header = Header {
            index,
            entries: FIRST_ENTRIES,
            names: names_at,
            segments: (names / SEGMENT) as u64,
            schema_version: version(1, 4),
            version: version(2, 0),
            application: format!("carom {}", env!("CARGO_PKG_VERSION")),
            schema: "hoomd".to_owned(),
        };
        let mut start = header.to_bytes().to_vec();
        start.resize(names_at as usize + names, 0);
        file.write_all(&start)?;
        let end = start.len() as u64;
        let (entries, places) = (Vec::new(), Vec::new());
        Ok(Self { file, header, entries, end, frames: 0, has_rotation: false, places })
    }

    /// Appends a frame.
    ///
    /// # Errors
    /// [`io::Error`] if the disk is full or gone; the file then ends with the frame before.
    pub fn push(&mut self, frame: &ParticleFrame) -> io::Result<()> {
        let frame_has_rotation = frame.angular_velocities.is_some();
        if self.frames == 0 {
            self.has_rotation = frame_has_rotation;
        }
        let whole = self.end;
        self.append(frame).inspect_err(|_| {
            // An error is being reported.
            self.file.set_len(whole).ok();
        })
    }

    fn append(&mut self, frame: &ParticleFrame) -> io::Result<()> {
        let (mut data, mut added) = (Vec::new(), Vec::new());
        let chunks = hoomd::chunks(frame, self.frames, self.has_rotation);
        if self.frames == 0 {
            self.places = chunks.iter().map(|(place, _)| *place).collect();
            self.write_names()?;
        }
        for (place, chunk) in chunks {
            let Some(name) = self.places.iter().position(|it| *it == place) else { continue };
            let entry = Entry {
                frame: self.frames,
                rows: chunk.rows,
                position: self.end + data.len() as u64,
                columns: chunk.columns,
                name: name as u16,
                kind: chunk.kind,
                flags: 0,
            };
            added.extend(entry.to_bytes());
            data.extend(chunk.bytes);
        }
        self.file.seek(SeekFrom::Start(self.end))?;
        self.file.write_all(&data)?;
        let mut end = self.end + data.len() as u64;
        let used = self.entries.len();
        let needed = ((used + added.len()) / ENTRY) as u64;
        // Readers find the end of the index by an entry of zeros.
        if needed < self.header.entries {
            self.file.seek(SeekFrom::Start(self.header.index + used as u64))?;
            self.file.write_all(&added)?;
        } else {
            end = self.write_longer_index(end, &added, needed)?;
        }
        self.entries.extend(added);
        self.end = end;
        self.frames += 1;
        Ok(())
    }

    /// Writes the names of the chunks of the first frame. Other programs fail at names that no chunk
    /// of that frame has.
    fn write_names(&mut self) -> io::Result<()> {
        let names: Vec<&str> = self.places.iter().map(|&place| hoomd::NAMES[place]).collect();
        self.file.seek(SeekFrom::Start(self.header.names))?;
        self.file.write_all(names.join("\0").as_bytes())
    }

    /// Writes an index with more room after the data, then the header that names it. Returns where
    /// the file ends.
    fn write_longer_index(&mut self, end: u64, added: &[u8], needed: u64) -> io::Result<u64> {
        let entries = 2 * needed;
        let mut index = self.entries.clone();
        index.extend(added);
        index.resize(entries as usize * ENTRY, 0);
        self.file.write_all(&index)?;
        let header = Header { index: end, entries, ..self.header.clone() };
        self.file.seek(SeekFrom::Start(0))?;
        self.file.write_all(&header.to_bytes())?;
        self.header = header;
        Ok(end + index.len() as u64)
    }
}
