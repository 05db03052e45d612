//! Reads glTF files with their buffers.

use std::cell::{Cell, OnceCell};
use std::fs;
use std::io::{self, Read};
use std::path::{Component, Path, PathBuf};

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use carom_scene::import::plain_name;
use percent_encoding::percent_decode_str;

use super::error::{ImportError, Malformed};
use crate::document::Document;
use crate::glb;

/// Largest size of a file, and of all buffers together \[bytes\].
const LARGEST: u64 = 1 << 30;
/// Largest size of the JSON \[bytes\]; its content takes many times as much memory.
const LARGEST_JSON: usize = 64 << 20;
/// Most numbers that are read for all meshes, because many meshes may use the same bytes.
const MOST_NUMBERS: usize = 100_000_000;

/// A glTF file. Files of its buffers are read when they are first needed.
pub(super) struct File {
    pub document: Document,
    folder: PathBuf,
    /// The binary part of a .glb file.
    binary: Option<Vec<u8>>,
    buffers: Vec<OnceCell<Vec<u8>>>,
    /// Remaining budget of bytes and numbers.
    bytes_left: Cell<u64>,
    numbers_left: Cell<usize>,
}

impl File {
    /// Reads a file.
    pub fn read(path: &Path) -> Result<Self, ImportError> {
        let unreadable = |source| ImportError::Unreadable { path: path.to_path_buf(), source };
        let whole = path.canonicalize().map_err(unreadable)?;
        let bytes = read_bounded(&whole, LARGEST).map_err(unreadable)?;
        let malformed = |place: &str, problem: String| Malformed::at(place, problem).in_file(path);
        let (json, binary) = if glb::is_glb(&bytes) {
            glb::read(&bytes).map_err(|problem| malformed("container", problem))?
        } else {
            (&bytes[..], None)
        };
        if json.len() > LARGEST_JSON {
            return Err(malformed("JSON", "is larger than 64 MiB".to_owned()));
        }
        let document = parse(json).map_err(|fault| fault.in_file(path))?;
        let buffers = document.buffers.iter().map(|_| OnceCell::new()).collect();
        let folder = whole.parent().unwrap_or(Path::new("/")).to_path_buf();
        let binary = binary.map(ToOwned::to_owned);
        let (bytes_left, numbers_left) = (Cell::new(LARGEST), Cell::new(MOST_NUMBERS));
        Ok(Self { document, folder, binary, buffers, bytes_left, numbers_left })
    }

    /// Takes `count` numbers from the budget; returns whether it was sufficient.
    pub fn take_numbers(&self, count: usize) -> bool {
        let left = self.numbers_left.get().checked_sub(count);
        self.numbers_left.set(left.unwrap_or(0));
        left.is_some()
    }

    /// Returns the bytes of a buffer, as many as its length states.
    pub fn buffer(&self, index: usize) -> Result<&[u8], Malformed> {
        let place = || format!("buffers[{index}]");
        let missing = || Malformed::at(place(), "is not there");
        let buffer = self.document.buffers.get(index).ok_or_else(missing)?;
        let cell = self.buffers.get(index).ok_or_else(missing)?;
        let bytes = match (&buffer.uri, &self.binary) {
            (None, Some(binary)) if index == 0 => binary,
            (None, _) => return Err(Malformed::at(place(), "has no bytes")),
            (Some(uri), _) => match cell.get() {
                Some(bytes) => bytes,
                None => {
                    let bytes = self.load(uri).map_err(|it| Malformed::at(place() + ".uri", it))?;
                    cell.get_or_init(|| bytes)
                }
            },
        };
        let bytes = usize::try_from(buffer.byte_length).ok().and_then(|len| bytes.get(..len));
        let has_less = || Malformed::at(place(), "is shorter than its byteLength");
        bytes.ok_or_else(has_less)
    }

    /// Reads the bytes of an address: from itself, or from a file in the folder of the glTF file or
    /// below.
    fn load(&self, uri: &str) -> Result<Vec<u8>, String> {
        if let Some(data) = uri.strip_prefix("data:") {
            let (_, bytes) = data.split_once(";base64,").ok_or("holds no base64")?;
            return STANDARD.decode(bytes).map_err(|error| format!("is no base64: {error}"));
        }
        let name = percent_decode_str(uri).decode_utf8().map_err(|_| "is no UTF-8")?;
        let relative = Path::new(name.as_ref());
        let stays = relative.components().all(|it| matches!(it, Component::Normal(_)));
        if !stays || name.contains(['\\', ':']) || name.is_empty() {
            return Err(format!("{} is no file in the folder of the scene", plain_name(&name)));
        }
        let unreadable = |error| format!("cannot read {}: {error}", plain_name(&name));
        let whole = self.folder.join(relative).canonicalize().map_err(unreadable)?;
        // A symbolic link may lead elsewhere.
        if !whole.starts_with(&self.folder) {
            return Err(format!("{} is no file in the folder of the scene", plain_name(&name)));
        }
        let bytes = read_bounded(&whole, self.bytes_left.get()).map_err(unreadable)?;
        self.bytes_left.set(self.bytes_left.get().saturating_sub(bytes.len() as u64));
        Ok(bytes)
    }
}

/// Reads a file of at most `most` bytes.
fn read_bounded(path: &Path, most: u64) -> io::Result<Vec<u8>> {
    // Opening a pipe would wait for its writer.
    if !fs::metadata(path)?.is_file() {
        return Err(io::Error::other("is no file"));
    }
    let mut bytes = Vec::new();
    // A file may grow while it is read; some files have length 0 but no end.
    fs::File::open(path)?.take(most.saturating_add(1)).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > most {
        return Err(io::Error::other("is larger than 1 GiB, or all buffers together are"));
    }
    Ok(bytes)
}

fn parse(json: &[u8]) -> Result<Document, Malformed> {
    let mut reader = serde_json::Deserializer::from_slice(json);
    let document: Document = serde_path_to_error::deserialize(&mut reader).map_err(|error| {
        let path = error.path().to_string();
        let error = error.into_inner();
        let line = format!("line {}", error.line());
        // The parser writes a question mark for an unknown part of the path.
        let path = path.trim_end_matches(['.', '?']);
        let place = if path.is_empty() { line } else { format!("{line}, {}", plain_name(path)) };
        let text = error.to_string();
        let text = text.rsplit_once(" at line ").map_or(&text[..], |(text, _)| text);
        Malformed::at(place, plain_name(text))
    })?;
    reader.end().map_err(|error| {
        Malformed::at(format!("line {}", error.line()), "there is more after the end")
    })?;
    match &document.asset {
        Some(asset) if asset.version.starts_with("2.") => Ok(document),
        Some(asset) => {
            let problem = format!("is {}; 2.0 is read", plain_name(&asset.version));
            Err(Malformed::at("asset.version", problem))
        }
        None => Err(Malformed::at("asset", "is missing: this is no glTF")),
    }
}
