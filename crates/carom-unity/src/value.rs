//! Reads YAML as values with their places.

use std::path::Path;
use std::rc::Rc;

use carom::DVec3;
use saphyr_parser::{Event, Parser};

use crate::error::{ImportError, Place};

/// A value of a document.
#[derive(Debug, Clone)]
pub(crate) struct Value {
    /// Place of the value in its file.
    pub place: Place,
    /// Content of the value.
    pub kind: Kind,
}

/// Content of a value.
#[derive(Debug, Clone)]
pub(crate) enum Kind {
    /// The text of a number, a string, or an empty value.
    Text(String),
    /// A list.
    List(Vec<Value>),
    /// Names and values, in the order of the file.
    Map(Vec<(String, Value)>),
}

/// Target of a `{fileID, guid}`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Reference {
    /// Id of the object in its file; 0 for no object.
    pub id: i64,
    /// Guid of the file; `None` for the same file.
    pub guid: Option<String>,
}

impl Value {
    /// Value of a field in a map.
    pub fn get(&self, name: &str) -> Option<&Value> {
        match &self.kind {
            Kind::Map(fields) => fields.iter().find(|(it, _)| it == name).map(|(_, value)| value),
            _ => None,
        }
    }

    /// Items of a list; empty for other values.
    pub fn items(&self) -> &[Value] {
        match &self.kind {
            Kind::List(items) => items,
            _ => &[],
        }
    }

    /// Values of a map; empty for other values.
    pub fn values(&self) -> impl Iterator<Item = &Value> {
        let fields = match &self.kind {
            Kind::Map(fields) => &fields[..],
            _ => &[],
        };
        fields.iter().map(|(_, value)| value)
    }

    /// Text of the value as written.
    pub fn text(&self) -> Option<&str> {
        match &self.kind {
            Kind::Text(text) => Some(text),
            _ => None,
        }
    }

    /// Reads a finite number.
    ///
    /// # Errors
    /// [`ImportError`] at the place of the value; `what` names it.
    pub fn number(&self, what: &str) -> Result<f64, ImportError> {
        let number = self.text().and_then(|text| text.parse::<f64>().ok());
        number.filter(|number| number.is_finite()).ok_or_else(|| self.not(what, "a finite number"))
    }

    /// Reads the numbers of these fields.
    ///
    /// # Errors
    /// The same as those of [`Self::number`], also if a field is missing.
    pub fn numbers<const N: usize>(
        &self,
        what: &str,
        names: [&str; N],
    ) -> Result<[f64; N], ImportError> {
        let mut numbers = [0.0; N];
        for (number, name) in numbers.iter_mut().zip(names) {
            let value = self.get(name).ok_or_else(|| {
                self.place.malformed(format!("{what} must have {}", names.join(", ")))
            })?;
            *number = value.number(&format!("{what}.{name}"))?;
        }
        Ok(numbers)
    }

    /// Reads a vector with the fields x, y, z.
    ///
    /// # Errors
    /// The same as those of [`Self::numbers`].
    pub fn vector(&self, what: &str) -> Result<[f64; 3], ImportError> {
        self.numbers(what, ["x", "y", "z"])
    }

    /// Reads the number of a field; returns `missing` if the field does not exist.
    ///
    /// # Errors
    /// The same as those of [`Self::number`].
    pub fn number_at(&self, name: &str, missing: f64) -> Result<f64, ImportError> {
        self.number_at_either([name; 2], missing)
    }

    /// Reads the number of the first of two fields that exists; versions of Unity use different
    /// names. Returns `missing` if neither exists.
    ///
    /// # Errors
    /// The same as those of [`Self::number`]; errors use the first name.
    pub fn number_at_either(&self, names: [&str; 2], missing: f64) -> Result<f64, ImportError> {
        let value = names.into_iter().find_map(|name| self.get(name));
        value.map_or(Ok(missing), |value| value.number(names[0]))
    }

    /// Reads the vector of a field; returns `missing` if the field does not exist.
    ///
    /// # Errors
    /// The same as those of [`Self::vector`].
    pub fn vector_at(&self, name: &str, missing: DVec3) -> Result<DVec3, ImportError> {
        let value = self.get(name);
        value.map_or(Ok(missing), |value| value.vector(name).map(DVec3::from_array))
    }

