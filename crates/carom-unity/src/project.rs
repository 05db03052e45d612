//! The project around a scene: finds files by guid.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use carom_scene::import::{Omission, omit};

use crate::document;
use crate::error::{ImportError, read_text};

/// Files of a project.
#[derive(Debug, Default)]
pub struct Project {
    /// The folder `Assets`, or that of a scene outside such a folder.
    assets: PathBuf,
    by_guid: BTreeMap<String, PathBuf>,
    scenes: Vec<PathBuf>,
    omissions: Vec<Omission>,
}

impl Project {
    /// Finds the project of a scene or folder: the nearest folder `Assets` around it, or else its
    /// own folder.
    ///
    /// # Errors
    /// [`ImportError::Unreadable`] if the scene or folder does not exist.
    pub fn around(path: &Path) -> Result<Self, ImportError> {
        let unreadable = |source| ImportError::Unreadable { path: path.to_path_buf(), source };
        let whole = path.canonicalize().map_err(unreadable)?;
        let is_assets = |folder: &&Path| folder.file_name().is_some_and(|name| name == "Assets");
        let own = if whole.is_dir() { &*whole } else { whole.parent().unwrap_or(&whole) };
        let assets = whole.ancestors().find(is_assets).unwrap_or(own);
        let mut project = Self { assets: assets.to_path_buf(), ..Self::default() };
        project.search();
        Ok(project)
    }

    /// Lists the scenes below a folder, sorted by path.
    ///
    /// # Errors
    /// [`ImportError::Refused`] if there are none.
    pub fn scenes(&self, folder: &Path) -> Result<Vec<PathBuf>, ImportError> {
        let unreadable = |source| ImportError::Unreadable { path: folder.to_path_buf(), source };
        let whole = folder.canonicalize().map_err(unreadable)?;
        let scenes: Vec<_> =
            self.scenes.iter().filter(|scene| scene.starts_with(&whole)).cloned().collect();
        if scenes.is_empty() {
            let problem = "holds no scene of Unity (*.unity)".to_owned();
            return Err(ImportError::Refused { path: folder.to_path_buf(), problem });
        }
        Ok(scenes)
    }

    /// Path of the file with this guid.
    pub(crate) fn file(&self, guid: &str) -> Option<&Path> {
        self.by_guid.get(guid).map(PathBuf::as_path)
    }

    /// Reads a field of the import settings of a file.
    pub(crate) fn import_setting(file: &Path, field: &str) -> Option<String> {
        let mut meta = file.as_os_str().to_owned();
        meta.push(".meta");
        let text = read_text(Path::new(&meta)).ok()?;
        let value =
            |line: &str| line.trim().strip_prefix(field)?.strip_prefix(':').map(str::to_owned);
        text.lines().find_map(value).map(|it| it.trim().to_owned())
    }

    /// Path of a file in reports, relative to the folder that contains `Assets`.
    pub(crate) fn shown(&self, file: &Path) -> String {
        let root = self.assets.parent().unwrap_or(&self.assets);
        file.strip_prefix(root).unwrap_or(file).display().to_string()
    }

    /// Omissions of the project.
    pub(crate) fn omissions(&self) -> &[Omission] {
        &self.omissions
    }

    /// Reads a setting of the project: a field of the first object of a file in `ProjectSettings`.
    pub(crate) fn setting(
        &self,
        file: &str,
        field: &str,
    ) -> Result<Option<crate::value::Value>, ImportError> {
        let Some(root) = self.assets.parent() else { return Ok(None) };
        let path = root.join("ProjectSettings").join(file);
        if !path.is_file() {
            return Ok(None);
        }
        let documents = document::read(&path)?;
        Ok(documents.first().and_then(|it| it.fields.get(field)).cloned())
    }

    /// Searches the folders, with limits on number and depth.
    fn search(&mut self) {
        const DEEPEST: usize = 32;
        const MOST: usize = 200_000;
        let mut folders = vec![(self.assets.clone(), 0)];
        let mut seen = 0;
        while let Some((folder, depth)) = folders.pop() {
            let Ok(entries) = fs::read_dir(&folder) else {
                omit(&mut self.omissions, &folder.display().to_string(), "folder", "unreadable");
                continue;
            };
            let mut entries: Vec<_> = entries.flatten().collect();
            entries.sort_by_key(fs::DirEntry::file_name);
            for entry in entries {
                seen += 1;
                if seen > MOST {
                    let reason = "has more than 200000 files; the others are left out";
                    omit(&mut self.omissions, &self.assets.display().to_string(), "folder", reason);
                    return;
                }
                let path = entry.path();
                // Symbolic links are not followed, because they may form circles.
                match entry.file_type() {
                    Ok(kind) if kind.is_dir() && depth < DEEPEST => folders.push((path, depth + 1)),
                    Ok(kind) if kind.is_file() => self.add(path),
                    _ => {}
                }
            }
        }
        self.scenes.sort();
    }

    fn add(&mut self, path: PathBuf) {
        match path.extension().and_then(|ending| ending.to_str()) {
            Some("unity") => self.scenes.push(path),
            Some("meta") => match guid(&path) {
                Some(guid) => {
                    self.by_guid.insert(guid, path.with_extension(""));
                }
                None => {
                    let reason = "has no line `guid:`; what refers to it is not found";
                    omit(&mut self.omissions, &path.display().to_string(), "meta file", reason);
                }
            },
            _ => {}
        }
    }
}

/// Reads the guid from a `.meta` file.
fn guid(path: &Path) -> Option<String> {
    let text = read_text(path).ok()?;
    let guid = text.lines().find_map(|line| line.strip_prefix("guid:"))?.trim();
    (!guid.is_empty()).then(|| guid.to_owned())
}
