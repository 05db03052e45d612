//! The first time at which a function becomes positive whose second derivative is bounded.

/// Least step, as a part of the interval, where the bound allows none.
const LEAST: f64 = 1e-12;
/// Largest number of steps towards a root; each step is a valid bound, so the search may end anywhere.
const MOST_STEPS: u32 = 1000;

/// First time in `(0, length]` at which a function is positive, to rounding. None is stepped over: up to the next
/// step the function is below a parabola of the largest `curvature`.
///
/// `function` gives the value and the slope at a time; it must not be positive at 0. `curvature` is an upper bound of
/// the second derivative.
pub(crate) fn first_positive(
    function: impl Fn(f64) -> [f64; 2],
    curvature: f64,
    length: f64,
) -> Option<f64> {
    let (mut time, mut least) = (0.0, LEAST * length);
    let [mut value, mut slope] = function(time);
    for _ in 0..MOST_STEPS {
        let safe = time_below(value.min(0.0), slope, curvature);
        least = if safe < least { 2.0 * least } else { LEAST * length };
        let next = (time + safe.max(least)).min(length);
        if next <= time {
            return None;
        }
        [value, slope] = function(next);
        if value > 0.0 {
            return Some(bisected(&function, [time, next]));
        }
        if next == length {
            return None;
        }
        time = next;
    }
    Some(time)
}

/// Returns how long `value + slope t + curvature t²/2` stays below 0, from a value that is not
/// above it.
fn time_below(value: f64, slope: f64, curvature: f64) -> f64 {
    let root = (slope * slope - 2.0 * curvature * value).max(0.0).sqrt();
    let time = if slope > 0.0 { -2.0 * value / (slope + root) } else { (root - slope) / curvature };
    if time.is_nan() { 0.0 } else { time }
}

/// The first number in an interval at which a function is positive, which it is at the end.
pub(crate) fn bisected(
    function: &impl Fn(f64) -> [f64; 2],
    [mut before, mut after]: [f64; 2],
) -> f64 {
    loop {
        let middle = before + 0.5 * (after - before);
        if middle <= before || middle >= after {
            return after;
        }
        if function(middle)[0] > 0.0 {
            after = middle;
        } else {
            before = middle;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn crossing_is_found_to_rounding() {
        let time = first_positive(|t| [t * t - 2.0, 2.0 * t], 2.0, 10.0).unwrap();
        assert!((time - 2.0f64.sqrt()).abs() < 1e-15, "{time}");
    }

    #[test]
    fn brief_crossing_is_not_stepped_over() {
        // Positive for 2e-7 about 3.
        let function = |t: f64| [1e-14 - (t - 3.0) * (t - 3.0), -2.0 * (t - 3.0)];
        let time = first_positive(function, 2.0, 10.0).unwrap();
        assert!((time - 3.0).abs() < 1.1e-7, "{time}");
        let below = |t: f64| [-1e-14 - (t - 3.0) * (t - 3.0), -2.0 * (t - 3.0)];
        assert_eq!(first_positive(below, 2.0, 10.0), None);
    }

    #[test]
    fn function_that_begins_at_a_root_crosses_the_next_one() {
        // Falls at first, and rises through 0 at 1.
        let time = first_positive(|t| [t * (t - 1.0), 2.0 * t - 1.0], 2.0, 10.0).unwrap();
        assert!((time - 1.0).abs() < 1e-15, "{time}");
        // Rises at once, from no slope.
        assert!(first_positive(|t| [t * t, 2.0 * t], 2.0, 10.0).unwrap() < 1e-10);
        assert_eq!(first_positive(|t| [-t, -1.0], 0.0, 10.0), None);
    }
}
