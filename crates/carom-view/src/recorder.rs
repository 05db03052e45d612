//! Records a film of the view.

use std::collections::VecDeque;
use std::ops::Range;

use egui_wgpu::wgpu::Device;

use crate::host::FilmMaker;
use crate::snapshot::Snapshot;

/// Film frames per second of simulated time.
pub const FRAMES_PER_SECOND: u32 = 30;

/// Width and height of a film \[px\].
pub const SIZE: [u32; 2] = [1280, 720];

/// Largest step of time between two frames of the interface that is no jump \[s\]: the fastest
/// speed on a machine that draws three frames a second. A step backwards is a jump, too.
const JUMP: f64 = 3.5;

/// Largest number of pictures in progress: enough to keep the device busy, few enough for memory.
const MOST_DRAWN: usize = 4;

/// A film that is being recorded, with frames at equal steps of simulated time.
pub struct Recorder {
    film: Box<dyn FilmMaker>,
    /// Time of the first frame \[s\]; jumps of time shift it.
    start: f64,
    /// Time of the last picture \[s\].
    last: f64,
    /// Number of frames with a picture, finished or not.
    frames: u32,
    /// Number of frames in the film.
    added: u32,
    /// Pictures in progress, each with its frames.
    drawn: VecDeque<(Snapshot, Range<u32>)>,
    /// Whether the film takes no more frames.
    is_ending: bool,
}

impl Recorder {
    /// Makes a recorder of a film that starts at this simulated time \[s\].
    pub fn new(film: Box<dyn FilmMaker>, start: f64) -> Self {
        let drawn = VecDeque::new();
        Self { film, start, last: start, frames: 0, added: 0, drawn, is_ending: false }
    }

    /// Returns the frames due at `time` \[s\]. One picture is drawn for all of them, so that the
    /// film keeps its speed on a slow machine.
    pub fn due(&mut self, time: f64) -> Option<Range<u32>> {
        let way = time - self.last;
        if !(0.0..=JUMP).contains(&way) {
            // The film continues with the present picture.
            self.start += way;
        }
        self.last = time;
        if self.is_ending || self.drawn.len() >= MOST_DRAWN {
            return None;
        }
        let due = ((time - self.start) * f64::from(FRAMES_PER_SECOND)).floor() + 1.0;
        // Casting a number that is too large returns the largest integer.
        let due = due as u32;
        (due > self.frames).then_some(self.frames..due)
    }

    /// Adds a picture that is still being drawn for these frames.
    pub fn add(&mut self, snapshot: Snapshot, frames: Range<u32>) {
        self.frames = frames.end;
        self.drawn.push_back((snapshot, frames));
    }

    /// Adds the finished pictures to the film.
    ///
    /// # Errors
    /// If a picture was lost or cannot be added; the film then ends before it.
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

    /// Ends the recording; only pictures in progress are still added.
    pub fn end(&mut self) {
        self.is_ending = true;
    }

    /// Returns whether the film has all its frames.
    pub fn is_complete(&self) -> bool {
        self.is_ending && self.drawn.is_empty()
    }

    /// Returns whether the recording has ended.
    pub fn is_ending(&self) -> bool {
        self.is_ending
    }

    /// Completes the film. Returns a message for the user.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn finish(self) -> Result<String, String> {
        let seconds = f64::from(self.added) / f64::from(FRAMES_PER_SECOND);
        let name = self.film.finish()?;
        Ok(format!("saved {name} ({seconds:.1} s)"))
    }
}
