//! Writes files under a temporary name until they are complete.

use std::ffi::OsString;
use std::fs::{self, File, OpenOptions, TryLockError};
use std::io;
use std::path::{Path, PathBuf};

/// Most unfinished files beside one target: those of programs that run at the same time, and those
/// that killed programs left.
const MOST_UNFINISHED: u32 = 1000;
/// Ending of an unfinished file.
const UNFINISHED: &str = ".unfinished";
/// Ending of a complete file while it is created from an unfinished one.
const CLOSING: &str = ".closing";

/// Creates and locks a new file `NAME.N.unfinished` beside `path`; returns it with its path.
///
/// # Errors
/// [`io::Error`] if the folder cannot be written to, or already contains a thousand such files.
pub fn create_beside(path: &Path) -> io::Result<(File, PathBuf)> {
    let Some(name) = path.file_name() else {
        return Err(io::Error::new(io::ErrorKind::InvalidInput, "this names no file"));
    };
    for number in 0..MOST_UNFINISHED {
        let mut unfinished = name.to_owned();
        unfinished.push(format!(".{number}{UNFINISHED}"));
        let unfinished = path.with_file_name(unfinished);
        match OpenOptions::new().read(true).write(true).create_new(true).open(&unfinished) {
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
            created => {
                let file = created?;
                if let Err(error) = lock(&file) {
                    drop(file);
                    // Ignored, because an earlier error is being reported.
                    drop(fs::remove_file(&unfinished));
                    return Err(error);
                }
                return Ok((file, unfinished));
            }
        }
    }
    let text = format!("{MOST_UNFINISHED} unfinished files (*{UNFINISHED}) lie beside it");
    Err(io::Error::new(io::ErrorKind::AlreadyExists, text))
}

/// Creates the missing folders above a file.
///
/// # Errors
/// [`io::Error`] if a folder cannot be created, for example below a file.
pub fn create_folders_of(path: &Path) -> io::Result<()> {
    let Some(folder) = path.parent() else { return Ok(()) };
    fs::create_dir_all(folder).map_err(|error| {
        let file = folder.ancestors().find(|it| it.exists() && !it.is_dir());
        // The error of the system would only say that something exists.
        file.map_or(error, |file| io::Error::other(format!("{} is not a folder", file.display())))
    })
}

/// Returns the path of the complete file: the name without `.N.unfinished`.
pub fn target_of(unfinished: &Path) -> Option<PathBuf> {
    let name = unfinished.file_name()?.to_str()?.strip_suffix(UNFINISHED)?;
    let (target, number) = name.rsplit_once('.')?;
    let is_number = !number.is_empty() && number.bytes().all(|it| it.is_ascii_digit());
    (is_number && !target.is_empty()).then(|| unfinished.with_file_name(target))
}

/// Lists the unfinished files beside `target`, by number.
pub fn beside(target: &Path) -> Vec<PathBuf> {
    let numbered = (0..MOST_UNFINISHED).filter_map(|number| {
        let mut name = target.file_name()?.to_owned();
        name.push(format!(".{number}{UNFINISHED}"));
        Some(target.with_file_name(name))
    });
    numbered.filter(|file| file.is_file()).collect()
}

/// Takes the lock that the writer of an unfinished file holds while it runs. File systems without
/// locks count as unlocked.
pub(crate) fn lock(file: &File) -> io::Result<()> {
    match file.try_lock() {
        Err(TryLockError::WouldBlock) => {
            let text = "a program is still writing it";
            Err(io::Error::new(io::ErrorKind::WouldBlock, text))
        }
        Err(TryLockError::Error(_)) | Ok(()) => Ok(()),
    }
}

/// A file that grows in another format, in `NAME.N.unfinished` beside its target, until the target
/// can be created from it. If it is dropped or the program is killed, the unfinished file remains.
#[derive(Debug)]
pub struct Unfinished {
    file: File,
    /// `None` if the target is no regular file, such as a pipe: the unfinished file then has no
    /// name.
    place: Option<PathBuf>,
    target: PathBuf,
    /// The target if it is no regular file; its reader takes it as complete once it is closed.
    stream: Option<File>,
}

impl Unfinished {
    /// Creates the unfinished file and the missing folders above it.
    ///
    /// # Errors
    /// The same as those of [`create_beside`].
    #[cfg(feature = "recording")]
    pub fn create(target: &Path) -> io::Result<Self> {
        // If the target is a link, the file behind it is replaced, not the link.
        let target = fs::canonicalize(target).unwrap_or_else(|_| target.to_owned());
        if fs::metadata(&target).is_ok_and(|found| !found.is_file()) {
            let stream = Some(OpenOptions::new().write(true).open(&target)?);
            return Ok(Self { file: tempfile::tempfile()?, place: None, target, stream });
        }
        create_folders_of(&target)?;
        let (file, place) = create_beside(&target)?;
        Ok(Self { file, place: Some(place), target, stream: None })
    }

    /// Creates the unfinished file and calls `begin` to start it; removes it if `begin` fails.
    ///
    /// # Errors
    /// The same as those of [`Self::create`], and those of `begin`.
    #[cfg(feature = "recording")]
    pub fn begin<T, E: From<io::Error>>(
        target: &Path,
        begin: impl FnOnce(&mut File) -> Result<T, E>,
    ) -> Result<(Self, T), E> {
        let mut unfinished = Self::create(target)?;
        match begin(unfinished.file()) {
            Ok(begun) => Ok((unfinished, begun)),
            Err(error) => {
                // Ignored, because an earlier error is being reported.
                unfinished.remove().ok();
                Err(error)
            }
        }
    }

