//! Impacts of two spheres that touch nothing else.

use std::hint::select_unpredictable;

use glam::DVec3;

use super::account::account_of_pair;
use super::friction::{self, FrictionImpulses};
use super::group;
use crate::detect::contact::Bodies;
use crate::norm::Norm;
use crate::report::{BodyPair, Impact};
use crate::respond;
use crate::restitution::Coefficient;
use crate::rule::exact::answer::changed::Changed;
use crate::rule::exact::contacts::Member;
use crate::rule::exact::context::StepContext;
use crate::rule::exact::flights::Body;
use crate::rule::exact::pair_times::NearTest;
use crate::rule::exact::timeline::Timeline;
use crate::rule::exact::zones;
use crate::rule::periodic;

/// Spheres nearer than this part of the distance of centres are tested closely for taking part in the impact. The
/// value is generous: it only decides which way is taken to one result.
pub(super) const NEARBY: f64 = 1e-6;

/// Answers the impact of two spheres at `time` \[s\], and of whatever touches them there. Returns the spheres to be
/// predicted.
pub(crate) fn answer_pair(
    timeline: &mut Timeline,
    context: &mut StepContext,
    slots: [u32; 2],
    time: f64,
) -> Changed {
    // In the order of ids, so that rounding does not depend on the memory.
    let [one, other] = slots;
    let is_ordered =
        timeline.flights.index_of[one as usize] < timeline.flights.index_of[other as usize];
    let slots = select_unpredictable(is_ordered, [one, other], [other, one]);
    let are_free = timeline.flights.only_species().is_some() || {
        let species = slots.map(|slot| timeline.flights.species_of(slot));
        if species.iter().any(|species| species.is_stepped) {
            return zones::meet(timeline, context, slots, time);
        }
        species[0].flies_like(species[1]) && species.iter().all(|species| species.cluster.is_none())
    };
    if !are_free {
        return group::answer(timeline, context, &slots, None, time);
    }
    // The impact is computed as if the two were alone, which saves a second search.
    let impact = PairImpact::at(timeline, context, slots, time);
    let before = slots.map(|slot| timeline.flights.bodies[slot as usize]);
    let after = impact.places.into_iter().zip(impact.velocities);
    for (slot, (place, velocity)) in slots.into_iter().zip(after) {
        timeline.flights.bodies[slot as usize].begin_flight(place, velocity, time);
    }
    if !(is_alone(timeline, context, slots, 0) && is_alone(timeline, context, slots, 1)) {
        slots
            .into_iter()
            .zip(before)
            .for_each(|(slot, body)| timeline.flights.bodies[slot as usize] = body);
        return group::answer(timeline, context, &slots, None, time);
    }
    if let Some(friction) = &impact.friction {
        for (slot, angular_velocity) in slots.into_iter().zip(friction.1) {
            timeline.flights.rotate(slot, [angular_velocity, DVec3::ZERO], time);
        }
    }
    if impact.impulse.is_some() {
        slots.iter().for_each(|&slot| timeline.flights.bodies[slot as usize].strike());
    }
    impact.record(timeline, context, slots);
    slots.iter().for_each(|&slot| timeline.note_flight(slot));
    // In another place distances round differently.
    let are_searched = slots.map(|slot| !timeline.wrap(slot));
    Changed::Pair { slots, are_searched }
}

/// Whether one of two spheres, whose flights begin at `time` \[s\], touches nothing but the other. Searches its
/// neighbours.
#[inline(always)]
fn is_alone(timeline: &Timeline, context: &mut StepContext, slots: [u32; 2], one: usize) -> bool {
    let (slot, other) = (slots[one], slots[1 - one]);
    let radius = timeline.flights.species_of(slot).radius;
    let Body { position, time, .. } = timeline.flights.bodies[slot as usize];
    let near_test = NearTest { exempt: other, margin: NEARBY };
    let search = &mut context.searches[one];
    let mut is_near = search.search(timeline, slot, time, near_test);
    // The two fly alike; with one species, all do.
    if timeline.flights.species.len() > 1 {
        is_near |= search.is_near_others(timeline, slot, near_test);
    }
    // Surfaces are read only where there are some.
    !is_near
        && (context.system.surfaces.is_empty()
            || context.touches_no_surface(timeline, slot, position, radius * NEARBY, time))
}

