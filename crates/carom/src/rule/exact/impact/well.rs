//! Events of two spheres at the edge of their well: they enter it, leave it, or turn back.

use super::meeting::MeetingPair;
use crate::norm::Norm;
use crate::respond::reduced_mass;
use crate::rule::exact::answer::changed::Changed;
use crate::rule::exact::context::StepContext;
use crate::rule::exact::timeline::Timeline;
use crate::rule::periodic;
use crate::well_event::{WellEvent, WellEventKind};

/// Least part of the relative speed with which a bound pair is turned back at the edge. Slower ones would meet the edge
/// again within the rounding of the clock; what it adds to the energy is rounding.
const LEAST_TURN: f64 = 1e-8;

/// Whether two spheres that meet at `time` \[s\] are at the edge of their well, and not at the cores.
pub(crate) fn meet_at_edge(
    timeline: &Timeline,
    context: &StepContext,
    slots: [u32; 2],
    time: f64,
) -> bool {
    let flights = &timeline.flights;
    let Some(wells) = &flights.wells else { return false };
    let [(x1, _), (x2, _)] = slots.map(|slot| flights.state_of(slot, time));
    let [r1, r2] = slots.map(|slot| flights.species_of(slot).radius);
    let distance_squared = periodic::wrapped(x2 - x1, context.period).length_squared();
    distance_squared > wells.range_ratio * (r1 + r2) * (r1 + r2)
}

/// Answers the event of two spheres at the edge of their well at `time` \[s\].
///
/// With the reduced mass m, the speed w through the edge, and the potential energy U that the pair gains there, the speed
/// becomes `√(w² - 2 U/m)`, or turns back where that is not real. The impulse acts along the line of centres.
pub(crate) fn answer_at_edge(
    timeline: &mut Timeline,
    context: &mut StepContext,
    slots: [u32; 2],
    time: f64,
) -> Changed {
    let meeting = MeetingPair::at(timeline, context, slots, time);
    let MeetingPair { slots, masses, positions, distance, normal, .. } = meeting;
    let pair = slots.map(|slot| timeline.flights.index_of[slot as usize]);
    let velocity = meeting.relative_velocity();
    let Some(wells) = &timeline.flights.wells else { return Changed::NONE };
    let is_bound = wells.is_bound(pair);
    let edge = Edge { is_bound, depth: wells.depth, speed: velocity.dot(normal) };
    let mut velocities = meeting.velocities;
    if let Some((kind, impulse)) = edge.impulse(masses, velocity.norm()) {
        velocities = meeting.velocities_after(impulse);
        let between = slots.map(|slot| context.id_of(timeline, slot));
        let time = context.since_start(time);
        context.report.well_events.push(WellEvent {
            time,
            between,
            kind,
            normal,
            distance,
            impulse,
        });
        if let Some(wells) =
            timeline.flights.wells.as_mut().filter(|_| kind != WellEventKind::Bounce)
        {
            wells.set_bound(pair, !is_bound);
        }
    }
    for (slot, (place, velocity)) in slots.into_iter().zip(positions.into_iter().zip(velocities)) {
        timeline.begin_flight(slot, place, velocity, time);
    }
    Changed::Pair { slots, are_searched: [false; 2] }
}

/// Two spheres at the edge of their well.
struct Edge {
    /// Whether they come from inside.
    is_bound: bool,
    /// Depth of the well \[J\].
    depth: f64,
    /// Speed at which they part \[m/s\].
    speed: f64,
}

impl Edge {
    /// What happens to spheres with these masses \[kg\] and this relative speed \[m/s\], and the impulse \[N s\] that
    /// drives them apart; `None` for spheres that do not move through it.
    fn impulse(&self, masses: [f64; 2], relative_speed: f64) -> Option<(WellEventKind, f64)> {
        let Self { is_bound, depth, speed } = *self;
        let reduced_mass = reduced_mass(masses);
        let (outwards, gained) = if is_bound { (1.0, depth) } else { (-1.0, -depth) };
        let through = outwards * speed;
        let least = if is_bound { LEAST_TURN * relative_speed } else { 0.0 };
        if through < -least || (!is_bound && through == 0.0) {
            return None;
        }
        let through = through.max(least);
        let rest = through * through - 2.0 * gained / reduced_mass;
        let (kind, after) = match (rest > 0.0, is_bound) {
            (true, true) => (WellEventKind::Dissociation, rest.sqrt()),
            (true, false) => (WellEventKind::Capture, rest.sqrt()),
            (false, _) => (WellEventKind::Bounce, -through),
        };
        Some((kind, reduced_mass * (outwards * after - speed)))
    }
}
