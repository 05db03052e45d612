//! A film of what is shown.

use std::collections::VecDeque;
use std::ops::Range;

use egui_wgpu::wgpu::Device;

use crate::host::FilmMaker;
use crate::snapshot::Snapshot;

/// Frames of a film in a second of simulated time.
pub const FRAMES_PER_SECOND: u32 = 30;

/// Width and height of a film \[px\].
pub const SIZE: [u32; 2] = [1280, 720];

/// More than this between two pictures of the interface is a jump to another time \[s\]: the fastest
/// speed on a machine that draws three pictures a second. Time that goes back is one, too.
const JUMP: f64 = 3.5;

/// Most pictures that are drawn at one time: enough to keep the device busy, few enough for memory.
const MOST_DRAWN: usize = 4;

/// A film in the making: its frames are shown at equal distances of simulated time.
pub struct Recorder {
    film: Box<dyn FilmMaker>,
    /// Time of the first frame \[s\]; moved along with jumps of time.
    start: f64,
    /// Time shown last \[s\].
    last: f64,
    /// Frames that pictures were drawn for.
    frames: u32,
    /// Frames that are in the film.
    added: u32,
    /// Pictures under way, each with the frames that it is shown in.
    drawn: VecDeque<(Snapshot, Range<u32>)>,
    /// Whether no frame follows any more.
    is_ending: bool,
}

impl Recorder {
    /// A film that begins at a time of the simulation \[s\].
    pub fn new(film: Box<dyn FilmMaker>, start: f64) -> Self {
        let drawn = VecDeque::new();
        Self { film, start, last: start, frames: 0, added: 0, drawn, is_ending: false }
    }

    /// Frames that are due at `time` \[s\]: one picture is to be drawn for all of them, so that the
    /// film keeps its time on a machine that cannot draw fast enough.
    pub fn due(&mut self, time: f64) -> Option<Range<u32>> {
        let way = time - self.last;
        if !(0.0..=JUMP).contains(&way) {
            // The film goes on with what is shown now.
            self.start += way;
        }
        self.last = time;
        if self.is_ending || self.drawn.len() >= MOST_DRAWN {
            return None;
        }
        let due = ((time - self.start) * f64::from(FRAMES_PER_SECOND)).floor() + 1.0;
        // A cast of a number that is too large gives the largest.
        let due = due as u32;
        (due > self.frames).then_some(self.frames..due)
    }

    /// Adds a picture that is being drawn for these frames.
    pub fn add(&mut self, snapshot: Snapshot, frames: Range<u32>) {
        self.frames = frames.end;
        self.drawn.push_back((snapshot, frames));
    }

    /// Puts into the film what has been drawn.
    ///
    /// # Errors
    /// If a picture was lost or cannot be added: then the film ends with the frames before.
    pub fn collect(&mut self, device: &Device) -> Result<(), String> {
        let collected = self.add_drawn(device);
        if collected.is_err() {
            self.drawn.clear();
            self.end();
        }
        collected
    }

    fn add_drawn(&mut self, device: &Device) -> Result<(), String> {
        while let Some((first, _)) = self.drawn.front()
            && first.is_ready(device)
        {
            let Some((snapshot, frames)) = self.drawn.pop_front() else { break };
            let picture = snapshot.picture().map_err(|error| error.to_string())?;
            for frame in frames {
                self.film.add(&picture, frame)?;
                self.added += 1;
            }
        }
        Ok(())
    }

    /// Adds no more frames but those that are being drawn.
    pub fn end(&mut self) {
        self.is_ending = true;
    }

    /// Whether the film has all its frames.
    pub fn is_complete(&self) -> bool {
        self.is_ending && self.drawn.is_empty()
    }

    /// Whether no frame follows any more.
    pub fn is_ending(&self) -> bool {
        self.is_ending
    }

    /// Completes the film. Returns what to tell.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn finish(self) -> Result<String, String> {
        let seconds = f64::from(self.added) / f64::from(FRAMES_PER_SECOND);
        let name = self.film.finish()?;
        Ok(format!("saved {name} ({seconds:.1} s)"))
    }
}
