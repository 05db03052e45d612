//! Times in links, with few digits.

use super::error::LinkError;

/// Most decimals of a rounded time: microseconds.
const READABLE_DECIMALS: usize = 6;

/// Returns the time \[s\] if it is valid.
pub fn checked_time(seconds: f64) -> Result<f64, LinkError> {
    if seconds >= 0.0 && seconds.is_finite() {
        // Turns -0 into 0.
        Ok(seconds.abs())
    } else {
        Err(LinkError::Time { found: format!("{seconds:?}") })
    }
}

/// Rounds a time \[s\] to the fewest decimals that keep it within a quarter of `shortest_frame`
/// \[s\], so that it means the same frame.
pub fn readable(time: f64, shortest_frame: f64) -> f64 {
    let is_same = |rounded: &f64| (rounded - time).abs() < 0.25 * shortest_frame;
    let rounded = (0..=READABLE_DECIMALS).filter_map(|decimals| {
        let text = format!("{time:.decimals$}");
        text.parse().ok()
    });
    rounded.into_iter().find(is_same).unwrap_or(time)
}
