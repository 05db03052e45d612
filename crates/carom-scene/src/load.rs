//! Scene files to scenes.

use std::path::Path;

use serde::Deserialize;

use crate::budget::Budget;
use crate::error::SceneError;
use crate::overrides::Override;
use crate::scene::Scene;
use crate::text::SceneText;

impl Scene {
    /// Reads a scene from TOML; `source_name` is what errors call it, and without its ending the name of
    /// a scene that has none.
    ///
    /// ```
    /// use carom_scene::Scene;
    ///
    /// let text = r#"
    /// name = "fall"
    /// spheres = [{ position = [0, 1, 0], radius = 0.5 }]
    /// [[forces]]
    /// gravity = { acceleration = [0, -9.81, 0] }
    /// "#;
    /// let scene = Scene::from_toml(text, "fall.toml")?;
    /// assert_eq!(scene.world()?.spheres().len(), 1);
    /// let mistyped = Scene::from_toml(&text.replace("radius", "radus"), "fall.toml").unwrap_err();
    /// assert!(mistyped.to_string().starts_with("fall.toml:3: spheres[0].radus: unknown field"));
    /// # Ok::<(), carom_scene::SceneError>(())
    /// ```
    ///
    /// # Errors
    /// [`SceneError::Invalid`] for text that is no TOML, unknown fields, numbers that make no
    /// sense, and spheres that overlap at the start.
    pub fn from_toml(text: &str, source_name: &str) -> Result<Self, SceneError> {
        Self::from_toml_with(text, source_name, &[])
    }

    /// Reads a scene from TOML and changes some of its values.
    ///
    /// # Errors
    /// As [`Self::from_toml`], and [`SceneError::BadOverride`] for a path that leads nowhere.
    pub fn from_toml_with(
        text: &str,
        source_name: &str,
        overrides: &[Override],
    ) -> Result<Self, SceneError> {
        SceneText::new(text, source_name)?.scene(overrides)
    }

    /// Reads a scene from TOML that may ask for as much as `budget` allows.
    ///
    /// # Errors
    /// As [`Self::from_toml`].
    pub fn from_toml_within(
        text: &str,
        source_name: &str,
        budget: Budget,
    ) -> Result<Self, SceneError> {
        SceneText::new(text, source_name)?.within(budget).scene(&[])
    }

    /// Reads a scene file, and those that it includes.
    ///
    /// # Errors
    /// [`SceneError::Unreadable`], and as [`Self::from_toml_with`].
    pub fn from_file(path: &Path, overrides: &[Override]) -> Result<Self, SceneError> {
        SceneText::from_file(path)?.scene(overrides)
    }

    /// The same scene with some values changed.
    ///
    /// # Errors
    /// As [`Self::from_toml_with`].
    pub fn with(&self, overrides: &[Override]) -> Result<Self, SceneError> {
        SceneText::new(&self.to_toml(), &self.name)?.within(Budget::MOST).scene(overrides)
    }

    /// The scene as TOML, every default written out.
    pub fn to_toml(&self) -> String {
        toml::to_string(self).expect("a scene has only strings as keys")
    }
}

/// Names only, without the rest of the scene.
#[derive(Debug, Clone, Default, PartialEq, Deserialize)]
pub(crate) struct Heading {
    #[serde(default)]
    pub name: String,
    #[serde(default)]
    pub title: String,
}

impl Heading {
    /// The names in a scene file, even in one that is broken further down.
    pub fn of(text: &str) -> Self {
        let whole = toml::from_str(text);
        whole.unwrap_or_else(|_| {
            let is_name = |line: &&str| line.starts_with("name") || line.starts_with("title");
            let lines: Vec<&str> = text.lines().filter(is_name).collect();
            toml::from_str(&lines.join("\n")).unwrap_or_default()
        })
    }
}
