//! An archive of a release: a folder of its name, packed.

use std::path::{Path, PathBuf};
use std::process::Command;

use super::files;
use crate::shell::{Outcome, finish, output, printed};

/// Options with which GNU's `tar` makes the same archive of the same files for every user.
const SAME: [&str; 4] = ["--sort=name", "--owner=0", "--group=0", "--numeric-owner"];

/// An archive that is put together.
pub struct Archive {
    name: String,
    /// What is packed lies in its folder `name`.
    staging: PathBuf,
}

impl Archive {
    /// An empty one.
    pub fn new(name: String) -> Outcome<Self> {
        let staging = files::staging(&name)?;
        Ok(Self { name, staging })
    }

    /// Where a file or folder of the archive lies until it is packed.
    pub fn place(&self, inside: &str) -> PathBuf {
        self.staging.join(&self.name).join(inside)
    }

    /// Adds a file, or a folder with all that is in it.
    pub fn add(&self, from: &Path, inside: &str) -> Outcome {
        files::copy(from, &self.place(inside))
    }

    /// Packs it, and puts it among the files of the release. Returns the file.
    pub fn pack(&self) -> Outcome<PathBuf> {
        let file = format!("{}.tar.gz", self.name);
        let mut command = Command::new("tar");
        if output("tar", &["--version"]).is_some_and(|text| text.contains("GNU")) {
            command.args(SAME);
        }
        // Names without folders: a colon is a machine to some versions of `tar`.
        command.args(["-czf", &file, &self.name]).current_dir(&self.staging);
        finish("tar", &mut command)?;
        files::publish(&self.staging.join(file))
    }
}

/// The names of the files in an archive of the release.
pub fn names_in(file: &Path) -> Outcome<Vec<String>> {
    let name = file.file_name().unwrap_or_default();
    let folder = file.parent().unwrap_or(file);
    let text = printed("tar", Command::new("tar").arg("-tzf").arg(name).current_dir(folder))?;
    Ok(text.lines().filter(|line| !line.ends_with('/')).map(str::to_owned).collect())
}

/// Refuses an archive that lacks one of these files. Their names begin below the folder that it holds.
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

/// Unpacks an archive as its users do. Returns the folder that it holds.
pub fn unpack(file: &Path) -> Outcome<PathBuf> {
    let name = file.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let folder = files::staging(&format!("unpacked-{name}"))?;
    files::copy(file, &folder.join(&name))?;
    finish("tar", Command::new("tar").args(["-xzf", &name]).current_dir(&folder))?;
    let first = names_in(file)?.into_iter().next().unwrap_or_default();
    Ok(folder.join(first.split('/').next().unwrap_or_default()))
}
