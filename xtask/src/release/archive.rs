//! Archives of a release: a folder with the archive's name, packed.

use std::path::{Path, PathBuf};
use std::process::Command;

use super::files;
use crate::shell::{Outcome, finish, output, printed};

/// Options of GNU `tar` that make archives independent of the user and the order of files.
const SAME: [&str; 4] = ["--sort=name", "--owner=0", "--group=0", "--numeric-owner"];

/// An archive that is being assembled.
pub struct Archive {
    name: String,
    /// The folder that contains the folder `name`, which is packed.
    staging: PathBuf,
}

impl Archive {
    /// Makes an empty archive.
    pub fn new(name: String) -> Outcome<Self> {
        let staging = files::staging(&name)?;
        Ok(Self { name, staging })
    }

    /// Returns the path of a file or folder of the archive before it is packed.
    pub fn place(&self, inside: &str) -> PathBuf {
        self.staging.join(&self.name).join(inside)
    }

    /// Adds a file, or a folder with its contents.
    pub fn add(&self, from: &Path, inside: &str) -> Outcome {
        files::copy(from, &self.place(inside))
    }

    /// Packs the archive into the files of the release. Returns the file.
    pub fn pack(&self) -> Outcome<PathBuf> {
        let file = format!("{}.tar.gz", self.name);
        let mut command = Command::new("tar");
        if output("tar", &["--version"]).is_some_and(|text| text.contains("GNU")) {
            command.args(SAME);
        }
        // File names without folders: some versions of `tar` take a colon for a machine name.
        command.args(["-czf", &file, &self.name]).current_dir(&self.staging);
        finish("tar", &mut command)?;
        files::publish(&self.staging.join(file))
    }
}

/// Returns the names of the files in an archive of the release.
pub fn names_in(file: &Path) -> Outcome<Vec<String>> {
    let name = file.file_name().unwrap_or_default();
    let folder = file.parent().unwrap_or(file);
    let text = printed("tar", Command::new("tar").arg("-tzf").arg(name).current_dir(folder))?;
    Ok(text.lines().filter(|line| !line.ends_with('/')).map(str::to_owned).collect())
}

/// Fails if an archive lacks one of these files. Names are relative to the folder in the archive.
pub fn demand(file: &Path, wanted: &[impl AsRef<str>]) -> Outcome {
    let names = names_in(file)?;
    let has = |wanted: &str| {
        names.iter().any(|name| name.split_once('/').is_some_and(|(_, rest)| rest == wanted))
    };
    let missing: Vec<&str> = wanted.iter().map(AsRef::as_ref).filter(|it| !has(it)).collect();
    if missing.is_empty() {
        return Ok(());
    }
    Err(format!("{} lacks {}", file.display(), missing.join(", ")))
}

/// Unpacks an archive as users do. Returns the folder in it.
pub fn unpack(file: &Path) -> Outcome<PathBuf> {
    let name = file.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let folder = files::staging(&format!("unpacked-{name}"))?;
    files::copy(file, &folder.join(&name))?;
    finish("tar", Command::new("tar").args(["-xzf", &name]).current_dir(&folder))?;
    let first = names_in(file)?.into_iter().next().unwrap_or_default();
    Ok(folder.join(first.split('/').next().unwrap_or_default()))
}
