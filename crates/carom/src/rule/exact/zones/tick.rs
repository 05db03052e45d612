//! A tick of the zones: spheres leave that are near no other one or fly freely, waiting spheres join, and all are
//! stepped to the next tick.

use std::mem::take;

use glam::DVec3;

use crate::bodies::Motion;
use crate::detect::contact::Bodies;
use crate::detect::sphere_surface;
use crate::id::SphereId;
use crate::rule::exact::context::StepContext;
use crate::rule::exact::displacement::{Displacement, energy_gained};
use crate::rule::exact::events::{NextEvents, Prediction};
use crate::rule::exact::neighbours::NeighbourBuffer;
use crate::rule::exact::persistent::flies_with;
use crate::rule::exact::predict;
use crate::rule::exact::predict::moving::Around;
use crate::rule::exact::timeline::Timeline;
use crate::rule::exact::zones::zone::Stepped;
use crate::rule::periodic;

/// A sphere touches surfaces that are nearer than this part of its radius: the solver leaves less.
const NEAR: f64 = 0.01;

/// Steps the zones from the present tick to the next one. Returns the time \[s\].
pub(crate) fn tick(timeline: &mut Timeline, context: &mut StepContext) -> f64 {
    let (now, tick) = (timeline.zone.next_tick(), context.parameters.zone_tick);
    timeline.zone.report_energy(now, &mut context.report.energy_account);
    if timeline.zone.is_idle() {
        let resting = timeline.zone.rest();
        fly(timeline, context, &resting, now);
        predict_near_zone(timeline, context);
        return now;
    }
    if timeline.zone.is_due_to_leave(tick) {
        let mut zone = take(&mut timeline.zone);
        let free = zone.take_out_free(|index, center| {
            would_rejoin(timeline, context, timeline.flights.slot_of[index as usize], center, now)
        });
        timeline.zone = zone;
        for (index, state) in free {
            leave(timeline, context, index, state, now);
        }
    }
    let Timeline { zone, flights, .. } = timeline;
    zone.admit(context.system, flights, now);
    let first = context.report.impacts.len();
    let stepped = zone.step(context.system, now - context.start, tick, context.report);
    // Impacts of a zone are known to the sub-step.
    let time = context.since_start(now);
    context.report.impacts[first..].iter_mut().for_each(|impact| impact.time = time);
    fly(timeline, context, &stepped, now);
    predict_near_zone(timeline, context);
    context.report.zone_account.ticks += 1;
    context.work.spend(stepped.len() as u64);
    now
}

/// Whether a sphere with this centre \[m\] that presses on others would join its zone again at once: friction acts,
/// and it does not lie on a single surface at rest, or drag slows it and it cannot fly on a curve there.
fn would_rejoin(
    timeline: &Timeline,
    context: &StepContext,
    slot: u32,
    center: DVec3,
    now: f64,
) -> bool {
    if !timeline.has_friction() {
        return false;
    }
    let species = timeline.flights.free_species_of(slot);
    let center = where_it_counts(timeline, context, slot, center, now);
    let touches = |(surface, shift): (u32, DVec3)| {
        let (form, _) = context.surface_at(surface, now);
        let separation = sphere_surface(&form, center - shift, species.radius);
        let is_near = separation.is_some_and(|it| it.distance <= NEAR * species.radius);
        is_near.then_some(surface)
    };
    let around = Around::touching(center, species.radius, now);
    let mut touched = context.surfaces_near(timeline, slot, around).filter_map(touches);
    let Some(first) = touched.next() else { return false };
    let motion = &context.system.surfaces[first as usize].motion;
    let sphere = timeline.flights.index_of[slot as usize];
    let bodies = Bodies::Surface { sphere, surface: first };
    let follows_drag = species.drag_rate == 0.0
        || (motion.belt == DVec3::ZERO
            && context.period == DVec3::INFINITY
            && flies_with(context, species, bodies));
    !motion.is_at_rest() || touched.next().is_some() || !follows_drag
}

/// The image of a place \[m\] beside the position of a sphere at `now` \[s\] in a periodic box.
fn where_it_counts(
    timeline: &Timeline,
    context: &StepContext,
    slot: u32,
    place: DVec3,
    now: f64,
) -> DVec3 {
    if context.period == DVec3::INFINITY {
        return place;
    }
    periodic::image_near(place, timeline.flights.state_of(slot, now).0, context.period)
}

