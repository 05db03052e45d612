//! How spheres join a zone.

use glam::DVec3;

use super::changes::changes_until_tick;
use crate::detect::sphere_surface;
use crate::norm::Norm;
use crate::rule::contact::{self, Passage};
use crate::rule::exact::answer::changed::Changed;
use crate::rule::exact::contacts::{self, Group};
use crate::rule::exact::context::StepContext;
use crate::rule::exact::persistent::held_forces;
use crate::rule::exact::predict::moving::Around;
use crate::rule::exact::timeline::Timeline;

/// How a sphere that joins a zone moves until the next tick.
#[derive(Debug, Clone, Copy)]
enum Moves {
    /// The sphere moves with this velocity of others \[m/s\].
    With(DVec3),
    /// Under its forces, which give it this acceleration without drag in closed form \[m/s²\].
    Under(DVec3),
}

/// Makes a zone of a group with the velocities after its impacts. Until the next tick the spheres move together
/// with their mean velocity, up to surfaces in the way; then their own velocities count. A single sphere moves
/// under its forces.
pub(crate) fn make_zone(
    timeline: &mut Timeline,
    context: &mut StepContext,
    group: &Group,
) -> Changed {
    let common = match group.members[..] {
        [_] => None,
        _ => Some(common_velocity(timeline, context, group)),
    };
    let states: Vec<_> = group.members.iter().map(|it| (it.slot, it.state())).collect();
    let accelerations = accelerations(timeline, context, &states, group.time);
    for (member, acceleration) in group.members.iter().zip(accelerations) {
        let common = common.filter(|_| !is_on_spring(timeline, member.slot));
        let moves = common.map_or(Moves::Under(acceleration), Moves::With);
        join(timeline, context, (member.slot, member.state()), moves, group.time);
        timeline.flights.rotate(member.slot, [member.angular_velocity, DVec3::ZERO], group.time);
    }
    Changed::Joined { slots: group.members.iter().map(|member| member.slot).collect() }
}

/// The mean velocity of a group \[m/s\], without the part that would move its spheres into surfaces.
fn common_velocity(timeline: &Timeline, context: &StepContext, group: &Group) -> DVec3 {
    let mass: f64 = group.members.iter().map(|member| member.species.mass).sum();
    let momenta = group.members.iter().map(|member| member.species.mass * member.velocity);
    let mean = momenta.sum::<DVec3>() / mass;
    group.members.iter().fold(mean, |velocity, member| {
        without_closing(timeline, context, (member.slot, member.position), velocity, group.time)
    })
}

/// Makes a zone of a sphere at `time` \[s\], and of what touches it.
pub(crate) fn make_zone_about(
    timeline: &mut Timeline,
    context: &mut StepContext,
    slot: u32,
    time: f64,
) -> Changed {
    let group = contacts::gather(timeline, context, &[slot], None, &[], time);
    make_zone(timeline, context, &group)
}

/// Answers the meeting of a sphere in a zone with one outside, at `time` \[s\]: the latter joins the zone with its
/// persistent contacts, and moves with the other until the next tick.
pub(crate) fn meet(
    timeline: &mut Timeline,
    context: &mut StepContext,
    slots: [u32; 2],
    time: f64,
) -> Changed {
    let [comes, stepped] =
        if timeline.flights.is_stepped(slots[0]) { [slots[1], slots[0]] } else { slots };
    let velocity = timeline.flights.bodies[stepped as usize].velocity;
    let cluster = timeline.flights.species_of(comes).cluster;
    let coming = match cluster {
        Some(number) => timeline.flights.clusters.get(number).members.clone(),
        None => vec![comes],
    };
    let state_of = |&slot: &u32| (slot, timeline.flights.state_of(slot, time).into());
    let states: Vec<(u32, [DVec3; 2])> = coming.iter().map(state_of).collect();
    let accelerations = accelerations(timeline, context, &states, time);
    for (&(slot, state), acceleration) in states.iter().zip(&accelerations) {
        let moves = match is_on_spring(timeline, slot) {
            true => Moves::Under(*acceleration),
            false => {
                Moves::With(without_closing(timeline, context, (slot, state[0]), velocity, time))
            }
        };
        join(timeline, context, (slot, state), moves, time);
    }
    Changed::Joined { slots: coming }
}

/// Whether a spring acts on a sphere. Within a tick such a sphere moves by itself, since a stiff spring would do
/// much work on a common motion.
fn is_on_spring(timeline: &Timeline, slot: u32) -> bool {
    timeline.flights.components.have_springs(timeline.flights.index_of[slot as usize])
}

/// Returns a velocity \[m/s\] without the part that would take a sphere with this centre \[m\] into surfaces
/// before the next tick.
fn without_closing(
    timeline: &Timeline,
    context: &StepContext,
    (slot, position): (u32, DVec3),
    mut velocity: DVec3,
    time: f64,
) -> DVec3 {
    let reach = velocity.norm() * context.parameters.zone_tick;
    let radius = timeline.flights.species_of(slot).radius;
    let around = Around::touching(position, radius, time).farther(reach);
    for (surface, shift) in context.surfaces_near(timeline, slot, around) {
        let (form, motion) = context.surface_at(surface, time);
        let separation = sphere_surface(&form, position - shift, radius);
        if let Some(near) = separation.filter(|it| it.distance <= reach) {
            let closing = (motion.velocity_at(near.point) - velocity).dot(near.normal).max(0.0);
            velocity += closing * near.normal;
        }
    }
    velocity
}

