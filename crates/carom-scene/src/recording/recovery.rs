//! Completes recordings of killed runs.

use std::fs::{File, OpenOptions};
use std::io::{self, BufRead, BufReader, Read, Seek, SeekFrom};
use std::path::Path;

use super::recovered::{Recovered, RecoveryError, recover_by};
use super::{csv_table, impact_arrays, impacts, ledger, npz};
use crate::unfinished::lock;

/// Creates the NPZ file `target`, a trajectory or impacts, from the file `unfinished` of a killed run, and removes
/// `unfinished`.
///
/// # Errors
/// [`RecoveryError`]. Both files are then unchanged, except if only the removal of `unfinished`
/// failed.
pub fn recover(unfinished: &Path, target: &Path) -> Result<Recovered, RecoveryError> {
    recover_by(unfinished, target, |source, target| {
        let trajectory = npz::close(source, target.try_clone()?)?;
        trajectory.map_or_else(|| impact_arrays::close(source, target), |it| Ok(Some(it)))
    })
}

/// Removes the last line of a table if it is incomplete, as a killed run may leave it. Returns the
/// number of bytes removed.
///
/// # Errors
/// [`RecoveryError::Unreadable`]; [`RecoveryError::Foreign`] if the first line is incomplete;
/// [`RecoveryError::ForeignTable`] if the header is not that of a trajectory, a table of impacts or
/// a ledger.
pub fn recover_table(path: &Path) -> Result<u64, RecoveryError> {
    let unreadable = |source| RecoveryError::Unreadable { path: path.to_owned(), source };
    let foreign = || RecoveryError::Foreign { path: path.to_owned() };
    let file = OpenOptions::new().read(true).write(true).open(path);
    let mut file = file.map_err(unreadable)?;
    lock(&file).map_err(unreadable)?;
    let header = first_line(&mut file).map_err(unreadable)?.ok_or_else(foreign)?;
    if !is_header(&header) {
        return Err(RecoveryError::ForeignTable { path: path.to_owned() });
    }
    cut_last_line(&mut file).map_err(unreadable)?.ok_or_else(foreign)
}

/// Upper bound of the length of any header \[bytes\].
const LONGEST_HEADER: u64 = 1 << 20;

/// Reads the first line without its end; `None` if it is incomplete.
fn first_line(file: &mut File) -> io::Result<Option<Vec<u8>>> {
    let mut line = Vec::new();
    BufReader::new(file.by_ref().take(LONGEST_HEADER)).read_until(b'\n', &mut line)?;
    Ok(line.strip_suffix(b"\n").map(<[u8]>::to_vec))
}

/// Whether the line is the header of a table that runs write. Trajectories may have further columns.
fn is_header(line: &[u8]) -> bool {
    let further = line.strip_prefix(csv_table::HEADER.join(",").as_bytes());
    further.is_some_and(|it| it.is_empty() || it.starts_with(b","))
        || line == impacts::HEADER.join(",").as_bytes()
        || line == ledger::HEADER.join(",").as_bytes()
}

/// Removes an incomplete last line; returns its length, or `None` if the file has no complete line.
fn cut_last_line(file: &mut File) -> io::Result<Option<u64>> {
    let length = file.seek(SeekFrom::End(0))?;
    let mut block = [0; 4096];
    let mut end = length;
    while end > 0 {
        let start = end.saturating_sub(block.len() as u64);
        let part = &mut block[..(end - start) as usize];
        file.seek(SeekFrom::Start(start))?;
        file.read_exact(part)?;
        if let Some(place) = part.iter().rposition(|byte| *byte == b'\n') {
            let whole = start + place as u64 + 1;
            if whole < length {
                file.set_len(whole)?;
            }
            return Ok(Some(length - whole));
        }
        end = start;
    }
    Ok(None)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Recovers a file with this content; returns the result and the new content.
    fn recovered(content: &str) -> (Result<u64, RecoveryError>, String) {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("t.csv");
        std::fs::write(&path, content).unwrap();
        let cut = recover_table(&path);
        (cut, std::fs::read_to_string(&path).unwrap())
    }

    #[test]
    fn tables_of_runs_lose_a_line_without_end_and_other_files_stay_as_they_are() {
        let further = csv_table::HEADER.join(",") + ",dx/d(acceleration.1)\n";
        let turning = "t,ball,x,y,z,vx,vy,vz,qx,qy,qz,qw,wx,wy,wz\n".to_owned();
        let headers =
            [csv_table::HEADER.join(","), impacts::HEADER.join(","), ledger::HEADER.join(",")];
        for header in headers.map(|it| it + "\n").into_iter().chain([turning, further]) {
            let (cut, left) = recovered(&(header.clone() + "1,2\n3,"));
            assert_eq!((cut.unwrap(), left), (2, header + "1,2\n"));
        }
        for foreign in ["name,points\nanna,3\nben,4", "notes\nof a day", "\n\nlast"] {
            let (cut, left) = recovered(foreign);
            assert!(matches!(cut, Err(RecoveryError::ForeignTable { .. })), "{foreign}");
            assert_eq!(left, foreign);
        }
        assert!(matches!(recovered("t,ball").0, Err(RecoveryError::Foreign { .. })));
    }
}
