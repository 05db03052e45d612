//! How calls end: a status, and a message for people.

use std::any::Any;
use std::cell::RefCell;
use std::ffi::{CStr, CString, c_char};
use std::panic::{AssertUnwindSafe, catch_unwind};

use carom::Error;
use carom_scene::part::PartError;
use carom_scene::{CheckpointError, SceneError};

/// How a call ended. After any status but CAROM_STATUS_OK the world is as it was before the call, unless
/// the function says otherwise, and carom_last_error() says what was wrong.
#[repr(i32)]
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum CaromStatus {
    /// Done.
    Ok = 0,
    /// A pointer is null, or a handle is zero.
    Null = 1,
    /// A handle names nothing: what it named was freed, or it was never given.
    Handle = 2,
    /// The world is in the middle of another call: of another thread, or of the one that called the
    /// function of a force.
    Busy = 3,
    /// A count, capacity or stride does not fit.
    Length = 4,
    /// A text is not UTF-8, or a constant is none of its enumeration.
    Argument = 5,
    /// A number makes no sense: not finite, negative where it must not be, ...
    Invalid = 6,
    /// An id names nothing in this world, or no scene has this name.
    Unknown = 7,
    /// The text of a scene makes no sense; the message names line and field.
    Scene = 8,
    /// The step was refused: a number would overflow, or there are more impacts than are allowed.
    Step = 9,
    /// The step was stopped by carom_world_set_stop().
    Stopped = 10,
    /// Bytes are no snapshot, or the snapshot has no bytes.
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

    /// An id that names nothing.
    pub fn unknown(kind: &str, id: u64) -> Self {
        Self::new(CaromStatus::Unknown, format!("there is no {kind} {id} in this world"))
    }

    /// A fault of the engine, which it tells in a panic.
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

/// What a function of the interface does, between C and the engine: no panic leaves it, and the message of
/// a failure is kept for carom_last_error().
pub(crate) fn call(work: impl FnOnce() -> Result<(), Failure>) -> CaromStatus {
    // What a panic may have left half done is a world, whose lock is poisoned then.
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
    /// The message of the last failure of this thread.
    static LAST: RefCell<CString> = RefCell::default();
}

fn remember(message: &str) {
    let text = CString::new(message.replace('\0', "\u{fffd}")).unwrap_or_default();
    // A thread that is about to end remembers nothing.
    let _ = LAST.try_with(|last| last.replace(text));
}

/// What was wrong in the last call of this thread that was refused, in UTF-8; empty if none was. The text
/// holds until the next refused call of this thread.
#[unsafe(no_mangle)]
pub extern "C" fn carom_last_error() -> *const c_char {
    LAST.try_with(|last| last.borrow().as_ptr()).unwrap_or(c"".as_ptr())
}

/// The name of a status, as in CAROM_STATUS_OK: "ok", "null", ...; "unknown status" for any other number.
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
