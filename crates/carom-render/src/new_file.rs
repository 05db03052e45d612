//! Files that get their name only when they are complete.

use std::fs::{self, File, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use carom_scene::unfinished::{create_beside, create_folders_of};

/// A file under a temporary name in the target folder until [`Self::complete`]. If it is dropped
/// before, it is removed, and a file that already had the name is unchanged.
#[derive(Debug)]
pub(crate) struct NewFile {
    file: File,
    path: PathBuf,
    /// `None` if the target is no regular file, for example a pipe: that is written directly.
    unfinished: Option<PathBuf>,
}

impl NewFile {
    /// Creates the file and missing folders above it.
    pub fn create(path: &Path) -> io::Result<Self> {
        // A link keeps pointing to its target, which is replaced.
        let path = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
        if fs::metadata(&path).is_ok_and(|found| !found.is_file()) {
            let file = OpenOptions::new().write(true).open(&path)?;
            return Ok(Self { file, path, unfinished: None });
        }
        create_folders_of(&path)?;
        let (file, unfinished) = create_beside(&path)?;
        Ok(Self { file, path, unfinished: Some(unfinished) })
    }

    /// Renames the file to its final name, and replaces a file of that name.
    pub fn complete(mut self) -> io::Result<()> {
        let Some(unfinished) = &self.unfinished else {
            return self.file.flush();
        };
        // Some file systems report a full disk only here.
        self.file.sync_data()?;
        fs::rename(unfinished, &self.path)?;
        self.unfinished = None;
        Ok(())
    }
}

impl Write for NewFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.file.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

impl Drop for NewFile {
    fn drop(&mut self) {
        if let Some(unfinished) = &self.unfinished {
            // A destructor cannot return an error.
            drop(fs::remove_file(unfinished));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_keeps_its_old_content_until_the_new_one_is_complete() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a/b.txt");
        let write = |text: &str| {
            let mut file = NewFile::create(&path).unwrap();
            file.write_all(text.as_bytes()).unwrap();
            file
        };
        write("old").complete().unwrap();
        let new = write("new");
        assert_eq!(fs::read_to_string(&path).unwrap(), "old");
        drop(new);
        assert_eq!(fs::read_to_string(&path).unwrap(), "old");
        write("newer").complete().unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), "newer");
        let left = fs::read_dir(path.parent().unwrap()).unwrap().count();
        assert_eq!(left, 1, "unfinished files are gone");
    }

    #[test]
    fn two_at_once_do_not_disturb_each_other() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("b.txt");
        let mut first = NewFile::create(&path).unwrap();
        let mut second = NewFile::create(&path).unwrap();
        first.write_all(b"first").unwrap();
        second.write_all(b"second").unwrap();
        first.complete().unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), "first");
        second.complete().unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), "second");
    }
}
