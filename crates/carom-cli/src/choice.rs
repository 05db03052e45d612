//! The scene that the command line names, and its overrides.

use carom_scene::{Library, Override, Scene, SceneText, Source};

use crate::failure::Failure;
use crate::standard_input::{self, STANDARD};

/// Names of the step rules.
pub const RULES: [&str; 4] = carom_scene::scene::Rule::NAMES;

/// Which scene, and what is different in it.
#[derive(Debug, clap::Args)]
pub struct Choice {
    /// Name or title of a scene, or a scene file; `-` reads the file from the standard input.
    scene: String,
    /// Overrides of the scene.
    #[command(flatten)]
    changes: Changes,
}

impl Choice {
    /// Finds the scene and applies its overrides, then those of `more`.
    pub fn find(
        &self,
        library: &Library,
        more: impl IntoIterator<Item = String>,
    ) -> Result<Scene, Failure> {
        Ok(self.changes.find(library, &self.scene, more)?.0)
    }

    /// Name or title of the scene, or its file.
    pub fn scene(&self) -> &str {
        &self.scene
    }

    /// Overrides of the scene.
    pub fn changes(&self) -> &Changes {
        &self.changes
    }
}

/// What is different in a scene.
#[derive(Debug, Clone, Default, clap::Args)]
pub struct Changes {
    /// Change a value of the scene, like emitters.0.max_spheres=100, or a parameter by its name, or
    /// take a value out with emitters.0.max_spheres=none; may be given several times.
    #[arg(long = "set", value_name = "PATH=VALUE", value_parser = parse_override)]
    #[arg(requires = "scene")]
    overrides: Vec<Override>,
}

impl Changes {
    /// Finds a scene and applies these overrides, then those of `more`.
    pub fn find(
        &self,
        library: &Library,
        scene: &str,
        more: impl IntoIterator<Item = String>,
    ) -> Result<(Scene, Source), Failure> {
        let overrides = self.overrides(more)?;
        if scene == STANDARD {
            let text = standard_input::text()?;
            let scene = SceneText::new(text, standard_input::NAME)?;
            let scene = scene.within(library.budget()).scene(&overrides)?;
            return Ok((scene, Source::Registered));
        }
        Ok(library.find(scene, &overrides)?)
    }

    /// Returns these overrides, followed by those of `more`.
    pub fn overrides(
        &self,
        more: impl IntoIterator<Item = String>,
    ) -> Result<Vec<Override>, Failure> {
        let mut overrides = self.overrides.clone();
        for text in more {
            overrides.push(text.parse()?);
        }
        Ok(overrides)
    }
}

fn parse_override(text: &str) -> Result<Override, String> {
    text.parse().map_err(|error: carom_scene::SceneError| error.to_string())
}
