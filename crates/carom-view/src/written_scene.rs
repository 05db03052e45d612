//! The text that a scene was read from, whose parameters can be changed.

use std::path::Path;

use carom_scene::{Override, Parameter, Scene, SceneError};
use carom_session::{Link, LinkSource};

/// A scene as it is written, with formulas where its author wrote some.
pub struct WrittenScene {
    name: String,
    text: String,
    overrides: Vec<Override>,
    /// What it comes to.
    scene: Scene,
    parameters: Vec<Parameter>,
}

impl WrittenScene {
    /// The text of a scene file, which errors call `name`, with these values changed.
    ///
    /// # Errors
    /// For a text that is no scene.
    pub fn new(name: &str, text: &str, overrides: Vec<Override>) -> Result<Self, SceneError> {
        let scene = Scene::from_toml_with(text, name, &overrides)?;
        let parameters = Scene::parameters(text, name, &overrides)?;
        let (name, text) = (name.to_owned(), text.to_owned());
        Ok(Self { name, text, overrides, scene, parameters })
    }

    /// A scene file of the disk, with these values changed.
    ///
    /// # Errors
    /// If it cannot be read, or is no scene.
    pub fn from_file(path: &Path, overrides: Vec<Override>) -> Result<Self, SceneError> {
        let text = std::fs::read_to_string(path)
            .map_err(|source| SceneError::Unreadable { path: path.to_owned(), source })?;
        // Links are for others: where it lies here is not for them.
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        Self::new(&name, &text, overrides)
    }

    /// The scene that the text comes to.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// The values that differ from the text.
    pub fn overrides(&self) -> &[Override] {
        &self.overrides
    }

    /// Its parameters, in the order of the file.
    pub fn parameters(&self) -> &[Parameter] {
        &self.parameters
    }

    /// This text with another value of one of its parameters.
    ///
    /// # Errors
    /// If that makes no sense.
    pub fn with(&self, parameter: &Parameter) -> Result<Self, SceneError> {
        let Parameter { name, value, .. } = parameter;
        // A whole number without a point counts something, and would from then on.
        let value = if parameter.is_whole { format!("{value}") } else { format!("{value:?}") };
        let changed: Override = format!("parameters.{name}={value}").parse()?;
        let is_other = |it: &&Override| !it.to_string().starts_with(&format!("parameters.{name}="));
        let others = self.overrides.iter().filter(is_other).cloned();
        Self::new(&self.name, &self.text, others.chain([changed]).collect())
    }

    /// A link to its beginning, which keeps formulas.
    pub fn link(&self) -> Link {
        let (name, text) = (self.name.clone(), self.text.clone());
        Link::new(LinkSource::File { name, text }).with_overrides(self.overrides.clone())
    }
}