/// The impact of two spheres that touch nothing else; all impact laws give the same answer.
pub(super) struct PairImpact {
    time: f64,
    pub(super) places: [DVec3; 2],
    velocities_before: [DVec3; 2],
    pub(super) velocities: [DVec3; 2],
    normal: DVec3,
    approach_speed: f64,
    restitution: f64,
    /// \[N s\]; `None` if a grazing contact turns out, by rounding, not to close.
    pub(super) impulse: Option<f64>,
    /// What friction did, and angular velocities after it \[rad/s\].
    friction: Option<Box<(FrictionImpulses, [DVec3; 2])>>,
}

impl PairImpact {
    #[inline(always)]
    fn at(timeline: &Timeline, context: &StepContext, slots: [u32; 2], time: f64) -> Self {
        let states @ [(x1, _), (x2, _)] = slots.map(|slot| timeline.flights.state_of(slot, time));
        let offset = periodic::wrapped(x2 - x1, context.period);
        Self::of((timeline, context), slots, (states, offset), time)
    }

    /// The impact of spheres with these places \[m\] and velocities \[m/s\], from whose first centre an offset leads
    /// to the second one \[m\].
    #[inline(always)]
    pub(super) fn of(
        (timeline, context): (&Timeline, &StepContext),
        slots: [u32; 2],
        ([(x1, v1), (x2, v2)], offset): ([(DVec3, DVec3); 2], DVec3),
        time: f64,
    ) -> Self {
        let species = slots.map(|slot| timeline.flights.species_of(slot));
        let normal = offset / offset.norm();
        let approach_speed = (v1 - v2).dot(normal);
        let restitution = if context.system.has_other_restitutions() {
            let bodies = Bodies::pair(slots.map(|slot| timeline.flights.index_of[slot as usize]));
            respond::restitution_of(bodies, context.system).coefficient(approach_speed)
        } else {
            let [e1, e2] = species.map(|species| species.restitution);
            Coefficient::constant(context.combine_rule().combine(e1, e2))
        };
        let restitution = context.restitution_at(timeline, slots, v2 - v1, restitution, time).value;
        let masses = species.map(|species| species.mass);
        let answer = respond::line_of_centres([v1, v2], masses, normal, restitution);
        let mut impact = Self {
            time,
            places: [x1, x2],
            velocities_before: [v1, v2],
            velocities: answer.map_or([v1, v2], |answer| answer.0),
            normal,
            approach_speed,
            restitution,
            impulse: answer.map(|answer| answer.1),
            friction: None,
        };
        if timeline.has_friction() {
            impact.apply_friction(timeline, context, slots);
        }
        impact
    }

    /// Applies friction to two spheres that got an impulse along the normal.
    #[inline(never)]
    fn apply_friction(&mut self, timeline: &Timeline, context: &StepContext, slots: [u32; 2]) {
        let Some(impulse) = self.impulse else { return };
        let mut members = slots.map(|slot| Member::at(&timeline.flights, slot, self.time));
        for (member, velocity) in members.iter_mut().zip(self.velocities) {
            member.velocity = velocity;
        }
        let bodies = Bodies::pair(members.map(|member| member.index));
        let friction = friction::of_pair(context, &mut members, bodies, (self.normal, impulse));
        self.velocities = members.map(|member| member.velocity);
        self.friction = Some(Box::new((friction, members.map(|member| member.angular_velocity))));
    }

    pub(super) fn record(&self, timeline: &Timeline, context: &mut StepContext, slots: [u32; 2]) {
        let Some(impulse) = self.impulse else { return };
        let species = slots.map(|slot| timeline.flights.species_of(slot));
        let [first, second] = slots.map(|slot| context.id_of(timeline, slot));
        let friction = self.friction.as_ref().map(|friction| &friction.0);
        let [radius, _] = timeline.flights.contact_radii(species);
        let point = self.places[0] + radius * self.normal;
        let impact = Impact {
            time: context.since_start(self.time),
            between: BodyPair::Spheres(first, second),
            point: periodic::wrapped(point, context.period),
            normal: self.normal,
            approach_speed: self.approach_speed,
            separation_speed: (self.velocities[1] - self.velocities[0]).dot(self.normal),
            impulse,
            tangential_impulse: friction.map_or(DVec3::ZERO, FrictionImpulses::total),
            kick: 0.0,
        };
        let account = account_of_pair(
            self.velocities_before,
            self.velocities,
            species.map(|species| species.mass),
            self.approach_speed,
            self.restitution,
        );
        context.record([impact], friction.map_or(account, |friction| friction.add_to(account)));
    }
}
