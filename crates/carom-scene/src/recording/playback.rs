//! A recording at any time: between its frames, too.

use carom::{Boundary, DQuat, DVec3};

use super::replay::{Replay, ReplayBall, ReplayError, ReplayFrame};

/// A recorded frame counts as that of a time if it is no farther away than this \[s\]: sums of
/// frame times and k / rate differ by rounding only, frames by far more.
const SAME_TIME: f64 = 1e-9;

/// Plays a recording at times that go on and on, like those of the frames of a film.
///
/// At the time of a recorded frame (give or take a nanosecond), balls are exactly as recorded; at 0
/// and up to the first one, the scene's start counts as a frame. In between, each ball follows the
/// cubic Hermite curve
///
/// ```text
/// x(t) = (2s³ - 3s² + 1) x1 + (s³ - 2s² + s) h v1 + (3s² - 2s³) x2 + (s³ - s²) h v2,
/// ```
///
/// with h = t2 - t1 and s = (t - t1) / h, from place and velocity in the frames at t1 and t2. It is
/// free flight exactly where the force is constant. Where the recording has orientations, balls turn the
/// shorter way. An impact in between is smoothed away: record
/// at the times that are to be seen (or more often) to see impacts as they were. A ball that is not
/// in both frames is seen until the one before it is gone, and not before the first one it is in.
#[derive(Debug)]
pub struct Playback {
    replay: Replay,
    boundary: Boundary,
    /// Not after the last time requested.
    before: Option<ReplayFrame>,
    /// After it.
    after: Option<ReplayFrame>,
}

impl Playback {
    /// Plays a recording from the start of its scene.
    ///
    /// # Errors
    /// As [`Replay::next_frame`].
    pub fn new(mut replay: Replay) -> Result<Self, ReplayError> {
        let boundary = replay.boundary();
        let after = replay.next_frame()?;
        let start = replay.start().clone();
        // A recording may have the start, too; then that is as good.
        let before = after.as_ref().is_none_or(|first| start.time < first.time).then_some(start);
        Ok(Self { replay, boundary, before, after })
    }

    /// The balls at this time \[s\], or at the last frame before the last time requested if that is
    /// later; `None` once the recording is over.
    ///
    /// # Errors
    /// As [`Replay::next_frame`].
    pub fn at(&mut self, time: f64) -> Result<Option<ReplayFrame>, ReplayError> {
        while let Some(frame) = self.after.take_if(|frame| frame.time <= time + SAME_TIME) {
            self.before = Some(frame);
            self.after = self.replay.next_frame()?;
        }
        Ok(match (&self.before, &self.after) {
            (Some(before), _) if before.time >= time - SAME_TIME => Some(before.clone()),
            (Some(before), Some(after)) => Some(between(before, after, time, self.boundary)),
            // Before the first frame of a recording that begins before its scene.
            (None, Some(after)) => Some(after.clone()),
            (_, None) => None,
        })
    }
}

/// The balls at a time \[s\] between two frames.
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

/// A ball at the part `s` of the time `h` \[s\] between two states.
fn curve(from: &ReplayBall, to: &ReplayBall, s: f64, h: f64, boundary: Boundary) -> ReplayBall {
    let (x1, v1, v2) = (from.position, from.velocity, to.velocity);
    let x2 = near(to.position, x1 + 0.5 * h * (v1 + v2), boundary);
    let (s2, s3) = (s * s, s * s * s);
    // About the first place, so that a ball at rest stays exactly where it is.
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

/// The image of a place that is nearest to another, under a boundary.
fn near(place: DVec3, to: DVec3, boundary: Boundary) -> DVec3 {
    let Boundary::Periodic { size } = boundary else {
        return place;
    };
    let image = |place: f64, to: f64, size: f64| {
        // Along an open axis, there is one image only.
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
            // A few roundings of numbers up to 5.
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
        // An angle of zero, from a cosine rounded.
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
