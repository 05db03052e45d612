//! Contact times against 77 digits.
//!
//! A contact is planted at a known time, the flights are wound back from there, and the answer
//! is put to two questions. Is it right: at the time it gives, do the surfaces touch and close,
//! to rounding, by a computation with 77 digits? Is it the first: does no overlap beyond rounding
//! that closes show up earlier, among some hundred times and at every minimum between them?
//! Together they say: not early, not late, not missed.

mod generate;
mod linear;
mod number;
mod propagator;
mod situation;

use generate::{Air, Kind, Numbers};
use situation::Situation;

/// How far answers may be off, in roundings of the sizes involved: the 16 that count as zero in
/// the search, times the difference between its sizes and those here. Only grazes use this up.
const ROUNDINGS: f64 = 32.0;

/// From which depth an overlap counts, in the same units.
const VISIBLE: f64 = ROUNDINGS;

/// What a run of situations came to.
#[derive(Debug, Default)]
struct Tally {
    count: usize,
    contacts: usize,
    /// Largest d and -d at contacts that close, in roundings of its size.
    early: f64,
    late: f64,
}

fn check(seed: u64, count: usize, kind: Kind, air: Air, turns: bool) -> Tally {
    let mut numbers = Numbers(seed);
    let mut tally = Tally { count, ..Tally::default() };
    for number in 0..count {
        let situation = generate::situation(&mut numbers, kind, air, turns);
        let answer = situation.contact_time();
        if let Some(t) = answer {
            tally.contacts += 1;
            assert!(t.is_finite(), "{t} {situation:?}");
            match is_contact(&situation, t) {
                Ok(off) => {
                    tally.early = tally.early.max(off);
                    tally.late = tally.late.max(-off);
                }
                Err(why) => panic!("no contact at {t} ({number}): {why}: {situation:?}"),
            }
        }
        if let Some((t, d)) = earlier_overlap(&situation, answer) {
            panic!("{answer:?} ({number}), but at {t} they overlap by {d}: {situation:?}");
        }
    }
    tally
}

/// Whether the bodies touch and close at `t`, to rounding; if so, by how many roundings of its
/// size the distance is off zero there.
fn is_contact(situation: &Situation, t: f64) -> Result<f64, String> {
    let (length, speed) = situation.sizes(t);
    let span = if t > 0.0 { t } else { length / speed.max(f64::MIN_POSITIVE) };
    // At rest, any will do.
    let span = span.min(1e20);
    let (d, closing, is_behind) = situation.judge(t, span);
    let off = d / (f64::EPSILON * length);
    // Within the rounding of d, d' changes by more than its own rounding.
    let hop = (2.0 * ROUNDINGS * f64::EPSILON * length * situation.pull(t)).sqrt();
    let still = ROUNDINGS * f64::EPSILON * speed + hop;
    if !situation_in_range(situation, t) {
        return Err("outside of the horizon".into());
    }
    if off > ROUNDINGS {
        return Err(format!("early, d is {d:e}, {off} roundings"));
    }
    if closing > still {
        return Err(format!("opening, by {closing:e} over {still:e}"));
    }
    if off >= -ROUNDINGS {
        // Starts and turns may be anywhere within rounding of the surface.
        return Ok(if t > 0.0 && closing < -still { off } else { 0.0 });
    }
    // Deeper: closing overlaps at the start, those that turn, and centres that come out in front
    // of a rectangle.
    let step = 1e-7 * span;
    let came_out = situation.distance(&(t - step)).is_behind || is_behind;
    if t == 0.0 || came_out || closing.abs() <= 1e-7 * speed {
        Ok(0.0)
    } else {
        Err(format!("late, d is {d:e}, {off} roundings, d' {closing:e}"))
    }
}

fn situation_in_range(situation: &Situation, t: f64) -> bool {
    (0.0..=situation.horizon).contains(&t)
}

