//! How near a run came to where derivatives end.

use super::saltation::Saltation;
use crate::id::SphereId;

/// How near a run came to an impact that grazes, or to two impacts of one sphere at once: there derivatives end.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Margin {
    /// The speed of approach in an impact as a part of the relative speed, the least of all: 1 head-on, 0 where it
    /// grazes. 1 if there was no impact.
    pub directness: f64,
    /// The sphere, body 2 of that impact, and when it was, on the world's clock \[s\].
    pub most_grazing: Option<(SphereId, f64)>,
    /// The shortest time between two impacts of one sphere \[s\]; infinite if none had two.
    pub interval: f64,
    /// That sphere, and when the second of the two was, on the world's clock \[s\].
    pub closest: Option<(SphereId, f64)>,
}

impl Default for Margin {
    fn default() -> Self {
        Self { directness: 1.0, most_grazing: None, interval: f64::INFINITY, closest: None }
    }
}

impl Margin {
    /// Takes in an impact. `began` is when derivatives began, on the world's clock \[s\]; `last_impacts` has the last impact
    /// of each sphere since then \[s\], by place.
    pub(super) fn look_at(&mut self, saltation: &Saltation, began: f64, last_impacts: &mut [f64]) {
        let time = saltation.time;
        let directness = saltation.directness();
        if directness < self.directness {
            self.directness = directness;
            self.most_grazing = Some((saltation.second.id, began + time));
        }
        for sphere in saltation.spheres() {
            let interval = time - last_impacts[sphere.place];
            if interval < self.interval {
                self.interval = interval;
                self.closest = Some((sphere.id, began + time));
            }
            last_impacts[sphere.place] = time;
        }
    }
}
