//! Packed text in addresses: compressed by zlib, in URL-safe base64.

use std::io::{Read, Write};

use base64::Engine;
use base64::engine::general_purpose::URL_SAFE_NO_PAD;
use flate2::Compression;
use flate2::read::ZlibDecoder;
use flate2::write::ZlibEncoder;
use thiserror::Error;

/// Largest unpacked text \[bytes\]: a scene of 50,000 single spheres, which is far more than fits
/// into an address unless it is very repetitive. A TOML parser takes fifty times as much memory.
pub const MAX_UNPACKED: usize = 8 << 20;

/// Why a packed text cannot be unpacked.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
pub enum PackedError {
    /// Part of it is missing or changed.
    #[error("is cut short or garbled; was all of the link copied?")]
    Garbled,
    /// The text is too long.
    #[error("unpacks to more than {} MiB, the limit", MAX_UNPACKED >> 20)]
    TooLarge,
    /// The content is not text.
    #[error("does not unpack to text")]
    NoText,
}

/// Packs a text.
pub fn pack(text: &str) -> String {
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::best());
    // Writing to a vector does not fail.
    let written = encoder.write_all(text.as_bytes()).and_then(|()| encoder.finish());
    URL_SAFE_NO_PAD.encode(written.unwrap_or_default())
}

/// Unpacks a text.
///
/// # Errors
/// [`PackedError`]. Zlib data end with a checksum, so changes are detected.
pub fn unpack(packed: &str) -> Result<String, PackedError> {
    let bytes = URL_SAFE_NO_PAD.decode(packed).map_err(|_| PackedError::Garbled)?;
    let mut decoder = ZlibDecoder::new(bytes.as_slice());
    let mut text = Vec::new();
    let limit = MAX_UNPACKED as u64 + 1;
    decoder.by_ref().take(limit).read_to_end(&mut text).map_err(|_| PackedError::Garbled)?;
    if text.len() > MAX_UNPACKED {
        return Err(PackedError::TooLarge);
    }
    if decoder.total_in() != bytes.len() as u64 {
        return Err(PackedError::Garbled);
    }
    String::from_utf8(text).map_err(|_| PackedError::NoText)
}
