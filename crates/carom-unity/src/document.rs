//! Reads files of Unity as documents, one per object.

use std::path::Path;
use std::rc::Rc;

use crate::error::{ImportError, Place, read_text};
use crate::value::{self, Kind, Value};

/// An object in a file.
#[derive(Debug, Clone)]
pub(crate) struct Document {
    /// Unity's number of the class.
    pub class: u32,
    /// Id of the object in its file.
    pub id: i64,
    /// Whether it stands for an object of a prefab, whose fields are in the prefab's file.
    pub stripped: bool,
    /// Name of the class.
    pub class_name: String,
    /// Fields of the object.
    pub fields: Value,
}

/// Reads all documents of a scene, prefab or asset.
///
/// # Errors
/// [`ImportError`] for a file that cannot be read, is no text, or is broken, with the line.
pub(crate) fn read(path: &Path) -> Result<Vec<Document>, ImportError> {
    let text = read_text(path)?;
    let file: Rc<Path> = path.into();
    let at = |line: usize| Place { file: file.clone(), line };
    let text = text.trim_start_matches('\u{feff}');
    if !text.starts_with("%YAML") {
        return Err(at(1).malformed("is no file of Unity: it must begin with %YAML"));
    }
    let mut documents = Vec::new();
    let mut open: Option<(Document, usize)> = None;
    let mut offset = 0;
    for (index, line) in text.split_inclusive('\n').enumerate() {
        let line_number = index + 1;
        if line.starts_with("<<<<<<< ") {
            return Err(at(line_number).malformed("has a conflict of a merge: solve it first"));
        }
        if line.starts_with("---") {
            if let Some((document, start)) = open.take() {
                documents.push(filled(document, &text[start..offset])?);
            }
            let document = header(line.trim_end(), at(line_number))?;
            open = Some((document, offset + line.len()));
        }
        offset += line.len();
    }
    if let Some((document, start)) = open {
        documents.push(filled(document, &text[start..])?);
    }
    Ok(documents)
}

/// Reads the header of a document, such as `--- !u!4 &123 stripped`; its fields are still empty.
fn header(line: &str, place: Place) -> Result<Document, ImportError> {
    let mut words = line.split(' ').skip(1);
    let class = words.next().and_then(|word| word.strip_prefix("!u!")?.parse().ok());
    let id = words.next().and_then(|word| word.strip_prefix('&')?.parse().ok());
    let stripped = match words.next() {
        None => Some(false),
        Some("stripped") => Some(true),
        Some(_) => None,
    };
    let (Some(class), Some(id), Some(stripped), None) = (class, id, stripped, words.next()) else {
        return Err(place.malformed("must be the head of a document, like `--- !u!4 &123`"));
    };
    let fields = Value { place, kind: Kind::Map(Vec::new()) };
    Ok(Document { class, id, stripped, class_name: String::new(), fields })
}

/// Parses the text of a document and fills in its fields.
fn filled(document: Document, text: &str) -> Result<Document, ImportError> {
    let place = &document.fields.place;
    let whole = value::read(text, &place.file, place.line)?;
    let Some(Value { kind: Kind::Map(classes), .. }) = whole else {
        return Err(place.malformed("the document must hold one object"));
    };
    let Some((class_name, fields)) = classes.into_iter().next() else {
        return Err(place.malformed("the document must hold one object"));
    };
    if !matches!(fields.kind, Kind::Map(_)) {
        return Err(fields.place.malformed(format!("{class_name} must have fields")));
    }
    // The place of the object is that of the header.
    let fields = Value { place: document.fields.place, kind: fields.kind };
    Ok(Document { class_name, fields, ..document })
}
