//! Ticks: the multiples of a time on the world's clock, whatever the frames.

use crate::settings::Exact;

/// The fastest motion on springs turns by at most this angle from one tick to the next \[rad\]: the leapfrog
/// scheme is stable up to 2, and the phase of that motion is off by a hundredth of it.
const MOST_TURN: f64 = 0.5;
/// Largest number of halvings of a tick for springs.
const MOST_HALVINGS: u32 = 12;
/// Largest number of force ticks in a frame without springs, for frames of days in the motion of planets, say.
pub(super) const MOST_FORCE_TICKS: f64 = 64.0;
/// Largest number of zone ticks in a frame without small spheres.
const MOST_ZONE_TICKS: f64 = 128.0;
/// Most frames in a tick.
const MOST_FRAMES: f64 = 4.0;
/// The length of a frame is the difference of two rounded times. Frames that differ by less than this part
/// have the same ticks.
const ROUNDING: f64 = 1e-6;

/// The first tick after a time, both on the world's clock \[s\].
pub(super) fn first_tick_after(time: f64, tick: f64) -> f64 {
    let number = (time / tick).floor() + 1.0;
    let first = number * tick;
    if first > time { first } else { ((number + 1.0) * tick).max(time.next_up()) }
}

/// Adapts a tick \[s\] to frames of this length \[s\]: doubled while a frame has more than `most` ticks, halved
/// while a tick has too many frames.
pub(super) fn tick_for_frames(mut tick: f64, frame: f64, most: f64) -> f64 {
    while frame > most * tick * (1.0 + ROUNDING) {
        tick *= 2.0;
    }
    while tick > MOST_FRAMES * frame * (1.0 + ROUNDING) {
        tick *= 0.5;
    }
    tick
}

/// The zone tick \[s\] in frames of this length \[s\], before spheres or springs make it shorter.
pub(super) fn zone_tick(parameters: Exact, frame: f64) -> f64 {
    tick_for_frames(parameters.zone_tick, frame, MOST_ZONE_TICKS)
}

/// Number of halvings of a tick \[s\] for springs with this rate of motion \[1/s\].
pub(super) fn halvings_for_springs(rate: f64, tick: f64) -> u32 {
    halvings(tick, MOST_HALVINGS, |part| rate * part <= MOST_TURN)
}

/// Number of halvings of a tick \[s\] until it is short, at most `most`.
pub(super) fn halvings(tick: f64, most: u32, is_short: impl Fn(f64) -> bool) -> u32 {
    (0..most).find(|&times| is_short(part(tick, times))).unwrap_or(most)
}

/// Whether a tick \[s\] can be halved often enough for springs with this rate of motion \[1/s\].
pub(super) fn can_follow_springs(rate: f64, tick: f64) -> bool {
    rate * part(tick, MOST_HALVINGS) <= MOST_TURN
}

/// A tick \[s\] after this many halvings.
pub(super) fn part(tick: f64, halvings: u32) -> f64 {
    tick / f64::from(1u32 << halvings)
}
