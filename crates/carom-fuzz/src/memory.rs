//! Largest memory use of the process, where the system reports it.

use std::fs;

use crate::fault::Fault;

/// Most memory of the process \[bytes\].
pub const MOST_BYTES: u64 = 500_000_000;

/// Returns the largest memory use of the process so far \[bytes\]; `None` where the system does not
/// report it.
pub fn peak() -> Option<u64> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kilobytes: u64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(1024 * kilobytes)
}

/// Checks the peak, and begins a new one if it was too high, so that the next case is not blamed
/// for it.
pub fn check_peak() -> Result<(), Fault> {
    match peak() {
        Some(bytes) if bytes > MOST_BYTES => {
            // Where this is refused, the next case is blamed as well.
            let _ = fs::write("/proc/self/clear_refs", "5");
            Err(Fault::Memory { bytes })
        }
        _ => Ok(()),
    }
}
