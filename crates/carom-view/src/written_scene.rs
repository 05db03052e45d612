//! The text that a scene was read from, whose parameters can be changed.

use std::path::Path;

use carom_scene::{Override, Parameter, Scene, SceneError, SceneText};
use carom_session::{Link, LinkSource};

/// A scene as it is written, with formulas where its author wrote some.
pub struct WrittenScene {
    text: SceneText,
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
        Self::of(SceneText::new(text, name)?, overrides)
    }

    fn of(text: SceneText, overrides: Vec<Override>) -> Result<Self, SceneError> {
        let (scene, parameters) = (text.scene(&overrides)?, text.parameters(&overrides)?);
        Ok(Self { text, overrides, scene, parameters })
    }

    /// A scene file of the disk and those that it includes, with these values changed.
    ///
    /// # Errors
    /// If it cannot be read, or is no scene.
    pub fn from_file(path: &Path, overrides: Vec<Override>) -> Result<Self, SceneError> {
        Self::of(SceneText::from_file(path)?, overrides)
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
        Self::of(self.text.clone(), others.chain([changed]).collect())
    }

    /// A link to its beginning, which keeps formulas.
    pub fn link(&self) -> Link {
        // Links are for others: where the file lies here is not for them.
        let name = Path::new(self.text.name()).file_name().unwrap_or_default();
        let (name, text) = (name.to_string_lossy().into_owned(), self.text.whole().into_owned());
        Link::new(LinkSource::File { name, text }).with_overrides(self.overrides.clone())
    }
}
