//! Times that are not rounded in long runs.

/// A time as the sum of a start on the world's clock and the time since then \[s\], so that phases of long runs are
/// not rounded.
pub(crate) type Moment = [f64; 2];
