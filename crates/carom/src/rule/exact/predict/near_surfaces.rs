//! The surfaces near a sphere.

use std::borrow::Borrow;

use glam::DVec3;

use crate::rule::exact::timeline::Timeline;
use crate::system::System;

impl Timeline {
    /// Surfaces at rest that a sphere may meet in its neighbour region, with the shift \[m\] that brings them to
    /// where its position counts.
    pub(crate) fn surfaces_at_rest_near(&self, slot: u32) -> impl Iterator<Item = (u32, DVec3)> {
        let level = self.flights.species_of(slot).level;
        let near = self.neighbours.surfaces_near(slot, level);
        near.filter(move |near| self.neighbours.meets_surface(slot, near.0))
    }

    /// Surfaces at rest that a sphere may meet in its neighbour region, and then these moving ones, with the shift
    /// \[m\] that brings them to where its position counts.
    pub(crate) fn surfaces_with<T: Borrow<u32>>(
        &self,
        slot: u32,
        moving: impl IntoIterator<Item = T>,
    ) -> impl Iterator<Item = (u32, DVec3)> {
        let shift = self.neighbours.shift_from_box(slot);
        let moving = moving.into_iter().map(move |surface| (*surface.borrow(), shift));
        let meets = move |near: &(u32, DVec3)| self.neighbours.meets_surface(slot, near.0);
        self.surfaces_at_rest_near(slot).chain(moving.filter(meets))
    }

    /// The images of a surface that a sphere may meet, with the shift \[m\] that brings each to where its position
    /// counts.
    pub(crate) fn images_of(
        &self,
        system: &System,
        slot: u32,
        surface: u32,
    ) -> impl Iterator<Item = (u32, DVec3)> {
        let moves = !system.surfaces[surface as usize].motion.is_at_rest();
        let all = self.surfaces_with(slot, moves.then_some(surface));
        all.filter(move |near| near.0 == surface)
    }
}
