//! Results of calls: a status, and a message for people.

use std::any::Any;
use std::cell::RefCell;
use std::ffi::{CStr, CString, c_char};
use std::panic::{AssertUnwindSafe, catch_unwind};

use carom::Error;
use carom_scene::part::PartError;
use carom_scene::{CheckpointError, SceneError};

/// Result of a call. After any status but CAROM_STATUS_OK the world is unchanged, unless the
/// function states otherwise, and carom_last_error() returns the reason.
#[repr(i32)]
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum CaromStatus {
    /// The call succeeded.
    Ok = 0,
    /// A pointer is null, or a handle is zero.
    Null = 1,
    /// A handle is unknown: its object was freed or never existed.
    Handle = 2,
    /// Another call is using the world: one of another thread, or the one that called the function
    /// of a force.
    Busy = 3,
    /// A count, capacity or stride does not fit.
    Length = 4,
    /// A text is not UTF-8, or a number is no constant of its enumeration.
    Argument = 5,
    /// A number is invalid: not finite, negative where it must not be, ...
    Invalid = 6,
    /// An id is unknown in this world, or no scene has this name.
    Unknown = 7,
    /// The text of a scene is invalid; the message has line and field.
    Scene = 8,
    /// The step was refused: a number would overflow, or there were more impacts than allowed.
    Step = 9,
    /// carom_world_set_stop() stopped the step.
    Stopped = 10,
    /// Bytes are no snapshot, or a snapshot cannot be written as bytes.
    Snapshot = 11,
    /// There is not enough memory.
    Memory = 12,
    /// The program was compiled for another version of the interface.
    Abi = 13,
    /// A fault of the engine. The world can only be freed.
    Panic = 14,
}

/// Why a call was refused.
#[derive(Debug)]
pub(crate) struct Failure {
    pub status: CaromStatus,
    pub message: String,
}

impl Failure {
    pub fn new(status: CaromStatus, message: impl ToString) -> Self {
        Self { status, message: message.to_string() }
    }

    /// Returns the failure of an unknown id.
    pub fn unknown(kind: &str, id: u64) -> Self {
        Self::new(CaromStatus::Unknown, format!("there is no {kind} {id} in this world"))
    }

    /// Returns the failure of a panic of the engine.
    fn of_panic(panic: &(dyn Any + Send)) -> Self {
        let text = panic.downcast_ref::<String>().map(String::as_str);
        let text = text.or_else(|| panic.downcast_ref::<&str>().copied());
        let message = format!("a fault of the engine: {}", text.unwrap_or("it says nothing"));
        Self::new(CaromStatus::Panic, message)
    }
}

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        let status = match error {
            Error::Invalid { .. } => CaromStatus::Invalid,
            Error::Unknown(_) => CaromStatus::Unknown,
            Error::Stopped { .. } => CaromStatus::Stopped,
            _ => CaromStatus::Step,
        };
        Self::new(status, error)
    }
}

impl From<SceneError> for Failure {
    fn from(error: SceneError) -> Self {
        let status = match error {
            SceneError::Unknown { .. } | SceneError::Unreadable { .. } => CaromStatus::Unknown,
            _ => CaromStatus::Scene,
        };
        Self::new(status, error)
    }
}

impl From<PartError> for Failure {
    fn from(error: PartError) -> Self {
        Self::new(CaromStatus::Scene, error)
    }
}

impl From<CheckpointError> for Failure {
    fn from(error: CheckpointError) -> Self {
        let status = match error {
            CheckpointError::NoMemory => CaromStatus::Memory,
            _ => CaromStatus::Snapshot,
        };
        Self::new(status, error)
    }
}

/// Runs the work of a function of the interface: no panic leaves it, and carom_last_error() keeps
/// the message of a failure.
pub(crate) fn call(work: impl FnOnce() -> Result<(), Failure>) -> CaromStatus {
    // A panic may leave a world half done; its lock is then poisoned.
    let done = catch_unwind(AssertUnwindSafe(work));
    match done.unwrap_or_else(|panic| Err(Failure::of_panic(&*panic))) {
        Ok(()) => CaromStatus::Ok,
        Err(failure) => {
            remember(&failure.message);
            failure.status
        }
    }
}

thread_local! {
    /// The message of the last failure in this thread.
    static LAST: RefCell<CString> = RefCell::default();
}

fn remember(message: &str) {
    let text = CString::new(message.replace('\0', "\u{fffd}")).unwrap_or_default();
    // A thread that is ending keeps no message.
    let _ = LAST.try_with(|last| last.replace(text));
}

/// Returns the message of the last refused call of this thread, in UTF-8; empty if none was
/// refused. The text is valid until the next refused call of this thread.
#[unsafe(no_mangle)]
pub extern "C" fn carom_last_error() -> *const c_char {
    LAST.try_with(|last| last.borrow().as_ptr()).unwrap_or(c"".as_ptr())
}

/// Returns the name of a status: "ok" for CAROM_STATUS_OK, "null", ...; "unknown status" for any
/// other number.
#[unsafe(no_mangle)]
pub extern "C" fn carom_status_name(status: i32) -> *const c_char {
    const NAMES: [&CStr; 15] = [
        c"ok",
        c"null",
        c"handle",
        c"busy",
        c"length",
        c"argument",
        c"invalid",
        c"unknown",
        c"scene",
        c"step",
        c"stopped",
        c"snapshot",
        c"memory",
        c"abi",
        c"panic",
    ];
    let name = usize::try_from(status).ok().and_then(|status| NAMES.get(status).copied());
    name.unwrap_or(c"unknown status").as_ptr()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_becomes_a_status_with_its_message() {
        let number = 7;
        assert_eq!(call(|| panic!("sphere {number} is lost")), CaromStatus::Panic);
        // SAFETY: the message is a text that ends in a zero.
        let message = unsafe { CStr::from_ptr(carom_last_error()) };
        assert_eq!(message, c"a fault of the engine: sphere 7 is lost");
    }

    #[test]
    fn a_message_ends_where_it_should() {
        let failure = || Err(Failure::new(CaromStatus::Scene, "a\0b"));
        assert_eq!(call(failure), CaromStatus::Scene);
        // SAFETY: the message is a text that ends in a zero.
        let message = unsafe { CStr::from_ptr(carom_last_error()) };
        assert_eq!(message.to_str(), Ok("a\u{fffd}b"));
    }
}
