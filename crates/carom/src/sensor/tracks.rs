//! Tracks: places of spheres at times of a frame, under rules with frames only.

use glam::DVec3;

/// Places of the spheres at equal intervals of a frame, by index, from its start on; empty without triggers.
#[derive(Debug, Clone, Default)]
pub(crate) struct Tracks {
    is_wanted: bool,
    /// \[m\]
    places: Vec<Vec<DVec3>>,
}

impl Tracks {
    /// Begins a frame with the spheres in these `places` \[m\], if tracks are wanted.
    pub fn begin(&mut self, is_wanted: bool, places: &[DVec3]) {
        self.places.clear();
        self.is_wanted = is_wanted;
        self.note(|| places.to_vec());
    }

    /// Adds the places of the spheres after another part of the frame \[m\].
    pub fn note(&mut self, places: impl FnOnce() -> Vec<DVec3>) {
        if self.is_wanted {
            self.places.push(places());
        }
    }

    /// Ends the frame with the spheres in these `places` \[m\]. Returns all places; `None` if tracks are not
    /// wanted.
    pub fn end(&mut self, places: &[DVec3]) -> Option<Vec<Vec<DVec3>>> {
        if self.places.len() == 1 {
            self.note(|| places.to_vec());
        }
        self.is_wanted.then(|| std::mem::take(&mut self.places))
    }
}
