//! Conditions: what must hold of a timeline so that domains can take its events.

use crate::rule::exact::timeline::Timeline;
use crate::system::System;

impl Timeline {
    /// Whether all spheres fly freely along parabolas between impacts with each other and with surfaces at rest, and
    /// nothing looks along their flights.
    pub(super) fn has_only_free_flights(&self, system: &System) -> bool {
        let flights = &self.flights;
        let is_watched = self.watch.is_some() || flights.is_logged();
        let is_steady = flights.growth.is_none() && self.neighbours.sliding().is_none();
        let is_one_by_one = flights.wells.is_none() && self.clearances.is_empty();
        let are_held = flights.hold_forces || flights.forces_vary || flights.are_curved();
        self.is_free()
            && !is_watched
            && is_steady
            && is_one_by_one
            && !are_held
            && self.moving_surfaces.is_empty()
            && system.settings.spheres_collide
    }

    /// Whether no sphere is in persistent contact or in a zone.
    pub(super) fn is_free(&self) -> bool {
        let is_free = self.zone.is_empty() && self.flights.clusters.iter().next().is_none();
        is_free && self.flights.lost.is_none() && self.restarted.is_empty() && self.spent.is_none()
    }

    /// Begins to take events in the frame of another timeline, of which this is a copy.
    pub(super) fn begin_segment_of(&mut self, other: &Self) {
        (self.parameters, self.frame) = (other.parameters, other.frame);
        (self.curves_until, self.next_emission) = (other.curves_until, other.next_emission);
        self.work.clone_from(&other.work);
        self.budget.clone_from(&other.budget);
        self.budget.charges = Some(Vec::new());
        self.flights.copy_work(&other.flights);
        if let Some(entered) = &mut self.entered {
            entered.clear();
        }
    }
}
