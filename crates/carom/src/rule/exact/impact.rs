//! Impacts of two spheres that touch nothing else.

use glam::DVec3;

use super::cells::Near;
use super::predict;
use super::stage::Stage;
use super::timeline::Timeline;
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
    let mut near = std::mem::take(&mut timeline.near);
    let is_alone = alike
        && (0..2).all(|one| {
            let others = &mut near[one];
            timeline.cells.near(slots[one], kinds[one].level, others);
            is_alone(timeline, stage, (slots[one], slots[1 - one]), others, time)
        });
    timeline.near = near;
    if !is_alone {
        group::answer(timeline, stage, &slots, None, time);
        return;
    }
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
            time: time - stage.start,
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
    for slot in slots {
        predict::predict(timeline, stage.system, slot, time);
    }
}

/// Whether a sphere touches nothing but one other at `time` \[s\].
#[inline]
fn is_alone(
    timeline: &Timeline,
    stage: &Stage,
    (slot, other): (u32, u32),
    near: &[Near],
    time: f64,
) -> bool {
    let kind = timeline.kind_of(slot);
    let place = timeline.state_of(slot, time).0;
    near.iter().all(|near| {
        let body = &timeline.bodies[near.slot as usize];
        let near_kind = &timeline.kinds[body.kind as usize];
        let offset = body.state_at(near_kind, time).0 + near.shift - place;
        let reach = (kind.radius + near_kind.radius) * (1.0 + NEARBY);
        offset.length_squared() > reach * reach || near.slot == other
    }) && stage.touches_no_surface(timeline, slot, place, kind.radius * NEARBY, time)
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
