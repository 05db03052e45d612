//! Where the colliders that move may be within a frame: most spheres are far from all of them, and need no search.

use crate::detect::swept_region::{PathBounds, SweptRegion};
use crate::surface::LastCarriage;
use crate::system::System;

/// Number of frames for which a sphere is found to be clear of colliders that move: many, so that few spheres are
/// looked at again in a frame, but few enough that what moves stays near where it is.
const FRAMES_AHEAD: f64 = 32.0;

/// The regions of the colliders that move in a frame, in the order of [`System::moving_after`].
#[derive(Debug, Clone, Default)]
pub(super) struct MovingRegions {
    /// Start and end of the frame on the world's clock \[s\]; `None` before they were found.
    frame: Option<[f64; 2]>,
    /// Regions within the frame.
    regions: Vec<SweptRegion>,
    /// Regions within several frames, which hold those of this frame.
    wide: Vec<SweptRegion>,
    /// How long spheres are clear of the wide regions, by slot.
    clear: Vec<Clear>,
}

/// How long a flight is clear of the wide regions.
#[derive(Debug, Clone, Copy)]
pub(super) struct Clear {
    /// Generation of the flight.
    generation: u32,
    /// End of the time for which it is clear, on the world's clock \[s\].
    until: f64,
}

impl Clear {
    const NEVER: Self = Self { generation: 0, until: f64::NEG_INFINITY };

    /// A flight of this generation that is clear until a time \[s\].
    pub fn until(until: f64, generation: u32) -> Self {
        Self { generation, until }
    }

    /// Whether the flight of this generation is clear until a time \[s\].
    #[inline(always)]
    pub fn holds(&self, until: f64, generation: u32) -> bool {
        (self.until >= until) & (self.generation == generation)
    }
}

impl MovingRegions {
    /// Finds the regions within a frame \[s\], at whose start surfaces are where the system says.
    pub fn find(&mut self, system: &System, frame @ [start, end]: [f64; 2]) {
        let last = LastCarriage::default();
        let swept = |length: f64| system.moving_after(0.0, &last).map(move |it| it.swept(length));
        self.regions.clear();
        self.regions.extend(swept(end - start));
        let is_held = self.regions.len() == self.wide.len()
            && self.wide.iter().zip(&self.regions).all(|(wide, region)| wide.holds(region));
        if !is_held {
            self.forget_clear();
            self.wide.clear();
            self.wide.extend(swept(FRAMES_AHEAD * (end - start)));
        }
        self.frame = Some(frame);
    }

    /// Forgets which spheres are clear: slots have other spheres, or regions are others.
    pub fn forget_clear(&mut self) {
        self.clear.clear();
    }

    /// The region of a collider that moves, by its number among them, in this frame \[s\].
    #[inline]
    pub fn of(&self, number: usize, frame: [f64; 2]) -> &SweptRegion {
        let known = self.regions.get(number).filter(|_| self.frame == Some(frame));
        known.unwrap_or(&SweptRegion::Everywhere)
    }

    /// Whether a sphere stays away from all colliders that move in this frame \[s\].
    #[inline]
    pub fn are_missed(&self, path: &PathBounds, frame: [f64; 2]) -> bool {
        self.frame == Some(frame) && self.regions.iter().all(|region| path.misses(region))
    }

    /// Whether a sphere stays away from the wide regions.
    pub fn are_missed_for_long(&self, path: &PathBounds) -> bool {
        self.wide.iter().all(|region| path.misses(region))
    }

    /// Whether spheres can be clear for several frames: no region is everywhere or turns as a plane.
    pub fn are_lasting(&self) -> bool {
        self.wide.iter().all(|region| region.holds(region))
    }

    /// Takes the times of all spheres, a number of them.
    pub fn take_clear(&mut self, count: usize) -> Vec<Clear> {
        let mut clear = std::mem::take(&mut self.clear);
        clear.resize(count, Clear::NEVER);
        clear
    }

    /// Sets the times of all spheres.
    pub fn set_clear(&mut self, clear: Vec<Clear>) {
        self.clear = clear;
    }

    /// End of the time for which clear flights are sought in a frame \[s\].
    pub fn sought_until(&self, [start, end]: [f64; 2]) -> f64 {
        start + FRAMES_AHEAD * (end - start)
    }
}
