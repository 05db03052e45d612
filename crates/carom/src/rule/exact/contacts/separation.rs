//! Finds the surfaces that a sphere touches, within rounding.

use glam::DVec3;

use super::member::Member;
use crate::detect::passage::is_passing;
use crate::detect::sphere_surface;
use crate::id::ColliderId;
use crate::norm::Norm;
use crate::rule::exact::contacts::contact_scale::{CLOCK_ROUNDING, TOUCHING};
use crate::rule::exact::context::StepContext;
use crate::rule::exact::features::{has, is_above, is_part};
use crate::rule::exact::timeline::Timeline;

/// Gap \[m\] below which two bodies touch: the rounding of their coordinates \[m\], and how far they move at a
/// relative `speed` \[m/s\] within the rounding of the clock.
pub(super) fn touching_gap(coordinates: f64, speed: f64, time: f64) -> f64 {
    TOUCHING * coordinates + CLOCK_ROUNDING * time.abs() * speed
}

/// The mesh with which a sphere is in persistent contact, and the colliders with faces flush with it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct HoldingMesh {
    /// `Surface::whole` of its surfaces.
    pub whole: ColliderId,
    /// Whether another part of the surface is now nearer to the sphere than the part that held it.
    pub is_left: bool,
}

/// The mesh with a part of which the sphere at `slot` is in persistent contact, at `time` \[s\].
pub(crate) fn holding_mesh(
    timeline: &Timeline,
    context: &StepContext,
    slot: u32,
    time: f64,
) -> Option<HoldingMesh> {
    let flights = &timeline.flights;
    let cluster = flights.clusters.get(flights.species_of(slot).cluster?);
    let surfaces = &context.system.surfaces;
    let mut parts = cluster
        .surfaces_of(flights.index_of[slot as usize])
        .filter(|&surface| is_part(&surfaces[surface as usize].form))
        .peekable();
    let first = *parts.peek()?;
    let left = parts.find(|&surface| !has_at(timeline, context, slot, surface, time));
    let whole = surfaces[left.unwrap_or(first) as usize].whole;
    Some(HoldingMesh { whole, is_left: left.is_some() })
}

/// Whether the sphere at `slot` is, at `time` \[s\], in the region of this part of a mesh; true for other surfaces.
pub(crate) fn has_at(
    timeline: &Timeline,
    context: &StepContext,
    slot: u32,
    surface: u32,
    time: f64,
) -> bool {
    if !is_part(&context.system.surfaces[surface as usize].form) {
        return true;
    }
    let (form, motion) = context.surface_at(surface, time);
    let (place, velocity) = timeline.flights.state_of(slot, time);
    has(&form, [place, velocity - motion.velocity_at(place)])
}

/// Whether a sphere touches a surface, or its image at the offset `shift` \[m\], at `time` \[s\], however deep it
/// overlaps; a sphere that passes from behind touches nothing there.
pub(crate) fn touches_surface(
    context: &StepContext,
    member: &Member,
    near: (u32, DVec3),
    time: f64,
) -> bool {
    touching_distance(context, member, near, 0.0, time).is_some()
}

/// The distance of a sphere from a surface, or from its image at the offset `shift` \[m\], that it touches at `time`
/// \[s\]: negative where they overlap. A gap of `missed` \[m\], the error of a path along a curve, counts as a touch.
pub(super) fn touching_distance(
    context: &StepContext,
    member: &Member,
    (surface, shift): (u32, DVec3),
    missed: f64,
    time: f64,
) -> Option<f64> {
    let Member { position: center, velocity, species, .. } = *member;
    let radius = species.radius;
    let (form, motion) = context.system.surfaces[surface as usize].place();
    if motion.is_at_rest() {
        // The point of the surface is no farther from the origin than this if they touch.
        let coordinates = 2.0 * (center.norm() + shift.norm() + radius);
        let gap = 2.0 * touching_gap(coordinates, velocity.norm(), time) + missed;
        if is_above(form, center - shift, radius + gap) {
            return None;
        }
    }
    let (form, motion) = context.surface_at(surface, time);
    let state = [center - shift, velocity - motion.velocity_at(center - shift)];
    if !has(&form, state) {
        return None;
    }
    let separation = sphere_surface(&form, center - shift, radius)?;
    if is_passing(&form, &separation, radius) {
        return None;
    }
    let speed = (velocity - motion.velocity_at(separation.point)).norm();
    let coordinates = center.norm() + separation.point.norm() + radius;
    let is_near = separation.distance <= touching_gap(coordinates, speed, time) + missed;
    is_near.then_some(separation.distance)
}
