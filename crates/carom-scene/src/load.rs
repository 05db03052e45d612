//! Reads scenes from TOML and writes them.

use std::path::Path;

use serde::Deserialize;

use crate::budget::Budget;
use crate::error::SceneError;
use crate::materials;
use crate::overrides::Override;
use crate::scene::Scene;
use crate::text::SceneText;

/// Why a scene can be written.
const STRINGS: &str = "a scene has only strings as keys";

impl Scene {
    /// Reads a scene from TOML. Errors call it `source_name`; a scene without a name gets that of
    /// the source, without its ending.
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
    /// [`SceneError::Invalid`] for text that is no TOML, unknown fields, invalid numbers, and
    /// spheres that overlap at the start.
    pub fn from_toml(text: &str, source_name: &str) -> Result<Self, SceneError> {
        Self::from_toml_with(text, source_name, &[])
    }

    /// Reads a scene from TOML and applies overrides.
    ///
    /// # Errors
    /// The same as those of [`Self::from_toml`], and [`SceneError::BadOverride`] for a path that
    /// does not exist.
    pub fn from_toml_with(
        text: &str,
        source_name: &str,
        overrides: &[Override],
    ) -> Result<Self, SceneError> {
        SceneText::new(text, source_name)?.scene(overrides)
    }

    /// Reads a scene from TOML within the limits of `budget`.
    ///
    /// # Errors
    /// The same as those of [`Self::from_toml`].
    pub fn from_toml_within(
        text: &str,
        source_name: &str,
        budget: Budget,
    ) -> Result<Self, SceneError> {
        SceneText::new(text, source_name)?.within(budget).scene(&[])
    }

    /// Reads a scene file and the files that it includes, and applies overrides.
    ///
    /// # Errors
    /// [`SceneError::Unreadable`], and those of [`Self::from_toml_with`].
    pub fn from_file(path: &Path, overrides: &[Override]) -> Result<Self, SceneError> {
        SceneText::from_file(path)?.scene(overrides)
    }

    /// Returns a copy of the scene with overrides applied.
    ///
    /// # Errors
    /// The same as those of [`Self::from_toml_with`].
    pub fn with(&self, overrides: &[Override]) -> Result<Self, SceneError> {
        SceneText::new(&self.to_toml(), &self.name)?.within(Budget::MOST).scene(overrides)
    }

    /// Writes the scene as TOML with every default, and without what materials give.
    pub fn to_toml(&self) -> String {
        if self.materials.is_empty() {
            toml::to_string(self).expect(STRINGS)
        } else {
            toml::to_string(&self.to_table()).expect(STRINGS)
        }
    }

    /// Returns the table that [`Self::to_toml`] writes.
    pub fn to_table(&self) -> toml::Table {
        let mut table = toml::Table::try_from(self).expect(STRINGS);
        materials::strip(&mut table);
        table
    }
}

/// Name and title of a scene, read without the rest.
#[derive(Debug, Clone, Default, PartialEq, Deserialize)]
pub(crate) struct Heading {
    #[serde(default)]
    pub name: String,
    #[serde(default)]
    pub title: String,
}

impl Heading {
    /// Reads name and title from a scene file, even if the rest is broken.
    pub fn of(text: &str) -> Self {
        let whole = toml::from_str(text);
        whole.unwrap_or_else(|_| {
            let is_name = |line: &&str| line.starts_with("name") || line.starts_with("title");
            let lines: Vec<&str> = text.lines().filter(is_name).collect();
            toml::from_str(&lines.join("\n")).unwrap_or_default()
        })
    }
}
