//! The pace of simulated time relative to a clock.

use carom_session::{FASTEST, LONGEST_DELAY, Pace, SLOWEST};

const FRAME: f64 = 1.0 / 60.0;

fn playing(speed: f64) -> Pace {
    let mut pace = Pace::new();
    pace.set_playing(true);
    pace.set_speed(speed);
    pace
}

/// Irregular times between two pictures \[s\], from 0.2 ms to 100 ms.
fn irregular() -> impl Iterator<Item = f64> {
    let mut state = 1_u64;
    std::iter::repeat_with(move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        0.0002 + 0.0998 * ((state >> 33) as f64 / f64::from(u32::MAX / 2))
    })
}

#[test]
fn frames_follow_the_clock_without_drift_whatever_the_pictures() {
    for speed in [SLOWEST, 0.3, 1.0, 2.5, FASTEST] {
        let mut pace = playing(speed);
        let (mut wall, mut frames) = (0.0, 0);
        for dt in irregular().take(10_000) {
            wall += dt;
            frames += pace.frames_due(dt, FRAME);
            let exact = (wall * speed / FRAME).floor();
            // At the exact time of a frame, rounding decides whether it is due.
            assert!((frames as f64 - exact).abs() <= 1.0, "{frames} of {exact} at {speed}");
        }
        assert!(pace.keeps_up());
    }
}

#[test]
fn nothing_is_due_while_it_is_stopped() {
    let mut pace = Pace::new();
    assert_eq!(pace.frames_due(10.0, FRAME), 0);
    assert_eq!(pace.seconds_to_next_frame(FRAME), None);
    pace.set_playing(true);
    assert_eq!(pace.frames_due(1.5 * FRAME, FRAME), 1);
    pace.set_playing(false);
    assert_eq!(pace.frames_due(10.0, FRAME), 0);
}

#[test]
fn the_speed_stays_within_its_bounds() {
    let mut pace = Pace::new();
    for (asked, got) in [(0.0, SLOWEST), (1e9, FASTEST), (0.5, 0.5), (f64::NAN, 0.5)] {
        pace.set_speed(asked);
        assert_eq!(pace.speed(), got);
    }
}

#[test]
fn after_a_stall_only_so_much_is_made_up_for() {
    let mut pace = playing(1.0);
    pace.frames_due(FRAME, FRAME);
    let frames = pace.frames_due(60.0, FRAME);
    // The part of a frame before the stall counts, too.
    assert!(frames as f64 <= LONGEST_DELAY / FRAME + 1.0, "{frames} frames");
    assert!(!pace.keeps_up());
    // A second later the stall no longer counts.
    (0..150).for_each(|_| _ = pace.frames_due(0.01, FRAME));
    assert!(pace.keeps_up());
}

#[test]
fn a_machine_that_is_too_slow_is_seen_and_does_not_fall_behind_for_ever() {
    let mut pace = playing(1.0);
    // Every frame takes the time of two, so half of the due frames can be taken.
    for _ in 0..500 {
        let due = pace.frames_due(2.0 * FRAME, FRAME);
        pace.give_back(due.saturating_sub(1));
    }
    assert!(!pace.keeps_up());
    // The window can start and end anywhere in a frame.
    let factor = pace.realtime_factor().unwrap();
    assert!((factor - 0.5).abs() < 0.05, "{factor}");
    // When the machine is fast again, only the longest delay is made up for.
    let frames: u64 = (0..100).map(|_| pace.frames_due(FRAME, FRAME)).sum();
    assert!(frames <= 100 + (LONGEST_DELAY / FRAME) as u64 + 1, "{frames}");
}

#[test]
fn where_it_keeps_up_the_factor_is_the_speed() {
    for speed in [0.5, 1.0, 4.0] {
        let mut pace = playing(speed);
        assert_eq!(pace.realtime_factor(), None);
        (0..300).for_each(|_| _ = pace.frames_due(0.007, FRAME));
        // The tolerance is a frame per second.
        let factor = pace.realtime_factor().unwrap();
        assert!((factor - speed).abs() < 1.2 * FRAME, "{factor} at {speed}");
    }
}

#[test]
fn in_slow_motion_a_picture_moves_evenly_from_frame_to_frame() {
    let mut pace = playing(SLOWEST);
    let mut shown = 0.0;
    let mut frames = 0.0;
    for _ in 0..1000 {
        frames += pace.frames_due(FRAME, FRAME) as f64;
        let now = frames + pace.blend();
        // A fiftieth of a frame each time, with a thousand rounding errors.
        assert!((now - shown - SLOWEST).abs() < 1e-12, "{}", now - shown);
        shown = now;
    }
}

#[test]
fn what_cannot_be_a_time_makes_nothing_due() {
    let mut pace = playing(1.0);
    for (wall, frame) in
        [(-1.0, FRAME), (f64::NAN, FRAME), (f64::INFINITY, FRAME), (1.0, 0.0), (1.0, f64::NAN)]
    {
        assert_eq!(pace.frames_due(wall, frame), 0);
    }
    assert_eq!(pace.frames_due(FRAME * 1.5, FRAME), 1);
}
