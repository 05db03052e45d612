//! Follow-up impacts: plastic contacts that an impact closes within its own duration. Answered one by one they are
//! the sweeps of a Gauss-Seidel iteration, which in a wedge does not end; merged into the group, they are answered
//! at once.

use crate::detect::contact::Bodies;
use crate::detect::sphere_surface;
use crate::norm::Norm;
use crate::respond;
use crate::restitution::Coefficient;
use crate::rule::exact::contacts::contact_scale::{ContactScale, RESOLVED_PATH};
use crate::rule::exact::contacts::{Group, Member};
use crate::rule::exact::context::StepContext;
use crate::rule::exact::neighbours::NeighbourBuffer;
use crate::rule::exact::predict;
use crate::rule::exact::predict::moving::Around;
use crate::rule::exact::timeline::Timeline;

/// The contacts that the spheres `struck` in a group close plastically within a contact duration of its impacts:
/// either the restitution is 0, or all their spheres were struck within that time. Ascending.
pub(super) fn follow_ups(
    timeline: &Timeline,
    context: &StepContext,
    group: &Group,
    struck: &[Bodies],
) -> Vec<Bodies> {
    if group.touches.len() < 2 {
        // A single impact needs no merging: a later one meets a struck sphere as any other does.
        return Vec::new();
    }
    let mut is_struck = vec![false; group.members.len()];
    for index in struck.iter().flat_map(|bodies| bodies.spheres()) {
        if let Some(place) = group.place_of(index) {
            is_struck[place] = true;
        }
    }
    let search = Search { timeline, context, group, is_struck: &is_struck };
    let mut found = Vec::new();
    for (place, _) in is_struck.iter().enumerate().filter(|(_, is_struck)| **is_struck) {
        search.spheres_closing(place, &mut found);
        search.surfaces_closing(place, &mut found);
    }
    found.sort_unstable();
    found.dedup();
    found
}

/// Impacts at the same instant as a group, of spheres within the reach of those that the follow-up impacts `found`
/// add to it. Answered after the group they would find changed velocities, and a symmetric scene would lose its
/// symmetry.
pub(super) fn impacts_beside(timeline: &Timeline, group: &Group, found: &[Bodies]) -> Vec<Bodies> {
    let mut beside = Vec::new();
    let mut near = NeighbourBuffer::default();
    let is_new = |index: &u32| group.place_of(*index).is_none();
    for index in found.iter().flat_map(|bodies| bodies.spheres()).filter(is_new) {
        let slot = timeline.flights.slot_of[index as usize];
        let comes = Member::at(&timeline.flights, slot, group.time);
        timeline.neighbours.find(slot, comes.species.level, &mut near);
        for neighbour in near.others(slot) {
            let other = Member::at(&timeline.flights, neighbour.slot(), group.time);
            let shift = timeline.neighbours.shift_of(slot, neighbour);
            let radius_sum = timeline.flights.contact_distance([&comes.species, &other.species]);
            let gap = (other.position + shift - comes.position).norm() - radius_sum;
            let is_near = gap <= RESOLVED_PATH * radius_sum && !other.species.is_stepped;
            if is_near && is_new(&other.index) {
                beside.extend(predict::meeting_at(timeline, neighbour.slot(), group.time));
            }
        }
    }
    beside.sort_unstable();
    beside.dedup();
    beside
}

/// A search for follow-up impacts of a group.
struct Search<'a> {
    timeline: &'a Timeline,
    context: &'a StepContext<'a>,
    group: &'a Group,
    /// Whether each member was struck, by its place among the members.
    is_struck: &'a [bool],
}

impl Search<'_> {
    fn spheres_closing(&self, place: usize, found: &mut Vec<Bodies>) {
        let Self { timeline, context, group, .. } = *self;
        if !context.system.settings.spheres_collide {
            return;
        }
        let member = &group.members[place];
        let mut near = NeighbourBuffer::default();
        timeline.neighbours.find(member.slot, member.species.level, &mut near);
        let flights = &timeline.flights;
        let free = near.others(member.slot).filter(|it| !flights.is_stepped(it.slot()));
        for neighbour in free {
            let other_index = timeline.flights.index_of[neighbour.slot() as usize];
            let bodies = Bodies::pair([member.index, other_index]);
            let other = self.state_of(neighbour.slot(), other_index);
            let shift = timeline.neighbours.shift_of(member.slot, neighbour);
            let offset = other.position + shift - member.position;
            let radius_sum = flights.contact_distance([&member.species, &other.species]);
            let gap = offset.norm() - radius_sum;
            if gap > RESOLVED_PATH * radius_sum || group.has(bodies) {
                continue;
            }
            let closing = (member.velocity - other.velocity).dot(offset) / offset.norm();
            let restitution = respond::restitution_of(bodies, context.system).coefficient(closing);
            if self.follows(&[member, &other], gap, closing, restitution) {
                found.push(bodies);
            }
        }
    }

    fn surfaces_closing(&self, place: usize, found: &mut Vec<Bodies>) {
        let Self { timeline, context, group, .. } = *self;
        let member = &group.members[place];
        let sphere = member.index;
        let around = Around::touching(member.position, member.species.radius, group.time);
        for (surface, shift) in context.surfaces_near(timeline, member.slot, around) {
            let bodies = Bodies::Surface { sphere, surface };
            let (form, motion) = context.surface_at(surface, group.time);
            let center = member.position - shift;
            let Some(separation) = sphere_surface(&form, center, member.species.radius) else {
                continue;
            };
            let gap = separation.distance;
            if gap > RESOLVED_PATH * member.species.radius || group.has(bodies) {
                continue;
            }
            let velocity = member.velocity - motion.velocity_at(separation.point);
            let closing = -velocity.dot(separation.normal);
            let restitution = respond::restitution_of(bodies, context.system).coefficient(closing);
            if self.follows(&[member], gap, closing, restitution) {
                found.push(bodies);
            }
        }
    }

    /// The state of a sphere after the group's impacts, or on its flight outside the group.
    fn state_of(&self, slot: u32, index: u32) -> Member {
        let Self { timeline, group, .. } = *self;
        group.place_of(index).map_or_else(
            || Member::at(&timeline.flights, slot, group.time),
            |place| group.members[place],
        )
    }

    /// Whether spheres close a gap \[m\] at a speed \[m/s\] within a contact duration, and plastically.
    fn follows(
        &self,
        spheres: &[&Member],
        gap: f64,
        closing: f64,
        restitution: Coefficient,
    ) -> bool {
        if closing <= 0.0 || restitution.is_elastic {
            return false;
        }
        let time = self.group.time;
        let scale = spheres.iter().fold(ContactScale::default(), |scale, member| {
            scale.with(member.position, member.velocity, &member.species)
        });
        let duration = self.context.duration_of(&scale, time);
        let was_struck = |member: &&Member| {
            let body = &self.timeline.flights.bodies[member.slot as usize];
            let place = self.group.place_of(member.index);
            place.is_some_and(|place| self.is_struck[place])
                || (body.is_struck() && time - body.time < duration)
        };
        gap <= closing * duration && (restitution.value == 0.0 || spheres.iter().all(was_struck))
    }
}