/// The velocity \[m/s\] with which a sphere passes no surface from its centre \[m\] until the next tick \[s\].
fn in_front(
    timeline: &Timeline,
    context: &StepContext,
    slot: u32,
    [position, velocity]: [DVec3; 2],
    [time, tick]: [f64; 2],
) -> DVec3 {
    let duration = tick - time;
    let radius = timeline.flights.species_of(slot).radius;
    // Pushed by one surface, the sphere may come to another one.
    let way = 2.0 * (radius + duration * velocity.norm());
    let around = Around::touching(position, radius, time).farther(way).lasting(duration);
    let surfaces = context.surfaces_near(timeline, slot, around);
    let passages: Vec<Passage> = surfaces
        .map(|(surface, shift)| {
            let (before, motion) = context.surface_at(surface, time);
            let (after, _) = motion.carry(&before, duration);
            let carried = motion.carried(position - shift, duration) + shift;
            Passage { before: before.shifted(shift), after: after.shifted(shift), carried }
        })
        .collect();
    let end = position + duration * velocity;
    let held = contact::held(&passages, [position, end], radius);
    held.map_or(velocity, |held| (held - position) / duration)
}

/// The motion of a sphere with this centre \[m\] and velocity \[m/s\] under its forces until the next tick, up to
/// surfaces in the way: its mean velocity and the velocity at the tick \[m/s\]. The kinetic energy gained equals
/// the work of the forces.
fn under_forces(
    timeline: &Timeline,
    context: &StepContext,
    slot: u32,
    [position, velocity]: [DVec3; 2],
    [time, tick]: [f64; 2],
) -> [DVec3; 2] {
    let species = timeline.flights.free_species_of(slot);
    let change = species.acceleration - species.drag_rate * velocity;
    let later = velocity + (tick - time) * change;
    let [before, after] =
        [velocity, later].map(|it| without_closing(timeline, context, (slot, position), it, time));
    let gained = after - before;
    [before + 0.5 * gained, velocity + gained]
}

/// Adds a sphere, by its slot, to a zone with this centre \[m\] and velocity \[m/s\].
fn join(
    timeline: &mut Timeline,
    context: &mut StepContext,
    (slot, state): (u32, [DVec3; 2]),
    moves: Moves,
    time: f64,
) {
    let [position, velocity] = state;
    held_forces::prepare_zone(timeline, context.system, time);
    if timeline.flights.free_species_of(slot).is_curved {
        let acceleration = match moves {
            Moves::With(_) => timeline.flights.free_species_at(slot, time).acceleration,
            Moves::Under(acceleration) => acceleration,
        };
        timeline.flights.set_free_acceleration(slot, acceleration);
    }
    timeline.set_free(slot, time);
    let index = timeline.flights.index_of[slot as usize];
    let next = expect(timeline, context, index, time);
    let [mean, later] = match moves {
        Moves::With(common) => [common, velocity],
        Moves::Under(_) => under_forces(timeline, context, slot, state, [time, next]),
    };
    let sphere = context.system.spheres.id[index as usize];
    let mean = in_front(timeline, context, slot, [position, mean], [time, next]);
    let motion = ([position, mean], [velocity, later]);
    let (changes, force) =
        changes_until_tick(context.system, &timeline.flights, slot, motion, [time, next]);
    timeline.zone.join(sphere, [velocity, later], force, (time, changes));
    timeline.flights.enter_zone(slot, [position, mean], time);
    timeline.note_flight(slot);
    timeline.note_for_companions(slot);
    context.report.zone_account.joined += 1;
}

/// Sets and returns the next tick \[s\] for a sphere, by its index, that is about to join a zone at a time \[s\].
fn expect(timeline: &mut Timeline, context: &StepContext, index: u32, time: f64) -> f64 {
    let tick = [context.parameters.zone_tick, timeline.spring_rate];
    timeline.zone.expect(context.system, index, time, tick)
}

/// Accelerations without drag in closed form \[m/s²\] of spheres that join a zone at `time` \[s\], by their slots, with
/// these centres \[m\] and velocities \[m/s\]. On curves those of the middle between then and the next tick: a stiff
/// spring would gain energy each time under those of the start.
fn accelerations(
    timeline: &mut Timeline,
    context: &StepContext,
    states: &[(u32, [DVec3; 2])],
    time: f64,
) -> Vec<DVec3> {
    let Some(&(first, _)) = states.first() else { return Vec::new() };
    let index = timeline.flights.index_of[first as usize];
    let half = 0.5 * (expect(timeline, context, index, time) - time);
    let flights = &timeline.flights;
    let state_of = |index: u32| {
        let slot = flights.slot_of[index as usize];
        let joins = states.iter().find(|it| it.0 == slot);
        let [position, velocity] =
            joins.map_or_else(|| flights.state_of(slot, time).into(), |it| it.1);
        [position + half * velocity, velocity]
    };
    let acceleration = |&(slot, [_, velocity]): &(u32, [DVec3; 2])| {
        let free = flights.free_species_of(slot);
        if !free.is_curved {
            return free.acceleration;
        }
        let all = flights.acceleration_among(context.system, slot, time + half, state_of);
        all + free.drag_rate * velocity
    };
    states.iter().map(acceleration).collect()
}
