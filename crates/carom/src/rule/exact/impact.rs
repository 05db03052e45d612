//! Impacts of two spheres that touch nothing else.

use glam::DVec3;

use super::body::Body;
use super::predict;
use super::stage::Stage;
use super::timeline::{Surroundings, Timeline};
use super::{cells, group};
use crate::report::{Impact, ImpactGroup, Participants};
use crate::respond;

/// Whatever is nearer to a sphere than this part of the distance of centres may take part in the
/// impact, and is looked at closely. Generous: it only decides which way is taken to one result.
const NEARBY: f64 = 1e-6;

/// Answers the impact of two spheres at `time` \[s\], and of whatever touches them there.
pub(super) fn of_spheres(timeline: &mut Timeline, stage: &mut Stage, slots: [u32; 2], time: f64) {
    // In the order of ids, as everywhere.
    let mut slots = slots;
    slots.sort_unstable_by_key(|&slot| timeline.index_of[slot as usize]);
    let kinds = slots.map(|slot| *timeline.kind_of(slot));
    let states = slots.map(|slot| timeline.state_of(slot, time));
    let alike = kinds[0].flies_like(&kinds[1]) && kinds.iter().all(|kind| kind.cluster.is_none());
    let mut around = std::mem::take(&mut timeline.around);
    let is_alone = alike
        && (0..2).all(|one| {
            let (slot, place) = (slots[one], states[one].0);
            timeline.cells.near(slot, kinds[one].level, &mut around[one].near);
            let begun = Body { position: place, time, ..timeline.bodies[slot as usize] };
            let acceleration = kinds[one].acceleration;
            predict::measure(timeline, &begun, acceleration, &mut around[one], |_| time);
            is_alone(timeline, [slot, slots[1 - one]], &around[one], place, time)
                && stage.touches_no_surface(timeline, slot, place, kinds[one].radius * NEARBY, time)
        });
    if is_alone {
        answer(timeline, stage, slots, states, time);
        for one in 0..2 {
            let slot = slots[one];
            if timeline.bodies[slot as usize].position == states[one].0 {
                predict::predict_from(timeline, stage.system, slot, &mut around[one], time);
            } else {
                // Its position was folded into the box: distances round differently now.
                predict::predict(timeline, stage.system, slot, time);
            }
        }
    } else {
        group::answer(timeline, stage, &slots, None, time);
    }
    timeline.around = around;
}

/// Whether a sphere touches nothing but one other at `time` \[s\].
#[inline]
fn is_alone(
    timeline: &Timeline,
    [slot, other]: [u32; 2],
    around: &Surroundings,
    place: DVec3,
    time: f64,
) -> bool {
    let kind = timeline.kind_of(slot);
    let is_apart = |near: u32, offset: DVec3, shift: DVec3| {
        let near_kind = timeline.kind_of(near);
        // The distances of spheres that fly differently were not measured.
        let offset = if near_kind.flies_like(kind) {
            offset
        } else {
            timeline.state_of(near, time).0 + shift - place
        };
        let reach = (kind.radius + near_kind.radius) * (1.0 + NEARBY);
        offset.length_squared() > reach * reach || near == other
    };
    let Surroundings { near, offsets, .. } = around;
    let (same_box, of_images) = offsets.split_at(near.in_same_box().len());
    let mut in_same_box = near.in_same_box().iter().zip(same_box);
    let mut images = near.images().iter().zip(of_images);
    in_same_box.all(|(&near, &offset)| is_apart(near, offset, DVec3::ZERO))
        && images.all(|(&(near, shift), &offset)| is_apart(near, offset, shift))
}

/// Gives the two spheres their impulse, and writes it down.
fn answer(
    timeline: &mut Timeline,
    stage: &mut Stage,
    slots: [u32; 2],
    states: [(DVec3, DVec3); 2],
    time: f64,
) {
    let kinds = slots.map(|slot| *timeline.kind_of(slot));
    let [(x1, v1), (x2, v2)] = states;
    let offset = cells::folded(x2 - x1, stage.period);
    let normal = offset / offset.length();
    let approach_speed = (v1 - v2).dot(normal);
    let bodies = slots.map(|slot| timeline.bodies[slot as usize]);
    let restitution = stage.restitution_rule().combine(kinds[0].restitution, kinds[1].restitution);
    let restitution = stage.restitution_at([&bodies[0], &bodies[1]], restitution, time);
    let masses = kinds.map(|kind| kind.mass);
    // A grazing contact may turn out, by rounding, not to close: then nothing happens.
    if let Some((after, impulse)) = respond::line_of_centres([v1, v2], masses, normal, restitution)
    {
        let separation_speed = (after[1] - after[0]).dot(normal);
        let [first, second] = slots.map(|slot| stage.id_of(timeline, slot));
        let between = Participants::Spheres(first, second);
        let point = cells::folded(x1 + kinds[0].radius * normal, stage.period);
        let impact = Impact {
            time: stage.since_start(time),
            between,
            point,
            normal,
            approach_speed,
            separation_speed,
            impulse,
        };
        let account = account_of([v1, v2], after, masses, approach_speed, restitution);
        stage.record(&[impact], account);
        timeline.begin_flight(slots[0], x1, after[0], time);
        timeline.begin_flight(slots[1], x2, after[1], time);
    } else {
        timeline.begin_flight(slots[0], x1, v1, time);
        timeline.begin_flight(slots[1], x2, v2, time);
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
        momentum_scale: m1 * before[0].length() + m2 * before[1].length(),
        energy_before: energy(before),
        energy_after: energy(after),
        energy_demanded: -0.5 * reduced_mass * lost * approach_speed * approach_speed,
        ..ImpactGroup::default()
    }
}
