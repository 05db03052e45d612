//! Bytes of the file layer of GSD. All numbers are little-endian.

/// First word of every file.
pub(super) const MAGIC: u64 = 0x65DF_65DF_65DF_65DF;
/// Length of the header \[byte\].
pub(super) const HEADER: usize = 256;
/// Length of an entry of the index \[byte\].
pub(super) const ENTRY: usize = 32;
/// Length of a segment of the list of names \[byte\].
pub(super) const SEGMENT: usize = 64;
/// Length of the names of application and schema \[byte\].
const NAME: usize = 64;

/// Returns a version of two numbers as one.
pub(super) const fn version(major: u32, minor: u32) -> u32 {
    major << 16 | minor
}

/// The header of a file.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Header {
    /// Position of the index \[byte\].
    pub index: u64,
    /// Number of entries that the index has room for.
    pub entries: u64,
    /// Position of the list of names \[byte\].
    pub names: u64,
    /// Number of segments of the list of names.
    pub segments: u64,
    /// Version of the schema.
    pub schema_version: u32,
    /// Version of the file layer.
    pub version: u32,
    /// Program that wrote the file.
    pub application: String,
    /// Name of the schema.
    pub schema: String,
}

impl Header {
    pub fn to_bytes(&self) -> [u8; HEADER] {
        let mut bytes = [0; HEADER];
        let words = [MAGIC, self.index, self.entries, self.names, self.segments];
        for (place, word) in bytes.chunks_exact_mut(8).zip(words) {
            place.copy_from_slice(&word.to_le_bytes());
        }
        bytes[40..44].copy_from_slice(&self.schema_version.to_le_bytes());
        bytes[44..48].copy_from_slice(&self.version.to_le_bytes());
        for (start, text) in [(48, &self.application), (48 + NAME, &self.schema)] {
            // The last byte stays 0.
            let text = text.as_bytes();
            let length = text.len().min(NAME - 1);
            bytes[start..start + length].copy_from_slice(&text[..length]);
        }
        bytes
    }

    /// Reads a header; `None` if the file is no GSD file.
    pub fn parse(bytes: &[u8; HEADER]) -> Option<Self> {
        let name = |start: usize| {
            let text = bytes[start..start + NAME].split(|&byte| byte == 0).next();
            String::from_utf8_lossy(text.unwrap_or_default()).into_owned()
        };
        (word(bytes, 0) == MAGIC).then(|| Self {
            index: word(bytes, 8),
            entries: word(bytes, 16),
            names: word(bytes, 24),
            segments: word(bytes, 32),
            schema_version: word(bytes, 40) as u32,
            version: (word(bytes, 40) >> 32) as u32,
            application: name(48),
            schema: name(48 + NAME),
        })
    }
}

/// Where a chunk of data stands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Entry {
    pub frame: u64,
    /// Number of rows.
    pub rows: u64,
    /// Position of the data \[byte\]; 0 ends the index.
    pub position: u64,
    /// Number of columns.
    pub columns: u32,
    /// Number of the name.
    pub name: u16,
    pub kind: u8,
    pub flags: u8,
}

impl Entry {
    pub fn to_bytes(self) -> [u8; ENTRY] {
        let mut bytes = [0; ENTRY];
        for (place, word) in bytes.chunks_exact_mut(8).zip([self.frame, self.rows, self.position]) {
            place.copy_from_slice(&word.to_le_bytes());
        }
        bytes[24..28].copy_from_slice(&self.columns.to_le_bytes());
        bytes[28..30].copy_from_slice(&self.name.to_le_bytes());
        bytes[30..].copy_from_slice(&[self.kind, self.flags]);
        bytes
    }

    pub fn parse(bytes: &[u8; ENTRY]) -> Self {
        let last = word(bytes, 24);
        Self {
            frame: word(bytes, 0),
            rows: word(bytes, 8),
            position: word(bytes, 16),
            columns: last as u32,
            name: (last >> 32) as u16,
            kind: bytes[30],
            flags: bytes[31],
        }
    }

    /// Length of the data \[byte\]; `None` for a kind of numbers that does not exist, or if it
    /// overflows.
    pub fn length(&self) -> Option<u64> {
        let count = self.rows.checked_mul(u64::from(self.columns))?;
        count.checked_mul(width(self.kind)?)
    }
}

/// Length of a number of a kind \[byte\].
pub(super) fn width(kind: u8) -> Option<u64> {
    match kind {
        1 | 5 | 11 => Some(1),
        2 | 6 => Some(2),
        3 | 7 | 9 => Some(4),
        4 | 8 | 10 => Some(8),
        _ => None,
    }
}

/// Returns the word at a position.
fn word(bytes: &[u8], position: usize) -> u64 {
    let word = bytes[position..].first_chunk().copied().unwrap_or_default();
    u64::from_le_bytes(word)
}
