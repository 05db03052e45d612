//! Plays a recording at any time, also between its frames.

use carom::{Boundary, DQuat, DVec3};

use super::replay::{Replay, ReplayBall, ReplayError, ReplayFrame};

/// Largest difference of times that count as equal \[s\]: sums of frame times and k / rate differ
/// by rounding errors only, frames by much more.
const SAME_TIME: f64 = 1e-9;

/// Plays a recording at ascending times, such as those of the frames of a film.
///
/// At the time of a recorded frame (to a nanosecond), balls are exactly as recorded. The start of
/// the scene counts as a frame before the first one. Between frames, each ball follows the cubic
/// Hermite curve
///
/// ```text
/// x(t) = (2s³ - 3s² + 1) x1 + (s³ - 2s² + s) h v1 + (3s² - 2s³) x2 + (s³ - s²) h v2,
/// ```
///
/// with h = t2 - t1 and s = (t - t1) / h, from position and velocity in the frames at t1 and t2.
/// Under a constant force this is exactly the free flight. If the recording has orientations, balls
/// rotate by the smaller angle. An impact between two frames is smoothed: to see impacts as they
/// were, record at the times to be shown, or more often. A ball that is missing in the second frame
/// is shown until that frame; one that is missing in the first frame is shown from the second on.
#[derive(Debug)]
pub struct Playback {
    replay: Replay,
    boundary: Boundary,
    /// Last frame that is not after the last time requested.
    before: Option<ReplayFrame>,
    /// First frame after that time.
    after: Option<ReplayFrame>,
}

impl Playback {
    /// Plays a recording from the start of its scene.
    ///
    /// # Errors
    /// The same as those of [`Replay::next_frame`].
    pub fn new(mut replay: Replay) -> Result<Self, ReplayError> {
        let boundary = replay.boundary();
        let after = replay.next_frame()?;
        let start = replay.start().clone();
        // The recording may contain the start as its first frame.
        let before = after.as_ref().is_none_or(|first| start.time < first.time).then_some(start);
        Ok(Self { replay, boundary, before, after })
    }

    /// Returns the balls at `time` \[s\], or in the last frame before the latest time requested if
    /// that frame is later; `None` after the end of the recording.
    ///
    /// # Errors
    /// The same as those of [`Replay::next_frame`].
    pub fn at(&mut self, time: f64) -> Result<Option<ReplayFrame>, ReplayError> {
        while let Some(frame) = self.after.take_if(|frame| frame.time <= time + SAME_TIME) {
            self.before = Some(frame);
            self.after = self.replay.next_frame()?;
        }
        Ok(match (&self.before, &self.after) {
            (Some(before), _) if before.time >= time - SAME_TIME => Some(before.clone()),
            (Some(before), Some(after)) => Some(between(before, after, time, self.boundary)),
            // The recording begins before its scene: use its first frame.
            (None, Some(after)) => Some(after.clone()),
            (_, None) => None,
        })
    }
}

/// Interpolates the balls at a time \[s\] between two frames.
fn between(
    before: &ReplayFrame,
    after: &ReplayFrame,
    time: f64,
    boundary: Boundary,
) -> ReplayFrame {
    let h = after.time - before.time;
    let s = (time - before.time) / h;
    let balls = before.balls.iter().map(|ball| {
        let place = after.balls.binary_search_by_key(&ball.number, |other| other.number);
        place.map_or(*ball, |place| curve(ball, &after.balls[place], s, h, boundary))
    });
    ReplayFrame { time, balls: balls.collect() }
}

/// Interpolates a ball between two states `h` \[s\] apart, at the fraction `s`.
fn curve(from: &ReplayBall, to: &ReplayBall, s: f64, h: f64, boundary: Boundary) -> ReplayBall {
    let (x1, v1, v2) = (from.position, from.velocity, to.velocity);
    let x2 = near(to.position, x1 + 0.5 * h * (v1 + v2), boundary);
    let (s2, s3) = (s * s, s * s * s);
    // Relative to the first position, so that a ball at rest stays exactly where it is.
    let position =
        x1 + (3.0 * s2 - 2.0 * s3) * (x2 - x1) + h * ((s3 - 2.0 * s2 + s) * v1 + (s3 - s2) * v2);
    let velocity = (6.0 * s - 6.0 * s2) * (x2 - x1) / h
        + (3.0 * s2 - 4.0 * s + 1.0) * v1
        + (3.0 * s2 - 2.0 * s) * v2;
    let position = near(position, DVec3::ZERO, boundary);
    let turned = |(from, to): (DQuat, DQuat)| from.lerp(to, s);
    let orientation = from.orientation.zip(to.orientation).map(turned);
    ReplayBall { position, velocity, orientation, ..*from }
}

