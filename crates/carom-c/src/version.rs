//! The version of the interface.

use std::ffi::{CStr, c_char};

use crate::status::{CaromStatus, Failure, call};

/// The version of the interface in this header. Within one version functions are only added:
/// structures, constants and parameters stay the same.
pub const CAROM_ABI_VERSION: u32 = 3;

/// Returns the version of Carom, for example "0.1.0".
#[unsafe(no_mangle)]
pub extern "C" fn carom_version() -> *const c_char {
    const VERSION: &CStr =
        match CStr::from_bytes_with_nul(concat!(env!("CARGO_PKG_VERSION"), "\0").as_bytes()) {
            Ok(version) => version,
            Err(_) => c"",
        };
    VERSION.as_ptr()
}

/// Returns the version of the library's interface.
#[unsafe(no_mangle)]
pub extern "C" fn carom_abi_version() -> u32 {
    CAROM_ABI_VERSION
}

/// Checks that the library has the interface that the program was compiled for. Call it first, with
/// CAROM_ABI_VERSION.
#[unsafe(no_mangle)]
pub extern "C" fn carom_check_abi(version: u32) -> CaromStatus {
    call(|| {
        if version == CAROM_ABI_VERSION {
            return Ok(());
        }
        let problem = format!(
            "the program was compiled for version {version} of the interface, and this library has \
             version {CAROM_ABI_VERSION}"
        );
        Err(Failure::new(CaromStatus::Abi, problem))
    })
}
