//! Scenes of links.

use carom_scene::{BUILT_IN_FILES, Budget, Library, Override, Scene, SceneError, SceneText};

use super::error::LinkError;
use super::rule::rule_override;
use super::run::{Link, LinkSource};

/// Name in errors of a scene file without a name.
const NAMELESS: &str = "scene file";

impl Link {
    /// Creates a link to the beginning of a scene. A built-in scene is named, with its rule if that
    /// was changed; any other is included as text.
    pub fn to_scene(scene: &Scene) -> Self {
        as_built_in(scene).unwrap_or_else(|| {
            let (name, text) = (scene.name.clone(), scene.to_toml());
            Self::new(LinkSource::File { name, text })
        })
    }

    /// Opens the scene at its beginning.
    ///
    /// # Errors
    /// [`LinkError::Scene`] if the scene does not exist or is invalid.
    pub fn open(&self) -> Result<Scene, LinkError> {
        self.open_within(Budget::LINK)
    }

    /// Opens the scene at its beginning within `budget`; [`Self::open`] uses [`Budget::LINK`].
    ///
    /// # Errors
    /// The same as those of [`Self::open`].
    pub fn open_within(&self, budget: Budget) -> Result<Scene, LinkError> {
        let scene = match &self.source {
            LinkSource::BuiltIn(name) => built_in(name, &self.overrides, budget),
            LinkSource::File { name, text } => {
                let name = if name.is_empty() { NAMELESS } else { name };
                SceneText::new(text, name)?.within(budget).scene(&self.overrides)
            }
        };
        Ok(scene?)
    }
}

/// Returns a link that names a built-in scene, if the scene equals it except for its rule.
fn as_built_in(scene: &Scene) -> Option<Link> {
    let mut own = built_in(&scene.name, &[], Budget::FILE).ok()?;
    let link = Link::new(LinkSource::BuiltIn(own.name.clone()));
    if own == *scene {
        return Some(link);
    }
    own.simulation.rule = scene.simulation.rule;
    let rule = rule_override(scene.simulation.rule.name()).ok()?;
    (own == *scene).then(|| link.with_overrides([rule]))
}

/// Finds a built-in scene by name or title. Unlike [`Library::find`], it opens no files by their
/// path, because links come from other people.
fn built_in(name: &str, overrides: &[Override], budget: Budget) -> Result<Scene, SceneError> {
    let wanted = name.to_lowercase();
    let is_wanted = |file: &str| file.strip_suffix(".toml").is_some_and(|own| own == wanted);
    if let Some((file, text)) = BUILT_IN_FILES.iter().find(|(file, _)| is_wanted(file)) {
        return SceneText::new(text, file)?.within(budget).scene(overrides);
    }
    let is_path = name.ends_with(".toml") || name.contains(['/', '\\']);
    if is_path {
        return Err(SceneError::Unknown { name: name.to_owned(), nearest: None });
    }
    Ok(Library::new().within(budget).find(name, overrides)?.0)
}
