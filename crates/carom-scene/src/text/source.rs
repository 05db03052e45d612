//! Text of one file, and the lines of its fields.

use serde::de::DeserializeOwned;
use toml::de::{DeTable, DeValue};
use toml::{Spanned, Table, Value};

use crate::error::{Fault, segments};
use crate::wording::{slip_of_syntax, suggestion, without_list};

/// Text of a scene file, or of a part of one.
#[derive(Debug, Clone)]
pub(super) struct SourceText {
    /// Name of the text in errors.
    pub name: String,
    pub text: String,
    /// Parsed content.
    pub table: Table,
}

impl SourceText {
    /// Parses a text as TOML.
    pub fn new(name: &str, text: &str) -> Result<Self, Fault> {
        let table = toml::from_str(text).map_err(|error| of_syntax(name, text, &error))?;
        Ok(Self { name: name.to_owned(), text: text.to_owned(), table })
    }

    /// Creates a fault at the line of a field.
    pub fn fault(&self, field: &str, problem: &str) -> Fault {
        let place: Vec<String> = segments(field);
        fault(&self.name, self.line_of(&place).map(|(line, _)| line), field, problem)
    }

    /// Finds the line of the value at `path`, or of the nearest value around it in this text. Also
    /// returns how many steps of the path exist.
    pub fn line_of(&self, path: &[String]) -> Option<(usize, usize)> {
        let document = DeTable::parse(&self.text).ok()?;
        let (first, rest) = path.split_first()?;
        let (key, mut place) = document.get_ref().get_key_value(first.as_str())?;
        let mut found = (line_at(&self.text, key.span().start), 1);
        for name in rest {
            let next = match place.get_ref() {
                DeValue::Table(table) => {
                    table.get_key_value(name.as_str()).map(|(key, value)| (key.span(), value))
                }
                DeValue::Array(array) => {
                    let element = name.parse().ok().and_then(|i: usize| array.get(i));
                    element.map(|value| (value.span(), value))
                }
                _ => None,
            };
            let Some((span, value)) = next else { break };
            found = (line_at(&self.text, span.start), found.1 + 1);
            place = value;
        }
        Some(found)
    }
}

/// Deserializes a text in TOML as scene files are, so that a program holds the code of each type once.
///
/// # Errors
/// The line, and what is wrong there.
pub fn from_toml_text<T: DeserializeOwned>(text: &str) -> Result<T, (usize, String)> {
    let source =
        SourceText::new("", text).map_err(|fault| (fault.line.unwrap_or(1), fault.problem))?;
    serde_path_to_error::deserialize(Value::Table(source.table.clone())).map_err(|error| {
        let place = source.line_of(&segments(&error.path().to_string()));
        (place.map_or(1, |(line, _)| line), error.into_inner().message().to_owned())
    })
}

/// Converts a syntax error of the TOML parser.
pub(super) fn of_syntax(name: &str, text: &str, error: &toml::de::Error) -> Fault {
    let Some(span) = error.span() else {
        let place = DeTable::parse(text).ok().and_then(|it| too_large_in(it.get_ref()));
        let line = place.map(|offset| line_at(text, offset));
        return fault(name, line, "", line.map_or(error.message(), |_| TOO_LARGE));
    };
    let problem = slip_of_syntax(text, span.start, error.message());
    let problem = problem.as_deref().unwrap_or(error.message());
    fault(name, Some(line_at(text, span.start)), "", problem)
}

/// Problem of an integer that the parser refuses without giving its place.
const TOO_LARGE: &str = "the integer is too large: 9223372036854775807 is the largest";

/// Position of the first integer that does not fit into 64 bits with a sign.
fn too_large_in(table: &DeTable) -> Option<usize> {
    table.iter().find_map(|(_, value)| too_large(value))
}

fn too_large(value: &Spanned<DeValue>) -> Option<usize> {
    match value.get_ref() {
        DeValue::Integer(it) => {
            i64::from_str_radix(it.as_str(), it.radix()).is_err().then(|| value.span().start)
        }
        DeValue::Array(values) => values.iter().find_map(too_large),
        DeValue::Table(table) => too_large_in(table),
        _ => None,
    }
}

pub(super) fn fault(name: &str, line: Option<usize>, field: &str, problem: &str) -> Fault {
    let nearest = suggestion(problem);
    Fault {
        source_name: name.to_owned(),
        line,
        field: field.to_owned(),
        problem: without_list(problem, nearest.is_some()).to_owned(),
        nearest,
    }
}

fn line_at(text: &str, offset: usize) -> usize {
    text.as_bytes().iter().take(offset).filter(|&&byte| byte == b'\n').count() + 1
}
