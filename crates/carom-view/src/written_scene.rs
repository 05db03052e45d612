//! The text of a scene whose parameters can be changed.

use std::path::Path;

use carom_scene::{Override, Parameter, Scene, SceneError, SceneText};
use carom_session::{Link, LinkSource};

/// A scene as text, with the formulas of its author.
pub struct WrittenScene {
    text: SceneText,
    overrides: Vec<Override>,
    /// The scene that the text describes.
    scene: Scene,
    parameters: Vec<Parameter>,
}

impl WrittenScene {
    /// Reads the text of a scene file, called `name` in errors, with these values changed.
    ///
    /// # Errors
    /// If the text is no valid scene.
    pub fn new(name: &str, text: &str, overrides: Vec<Override>) -> Result<Self, SceneError> {
        Self::of(SceneText::new(text, name)?, overrides)
    }

    fn of(text: SceneText, overrides: Vec<Override>) -> Result<Self, SceneError> {
        let (scene, parameters) = (text.scene(&overrides)?, text.parameters(&overrides)?);
        Ok(Self { text, overrides, scene, parameters })
    }

    /// Reads a scene file and the files that it includes, with these values changed.
    ///
    /// # Errors
    /// If it cannot be read, or is no valid scene.
    pub fn from_file(path: &Path, overrides: Vec<Override>) -> Result<Self, SceneError> {
        Self::of(SceneText::from_file(path)?, overrides)
    }

    /// Returns the scene that the text describes.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// Returns the values that differ from the text.
    pub fn overrides(&self) -> &[Override] {
        &self.overrides
    }

    /// Returns the parameters, in the order of the file.
    pub fn parameters(&self) -> &[Parameter] {
        &self.parameters
    }

    /// Returns this text with another value of one of its parameters.
    ///
    /// # Errors
    /// If the scene becomes invalid.
    pub fn with(&self, parameter: &Parameter) -> Result<Self, SceneError> {
        let Parameter { name, value, .. } = parameter;
        // A number without a decimal point would become an integer parameter.
        let value = if parameter.is_whole { format!("{value}") } else { format!("{value:?}") };
        let changed: Override = format!("parameters.{name}={value}").parse()?;
        let is_other = |it: &&Override| !it.to_string().starts_with(&format!("parameters.{name}="));
        let others = self.overrides.iter().filter(is_other).cloned();
        Self::of(self.text.clone(), others.chain([changed]).collect())
    }

    /// Returns a link to the beginning of the scene, with its formulas.
    pub fn link(&self) -> Link {
        // A link is for others, so it contains only the file name, not the local path.
        let name = Path::new(self.text.name()).file_name().unwrap_or_default();
        let (name, text) = (name.to_string_lossy().into_owned(), self.text.whole().into_owned());
        Link::new(LinkSource::File { name, text }).with_overrides(self.overrides.clone())
    }
}
