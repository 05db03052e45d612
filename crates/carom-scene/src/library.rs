//! Finds scenes: built-in ones, those in folders, and those registered in code.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use crate::budget::Budget;
use crate::builtin;
use crate::error::{SceneError, nearest};
use crate::load::Heading;
use crate::overrides::Override;
use crate::scene::Scene;
use crate::text::SceneText;

/// Where a scene was found.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Source {
    /// Among the built-in scenes.
    BuiltIn,
    /// In a file.
    File(PathBuf),
    /// Among the scenes registered in code.
    Registered,
}

impl std::fmt::Display for Source {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::BuiltIn => f.write_str("built-in"),
            Self::File(path) => path.display().fmt(f),
            Self::Registered => f.write_str("registered"),
        }
    }
}

/// Scenes by name.
///
/// If several scenes have the same name, registered ones come first, then those in folders, in the
/// order in which the folders were added, then built-in ones.
///
/// ```
/// use carom_scene::{Library, Source};
///
/// let library = Library::new();
/// let (scene, source) = library.find("SimTest1", &["simulation.rule=exact".parse()?])?;
/// assert_eq!((scene.name.as_str(), source), ("simtest1", Source::BuiltIn));
/// let mistyped = library.find("simtst1", &[]).unwrap_err();
/// assert!(mistyped.to_string().contains("did you mean \"simtest1\"?"));
/// # Ok::<(), carom_scene::SceneError>(())
/// ```
#[derive(Debug, Clone, Default)]
pub struct Library {
    registered: Vec<Scene>,
    folders: Vec<PathBuf>,
    /// Limits on the size of scenes.
    budget: Budget,
}

/// A scene in a list: readable, or with the error in it.
#[derive(Debug)]
pub struct Entry {
    /// Name under which [`Library::find`] finds the scene.
    pub name: String,
    /// Where the scene was found.
    pub source: Source,
    /// The scene, or why it cannot be read.
    pub scene: Result<Scene, SceneError>,
}

impl Library {
    /// Creates a library of the built-in scenes.
    pub fn new() -> Self {
        Self::default()
    }

    /// Sets the limits on the size of scenes; the default is [`Budget::FILE`].
    pub fn within(self, budget: Budget) -> Self {
        Self { budget, ..self }
    }

    /// Limits on the size of scenes.
    pub fn budget(&self) -> Budget {
        self.budget
    }

    fn read(&self, path: &Path, overrides: &[Override]) -> Result<Scene, SceneError> {
        SceneText::from_file_within(path, self.budget)?.scene(overrides)
    }

    /// Adds the scene files (`*.toml`) of a folder.
    ///
    /// # Errors
    /// [`SceneError::Unreadable`] if the folder cannot be listed.
    pub fn add_folder(&mut self, folder: &Path) -> Result<(), SceneError> {
        files_in(folder)?;
        self.folders.push(folder.to_owned());
        Ok(())
    }

    /// Adds a scene built in code.
    ///
    /// ```
    /// use carom_scene::Library;
    /// use carom_scene::scene::{Scene, Sphere};
    ///
    /// let mut scene = Scene::new("two");
    /// scene.description = "Two spheres, side by side.".to_owned();
    /// scene.spheres = vec![Sphere::at([-1.0, 0.0, 0.0], 0.5), Sphere::at([1.0, 0.0, 0.0], 0.5)];
    /// let mut library = Library::new();
    /// library.register(scene)?;
    /// assert_eq!(library.find("two", &[])?.0.spheres.len(), 2);
    /// # Ok::<(), carom_scene::SceneError>(())
    /// ```
    ///
    /// # Errors
    /// [`SceneError::Invalid`] if the scene is invalid.
    pub fn register(&mut self, scene: Scene) -> Result<(), SceneError> {
        scene.world()?;
        self.registered.push(scene);
        Ok(())
    }

