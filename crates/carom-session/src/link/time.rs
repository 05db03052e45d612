//! Times of links: checked, and easy to read.

use super::error::LinkError;

/// Decimals of a time that people read \[1\]: microseconds.
const READABLE_DECIMALS: usize = 6;

/// A time \[s\], if it is one.
pub fn checked_time(seconds: f64) -> Result<f64, LinkError> {
    if seconds >= 0.0 && seconds.is_finite() {
        // Not -0, which is a time as well as 0 but reads like none.
        Ok(seconds.abs())
    } else {
        Err(LinkError::Time { found: format!("{seconds:?}") })
    }
}

/// A time \[s\] near this one that is easier to read, and as near to the same frame, where none is
/// shorter than `shortest_frame` \[s\].
pub fn readable(time: f64, shortest_frame: f64) -> f64 {
    let is_same = |rounded: &f64| (rounded - time).abs() < 0.25 * shortest_frame;
    let rounded = (0..=READABLE_DECIMALS).filter_map(|decimals| {
        let text = format!("{time:.decimals$}");
        text.parse().ok()
    });
    rounded.into_iter().find(is_same).unwrap_or(time)
}