    /// Opens an unfinished file that a program left, in order to create `target` from it.
    ///
    /// # Errors
    /// [`io::Error`] if the file cannot be read, or is still being written.
    pub fn open(place: &Path, target: &Path) -> io::Result<Self> {
        let file = File::open(place)?;
        lock(&file)?;
        let (place, target) = (Some(place.to_owned()), target.to_owned());
        Ok(Self { file, place, target, stream: None })
    }

    /// The file to which the growing form is written.
    pub fn file(&mut self) -> &mut File {
        &mut self.file
    }

    /// Path of the unfinished file, if it has a name.
    pub fn place(&self) -> Option<&Path> {
        self.place.as_deref()
    }

    /// Creates the complete file, which replaces the target. `close` reads the unfinished file from
    /// its start and writes the complete one. The unfinished file remains.
    ///
    /// # Errors
    /// The error of `close` or of the disk; the target is then unchanged.
    pub fn close<T, E: From<io::Error>>(
        &mut self,
        close: impl FnOnce(&mut File, File) -> Result<T, E>,
    ) -> Result<T, E> {
        io::Seek::rewind(&mut self.file)?;
        let Some(place) = &self.place else {
            let stream = self.stream.take();
            let stream = stream.ok_or_else(|| io::Error::other("it is complete already"))?;
            return close(&mut self.file, stream);
        };
        let closing = closing(place, &self.target);
        let created = create_folders_of(&closing).and_then(|()| File::create(&closing));
        let closed = created.map_err(E::from).and_then(|target| {
            let written = close(&mut self.file, target.try_clone()?)?;
            // Some file systems report a full disk only here.
            target.sync_data()?;
            fs::rename(&closing, &self.target)?;
            Ok(written)
        });
        if closed.is_err() {
            // Ignored, because an earlier error is being reported.
            drop(fs::remove_file(&closing));
        }
        closed
    }

    /// Removes the unfinished file.
    ///
    /// # Errors
    /// [`io::Error`] if the disk fails.
    pub fn remove(self) -> io::Result<()> {
        let Self { file, place, .. } = self;
        drop(file);
        place.map_or(Ok(()), fs::remove_file)
    }
}

/// Path at which the complete file is created: in the folder of the target, so that it can be
/// renamed, under a unique name.
fn closing(place: &Path, target: &Path) -> PathBuf {
    let name = place.file_name().map(OsString::from).unwrap_or_default();
    let mut name = match name.to_str().and_then(|it| it.strip_suffix(UNFINISHED)) {
        Some(stem) => OsString::from(stem),
        None => name,
    };
    name.push(CLOSING);
    target.with_file_name(name)
}

#[cfg(test)]
#[cfg(feature = "recording")]
mod tests {
    use std::io::{Read, Write};

    use super::*;

    #[test]
    fn a_target_is_the_name_without_the_number_and_the_ending() {
        let target = |name: &str| target_of(Path::new(name));
        assert_eq!(target("a/t.npz.12.unfinished"), Some(PathBuf::from("a/t.npz")));
        for other in ["t.npz", "t.npz.unfinished", "t.npz..unfinished", "t.x1.unfinished"] {
            assert_eq!(target(other), None, "{other}");
        }
        assert_eq!(target(".0.unfinished"), None);
    }

    #[test]
    fn a_folder_below_a_file_is_refused_by_the_name_of_the_file() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("file");
        fs::write(&file, "").unwrap();
        let error = create_folders_of(&file.join("a/b/t.csv")).unwrap_err();
        assert_eq!(error.to_string(), format!("{} is not a folder", file.display()));
        assert!(create_folders_of(Path::new("t.csv")).is_ok());
    }

    #[test]
    fn a_target_stays_as_it_was_where_closing_fails_and_the_unfinished_file_stays() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("t.txt");
        fs::write(&path, "old").unwrap();
        let mut unfinished = Unfinished::create(&path).unwrap();
        unfinished.file().write_all(b"grown").unwrap();
        let failed = unfinished.close(|_, mut target| {
            target.write_all(b"half")?;
            Err::<(), _>(io::Error::other("no more"))
        });
        assert_eq!(failed.unwrap_err().to_string(), "no more");
        assert_eq!(fs::read_to_string(&path).unwrap(), "old");
        assert_eq!(beside(&path), [path.with_file_name("t.txt.0.unfinished")]);
        let close = |source: &mut File, mut target: File| {
            let mut text = String::new();
            source.read_to_string(&mut text)?;
            target.write_all(text.to_uppercase().as_bytes())
        };
        unfinished.close(close).unwrap();
        unfinished.remove().unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), "GROWN");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn what_is_still_being_written_cannot_be_opened() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("t.txt");
        let first = Unfinished::create(&path).unwrap();
        let place = first.place().unwrap().to_owned();
        let second = Unfinished::create(&path).unwrap();
        assert_ne!(second.place().unwrap(), place);
        let error = Unfinished::open(&place, &path).unwrap_err();
        assert_eq!(error.kind(), io::ErrorKind::WouldBlock);
        drop(first);
        Unfinished::open(&place, &path).unwrap();
    }
}
