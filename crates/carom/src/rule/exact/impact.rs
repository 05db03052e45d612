//! Impacts of two spheres that touch nothing else.

use std::hint::select_unpredictable;

use glam::DVec3;

use super::body::Body;
use super::predict;
use super::stage::Stage;
use super::timeline::Timeline;
use super::{group, periodic};
use crate::norm::Norm;
use crate::report::{Impact, ImpactGroup, Participants};
use crate::respond;

/// Whatever is nearer to a sphere than this part of the distance of centres may take part in the
/// impact, and is looked at closely. Generous: it only decides which way is taken to one result.
pub(super) const NEARBY: f64 = 1e-6;

/// Answers the impact of two spheres at `time` \[s\], and of whatever touches them there.
pub(super) fn of_spheres(timeline: &mut Timeline, stage: &mut Stage, slots: [u32; 2], time: f64) {
    // In the order of ids, as everywhere.
    let [one, other] = slots;
    let is_ordered = timeline.index_of[one as usize] < timeline.index_of[other as usize];
    let slots = select_unpredictable(is_ordered, [one, other], [other, one]);
    let are_free = timeline.only_kind().is_some() || {
        let kinds = slots.map(|slot| timeline.kind_of(slot));
        kinds[0].flies_like(kinds[1]) && kinds.iter().all(|kind| kind.cluster.is_none())
    };
    if !are_free {
        return group::answer(timeline, stage, &slots, None, time);
    }
    // As if they were alone: then they need not look around once more.
    let impact = PairImpact::at(timeline, stage, slots, time);
    let before = slots.map(|slot| timeline.bodies[slot as usize]);
    let after = impact.places.into_iter().zip(impact.velocities);
    for (slot, (place, velocity)) in slots.into_iter().zip(after) {
        timeline.bodies[slot as usize].begin_flight(place, velocity, time);
    }
    if !(is_alone(timeline, stage, slots, 0) && is_alone(timeline, stage, slots, 1)) {
        slots
            .into_iter()
            .zip(before)
            .for_each(|(slot, body)| timeline.bodies[slot as usize] = body);
        return group::answer(timeline, stage, &slots, None, time);
    }
    if impact.impulse.is_some() {
        slots.iter().for_each(|&slot| timeline.bodies[slot as usize].strike());
    }
    impact.record(timeline, stage, slots);
    let is_folded = slots.map(|slot| timeline.fold(slot));
    for (one, slot) in slots.into_iter().enumerate() {
        if is_folded[one] {
            // In another place distances round differently.
            predict::predict(timeline, stage, slot, time);
        } else {
            let around = &stage.around[one];
            let outlook = predict::outlook_from_here(timeline, stage.system, slot, around, time);
            timeline.schedule(slot, outlook);
        }
    }
}

/// Whether one of two spheres, whose flights begin at `time` \[s\], touches nothing but the other.
/// It looks around.
#[inline(always)]
fn is_alone(timeline: &Timeline, stage: &mut Stage, slots: [u32; 2], one: usize) -> bool {
    let (slot, other) = (slots[one], slots[1 - one]);
    let radius = timeline.kind_of(slot).radius;
    let Body { position, time, .. } = timeline.bodies[slot as usize];
    let around = &mut stage.around[one];
    let mut touches = around.look(timeline, slot, time, (other, NEARBY));
    // The two fly alike: where all are of one kind, all do.
    if timeline.kinds.len() > 1 {
        touches |= around.touches_others(timeline, slot, (other, NEARBY));
    }
    // Surfaces are not called for where there are none.
    !touches
        && (stage.system.surfaces.is_empty()
            || stage.touches_no_surface(timeline, slot, position, radius * NEARBY, time))
}

/// The impact of two spheres by itself, which all laws answer alike.
struct PairImpact {
    time: f64,
    places: [DVec3; 2],
    velocities_before: [DVec3; 2],
    velocities: [DVec3; 2],
    normal: DVec3,
    approach_speed: f64,
    restitution: f64,
    /// \[N s\]; `None` if a grazing contact turns out, by rounding, not to close.
    impulse: Option<f64>,
}

impl PairImpact {
    #[inline(always)]
    fn at(timeline: &Timeline, stage: &Stage, slots: [u32; 2], time: f64) -> Self {
        let kinds = slots.map(|slot| timeline.kind_of(slot));
        let [(x1, v1), (x2, v2)] = slots.map(|slot| timeline.state_of(slot, time));
        let offset = periodic::folded(x2 - x1, stage.period);
        let normal = offset / offset.norm();
        let [e1, e2] = kinds.map(|kind| kind.restitution);
        let restitution = stage.restitution_rule().combine(e1, e2);
        let restitution = stage.restitution_at(timeline, slots, restitution, time);
        let masses = kinds.map(|kind| kind.mass);
        let answer = respond::line_of_centres([v1, v2], masses, normal, restitution);
        Self {
            time,
            places: [x1, x2],
            velocities_before: [v1, v2],
            velocities: answer.map_or([v1, v2], |answer| answer.0),
            normal,
            approach_speed: (v1 - v2).dot(normal),
            restitution,
            impulse: answer.map(|answer| answer.1),
        }
    }

    fn record(&self, timeline: &Timeline, stage: &mut Stage, slots: [u32; 2]) {
        let Some(impulse) = self.impulse else { return };
        let kinds = slots.map(|slot| timeline.kind_of(slot));
        let [first, second] = slots.map(|slot| stage.id_of(timeline, slot));
        let point = self.places[0] + kinds[0].radius * self.normal;
        let impact = Impact {
            time: stage.since_start(self.time),
            between: Participants::Spheres(first, second),
            point: periodic::folded(point, stage.period),
            normal: self.normal,
            approach_speed: self.approach_speed,
            separation_speed: (self.velocities[1] - self.velocities[0]).dot(self.normal),
            impulse,
        };
        let account = account_of(
            self.velocities_before,
            self.velocities,
            kinds.map(|kind| kind.mass),
            self.approach_speed,
            self.restitution,
        );
        stage.record([impact], account);
    }
}

/// What an impact of two spheres did to momentum and energy.
fn account_of(
    before: [DVec3; 2],
    after: [DVec3; 2],
    masses: [f64; 2],
    approach_speed: f64,
    restitution: f64,
) -> ImpactGroup {
    let [m1, m2] = masses;
    let energy = |[v1, v2]: [DVec3; 2]| 0.5 * (m1 * v1.length_squared() + m2 * v2.length_squared());
    let reduced_mass = m1.min(m2) / (1.0 + m1.min(m2) / m1.max(m2));
    let lost = (1.0 - restitution) * (1.0 + restitution);
    ImpactGroup {
        momentum_before: m1 * before[0] + m2 * before[1],
        momentum_after: m1 * after[0] + m2 * after[1],
        momentum_scale: m1 * before[0].norm() + m2 * before[1].norm(),
        energy_before: energy(before),
        energy_after: energy(after),
        energy_demanded: -0.5 * reduced_mass * lost * approach_speed * approach_speed,
        ..ImpactGroup::default()
    }
}
