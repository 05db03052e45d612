//! Distance of a run from where derivatives end.

use super::group::GroupSaltation;
use super::saltation::Saltation;
use crate::id::SphereId;

/// Distance of a run from where derivatives end: impacts that graze, and two impacts of one sphere at once.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Margin {
    /// Smallest ratio of the speed of approach to the relative speed of an impact: 1 if all were head-on, near 0 if
    /// one grazed. 1 if there was no impact. A sphere that passes an edge at which a force jumps counts likewise.
    pub directness: f64,
    /// Body 2 of that impact, and its time on the world's clock \[s\].
    pub most_grazing: Option<(SphereId, f64)>,
    /// The shortest time between two impacts of one sphere \[s\]; infinite if none had two.
    pub interval: f64,
    /// The sphere of these two impacts, and the time of the second on the world's clock \[s\].
    pub closest: Option<(SphereId, f64)>,
    /// How near the impact law of a group of touching bodies was to taking other contacts: the smallest impulse or rate
    /// of opening as a part of the largest. 1 if there was no group.
    pub activity: f64,
    /// One of the spheres of that group, and its time on the world's clock \[s\].
    pub least_active: Option<(SphereId, f64)>,
}

impl Default for Margin {
    fn default() -> Self {
        Self {
            directness: 1.0,
            most_grazing: None,
            interval: f64::INFINITY,
            closest: None,
            activity: 1.0,
            least_active: None,
        }
    }
}

impl Margin {
    /// Adds an impact. `began` is the start of the derivatives on the world's clock \[s\]; `last_impacts` has the
    /// time of the last impact of each sphere since then \[s\], by index.
    pub(super) fn look_at(&mut self, saltation: &Saltation, began: f64, last_impacts: &mut [f64]) {
        let time = saltation.time;
        self.look_at_directness(saltation.directness(), (saltation.second.id, began + time));
        for sphere in saltation.spheres() {
            let interval = time - last_impacts[sphere.place];
            if interval < self.interval {
                self.interval = interval;
                self.closest = Some((sphere.id, began + time));
            }
            last_impacts[sphere.place] = time;
        }
    }

    /// Adds the impact of a group, as [`Self::look_at`] does. Where bodies touch that nothing presses together, other changes
    /// than those that keep them in touch make several impacts of one: the interval is 0.
    pub(super) fn look_at_group(
        &mut self,
        group: &GroupSaltation,
        began: f64,
        last_impacts: &mut [f64],
    ) {
        let (time, at) = (group.time, (group.second, began + group.time));
        self.look_at_directness(group.directness, at);
        if group.margin < self.activity {
            (self.activity, self.least_active) = (group.margin, Some(at));
        }
        for (&place, &id) in group.places.iter().zip(group.ids()) {
            let interval = time - last_impacts[place];
            let interval = if group.has_loose_touches { 0.0 } else { interval };
            if interval < self.interval {
                (self.interval, self.closest) = (interval, Some((id, began + time)));
            }
            last_impacts[place] = time;
        }
    }

    /// Adds the directness of an impact of a sphere, or of its passing an edge, at a time on the world's clock \[s\].
    pub(super) fn look_at_directness(&mut self, directness: f64, at: (SphereId, f64)) {
        if directness < self.directness {
            self.directness = directness;
            self.most_grazing = Some(at);
        }
    }
}
