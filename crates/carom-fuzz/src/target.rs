//! One reader, or the engine: how its cases are drawn, and what must hold of each.

use std::panic::{self, AssertUnwindSafe};
use std::time::Duration;

use proptest::strategy::BoxedStrategy;

use crate::fault::Fault;
use crate::memory;
use crate::stopwatch::Stopwatch;

/// Longest processor time that a case may take.
pub const PATIENCE: Duration = Duration::from_secs(5);

/// A reader, or the engine.
#[derive(Debug, Clone, Copy)]
pub struct Target {
    /// Name of the target, as typed.
    pub name: &'static str,
    /// Description of its cases.
    pub about: &'static str,
    /// Number of cases of a whole campaign.
    pub campaign: u64,
    /// Strategy that draws cases. Each case is the content of a file.
    pub cases: fn() -> BoxedStrategy<Vec<u8>>,
    /// Checks a case.
    pub check: fn(&[u8]) -> Result<Answer, Fault>,
}

/// What a reader answers to a case. Both are right; a campaign in which one is missing tests
/// little.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Answer {
    /// The case is valid.
    Accepted,
    /// The case is invalid, and the error says so.
    Refused,
}

impl Target {
    /// Checks a case, its time and its memory, too.
    ///
    /// # Errors
    /// What it breaks.
    pub fn try_case(&self, case: &[u8]) -> Result<Answer, Fault> {
        let stopwatch = Stopwatch::start();
        let answer = panic::catch_unwind(AssertUnwindSafe(|| (self.check)(case)));
        let took = stopwatch.elapsed();
        let answer = answer.map_err(|payload| Fault::Panic(message(&*payload)))??;
        memory::check_peak()?;
        if took > PATIENCE { Err(Fault::Slow(took)) } else { Ok(answer) }
    }
}

/// Returns the message of a panic.
fn message(payload: &(dyn std::any::Any + Send)) -> String {
    let text = payload.downcast_ref::<String>().map(String::as_str);
    text.or(payload.downcast_ref::<&str>().copied()).unwrap_or("without a message").to_owned()
}
