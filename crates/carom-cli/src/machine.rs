//! Description of the machine on which figures were measured.

use serde::Serialize;

/// Machine and version with which figures were measured.
#[derive(Debug, Clone, Serialize)]
pub struct Machine {
    pub carom: &'static str,
    pub os: &'static str,
    pub architecture: &'static str,
    pub cores: usize,
}

impl Machine {
    pub fn this() -> Self {
        Self {
            carom: env!("CARGO_PKG_VERSION"),
            os: std::env::consts::OS,
            architecture: std::env::consts::ARCH,
            cores: cores(),
        }
    }
}

impl std::fmt::Display for Machine {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { carom, os, architecture, cores } = self;
        write!(f, "carom {carom} on {os}, {architecture}, {cores} cores")
    }
}

/// Number of cores that the program may use.
pub fn cores() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}

/// Peak memory of this program \[bytes\], if the system reports it.
pub fn peak_memory() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kibibytes: u64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(1024 * kibibytes)
}
