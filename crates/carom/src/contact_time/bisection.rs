//! When a contact begins, by bisection.

/// Result of a probe of a bisection at one instant.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Probe {
    /// No contact yet: it begins later.
    Before,
    /// The contact begins exactly here.
    At,
    /// Already intersecting: it began earlier.
    After,
}

/// Result of a bisection.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bisection {
    /// The instant probed last \[s\].
    pub time: f64,
    /// Result of the last probe. Unless it is [`Probe::At`], the contact is at most `h / 2^n` away.
    pub last: Probe,
}

/// Time of the first contact in `(0, h]`, given that the bodies intersect at `h`.
///
/// Halves the interval at most `max_halvings` (n) times; the error is at most `h / 2^n`.
/// Source: the tutorial's `GetTimeOfIntersection`; `docs/physics/bisect-and-discrete.md`, "Time of
/// contact".
///
/// - `h` \[s\], > 0; `max_halvings` >= 1
/// - `probe` tells what is there at a time \[s\] in `(0, h)`
pub fn bisect(h: f64, max_halvings: u32, mut probe: impl FnMut(f64) -> Probe) -> Bisection {
    let (mut floor, mut ceiling) = (0.0, h);
    let mut found = Bisection { time: h, last: Probe::After };
    for _ in 0..max_halvings {
        let time = floor + 0.5 * (ceiling - floor);
        if time == floor || time == ceiling {
            // The interval has no number inside.
            break;
        }
        found = Bisection { time, last: probe(time) };
        match found.last {
            Probe::At => break,
            Probe::Before => floor = time,
            Probe::After => ceiling = time,
        }
    }
    found
}
