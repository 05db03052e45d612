//! Converts the time of a clock to numbers of frames.

use std::collections::VecDeque;

/// Slowest speed: simulated seconds per second of the clock.
pub const SLOWEST: f64 = 1.0 / 50.0;

/// Fastest speed: simulated seconds per second of the clock.
pub const FASTEST: f64 = 10.0;

/// Largest delay that is made up for \[s of the clock\]: it is hardly visible. Larger delays are
/// lost, so that a slow machine shows slower motion instead of falling further behind.
pub const LONGEST_DELAY: f64 = 0.25;

/// Time over which the speed is measured \[s of the clock\].
const MEASURED: f64 = 1.0;

/// Shortest time for which a measurement is reported \[s of the clock\].
const MEASUREMENT: f64 = 0.1;

/// Fraction of the requested time that jitter of the clock may lose without a warning.
const UNNOTICED_LOSS: f64 = 0.02;

/// Simulated time during one call.
#[derive(Debug, Clone, Copy, Default)]
struct Measurement {
    /// \[s of the clock\]
    wall: f64,
    /// Requested time \[simulated s\].
    wished: f64,
    /// Part of the requested time that was lost \[simulated s\].
    lost: f64,
    /// Time simulated in frames \[simulated s\].
    taken: f64,
}

/// Converts elapsed time to frames. It has no clock of its own: the caller passes the elapsed time.
#[derive(Debug, Clone)]
pub struct Pace {
    playing: bool,
    speed: f64,
    /// Length of the last frame \[simulated s\].
    frame_time: f64,
    /// Time since the last frame was due \[simulated s\].
    owed: f64,
    measured: VecDeque<Measurement>,
}

impl Default for Pace {
    fn default() -> Self {
        Self::new()
    }
}

impl Pace {
    /// Creates a stopped pace with speed 1.
    pub fn new() -> Self {
        let measured = VecDeque::new();
        Self { playing: false, speed: 1.0, frame_time: f64::INFINITY, owed: 0.0, measured }
    }

    /// Whether it is playing.
    pub fn is_playing(&self) -> bool {
        self.playing
    }

    /// Starts or stops playing.
    pub fn set_playing(&mut self, playing: bool) {
        if playing != self.playing {
            self.measured.clear();
        }
        self.playing = playing;
    }

    /// Speed in simulated seconds per second of the clock.
    pub fn speed(&self) -> f64 {
        self.speed
    }

    /// Sets the speed, limited to the range from [`SLOWEST`] to [`FASTEST`]; ignores NaN.
    pub fn set_speed(&mut self, speed: f64) {
        if !speed.is_nan() {
            self.speed = speed.clamp(SLOWEST, FASTEST);
            self.measured.clear();
        }
    }

    /// Returns the number of frames of `frame_time` \[s\] that are due after `wall_seconds`.
    pub fn frames_due(&mut self, wall_seconds: f64, frame_time: f64) -> u64 {
        let is_time = frame_time > 0.0 && wall_seconds >= 0.0 && wall_seconds.is_finite();
        if !(self.playing && is_time) {
            return 0;
        }
        self.frame_time = frame_time;
        let wished = wall_seconds * self.speed;
        // Time lost in a stall does not count towards the next frame.
        let counted = wished.min(LONGEST_DELAY * self.speed);
        self.owed += counted;
        let lost = wished - counted + self.limit();
        let due = (self.owed / frame_time).floor();
        self.owed = (self.owed - due * frame_time).max(0.0);
        self.measure(Measurement { wall: wall_seconds, wished, lost, taken: due * frame_time });
        due as u64
    }

    /// Returns frames that were due but could not be taken. They remain due, within the longest
    /// delay.
    pub fn give_back(&mut self, frames: u64) {
        if frames == 0 {
            return;
        }
        let time = frames as f64 * self.frame_time;
        self.owed += time;
        let lost = self.limit();
        // These frames were counted in the last measurement.
        if let Some(last) = self.measured.back_mut() {
            last.lost += lost;
            last.taken -= time;
        }
    }

    /// Limits the owed time to a frame plus the longest delay; returns the time lost.
    fn limit(&mut self) -> f64 {
        let most = self.frame_time + LONGEST_DELAY * self.speed;
        let lost = (self.owed - most).max(0.0);
        self.owed -= lost;
        lost
    }

    /// Makes the next frame due at once, after a frame was taken or shown out of turn.
    pub fn show_whole_frame(&mut self) {
        self.owed = if self.frame_time.is_finite() { self.frame_time } else { 0.0 };
    }

    /// Elapsed fraction of the current frame, in \[0, 1\]. Pictures show spheres at this fraction
    /// between the last two frames.
    pub fn blend(&self) -> f64 {
        // Before the first frame there is nothing to blend.
        if self.frame_time.is_finite() { (self.owed / self.frame_time).min(1.0) } else { 1.0 }
    }

    /// Growth of [`Self::blend`] \[1/s of the clock\].
    pub fn blend_rate(&self) -> f64 {
        if self.playing { self.speed / self.frame_time } else { 0.0 }
    }

    /// Seconds of the clock until the next frame is due; `None` while stopped.
    pub fn seconds_to_next_frame(&self, frame_time: f64) -> Option<f64> {
        self.playing.then(|| ((frame_time - self.owed) / self.speed).max(0.0))
    }

    /// Measured speed in simulated seconds per second of the clock, over about the last second;
    /// `None` before the first measurement. It equals the speed if the machine keeps up.
    pub fn realtime_factor(&self) -> Option<f64> {
        let wall: f64 = self.measured.iter().map(|it| it.wall).sum();
        let taken: f64 = self.measured.iter().map(|it| it.taken).sum();
        // Over a shorter time, the result would depend on when frames are due.
        (wall >= MEASUREMENT).then(|| taken / wall)
    }

    /// Whether the frames that were due in about the last second could be taken.
    pub fn keeps_up(&self) -> bool {
        let wished: f64 = self.measured.iter().map(|it| it.wished).sum();
        let lost: f64 = self.measured.iter().map(|it| it.lost).sum();
        lost <= UNNOTICED_LOSS * wished
    }

    fn measure(&mut self, new: Measurement) {
        match self.measured.back_mut() {
            Some(last) if last.wall < MEASUREMENT => {
                last.wall += new.wall;
                last.wished += new.wished;
                last.lost += new.lost;
                last.taken += new.taken;
            }
            _ => self.measured.push_back(new),
        }
        let mut wall: f64 = self.measured.iter().map(|it| it.wall).sum();
        while let Some(oldest) = self.measured.front() {
            if self.measured.len() == 1 || wall - oldest.wall < MEASURED {
                break;
            }
            wall -= oldest.wall;
            self.measured.pop_front();
        }
    }
}