    /// Lists all scenes in the order of the search. Folders are read at each call.
    ///
    /// # Errors
    /// [`SceneError::Unreadable`] if a folder has become unreadable. A broken scene file is no
    /// error: its entry contains the error.
    pub fn entries(&self) -> Result<Vec<Entry>, SceneError> {
        let mut entries = Vec::new();
        for scene in &self.registered {
            let (name, scene) = (scene.name.clone(), Ok(scene.clone()));
            entries.push(Entry { name, source: Source::Registered, scene });
        }
        for folder in &self.folders {
            for path in files_in(folder)? {
                let scene = self.read(&path, &[]);
                let name = heading_of(&path).name;
                entries.push(Entry { name, source: Source::File(path), scene });
            }
        }
        for (file, text) in builtin::FILES {
            let scene = Scene::from_toml(text, file);
            let name = file.trim_end_matches(".toml").to_owned();
            entries.push(Entry { name, source: Source::BuiltIn, scene });
        }
        // If several scenes have one name, only the first can be found.
        let mut names = BTreeSet::new();
        entries.retain(|entry| names.insert(entry.name.to_lowercase()));
        Ok(entries)
    }

    /// Finds a scene by name or title (in any case) or by the path of its file, and applies
    /// overrides. If no scene is called `drop`, it reads the file `drop.toml` or `drop` of the
    /// current folder.
    ///
    /// # Errors
    /// [`SceneError::Unknown`] with a suggested name, or the error in the scene.
    pub fn find(&self, name: &str, overrides: &[Override]) -> Result<(Scene, Source), SceneError> {
        if is_path(name) {
            let path = Path::new(name);
            let scene = self.read(path, overrides)?;
            return Ok((scene, Source::File(path.to_owned())));
        }
        let wanted = name.to_lowercase();
        let is_wanted = |own: &Heading| {
            [&own.name, &own.title]
                .iter()
                .any(|own| !own.is_empty() && own.to_lowercase() == wanted)
        };
        let mut known = Vec::new();
        for scene in &self.registered {
            let own = Heading { name: scene.name.clone(), title: scene.title.clone() };
            if is_wanted(&own) {
                return Ok((scene.with(overrides)?, Source::Registered));
            }
            known.extend([own.name, own.title]);
        }
        for folder in &self.folders {
            for path in files_in(folder)? {
                let own = heading_of(&path);
                if is_wanted(&own) {
                    return Ok((self.read(&path, overrides)?, Source::File(path)));
                }
                known.extend([own.name, own.title]);
            }
        }
        for (file, text) in builtin::FILES {
            let own = Heading::of(text);
            if is_wanted(&own) {
                let text = SceneText::new(text, file)?.within(self.budget);
                return Ok((text.scene(overrides)?, Source::BuiltIn));
            }
            known.extend([own.name, own.title]);
        }
        let files = [format!("{name}.toml"), name.to_owned()].map(PathBuf::from);
        if let Some(file) = files.into_iter().find(|file| !name.is_empty() && file.is_file()) {
            return Ok((self.read(&file, overrides)?, Source::File(file)));
        }
        let beside = files_in(Path::new(".")).unwrap_or_default();
        let names = beside.iter().filter_map(|path| path.file_name()?.to_str());
        known.extend(names.map(str::to_owned));
        let is_word = |word: &str| !word.is_empty() && word.to_lowercase() == wanted;
        let holds = |own: &&String| own.split(|it: char| !it.is_alphanumeric()).any(is_word);
        let nearest = || nearest(name, known.iter().map(String::as_str));
        let nearest = known.iter().find(holds).cloned().or_else(nearest);
        Err(SceneError::Unknown { name: name.to_owned(), nearest })
    }
}

/// Whether the text is the path of a scene file, not the name of a scene.
fn is_path(name: &str) -> bool {
    name.ends_with(".toml") || name.contains(std::path::MAIN_SEPARATOR)
}

/// Name and title in a scene file. The name is that of the file if it cannot be read or states
/// none.
fn heading_of(path: &Path) -> Heading {
    let mut own = Heading::of(&std::fs::read_to_string(path).unwrap_or_default());
    if own.name.is_empty() {
        own.name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    }
    own
}

/// Scene files of a folder, sorted.
fn files_in(folder: &Path) -> Result<Vec<PathBuf>, SceneError> {
    let unreadable = |source| SceneError::Unreadable { path: folder.to_owned(), source };
    let mut files = Vec::new();
    for entry in std::fs::read_dir(folder).map_err(unreadable)? {
        let path = entry.map_err(unreadable)?.path();
        if path.extension().is_some_and(|extension| extension == "toml") {
            files.push(path);
        }
    }
    files.sort();
    Ok(files)
}
