//! Deserializes tables of scene files.

use serde::de::DeserializeOwned;
use toml::{Table, Value};

use crate::error::Problem;
use crate::wording::{in_plain_words, with_form};

/// Deserializes a table without formulas and units.
pub(crate) fn deserialize<T: DeserializeOwned>(table: Table) -> Result<T, Problem> {
    serde_path_to_error::deserialize(Value::Table(table)).map_err(|error| {
        let path = error.path().to_string();
        let path = if path == "." { String::new() } else { path };
        let problem = in_plain_words(error.into_inner().message().trim());
        Problem::new(&*path, with_form(problem, &path))
    })
}
