//! Reads scripts by the meanings of their fields.

use carom::DVec3;

use crate::document::Document;
use crate::error::ImportError;
use crate::mapping::{Mapping, Number, ScriptKind, Vector};
use crate::project::Project;
use crate::value::{Kind, Value};

/// A script of a known kind.
#[derive(Clone, Copy)]
pub(crate) struct Script<'a> {
    /// Kind of the script, with the meanings of its fields.
    pub kind: &'a ScriptKind,
    /// Document with its fields.
    pub document: &'a Document,
}

impl<'a> Script<'a> {
    /// Recognizes the script of a component; the error is the reason for the report.
    pub fn of(
        document: &'a Document,
        mapping: &'a Mapping,
        project: &Project,
    ) -> Result<Self, String> {
        let file = file(document, project);
        let fits = |kind: &&ScriptKind| {
            let is_file = kind.file.as_deref().is_none_or(|it| Some(it) == file.as_deref());
            is_file && kind.fields.iter().all(|field| document.fields.get(field).is_some())
        };
        if let Some(kind) = mapping.scripts.iter().find(fits) {
            return Ok(Self { kind, document });
        }
        let file = file.unwrap_or_else(|| "a script that is not in the project".to_owned());
        let fields = own_fields(document).collect::<Vec<_>>();
        match fields.len() {
            0 => Err(format!("{file} has no fields")),
            1..=8 => Err(format!("{file} is not known; its fields are {}", fields.join(", "))),
            more => Err(format!("{file} is not known; it has {more} fields, like {}", fields[0])),
        }
    }

    /// Names of the fields that are not used.
    pub fn unread(&self) -> Vec<&'a str> {
        let read = self.kind.read_fields();
        own_fields(self.document).filter(|field| !read.contains(field)).collect()
    }

    /// Reads a number that must exist.
    pub fn number(&self, number: &Number) -> Result<f64, ImportError> {
        match number {
            Number::Constant(number) => Ok(*number),
            Number::Field(name) => self.field(name)?.number(name),
        }
    }

    /// Reads a number that may be missing.
    pub fn some_number(&self, number: Option<&Number>) -> Result<Option<f64>, ImportError> {
        let is_there = |it: &&Number| match it {
            Number::Constant(_) => true,
            Number::Field(name) => self.document.fields.get(name).is_some(),
        };
        number.filter(is_there).map(|it| self.number(it)).transpose()
    }

    /// Reads a vector that may be missing, in Unity's coordinates.
    pub fn some_vector(&self, vector: Option<&Vector>) -> Result<Option<DVec3>, ImportError> {
        let vector = match vector {
            None => return Ok(None),
            Some(Vector::Constant(vector)) => Some(*vector),
            Some(Vector::Field(name)) => {
                self.document.fields.get(name).map(|value| value.vector(name)).transpose()?
            }
        };
        Ok(vector.map(DVec3::from_array))
    }

    fn field(&self, name: &str) -> Result<&'a Value, ImportError> {
        self.document.fields.get(name).ok_or_else(|| {
            let problem = format!("the script \"{}\" must have a field {name}", self.kind.name);
            self.document.fields.place.malformed(problem)
        })
    }
}

/// Names of the fields of the script itself, without those that Unity writes for every script.
fn own_fields(document: &Document) -> impl Iterator<Item = &str> {
    let fields = match &document.fields.kind {
        Kind::Map(fields) => fields.as_slice(),
        _ => &[],
    };
    fields.iter().map(|(name, _)| name.as_str()).filter(|name| !name.starts_with("m_"))
}

/// Name of the script's file.
fn file(document: &Document, project: &Project) -> Option<String> {
    let guid = document.fields.get("m_Script")?.reference()?.guid?;
    Some(project.file(&guid)?.file_name()?.to_string_lossy().into_owned())
}
