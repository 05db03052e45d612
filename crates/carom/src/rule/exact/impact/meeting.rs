//! Two spheres at the time when they meet.

use glam::DVec3;

use crate::norm::Norm;
use crate::rule::exact::context::StepContext;
use crate::rule::exact::timeline::Timeline;
use crate::rule::periodic;

/// Two spheres at the time when they meet, in the order of their ids, so that rounding does not depend on the memory.
pub(super) struct MeetingPair {
    pub slots: [u32; 2],
    /// \[kg\]
    pub masses: [f64; 2],
    /// \[m\]
    pub positions: [DVec3; 2],
    /// \[m/s\]
    pub velocities: [DVec3; 2],
    /// Distance between the centres \[m\].
    pub distance: f64,
    /// Points from the first centre to the nearest image of the second one.
    pub normal: DVec3,
}

impl MeetingPair {
    /// Returns two spheres at `time` \[s\].
    pub fn at(timeline: &Timeline, context: &StepContext, slots: [u32; 2], time: f64) -> Self {
        let flights = &timeline.flights;
        let mut slots = slots;
        slots.sort_unstable_by_key(|&slot| flights.index_of[slot as usize]);
        let [(x1, v1), (x2, v2)] = slots.map(|slot| flights.state_of(slot, time));
        let offset = periodic::wrapped(x2 - x1, context.period);
        let distance = offset.norm();
        Self {
            slots,
            masses: slots.map(|slot| flights.species_of(slot).mass),
            positions: [x1, x2],
            velocities: [v1, v2],
            distance,
            normal: offset / distance,
        }
    }

    /// Returns the velocity of the second sphere relative to the first \[m/s\].
    pub fn relative_velocity(&self) -> DVec3 {
        self.velocities[1] - self.velocities[0]
    }

    /// Returns the velocities after an impulse \[N s\] that drives the spheres apart \[m/s\].
    pub fn velocities_after(&self, impulse: f64) -> [DVec3; 2] {
        let Self { velocities: [v1, v2], masses: [m1, m2], normal, .. } = *self;
        [v1 - impulse / m1 * normal, v2 + impulse / m2 * normal]
    }
}