/// A time before the answer at which the bodies overlap visibly and close.
fn earlier_overlap(situation: &Situation, answer: Option<f64>) -> Option<(f64, f64)> {
    let end = answer.unwrap_or(if situation.horizon.is_finite() {
        situation.horizon
    } else {
        situation.end_of_interest()
    });
    let times = times(end);
    let look = |t: f64| situation.distance(&t);
    let visible = |t: f64| VISIBLE * f64::EPSILON * situation.sizes(t).0;
    let seen: Vec<_> = times.iter().map(|&t| look(t)).collect();
    for i in 1..times.len() {
        let (before, now) = (&seen[i - 1], &seen[i]);
        if before.is_behind || now.is_behind || now.value > before.value {
            continue;
        }
        let is_deep = |t, d: f64| d < -visible(t) && d < before.value - visible(t);
        if now.value < 0.0 && is_deep(times[i], now.value) {
            return Some((times[i], now.value));
        }
        let Some(after) = seen.get(i + 1).filter(|after| !after.is_behind) else { continue };
        // Further down than this goes no minimum, be it round or sharp.
        let drop = 4.0 * (before.value - now.value + after.value - now.value);
        if now.value <= after.value && now.value <= drop {
            let (t, d) = minimum(times[i - 1], times[i + 1], |t| look(t).value);
            // A centre may have passed the plane of a rectangle in between.
            let way = t - times[i - 1];
            let is_whole = || (0..40).all(|k| !look(t - way * libm::exp2(f64::from(-k))).is_behind);
            if is_deep(t, d) && is_whole() {
                return Some((t, d));
            }
        }
    }
    None
}

/// Evenly spaced, and denser towards both ends.
fn times(end: f64) -> Vec<f64> {
    let even = (0..=64).map(|i| end * f64::from(i) / 64.0);
    let halves = (7..40).scan(end / 64.0, |part, _| {
        *part *= 0.5;
        Some(*part)
    });
    let mut times: Vec<f64> = even.chain(halves.flat_map(|part| [part, end - part])).collect();
    times.sort_by(f64::total_cmp);
    times
}

/// Golden section search.
fn minimum(mut low: f64, mut high: f64, f: impl Fn(f64) -> f64) -> (f64, f64) {
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    let (mut a, mut b) = (high - GOLDEN * (high - low), low + GOLDEN * (high - low));
    let (mut f_a, mut f_b) = (f(a), f(b));
    for _ in 0..45 {
        if f_a < f_b {
            (high, b, f_b) = (b, a, f_a);
            a = high - GOLDEN * (high - low);
            f_a = f(a);
        } else {
            (low, a, f_a) = (a, b, f_b);
            b = low + GOLDEN * (high - low);
            f_b = f(b);
        }
    }
    if f_a < f_b { (a, f_a) } else { (b, f_b) }
}

macro_rules! contacts_of {
    ($name:ident, $seed:expr, $count:expr, $kind:ident, $air:ident, $turns:expr) => {
        #[test]
        fn $name() {
            let tally = check($seed, $count, Kind::$kind, Air::$air, $turns);
            println!("{tally:?}");
            // A test of nothing but misses would prove little.
            assert!(tally.contacts * 4 > tally.count, "{tally:?}");
        }
    };
}

contacts_of!(spheres_in_vacuum_meet_when_they_touch, 1, 10_000, Spheres, None, false);
contacts_of!(spheres_in_air_meet_when_they_touch, 2, 10_000, Spheres, Drag, false);
contacts_of!(fixed_spheres_are_met_when_they_touch, 3, 5_000, Sphere, None, false);
contacts_of!(fixed_spheres_in_air_are_met_when_they_touch, 4, 5_000, Sphere, Drag, false);
contacts_of!(planes_are_met_when_they_touch, 5, 10_000, HalfSpace, None, false);
contacts_of!(planes_in_air_are_met_when_they_touch, 6, 10_000, HalfSpace, Drag, false);
contacts_of!(rectangles_are_met_when_they_touch, 7, 10_000, Rectangle, None, false);
contacts_of!(rectangles_in_air_are_met_when_they_touch, 8, 10_000, Rectangle, Drag, false);
contacts_of!(turning_spheres_are_met_when_they_touch, 9, 2_000, Sphere, Drag, true);
contacts_of!(turning_planes_are_met_when_they_touch, 10, 3_000, HalfSpace, Drag, true);
contacts_of!(turning_rectangles_are_met_when_they_touch, 11, 5_000, Rectangle, None, true);
contacts_of!(turning_rectangles_in_air_are_met_when_they_touch, 12, 5_000, Rectangle, Drag, true);
contacts_of!(surfaces_of_revolution_are_met_when_they_touch, 13, 2_000, Band, None, false);
contacts_of!(surfaces_of_revolution_in_air_are_met_when_they_touch, 14, 1_000, Band, Drag, false);
contacts_of!(turning_surfaces_of_revolution_are_met_when_they_touch, 15, 700, Band, Drag, true);
