//! Protection of existing files.

use std::path::Path;

use crate::failure::Failure;

/// Whether files that are there are replaced.
#[derive(Debug, Clone, Copy, Default, clap::Args)]
pub struct Replacing {
    /// Replace files that are there already.
    #[arg(long, short)]
    pub force: bool,
}

impl Replacing {
    /// Refuses to replace existing files, unless forced. Devices are no such files.
    pub fn check<'a>(self, files: impl IntoIterator<Item = &'a Path>) -> Result<(), Failure> {
        let there = files.into_iter().find(|file| file.is_file() && !self.force);
        there.map_or(Ok(()), |file| Err(already_there(file)))
    }
}

/// Error for an existing file.
pub fn already_there(file: &Path) -> Failure {
    Failure::Usage(format!("{} is there already; --force replaces it", file.display()))
}
