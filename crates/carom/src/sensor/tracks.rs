//! Tracks: where spheres were at times of a frame, under rules that know nothing else.

use glam::DVec3;

/// Where the spheres were at equal times of a frame, by index, from its start on; empty without triggers.
#[derive(Debug, Clone, Default)]
pub(crate) struct Tracks {
    is_wanted: bool,
    /// \[m\]
    places: Vec<Vec<DVec3>>,
}

impl Tracks {
    /// Begins a frame in which spheres start from these `places` \[m\], if it is wanted.
    pub fn begin(&mut self, is_wanted: bool, places: &[DVec3]) {
        self.places.clear();
        self.is_wanted = is_wanted;
        self.note(|| places.to_vec());
    }

    /// Notes where the spheres are after another part of the frame \[m\].
    pub fn note(&mut self, places: impl FnOnce() -> Vec<DVec3>) {
        if self.is_wanted {
            self.places.push(places());
        }
    }

    /// Ends the frame in which spheres come to these `places` \[m\], and returns all that were noted; `None` if none are
    /// wanted.
    pub fn end(&mut self, places: &[DVec3]) -> Option<Vec<Vec<DVec3>>> {
        if self.places.len() == 1 {
            self.note(|| places.to_vec());
        }
        self.is_wanted.then(|| std::mem::take(&mut self.places))
    }
}