/// Begins the straight flights of spheres in a zone from a tick at `now` \[s\] to the next one.
fn fly(timeline: &mut Timeline, context: &StepContext, stepped: &[Stepped], now: f64) {
    let next = timeline.zone.next_tick();
    let mut found = NeighbourBuffer::default();
    for Stepped { index, positions: [from, to], rotation } in stepped {
        let (index, from, to) = (*index, *from, *to);
        let slot = timeline.flights.slot_of[index as usize];
        if let Some(rotation) = rotation {
            timeline.flights.rotations[index as usize] = rotation.clone();
        }
        let velocity = if from == to { DVec3::ZERO } else { (to - from) / (next - now) };
        let from = where_it_counts(timeline, context, slot, from, now);
        let body = &timeline.flights.bodies[slot as usize];
        if velocity == DVec3::ZERO && body.velocity == DVec3::ZERO && body.position == from {
            continue;
        }
        timeline.begin_flight(slot, from, velocity, now);
        let cell_crossing = stay_in_region(timeline, slot, [now, next], &mut found);
        // Spheres near it predict the meetings.
        let events = NextEvents::NEVER;
        timeline.enter(slot, Prediction { events, cell_crossing });
        timeline.note_near_zone(slot, &found);
        found.clear();
    }
}

/// Moves a sphere that leaves its neighbour region between two times \[s\] to the next one, with the
/// spheres that it finds there. Returns when it leaves that \[s\]; infinite if it stays.
fn stay_in_region(
    timeline: &mut Timeline,
    slot: u32,
    [now, next]: [f64; 2],
    found: &mut NeighbourBuffer,
) -> f64 {
    let stays = |timeline: &Timeline| {
        let body = &timeline.flights.bodies[slot as usize];
        timeline.neighbours.stays(slot, body, timeline.flights.species_of(slot), next)
    };
    if stays(timeline) {
        return f64::INFINITY;
    }
    let state = timeline.flights.state_of(slot, now);
    timeline.cross_cell(slot, state.into(), found);
    if stays(timeline) {
        return f64::INFINITY;
    }
    let body = &timeline.flights.bodies[slot as usize];
    timeline.neighbours.crossing_time(slot, body, timeline.flights.species_of(slot), now)
}

/// Predicts the meetings of free spheres with their neighbours in zones.
fn predict_near_zone(timeline: &mut Timeline, context: &mut StepContext) {
    let mut near = take(&mut timeline.zone.near);
    near.sort_unstable();
    near.dedup();
    near.retain(|&slot| {
        if timeline.flights.is_stepped(slot) {
            return false;
        }
        let known = timeline.schedule.next_events(slot);
        let mut events = known;
        let are_any = context.searches[0].add_meetings_with_zone(timeline, slot, &mut events);
        if events != known {
            timeline.reschedule(slot, events);
        }
        are_any
    });
    timeline.zone.near = near;
}

/// Takes the sphere at an index of the world's arrays out of its zone at `now` \[s\], with this centre
/// \[m\] and velocity \[m/s\]. It is lifted out of surfaces that it overlaps.
fn leave(
    timeline: &mut Timeline,
    context: &mut StepContext,
    index: u32,
    [position, velocity]: [DVec3; 2],
    now: f64,
) {
    let slot = timeline.flights.slot_of[index as usize];
    let mut position = where_it_counts(timeline, context, slot, position, now);
    let before = position;
    let radius = timeline.flights.free_species_of(slot).radius;
    let around = Around::touching(position, radius, now).farther(radius);
    for (surface, shift) in context.surfaces_near(timeline, slot, around) {
        let (form, _) = context.surface_at(surface, now);
        let separation = sphere_surface(&form, position - shift, radius);
        if let Some(overlap) = separation.filter(|it| it.distance < 0.0) {
            position -= overlap.distance * overlap.normal;
        }
    }
    if position != before {
        let moved = Displacement { index, from: before, to: position, velocity };
        let gained = energy_gained(timeline, context.system, &[moved], now);
        context.report.energy_account.correction += gained;
    }
    timeline.flights.leave_zone(slot, [position, velocity], now);
    timeline.note_flight(slot);
    timeline.note_for_companions(slot);
    timeline.wrap(slot);
    timeline.flights.end_torque(slot, now);
    predict::predict(timeline, context, slot, now);
    timeline.zone.near.push(slot);
    context.report.zone_account.left += 1;
}

/// Writes the velocities of spheres in a zone at `time` \[s\]: between ticks they change steadily.
pub(crate) fn write_velocities(
    timeline: &Timeline,
    ids: &[SphereId],
    motion: &mut Motion,
    time: f64,
) {
    let zone = &timeline.zone;
    for (index, velocity) in zone.velocities(time) {
        motion.velocity[index as usize] = velocity;
    }
    for (sphere, velocity) in zone.waiting(time) {
        if let Ok(index) = ids.binary_search(&sphere) {
            motion.velocity[index] = velocity;
        }
    }
}
