//! Cases that once broke a promise, each in a file of the folder of its target.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use crate::target::Target;

/// A case of the corpus.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Known {
    /// Path of its file.
    pub path: PathBuf,
    /// Content of its file.
    pub case: Vec<u8>,
}

impl Known {
    /// All cases of a target in the corpus in `folder`, in the order of their names.
    ///
    /// # Errors
    /// Files that cannot be read. A target without a folder has none.
    pub fn of(target: &Target, folder: &Path) -> io::Result<Vec<Self>> {
        let entries = match fs::read_dir(folder.join(target.name)) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(Vec::new()),
            entries => entries?,
        };
        let mut paths =
            entries.map(|entry| entry.map(|it| it.path())).collect::<io::Result<Vec<_>>>()?;
        paths.sort();
        let read = |path: PathBuf| Ok(Self { case: fs::read(&path)?, path });
        paths.into_iter().map(read).collect()
    }
}
