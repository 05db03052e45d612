//! Forms of meshes, each found once.

use std::collections::BTreeMap;

use super::error::Malformed;
use super::file::File;
use super::form::{self, Form};
use super::vertices::triangles;

/// The forms of a file's meshes, as far as they were needed.
pub(super) struct Meshes<'a> {
    file: &'a File,
    forms: BTreeMap<usize, Result<Form, &'static str>>,
}

impl<'a> Meshes<'a> {
    /// Those of a file.
    pub fn new(file: &'a File) -> Self {
        Self { file, forms: BTreeMap::new() }
    }

    /// The form of a mesh; `Err` in `Ok` says for the report why it has none.
    ///
    /// # Errors
    /// What is wrong with the file.
    pub fn form(&mut self, mesh: usize) -> Result<Result<Form, &'static str>, Malformed> {
        if let Some(known) = self.forms.get(&mesh) {
            return Ok(*known);
        }
        let form = triangles(self.file, mesh)?.and_then(|triangles| form::of(&triangles));
        self.forms.insert(mesh, form);
        Ok(form)
    }
}
