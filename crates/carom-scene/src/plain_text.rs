//! Reads text files, and recognizes files that are not text.

use thiserror::Error;

/// Why a file cannot be read as text.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
pub enum NotText {
    /// The file starts like one of a known binary format.
    #[error("it begins like {kind}, and is not text")]
    OfKind {
        /// The format, with an article.
        kind: &'static str,
    },
    /// They are text in another encoding.
    #[error("it is text in UTF-16: save it in UTF-8")]
    Utf16,
    /// The file contains a byte that is not valid UTF-8, or zero.
    #[error("it is not text in UTF-8 (byte {position} of it is {byte:#04x})")]
    Byte {
        /// Position of the byte, from 1.
        position: usize,
        /// Value of the byte.
        byte: u8,
    },
}

/// Binary formats that people may keep beside their scenes: offset and bytes of the signature, and
/// name. The first match counts.
const BEGINNINGS: [(usize, &[u8], &str); 13] = [
    (0, b"\x89PNG", "a PNG picture"),
    (0, b"\xff\xd8\xff", "a JPEG picture"),
    (0, b"GIF8", "a GIF picture"),
    (8, b"WEBP", "a WebP picture"),
    (4, b"ftyphei", "a HEIC picture"),
    (4, b"ftypavif", "an AVIF picture"),
    (4, b"ftyp", "a film (MP4)"),
    (0, b"II*\0", "a TIFF picture"),
    (0, b"MM\0*", "a TIFF picture"),
    (0, b"%PDF-", "a PDF document"),
    (0, b"PK\x03\x04", "a ZIP archive (.npz is one)"),
    (0, b"\x1f\x8b", "a compressed file (gzip)"),
    (0, b"glTF", "an animation or a scene in glTF (.glb)"),
];

/// Recognizes a file that is not text by its first bytes.
fn kind_of(bytes: &[u8]) -> Option<NotText> {
    if bytes.starts_with(b"\xff\xfe") || bytes.starts_with(b"\xfe\xff") {
        return Some(NotText::Utf16);
    }
    let begins = |&&(offset, start, _): &&(usize, &[u8], &str)| {
        bytes.get(offset..).is_some_and(|rest| rest.starts_with(start))
    };
    BEGINNINGS.iter().find(begins).map(|&(_, _, kind)| NotText::OfKind { kind })
}

/// Converts the bytes of a file to text in UTF-8.
///
/// ```
/// use carom_scene::text_of;
///
/// assert_eq!(text_of(b"radius = 1".to_vec())?, "radius = 1");
/// let error = text_of(b"\x89PNG\r\n\x1a\n\0\0".to_vec()).unwrap_err();
/// assert_eq!(error.to_string(), "it begins like a PNG picture, and is not text");
/// # Ok::<(), carom_scene::NotText>(())
/// ```
///
/// # Errors
/// [`NotText`]; also for a byte of zero, which no text contains.
pub fn text_of(bytes: Vec<u8>) -> Result<String, NotText> {
    if let Some(kind) = kind_of(&bytes) {
        return Err(kind);
    }
    let at = |index: usize, bytes: &[u8]| NotText::Byte { position: index + 1, byte: bytes[index] };
    if let Some(zero) = bytes.iter().position(|&byte| byte == 0) {
        return Err(at(zero, &bytes));
    }
    String::from_utf8(bytes).map_err(|error| at(error.utf8_error().valid_up_to(), error.as_bytes()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_and_archives_are_named_and_not_read() {
        for (bytes, kind) in [
            (&b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR"[..], "a PNG picture"),
            (b"\xff\xd8\xff\xe0\0\x10JFIF", "a JPEG picture"),
            (b"GIF89a", "a GIF picture"),
            (b"RIFF\x10\0\0\0WEBPVP8 ", "a WebP picture"),
            (b"\0\0\0\x18ftypheic", "a HEIC picture"),
            (b"\0\0\0\x18ftypmp42", "a film (MP4)"),
            (b"%PDF-1.7\n", "a PDF document"),
            (b"PK\x03\x04\x14\0", "a ZIP archive (.npz is one)"),
            (b"glTF\x02\0\0\0", "an animation or a scene in glTF (.glb)"),
        ] {
            assert_eq!(text_of(bytes.to_vec()), Err(NotText::OfKind { kind }));
        }
    }

    #[test]
    fn text_of_another_encoding_and_stray_bytes_are_told() {
        let utf16: Vec<u8> = "\u{feff}name".encode_utf16().flat_map(u16::to_le_bytes).collect();
        assert_eq!(text_of(utf16), Err(NotText::Utf16));
        let latin1 = text_of(b"name = \"fl\xe4che\"".to_vec()).unwrap_err();
        assert_eq!(latin1.to_string(), "it is not text in UTF-8 (byte 11 of it is 0xe4)");
        assert_eq!(text_of(b"a\0".to_vec()), Err(NotText::Byte { position: 2, byte: 0 }));
        for text in ["", "name = \"fläche\"", "GI = 1", "P"] {
            assert_eq!(text_of(text.as_bytes().to_vec()).as_deref(), Ok(text));
        }
    }
}