    /// Target of the reference; `None` for other values, and for a reference to nothing.
    pub fn reference(&self) -> Option<Reference> {
        let id = self.get("fileID")?.text()?.parse().ok().filter(|&id| id != 0)?;
        let guid = self.get("guid").and_then(Self::text).map(str::to_owned);
        Some(Reference { id, guid })
    }

    /// Approximate memory of the value \[bytes\].
    pub fn size(&self) -> usize {
        let within = match &self.kind {
            Kind::Text(text) => text.len(),
            Kind::List(items) => items.iter().map(Self::size).sum(),
            Kind::Map(fields) => fields.iter().map(|(name, value)| name.len() + value.size()).sum(),
        };
        size_of::<Self>() + within
    }

    /// Changes the ids of all references to the same file.
    pub fn refer(&mut self, change: &impl Fn(i64) -> i64) {
        match &mut self.kind {
            Kind::Text(_) => {}
            Kind::List(items) => items.iter_mut().for_each(|item| item.refer(change)),
            Kind::Map(fields) => {
                let is_foreign = fields.iter().any(|(name, _)| name == "guid");
                for (name, value) in fields {
                    match &mut value.kind {
                        Kind::Text(id) if name == "fileID" && !is_foreign => {
                            let changed = id.parse().ok().filter(|&id| id != 0).map(change);
                            *id = changed.map_or_else(|| id.clone(), |id| id.to_string());
                        }
                        _ => value.refer(change),
                    }
                }
            }
        }
    }

    fn not(&self, what: &str, wanted: &str) -> ImportError {
        let found = match &self.kind {
            Kind::Text(text) => format!("\"{}\"", text.chars().take(40).collect::<String>()),
            Kind::List(_) => "a list".to_owned(),
            Kind::Map(_) => "a table".to_owned(),
        };
        self.place.malformed(format!("{what} must be {wanted}, not {found}"))
    }
}

/// A list or map that is not yet complete.
struct Unfinished {
    value: Value,
    /// Name of the next value in a map.
    name: Option<String>,
}

/// Reads one YAML document that starts after `lines_before` lines of `file`.
///
/// # Errors
/// [`ImportError`] for text that is no YAML, for aliases, and for values nested more than 64 deep.
pub(crate) fn read(
    text: &str,
    file: &Rc<Path>,
    lines_before: usize,
) -> Result<Option<Value>, ImportError> {
    const DEEPEST: usize = 64;
    let mut open: Vec<Unfinished> = Vec::new();
    for event in Parser::new_from_str(text) {
        let (event, span) = event.map_err(|error| {
            let line = lines_before + error.marker().line();
            Place { file: file.clone(), line }.malformed(format!("is no YAML: {}", error.info()))
        })?;
        let place = Place { file: file.clone(), line: lines_before + span.start.line() };
        let mut whole = match event {
            Event::Scalar(text, ..) => Value { place, kind: Kind::Text(text.into_owned()) },
            Event::SequenceStart(..) | Event::MappingStart(..) => {
                if open.len() == DEEPEST {
                    return Err(place.malformed("has values more than 64 deep in each other"));
                }
                let kind = match event {
                    Event::SequenceStart(..) => Kind::List(Vec::new()),
                    _ => Kind::Map(Vec::new()),
                };
                open.push(Unfinished { value: Value { place, kind }, name: None });
                continue;
            }
            Event::SequenceEnd | Event::MappingEnd => match open.pop() {
                Some(finished) => finished.value,
                None => continue,
            },
            Event::Alias(..) => {
                return Err(place.malformed("has an alias, which Unity never writes"));
            }
            _ => continue,
        };
        let Some(around) = open.last_mut() else { return Ok(Some(whole)) };
        match &mut around.value.kind {
            Kind::List(items) => items.push(whole),
            Kind::Map(fields) => match around.name.take() {
                Some(name) => fields.push((name, whole)),
                None => match &mut whole.kind {
                    Kind::Text(name) => around.name = Some(std::mem::take(name)),
                    _ => return Err(whole.place.malformed("has a name that is no text")),
                },
            },
            Kind::Text(_) => {}
        }
    }
    Ok(None)
}