/// Returns the periodic image of a position that is nearest to another position.
fn near(place: DVec3, to: DVec3, boundary: Boundary) -> DVec3 {
    let Boundary::Periodic { size } = boundary else {
        return place;
    };
    let image = |place: f64, to: f64, size: f64| {
        // An open axis has one image only.
        if size.is_finite() { place + ((to - place) / size).round() * size } else { place }
    };
    DVec3::new(
        image(place.x, to.x, size.x),
        image(place.y, to.y, size.y),
        image(place.z, to.z, size.z),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ball(number: u64, x: f64, v: f64) -> ReplayBall {
        let (position, velocity) = (DVec3::new(x, 0.0, 0.0), DVec3::new(v, 0.0, 0.0));
        let (orientation, color) = (None, None);
        ReplayBall { number, position, velocity, orientation, radius: 0.1, mass: 1.0, color }
    }

    fn frame(time: f64, balls: &[ReplayBall]) -> ReplayFrame {
        ReplayFrame { time, balls: balls.to_vec() }
    }

    #[test]
    fn free_fall_is_followed_exactly() {
        let (x, v, a, h) = (3.0, 2.0, -9.81, 0.5);
        let before = frame(1.0, &[ball(4, x, v)]);
        let after = frame(1.0 + h, &[ball(4, x + v * h + 0.5 * a * h * h, v + a * h)]);
        for s in [0.1, 0.5, 0.77] {
            let t: f64 = s * h;
            let found = between(&before, &after, 1.0 + t, Boundary::Open).balls[0];
            // A few rounding errors of numbers up to 5.
            assert!((found.position.x - (x + v * t + 0.5 * a * t * t)).abs() < 1e-14);
            assert!((found.velocity.x - (v + a * t)).abs() < 1e-13);
        }
    }

    #[test]
    fn a_ball_through_the_side_of_a_periodic_box_comes_back_on_the_other() {
        let boundary = Boundary::Periodic { size: DVec3::new(2.0, f64::INFINITY, 2.0) };
        let (before, after) = (frame(0.0, &[ball(0, 0.9, 0.4)]), frame(1.0, &[ball(0, -0.7, 0.4)]));
        let x = |time| between(&before, &after, time, boundary).balls[0].position.x;
        assert!((x(0.2) - 0.98).abs() < 1e-15, "{}", x(0.2));
        assert!((x(0.5) + 0.9).abs() < 1e-15, "{}", x(0.5));
    }

    #[test]
    fn a_ball_turns_the_shorter_way() {
        let turned = |angle, sign: f64| {
            let orientation = Some(DQuat::from_rotation_y(angle) * sign);
            ReplayBall { orientation, ..ball(0, 0.0, 0.0) }
        };
        let (before, after) = (frame(1.0, &[turned(0.3, 1.0)]), frame(2.0, &[turned(0.5, -1.0)]));
        let found = between(&before, &after, 1.5, Boundary::Open).balls[0].orientation.unwrap();
        // The angle is zero up to the rounding of its cosine.
        assert!(found.angle_between(DQuat::from_rotation_y(0.4)) < 1e-7, "{found}");
        let plain = frame(2.0, &[ball(0, 0.0, 0.0)]);
        assert_eq!(between(&before, &plain, 1.5, Boundary::Open).balls[0].orientation, None);
    }

    #[test]
    fn a_ball_in_one_frame_only_stays_until_it_goes() {
        let before = frame(0.0, &[ball(0, 1.0, 1.0), ball(1, 5.0, 1.0)]);
        let after = frame(1.0, &[ball(1, 6.0, 1.0), ball(2, 9.0, 0.0)]);
        let balls = between(&before, &after, 0.5, Boundary::Open).balls;
        let places: Vec<_> = balls.iter().map(|ball| (ball.number, ball.position.x)).collect();
        assert_eq!(places, [(0, 1.0), (1, 5.5)]);
    }
}
