//! Flights that end before the sphere has moved. Too many of them in a tick make a zone.

use glam::DVec3;

use crate::detect::sphere_surface;
use crate::norm::Norm;
use crate::rule::exact::contacts::contact_scale::RESOLVED_PATH;
use crate::rule::exact::context::StepContext;
use crate::rule::exact::events::{Event, EventTarget, PackedTarget};
use crate::rule::exact::timeline::Timeline;
use crate::rule::exact::zones::budget::ShortFlight;

/// What kind of short flight ends with an event of the sphere at `slot`; `None` if the flight is not short.
pub(super) fn find(
    timeline: &Timeline,
    context: &StepContext,
    slot: u32,
    event: &Event,
) -> Option<ShortFlight> {
    if !context.has_zones() || event.target == PackedTarget::STEP_END {
        return None;
    }
    if context.system.has_nonconservative_forces() && is_hop(timeline, context, slot, event) {
        return Some(ShortFlight::DampedHop);
    }
    // Between impacts with a light sphere a heavy one hardly moves, so both must have stayed.
    let stays = |slot: u32| {
        let body = &timeline.flights.bodies[slot as usize];
        is_short(timeline, slot, event.time - body.time, body.velocity)
    };
    let have_stayed = stays(slot) && event.target.slot().is_none_or(stays);
    have_stayed.then_some(ShortFlight::Still)
}

/// Whether a path of a duration \[s\] with this velocity \[m/s\] is too short for a sphere to count as moved.
fn is_short(timeline: &Timeline, slot: u32, duration: f64, velocity: DVec3) -> bool {
    let resolved = RESOLVED_PATH * timeline.flights.species_of(slot).radius;
    duration * duration * velocity.length_squared() < resolved * resolved
}

/// Whether forces, and not its speed, bring a sphere back to a body, on a path relative to it that is straight but for
/// what counts as no motion. A sphere that slides may go far meanwhile.
fn is_hop(timeline: &Timeline, context: &StepContext, slot: u32, event: &Event) -> bool {
    let Some(approach) = Approach::of(timeline, context, slot, event) else { return false };
    approach.closing <= approach.change.norm()
        && is_short(timeline, slot, approach.duration, approach.change)
}

/// How a sphere comes to the body that it meets.
struct Approach {
    /// Since both began their flights \[s\].
    duration: f64,
    /// Change of their relative velocity in that time \[m/s\].
    change: DVec3,
    /// Speed of approach at its end \[m/s\].
    closing: f64,
}

impl Approach {
    /// The approach that ends with an event of the sphere at `slot`; `None` without another body.
    fn of(timeline: &Timeline, context: &StepContext, slot: u32, event: &Event) -> Option<Self> {
        match event.target.unpacked() {
            EventTarget::Surface(surface) => {
                Self::to_surface(timeline, context, [slot, surface], event.time)
            }
            EventTarget::Sphere(other) => {
                Some(Self::to_sphere(timeline, [slot, other], event.time))
            }
            _ => None,
        }
    }

    fn to_surface(
        timeline: &Timeline,
        context: &StepContext,
        [slot, surface]: [u32; 2],
        time: f64,
    ) -> Option<Self> {
        let body = &timeline.flights.bodies[slot as usize];
        let (position, velocity) = timeline.flights.state_of(slot, time);
        let radius = timeline.flights.species_of(slot).radius;
        let (form, motion) = context.surface_at(surface, time);
        let near = sphere_surface(&form, position, radius)?;
        let closing = (motion.velocity_at(near.point) - velocity).dot(near.normal);
        Some(Self { duration: time - body.time, change: velocity - body.velocity, closing })
    }

    fn to_sphere(timeline: &Timeline, [slot, other]: [u32; 2], time: f64) -> Self {
        let flights = &timeline.flights;
        let start = [slot, other].map(|it| flights.bodies[it as usize].time);
        let start = start[0].max(start[1]);
        let relative = |time: f64| {
            let [own, others] = [slot, other].map(|it| flights.state_of(it, time));
            (own.0 - others.0, own.1 - others.1)
        };
        let (offset, velocity) = relative(time);
        let change = velocity - relative(start).1;
        let closing = -velocity.dot(offset) / offset.norm();
        Self { duration: time - start, change, closing }
    }
}

/// Counts a short flight of a sphere that ended at `time` \[s\]. Returns whether there have been too many, so that the
/// sphere is to join a zone.
pub(super) fn count(
    timeline: &mut Timeline,
    context: &StepContext,
    (slot, flight): (u32, ShortFlight),
    time: f64,
) -> bool {
    let index = timeline.flights.index_of[slot as usize];
    let is_spent = timeline.budget.is_spent_by_flight(context.parameters, (index, flight), time);
    is_spent && !timeline.flights.is_stepped(slot)
}
