//! What a sphere sees around it: how far its neighbours are, and which of them it meets first.

use glam::DVec3;
use prefetch_index::prefetch_index;

use super::body::{Body, Kind};
use super::neighbour::Neighbour;
use super::outlook::Ahead;
use super::sight::Look;
use super::timeline::Timeline;
use super::vicinity::Vicinity;
use crate::contact_time::{self, Reach};
use crate::detect::contact::Bodies;

/// Who is near a sphere, and whom of them it may meet.
#[derive(Debug, Clone, Default)]
pub(super) struct Surroundings {
    pub near: Vicinity,
    /// The first two meetings with those that fly alike, on the world's clock \[s\], and whom it meets;
    /// infinite if there are none.
    meetings: [(f64, u32); 2],
}

impl Surroundings {
    /// Looks, `now` \[s\], for those near a sphere whom it meets first. Tells whether one of those that
    /// fly alike, but `other`, is nearer to it than the sum of their radii and `part` of it.
    #[inline(always)]
    pub fn look(&mut self, timeline: &Timeline, slot: u32, now: f64, besides: (u32, f64)) -> bool {
        timeline.neighbours.find(slot, timeline.kind_of(slot).level, &mut self.near);
        self.look_at_found(timeline, slot, now, besides)
    }

    /// Looks for the first meetings among the spheres that were found already.
    #[inline(always)]
    pub fn look_at_found(
        &mut self,
        timeline: &Timeline,
        slot: u32,
        now: f64,
        besides: (u32, f64),
    ) -> bool {
        if timeline.are_many() {
            let slots = self.near.found().iter().map(|near| near.slot() as usize);
            slots.for_each(|slot| prefetch_index(&timeline.bodies, slot));
        }
        let (count, has_images) = (self.near.len, self.near.has_images());
        let near = self.near.in_fours();
        let seen = Look { timeline, slot, near, count, has_images, now, besides }.at_all();
        self.meetings = seen.meetings;
        seen.touches
    }

    /// Whether one of the spheres that fly differently, but `other`, is nearer to the sphere than the
    /// sum of their radii and `part` of it, when its flight begins.
    pub fn touches_others(
        &self,
        timeline: &Timeline,
        slot: u32,
        (other, part): (u32, f64),
    ) -> bool {
        let (body, kind) = (&timeline.bodies[slot as usize], timeline.kind_of(slot));
        self.near.others(slot).any(|near| {
            near.slot() != other
                && !timeline.kind_of(near.slot()).flies_like(kind)
                && is_near(timeline, slot, near, (body.position, body.time), part)
        })
    }

    /// Looks for those near a sphere that is at `place` \[m\] at `time` \[s\]. Tells whether one of them
    /// is nearer to it than the sum of their radii and `part` of it.
    pub fn touches_any(
        &mut self,
        timeline: &Timeline,
        slot: u32,
        place: (DVec3, f64),
        part: f64,
    ) -> bool {
        timeline.neighbours.find(slot, timeline.kind_of(slot).level, &mut self.near);
        self.near.others(slot).any(|near| is_near(timeline, slot, near, place, part))
    }

    /// The first two meetings that the sphere has seen, or has with spheres that fly differently.
    #[inline(always)]
    pub fn first_meetings(&self, timeline: &Timeline, slot: u32) -> Ahead {
        let [first, second] = self.meetings;
        let mut ahead = Ahead {
            first: timeline.meeting(first.0, first.1),
            second: timeline.meeting(second.0, second.1),
        };
        if timeline.only_kind().is_none() {
            self.meetings_with_others(timeline, slot, &mut ahead);
        }
        ahead
    }

    #[inline(never)]
    fn meetings_with_others(&self, timeline: &Timeline, slot: u32, ahead: &mut Ahead) {
        let kind = timeline.kind_of(slot);
        for near in self.near.others(slot) {
            if !kind.flies_like(timeline.kind_of(near.slot())) {
                let time = meeting_of_others(timeline, slot, near);
                ahead.add(timeline.meeting(time, near.slot()));
            }
        }
    }
}

/// Whether a neighbour is nearer to a sphere than the sum of their radii and `part` of it, where that
/// is at `place` \[m\] at `time` \[s\].
fn is_near(
    timeline: &Timeline,
    slot: u32,
    neighbour: Neighbour,
    (place, time): (DVec3, f64),
    part: f64,
) -> bool {
    let shift = timeline.neighbours.shift_of(slot, neighbour);
    let offset = timeline.state_of(neighbour.slot(), time).0 + shift - place;
    let radius_sum = timeline.kind_of(slot).radius + timeline.kind_of(neighbour.slot()).radius;
    let reach = radius_sum * (1.0 + part);
    offset.length_squared() <= reach * reach
}

/// When a sphere meets one that flies differently, on the world's clock \[s\]; infinite if never.
fn meeting_of_others(timeline: &Timeline, slot: u32, neighbour: Neighbour) -> f64 {
    let slots = [slot, neighbour.slot()];
    let bodies = slots.map(|slot| &timeline.bodies[slot as usize]);
    let kinds = slots.map(|slot| timeline.kind_of(slot));
    let indices @ [index, other_index] = slots.map(|slot| timeline.index_of[slot as usize]);
    if timeline.has_lasted(Bodies::pair(indices)) {
        // No impact ends their flights.
        return f64::INFINITY;
    }
    let shift = timeline.neighbours.shift_of(slot, neighbour);
    let [end, other_end] = kinds.map(|kind| timeline.flight_end(kind));
    let end = end.min(other_end);
    if end < f64::INFINITY {
        let reach = |one: usize| {
            let (body, kind) = (bodies[one], kinds[one]);
            Reach::of(body.flight(kind), kind.radius, end - body.time)
        };
        if reach(0).misses_sphere(&reach(1), shift) {
            return f64::INFINITY;
        }
    }
    if index < other_index {
        meeting(bodies, kinds, shift)
    } else {
        // In the order of ids: the other way round the same time might round differently.
        meeting([bodies[1], bodies[0]], [kinds[1], kinds[0]], -shift)
    }
}

/// When two spheres meet that fly differently. Searched for without end: what is known already must
/// not change by a bit what is found.
fn meeting(bodies: [&Body; 2], kinds: [&Kind; 2], shift: DVec3) -> f64 {
    let start = bodies[0].time.max(bodies[1].time);
    let first = bodies[0].flight_from(kinds[0], start);
    let mut second = bodies[1].flight_from(kinds[1], start);
    second.position += shift;
    let radius_sum = kinds[0].radius + kinds[1].radius;
    match contact_time::sphere_sphere(&first, &second, radius_sum, f64::INFINITY) {
        Some(delay) => start + delay,
        None => f64::INFINITY,
    }
}
