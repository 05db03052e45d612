//! The container of .glb files: a header, the JSON, and the binary part.

use std::io::{self, Write};

const MAGIC: [u8; 4] = *b"glTF";
const VERSION: u32 = 2;
const JSON: [u8; 4] = *b"JSON";
const BINARY: [u8; 4] = *b"BIN\0";

/// Length of the headers of a file and of two chunks \[bytes\].
const HEADS: u64 = 12 + 8 + 8;

/// Writes the header of a file, its JSON, and the header of its binary part, whose length is a
/// multiple of 4.
///
/// # Errors
/// [`io::Error`] if the disk is full or gone, or if the file is larger than 4 GiB, which its length
/// cannot express.
pub(crate) fn write_head(out: &mut impl Write, json: &[u8], binary_len: u64) -> io::Result<()> {
    let json_len = json.len().next_multiple_of(4);
    let heads = if binary_len == 0 { HEADS - 8 } else { HEADS };
    let whole = heads + json_len as u64 + binary_len;
    let whole = u32::try_from(whole).map_err(|_| too_large())?;
    out.write_all(&MAGIC)?;
    for word in [VERSION, whole, json_len as u32] {
        out.write_all(&word.to_le_bytes())?;
    }
    out.write_all(&JSON)?;
    out.write_all(json)?;
    out.write_all(&b"   "[..json_len - json.len()])?;
    if binary_len == 0 {
        return Ok(());
    }
    out.write_all(&(binary_len as u32).to_le_bytes())?;
    out.write_all(&BINARY)
}

/// Error of a file that is too large.
pub(crate) fn too_large() -> io::Error {
    let text = "a .glb file has room for 4 GiB: write fewer frames (--every)";
    io::Error::new(io::ErrorKind::FileTooLarge, text)
}

/// Whether the bytes start a .glb file.
pub(crate) fn is_glb(bytes: &[u8]) -> bool {
    bytes.starts_with(&MAGIC)
}

/// Returns the JSON and the binary part of a file.
///
/// # Errors
/// A description of what is wrong with the file.
pub(crate) fn read(bytes: &[u8]) -> Result<(&[u8], Option<&[u8]>), String> {
    let word = |at: usize| -> Option<u32> {
        Some(u32::from_le_bytes(bytes.get(at..at.checked_add(4)?)?.try_into().ok()?))
    };
    let [Some(version), Some(len)] = [word(4), word(8)] else {
        return Err("ends in its head".to_owned());
    };
    if version != VERSION {
        return Err(format!("has version {version} of the container; 2 is read"));
    }
    if (len as usize) > bytes.len() {
        return Err(format!("is cut off: it has {} of its {len} bytes", bytes.len()));
    }
    let (mut json, mut binary) = (None, None);
    let mut at = 12;
    while at < len as usize {
        let kind = bytes.get(at + 4..at + 8);
        let (Some(size), Some(kind)) = (word(at), kind) else {
            return Err("ends in the head of a chunk".to_owned());
        };
        let chunk = bytes.get(at + 8..(at + 8).saturating_add(size as usize));
        let Some(chunk) = chunk else {
            return Err(format!("has a chunk of {size} bytes that is cut off"));
        };
        if kind == JSON {
            json = json.or(Some(chunk));
        } else if kind == BINARY {
            binary = binary.or(Some(chunk));
        }
        at += 8 + (size as usize).next_multiple_of(4);
    }
    Ok((json.ok_or("has no JSON")?, binary))
}
