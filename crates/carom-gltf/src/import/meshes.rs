//! Recognizes each mesh of a file once.

use std::collections::BTreeMap;

use super::error::Malformed;
use super::file::File;
use super::form::{self, Form};
use super::vertices::triangles;

/// Forms of a file's meshes, found when first needed.
pub(super) struct Meshes<'a> {
    file: &'a File,
    forms: BTreeMap<usize, Result<Form, &'static str>>,
}

impl<'a> Meshes<'a> {
    /// Creates an empty list for a file.
    pub fn new(file: &'a File) -> Self {
        Self { file, forms: BTreeMap::new() }
    }

    /// Form of a mesh; the inner error is the reason for the report.
    ///
    /// # Errors
    /// [`Malformed`] if the file is invalid.
    pub fn form(&mut self, mesh: usize) -> Result<Result<Form, &'static str>, Malformed> {
        if let Some(known) = self.forms.get(&mesh) {
            return Ok(*known);
        }
        let form = triangles(self.file, mesh)?.and_then(|triangles| form::of(&triangles));
        self.forms.insert(mesh, form);
        Ok(form)
    }
}
