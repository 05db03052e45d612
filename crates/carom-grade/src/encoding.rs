//! Recognises what a file is, and decodes its text.

use std::borrow::Cow;

use encoding_rs::{Encoding, UTF_8, UTF_16BE, UTF_16LE, WINDOWS_1252};

/// Bytes at the start of a file that are looked at.
const LOOKED_AT: usize = 512;

/// Content of a file.
#[derive(Debug)]
pub(crate) enum Content<'a> {
    Text(Cow<'a, str>),
    /// A spreadsheet, as an archive of parts.
    Spreadsheet,
    /// No table, with what it is and what to do.
    Other(&'static str),
}

/// Starts of files that are no tables, at an offset.
const OTHERS: [(usize, &[u8], &str); 12] = [
    (0, b"%PDF", "is a PDF document, not a table"),
    (0, b"\x89PNG", "is a picture, not a table"),
    (0, b"\xff\xd8\xff", "is a photo, not a table"),
    (0, b"GIF8", "is a picture, not a table"),
    (8, b"WEBP", "is a picture, not a table"),
    (4, b"ftypheic", "is a photo, not a table"),
    (4, b"ftyp", "is a film, not a table"),
    (8, b"AVI ", "is a film, not a table"),
    (0, b"\xd0\xcf\x11\xe0", "is an old document of Office; save it as .xlsx or CSV"),
    (0, b"\x1f\x8b", "is packed; unpack it first"),
    (0, b"Rar!", "is packed; unpack it first"),
    (0, b"7z\xbc\xaf", "is packed; unpack it first"),
];

/// Starts of texts that are no tables.
const OTHER_TEXTS: [(&str, &str); 4] = [
    ("<!doctype html", "is a web page, not a table"),
    ("<html", "is a web page, not a table"),
    ("<?xml", "is XML, as the projects of Tracker and Logger Pro; export the table as CSV"),
    ("{\\rtf", "is a text document; save the table as CSV"),
];

/// Recognises what a file is.
pub(crate) fn content(bytes: &[u8]) -> Content<'_> {
    let is_at =
        |start: usize, mark: &[u8]| bytes.get(start..).is_some_and(|it| it.starts_with(mark));
    if is_at(0, b"PK\x03\x04") {
        return Content::Spreadsheet;
    }
    if let Some((_, _, what)) = OTHERS.iter().find(|(start, mark, _)| is_at(*start, mark)) {
        return Content::Other(what);
    }
    let text = decoded(bytes);
    let start = text.trim_start().get(..16).unwrap_or(text.trim_start()).to_lowercase();
    match OTHER_TEXTS.iter().find(|(mark, _)| start.starts_with(mark)) {
        Some((_, what)) => Content::Other(what),
        None => Content::Text(text),
    }
}

/// Decodes UTF-8, UTF-16 with or without a mark, and Latin-1 as Windows extends it.
fn decoded(bytes: &[u8]) -> Cow<'_, str> {
    if let Some((encoding, length)) = Encoding::for_bom(bytes) {
        return encoding.decode_without_bom_handling(&bytes[length..]).0;
    }
    let start = &bytes[..bytes.len().min(LOOKED_AT)];
    let zeros = |first: usize| start.iter().skip(first).step_by(2).filter(|it| **it == 0).count();
    // The digits and letters of a table have a zero as their other byte.
    let is_mostly = |count: usize| count > 0 && 5 * count > 2 * start.len().div_ceil(2);
    let encoding = match (zeros(0), zeros(1)) {
        (0, low) if is_mostly(low) => UTF_16LE,
        (high, 0) if is_mostly(high) => UTF_16BE,
        _ if std::str::from_utf8(bytes).is_ok() => UTF_8,
        _ => WINDOWS_1252,
    };
    encoding.decode_without_bom_handling(bytes).0
}
