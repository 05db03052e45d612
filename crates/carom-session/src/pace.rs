//! How many frames are due: the pace of simulated time beside that of a clock.

use std::collections::VecDeque;

/// Slowest speed: simulated seconds per second of the clock.
pub const SLOWEST: f64 = 1.0 / 50.0;

/// Fastest speed: simulated seconds per second of the clock.
pub const FASTEST: f64 = 10.0;

/// Delay that is made up for \[s of the clock\]: one that is hardly seen. More than that is lost,
/// so that a machine that is too slow shows a slower motion, and does not fall behind for ever.
pub const LONGEST_DELAY: f64 = 0.25;

/// Time over which the pace is measured \[s of the clock\].
const MEASURED: f64 = 1.0;

/// Time that one of the measurements covers at least \[s of the clock\].
const MEASUREMENT: f64 = 0.1;

/// Part of the wish that may be lost while keeping up: what jitter of a clock makes.
const UNNOTICED_LOSS: f64 = 0.02;

/// What happened in a stretch of time.
#[derive(Debug, Clone, Copy, Default)]
struct Measurement {
    /// \[s of the clock\]
    wall: f64,
    /// Wished for \[simulated s\].
    wished: f64,
    /// Lost of that \[simulated s\].
    lost: f64,
    /// Taken in frames \[simulated s\].
    taken: f64,
}

/// The pace of simulated time. It has no clock of its own: its caller passes the time that went by.
#[derive(Debug, Clone)]
pub struct Pace {
    playing: bool,
    speed: f64,
    /// Length of a frame, as given last \[simulated s\].
    frame_time: f64,
    /// Time that went by since the frame taken last was due \[simulated s\].
    owed: f64,
    measured: VecDeque<Measurement>,
}

impl Default for Pace {
    fn default() -> Self {
        Self::new()
    }
}

impl Pace {
    /// Stopped, as fast as the clock when it plays.
    pub fn new() -> Self {
        let measured = VecDeque::new();
        Self { playing: false, speed: 1.0, frame_time: f64::INFINITY, owed: 0.0, measured }
    }

    /// Whether time goes on.
    pub fn is_playing(&self) -> bool {
        self.playing
    }

    /// Lets time go on or stops it.
    pub fn set_playing(&mut self, playing: bool) {
        if playing != self.playing {
            self.measured.clear();
        }
        self.playing = playing;
    }

    /// Simulated seconds per second of the clock.
    pub fn speed(&self) -> f64 {
        self.speed
    }

    /// Sets the speed, to the nearest one there is between [`SLOWEST`] and [`FASTEST`]; what is
    /// not a number changes nothing.
    pub fn set_speed(&mut self, speed: f64) {
        if !speed.is_nan() {
            self.speed = speed.clamp(SLOWEST, FASTEST);
            self.measured.clear();
        }
    }

    /// How many frames of `frame_time` \[s\] are to be taken now that `wall_seconds` have gone by.
    pub fn frames_due(&mut self, wall_seconds: f64, frame_time: f64) -> u64 {
        let is_time = frame_time > 0.0 && wall_seconds >= 0.0 && wall_seconds.is_finite();
        if !(self.playing && is_time) {
            return 0;
        }
        self.frame_time = frame_time;
        let wished = wall_seconds * self.speed;
        // What a stall lost before is no part of the way to the next frame.
        let counted = wished.min(LONGEST_DELAY * self.speed);
        self.owed += counted;
        let lost = wished - counted + self.limit();
        let due = (self.owed / frame_time).floor();
        self.owed = (self.owed - due * frame_time).max(0.0);
        self.measure(Measurement { wall: wall_seconds, wished, lost, taken: due * frame_time });
        due as u64
    }

    /// Gives back frames that were due and could not be taken: they stay due, as far as the delay
    /// can be made up for.
    pub fn give_back(&mut self, frames: u64) {
        if frames == 0 {
            return;
        }
        let time = frames as f64 * self.frame_time;
        self.owed += time;
        let lost = self.limit();
        // They were counted in the last measurement.
        if let Some(last) = self.measured.back_mut() {
            last.lost += lost;
            last.taken -= time;
        }
    }

    /// Limits what is owed to a frame and the longest delay; returns what was lost.
    fn limit(&mut self) -> f64 {
        let most = self.frame_time + LONGEST_DELAY * self.speed;
        let lost = (self.owed - most).max(0.0);
        self.owed -= lost;
        lost
    }

    /// Another frame was taken or shown out of turn: the next one is due at once.
    pub fn show_whole_frame(&mut self) {
        self.owed = if self.frame_time.is_finite() { self.frame_time } else { 0.0 };
    }

    /// Part of the frame under way that has gone by, in \[0, 1\]: a picture shows spheres so far on
    /// the way from the last frame but one to the last.
    pub fn blend(&self) -> f64 {
        // Before the first frame there is nothing to blend.
        if self.frame_time.is_finite() { (self.owed / self.frame_time).min(1.0) } else { 1.0 }
    }

    /// How fast [`Self::blend`] grows \[1/s of the clock\].
    pub fn blend_rate(&self) -> f64 {
        if self.playing { self.speed / self.frame_time } else { 0.0 }
    }

    /// Seconds of the clock until the next frame is due; `None` while stopped.
    pub fn seconds_to_next_frame(&self, frame_time: f64) -> Option<f64> {
        self.playing.then(|| ((frame_time - self.owed) / self.speed).max(0.0))
    }

    /// Simulated seconds per second of the clock, over the last second or so; `None` before
    /// anything was measured. Where the machine keeps up, it is the speed.
    pub fn realtime_factor(&self) -> Option<f64> {
        let wall: f64 = self.measured.iter().map(|it| it.wall).sum();
        let taken: f64 = self.measured.iter().map(|it| it.taken).sum();
        // A single short look would measure when frames fall, not how many there are.
        (wall >= MEASUREMENT).then(|| taken / wall)
    }

    /// Whether, over the last second or so, the frames that were due could be taken.
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
