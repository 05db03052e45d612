//! The index of a GSD file, and the chunks that it names.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom};

use super::chunk::Chunk;
use super::layout::{ENTRY, Entry, HEADER, Header, SEGMENT, version};
use crate::recording::particles::error::{Problem, shown};

/// Why a part of the file is not read.
#[derive(Debug)]
pub(super) enum Fault {
    Problem(Problem),
    Io(io::Error),
}

impl<T: Into<Problem>> From<T> for Fault {
    fn from(problem: T) -> Self {
        Self::Problem(problem.into())
    }
}

/// The chunks of a file.
#[derive(Debug)]
pub(super) struct Chunks {
    file: File,
    /// Length of the file \[byte\].
    length: u64,
    names: BTreeMap<String, u16>,
    /// Entries by frame and number of the name.
    index: BTreeMap<(u64, u16), Entry>,
}

impl Chunks {
    /// Reads the index of a file, and checks that it has the schema of HOOMD-blue.
    pub fn open(mut file: File) -> Result<Self, Fault> {
        let length = file.metadata().map_err(Fault::Io)?.len();
        let mut bytes = [0; HEADER];
        let header = match file.read_exact(&mut bytes) {
            Ok(()) => Header::parse(&bytes),
            Err(error) if error.kind() == io::ErrorKind::UnexpectedEof => None,
            Err(error) => return Err(Fault::Io(error)),
        };
        let header = header.ok_or("is no GSD file")?;
        if !(version(1, 0)..version(3, 0)).contains(&header.version) {
            return Err(
                format!("version {} of GSD is not read", shown_version(header.version)).into()
            );
        }
        if header.schema != "hoomd" {
            let schema = shown(&header.schema);
            return Err(format!("its schema is {schema}, expected \"hoomd\"").into());
        }
        if !(version(1, 0)..version(3, 0)).contains(&header.schema_version) {
            let version = shown_version(header.schema_version);
            return Err(format!("version {version} of the schema of HOOMD is not read").into());
        }
        let mut chunks = Self { file, length, names: BTreeMap::new(), index: BTreeMap::new() };
        chunks.read_names(&header)?;
        chunks.read_index(&header)?;
        Ok(chunks)
    }

    /// Number of frames.
    pub fn frames(&self) -> u64 {
        self.index.keys().next_back().map_or(0, |(frame, _)| frame + 1)
    }

    fn read_names(&mut self, header: &Header) -> Result<(), Fault> {
        let length = header.segments.checked_mul(SEGMENT as u64);
        let bytes =
            self.bytes(header.names, length).map_err(|fault| about("its list of names", fault))?;
        let names: Vec<&[u8]> = match header.version < version(2, 0) {
            true => {
                bytes.chunks(SEGMENT).filter_map(|it| it.split(|&byte| byte == 0).next()).collect()
            }
            false => bytes.split(|&byte| byte == 0).collect(),
        };
        let names = names.into_iter().take_while(|name| !name.is_empty());
        let names = names.map(|name| String::from_utf8_lossy(name).into_owned());
        self.names = names.zip(0..=u16::MAX).collect();
        Ok(())
    }

    fn read_index(&mut self, header: &Header) -> Result<(), Fault> {
        let length = header.entries.checked_mul(ENTRY as u64);
        let bytes = self.bytes(header.index, length).map_err(|fault| about("its index", fault))?;
        let (entries, _) = bytes.as_chunks::<ENTRY>();
        for (number, bytes) in entries.iter().enumerate() {
            let entry = Entry::parse(bytes);
            if entry.position == 0 {
                break;
            }
            let end = entry.length().and_then(|length| length.checked_add(entry.position));
            // As the library of GSD checks it: there is an entry for each frame at least.
            let is_right = end.is_some_and(|end| end <= self.length)
                && entry.frame < header.entries
                && usize::from(entry.name) < self.names.len()
                && entry.flags == 0;
            if !is_right {
                return Err(format!("entry {number} of its index is invalid").into());
            }
            self.index.insert((entry.frame, entry.name), entry);
        }
        Ok(())
    }

    /// Reads a part of the file.
    fn bytes(&mut self, position: u64, length: Option<u64>) -> Result<Vec<u8>, Fault> {
        let end = length.and_then(|length| position.checked_add(length));
        let length = length.filter(|_| end.is_some_and(|end| end <= self.length));
        let length = length.ok_or("reaches beyond the end of the file")?;
        self.file.seek(SeekFrom::Start(position)).map_err(Fault::Io)?;
        let mut bytes = vec![0; length as usize];
        self.file.read_exact(&mut bytes).map_err(Fault::Io)?;
        Ok(bytes)
    }

    /// Reads a chunk; `None` if the frame does not have it.
    pub fn read(&mut self, frame: u64, name: &str) -> Result<Option<Chunk>, Fault> {
        let entry = self.names.get(name).and_then(|&name| self.index.get(&(frame, name)));
        let Some(&entry) = entry else { return Ok(None) };
        let bytes = self.bytes(entry.position, entry.length())?;
        let Entry { rows, columns, kind, .. } = entry;
        Ok(Some(Chunk { rows, columns, kind, bytes }))
    }
}

/// Says which part of the file is wrong.
fn about(part: &str, fault: Fault) -> Fault {
    match fault {
        Fault::Problem(Problem(problem)) => format!("{part} {problem}").into(),
        fault => fault,
    }
}

fn shown_version(version: u32) -> String {
    format!("{}.{}", version >> 16, version & 0xFFFF)
}
