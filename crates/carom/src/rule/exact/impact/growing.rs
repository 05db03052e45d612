//! Impacts of elastic spheres whose radii grow: the surfaces part with the speed of their approach. Bodies that
//! meet at one instant are answered one pair after the other.

use glam::DVec3;

use super::account::{account_of, account_of_pair};
use super::meeting::MeetingPair;
use crate::detect::contact::Bodies;
use crate::detect::{Separation, known_in_front};
use crate::report::{BodyPair, Impact, ImpactGroup};
use crate::respond::reduced_mass;
use crate::rule::exact::answer::changed::Changed;
use crate::rule::exact::context::StepContext;
use crate::rule::exact::timeline::Timeline;
use crate::rule::periodic;

/// Answers the impact of two spheres at `time` \[s\].
///
/// With the speed G at which the sum of their radii grows, the relative velocity along the normal becomes `2 G - v·n`;
/// growth does the work `2 m G (G - v·n)`, with m the reduced mass.
pub(crate) fn answer_growing_pair(
    timeline: &mut Timeline,
    context: &mut StepContext,
    slots: [u32; 2],
    time: f64,
) -> Changed {
    let meeting = MeetingPair::at(timeline, context, slots, time);
    let MeetingPair { slots, masses, positions, normal, .. } = meeting;
    let flights = &timeline.flights;
    let species = slots.map(|slot| flights.species_of(slot));
    let factor = flights.distance_factor(species);
    let growth_speed: f64 = species.iter().map(|it| factor * it.growth_speed).sum();
    let approach_speed = growth_speed - meeting.relative_velocity().dot(normal);
    // A graze may turn out, by rounding, not to close.
    let impulse = 2.0 * reduced_mass(masses) * approach_speed.max(0.0);
    let velocities = meeting.velocities_after(impulse);
    if impulse > 0.0 {
        let before = meeting.velocities;
        let account = account_of_pair(before, velocities, masses, approach_speed, 1.0);
        let point = positions[0] + factor * flights.radius_at(slots[0], time) * normal;
        let [first, second] = slots.map(|slot| context.id_of(timeline, slot));
        let impact = Impact {
            time: context.since_start(time),
            between: BodyPair::Spheres(first, second),
            point: periodic::wrapped(point, context.period),
            normal,
            approach_speed,
            separation_speed: (velocities[1] - velocities[0]).dot(normal) - growth_speed,
            impulse,
            tangential_impulse: DVec3::ZERO,
            kick: 0.0,
        };
        context.record([impact], worked(account, growth_speed * impulse));
    }
    for (slot, (place, velocity)) in slots.into_iter().zip(positions.into_iter().zip(velocities)) {
        begin_flight(timeline, slot, [place, velocity], impulse > 0.0, time);
    }
    Changed::Pair { slots, are_searched: [false; 2] }
}

/// Answers the impact of a sphere on a surface at rest at `time` \[s\].
pub(crate) fn answer_growing_single(
    timeline: &mut Timeline,
    context: &mut StepContext,
    slot: u32,
    surface: u32,
    time: f64,
) -> Changed {
    let flights = &timeline.flights;
    let species = flights.species_of(slot);
    let (mass, growth_speed) = (species.mass, species.growth_speed);
    let (place, before) = flights.state_of(slot, time);
    let mut velocity = before;
    if let Some(Separation { normal, point, .. }) =
        nearest_image(timeline, context, slot, (surface, place), time)
    {
        let approach_speed = growth_speed - before.dot(normal);
        let impulse = 2.0 * mass * approach_speed.max(0.0);
        velocity = before + impulse / mass * normal;
        if impulse > 0.0 {
            let mut account = account_of([&[before], &[velocity]], &[mass]);
            account.momentum_after -= impulse * normal;
            let sphere = flights.index_of[slot as usize];
            let impact = Impact {
                time: context.since_start(time),
                between: BodyPair::of(Bodies::Surface { sphere, surface }, context.system),
                point: periodic::wrapped(point, context.period),
                normal,
                approach_speed,
                separation_speed: velocity.dot(normal) - growth_speed,
                impulse,
                tangential_impulse: DVec3::ZERO,
                kick: 0.0,
            };
            context.record([impact], worked(account, growth_speed * impulse));
        }
    }
    begin_flight(timeline, slot, [place, velocity], velocity != before, time);
    Changed::sphere(slot)
}

/// The separation of a sphere at a place \[m\] from the nearest image of a surface.
fn nearest_image(
    timeline: &Timeline,
    context: &StepContext,
    slot: u32,
    (surface, place): (u32, DVec3),
    time: f64,
) -> Option<Separation> {
    let radius = timeline.flights.radius_at(slot, time);
    let form = &context.system.surfaces[surface as usize].form;
    let images = timeline.images_of(context.system, slot, surface);
    let seen = images.filter_map(|(_, shift)| {
        let separation = known_in_front(form, place - shift, radius)?;
        Some(Separation { point: separation.point + shift, ..separation })
    });
    seen.min_by(|a, b| a.distance.abs().total_cmp(&b.distance.abs()))
}

/// Begins the flight of a sphere from a place \[m\] with a velocity \[m/s\].
fn begin_flight(
    timeline: &mut Timeline,
    slot: u32,
    [place, velocity]: [DVec3; 2],
    is_struck: bool,
    time: f64,
) {
    timeline.begin_flight(slot, place, velocity, time);
    if is_struck {
        timeline.flights.bodies[slot as usize].strike();
    }
}

/// An account with the work that growth did \[J\]: it counts as that of kicks.
fn worked(account: ImpactGroup, kick_work: f64) -> ImpactGroup {
    ImpactGroup { energy_after: account.energy_after - kick_work, kick_work, ..account }
}
