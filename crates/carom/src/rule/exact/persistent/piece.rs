//! A piece of path along a curve: a parabola through the middle of a turn of the normals.

use glam::DVec3;

use super::accelerations::{Accelerations, IDLE, accelerations_under, forces, is_idle};
use super::correction::corrections;
use crate::flight::Propagator;
use crate::norm::Norm;
use crate::rule::exact::contacts::contact_scale::{ContactScale, MOST_MISSED, TOUCHING};
use crate::rule::exact::contacts::{Group, Member, Touch};
use crate::rule::exact::context::StepContext;
use crate::rule::exact::features::NormalCurvature;
use crate::sum::Sum;

/// How far the normal of a persistent contact turns before its force is computed again \[rad\]. The path between is
/// a parabola through the middle of the turn; its gap to the true one is of the third order, below 1e-10 of the
/// radius of the curve.
pub(super) const TURN: f64 = 1e-3;
/// The turn of a piece where a surface of revolution turns the normal \[rad\]: there a sphere may stay for long,
/// and the errors of many pieces add up.
const TURN_ON_BAND: f64 = 0.2 * TURN;
/// The turn of a piece where a surface turns steadily \[rad\]; shorter where the gap of the middle demands it.
const TURN_OF_SPIN: f64 = 5e-3;
/// The turn of a piece as a part of the phase of a driven surface \[rad\]; shorter where the gap of the middle
/// demands it.
const TURN_OF_DRIVE: f64 = 0.03;
/// Part of a radius by which a piece of path may close the gap of a persistent contact: more than what
/// rounding opens.
const MOST_CLOSED: f64 = 1e-10;
/// A force computed from the gap at the end of a turn differs from that of the middle by at most this part of the
/// accelerations at work.
const MOST_CORRECTED: f64 = 1e-2;
/// Part of the kinetic energy at the end of a piece of path that may be its error.
const MOST_GAINED: f64 = 0.1;
/// Length of the next piece to try, as a part of the longest that keeps its contacts.
const SAFETY: f64 = 0.9;
/// Least length of the next piece to try, as a part of the last one.
const LEAST_PART: f64 = 0.0625;
/// Part of the force at the beginning of a piece of path by which a contact may pull at its end.
const MOST_PULLED: f64 = 0.05;
/// Below this turn \[rad\] a force that ends within a piece of the path ends at its beginning.
const SHORTEST_TURN: f64 = 1e-6;

/// Time \[s\] in which the normal of some contact turns by [`TURN`]; infinite where none does. The rotation of
/// surfaces is known for the rest of the frame \[s\].
pub(super) fn turning_time(
    members: &[Member],
    touches: &[Touch],
    accelerations: &Accelerations,
    frame_left: f64,
) -> f64 {
    let mut time = f64::INFINITY;
    for touch in touches {
        let spin = touch.form_spin().norm();
        if touch.drive_rate > 0.0 {
            time = time.min(TURN_OF_DRIVE / touch.drive_rate).min(touch.drive_smooth_for);
        } else if spin > 0.0 {
            time = time.min(TURN_OF_SPIN / spin).min(frame_left);
        }
        let acceleration = |place: usize| {
            accelerations.each[place] - members[place].species.drag_rate * members[place].velocity
        };
        let relative = acceleration(touch.second) - touch.first.map_or(DVec3::ZERO, acceleration);
        let velocity = touch.across(touch.relative_velocity(members));
        let (Some((velocity, distance)), Some((acceleration, _))) =
            (touch.curvature.turning(velocity), touch.curvature.turning(touch.across(relative)))
        else {
            continue;
        };
        let scale = IDLE * (accelerations.largest + relative.norm());
        let is_band = matches!(touch.curvature, NormalCurvature::Principal { .. });
        let turn = if is_band { TURN_ON_BAND } else { TURN };
        if velocity.norm() > 0.0 {
            time = time.min(turn * distance / velocity.norm());
        }
        if velocity.norm() > 0.0 || acceleration.norm() > scale {
            let radii = touch.places().map(|place| members[place].species.radius);
            let length = 0.25 * radii.fold(distance, f64::min);
            let acceleration = acceleration.norm().max(scale);
            time = time.min((2.0 * turn * length / acceleration).sqrt());
        }
    }
    time
}

/// The contact forces with which a turn begins.
#[derive(Clone, Copy)]
pub(super) struct TurnStart<'a> {
    pub accelerations: &'a Accelerations,
    /// One per contact \[N\].
    pub forces: &'a [f64],
}

/// Accelerations in the middle of a turn that takes `turning` \[s\], and how long they are valid \[s\];
/// or the contacts that part before.
pub(super) fn through_the_middle(
    context: &StepContext,
    group: &Group,
    touches: &[Touch],
    start: TurnStart,
    turning: f64,
) -> Result<(Accelerations, f64), Vec<bool>> {
    let mut valid_for = turning;
    loop {
        let middle: Vec<Member> = group
            .members
            .iter()
            .zip(&start.accelerations.each)
            .map(|(member, &acceleration)| member.after(acceleration, 0.5 * valid_for))
            .collect();
        let time = group.time + 0.5 * valid_for;
        let measured: Vec<Option<Touch>> =
            touches.iter().map(|touch| touch.measured_at(context, &middle, time)).collect();
        let still: Vec<Touch> = measured.iter().flatten().copied().collect();
        let forces = forces(context.work, &middle, &still);
        let accelerations = accelerations_under(&middle, &still, &forces);
        // A redundant contact may have no force and still not open.
        let opens = |touch: &Touch| !is_idle(&accelerations, touch, &middle);
        let mut in_middle = forces.iter();
        let released: Vec<bool> = measured
            .iter()
            .zip(start.forces)
            .map(|(measured, &before)| match measured {
                Some(touch) => in_middle.next() == Some(&0.0) && before > 0.0 && opens(touch),
                None => true,
            })
            .collect();
        let is_shortest = 0.5 * valid_for < turning * (SHORTEST_TURN / TURN);
        let mut part = 0.5;
        let lift_off = part_before_lift_off(&still, start.forces, &forces);
        if released.contains(&true) {
            if is_shortest {
                return Err(released);
            }
        } else if lift_off < 1.0 && !is_shortest {
            part = lift_off;
        } else {
            let end = ending_in_contact(context, group, touches, accelerations, valid_for);
            if end.keeps_energy && end.missed <= 1.0 {
                return Ok((end.accelerations, valid_for));
            }
            part = end.part_that_follows();
            if is_shortest {
                let is_jammed = !end.keeps_energy && is_at_rest(&group.members, touches);
                return Ok(if is_jammed {
                    (stopped(end.accelerations, touches), f64::INFINITY)
                } else {
                    (end.accelerations, valid_for)
                });
            }
        }
        valid_for *= part;
    }
}

/// Part of a piece of path after which the force of some moving surface reaches zero, taken as linear in time; 1 where
/// none does. No contact may have parted in the middle.
fn part_before_lift_off(touches: &[Touch], before: &[f64], in_middle: &[f64]) -> f64 {
    let parts = touches.iter().zip(before.iter().zip(in_middle)).map(|(touch, (&before, &now))| {
        let moves = touch.drive_rate > 0.0 || touch.form_spin() != DVec3::ZERO;
        let ends = 2.0 * now < (1.0 - MOST_PULLED) * before;
        if moves && before > 0.0 && ends { 0.5 * before / (before - now) } else { 1.0 }
    });
    parts.fold(1.0, f64::min)
}

/// A piece of path that ends in contact.
struct Ending {
    accelerations: Accelerations,
    /// How far the forces of the middle alone miss a contact, as a part of what they may; the piece is too long
    /// above 1.
    missed: f64,
    /// Whether the piece gains no energy.
    keeps_energy: bool,
}

impl Ending {
    /// The part of the piece to try next: what a piece misses is of the third order in its length.
    fn part_that_follows(&self) -> f64 {
        if self.missed > 1.0 { (SAFETY / libm::cbrt(self.missed)).max(LEAST_PART) } else { 0.5 }
    }
}

/// Whether no sphere in contact moves.
fn is_at_rest(members: &[Member], touches: &[Touch]) -> bool {
    touches.iter().flat_map(Touch::places).all(|place| members[place].velocity == DVec3::ZERO)
}

/// The accelerations, or none for spheres at rest in contact: a motion that would gain energy from rest is the
/// rounding of a jammed cluster.
fn stopped(mut accelerations: Accelerations, touches: &[Touch]) -> Accelerations {
    for place in touches.iter().flat_map(Touch::places) {
        accelerations.each[place] = DVec3::ZERO;
    }
    accelerations
}

/// Accelerations under which the gaps of contacts after `valid_for` \[s\] equal the present ones, or are a little
/// smaller where they are open. They are constraint forces computed from positions, as in SHAKE (Ryckaert, Ciccotti
/// and Berendsen, J. Comput. Phys. 23, 327 (1977)).
fn ending_in_contact(
    context: &StepContext,
    group: &Group,
    touches: &[Touch],
    mut accelerations: Accelerations,
    valid_for: f64,
) -> Ending {
    let members = group.members.iter().zip(&accelerations.each);
    let end: Vec<Member> =
        members.map(|(member, &acceleration)| member.after(acceleration, valid_for)).collect();
    let mut missed = 0.0f64;
    let mut at_end = |touch: &Touch| {
        let after = touch.measured_at(context, &end, group.time + valid_for)?;
        let ContactScale { radius, length, .. } = group.scale(touch);
        let closed = (0.5 * touch.gap).clamp(0.0, MOST_CLOSED * radius);
        let excess = after.gap - (touch.gap - closed);
        missed = missed.max(excess.abs() / (MOST_MISSED * radius));
        Some((after, if excess.abs() > TOUCHING * length { excess } else { 0.0 }))
    };
    let (touches, excess): (Vec<Touch>, Vec<f64>) = touches.iter().filter_map(&mut at_end).unzip();
    let moves = corrections(context.work, &end, &touches, &excess);
    let needed = |(way, member): (DVec3, &Member)| {
        way / Propagator::over(valid_for, member.species.drag_rate).fall
    };
    let changes: Vec<DVec3> = moves.into_iter().zip(&end).map(needed).collect();
    // The correction is of the order of the turn; where contacts hardly differ, rounding may make it any size.
    let is_small = |(member, change): (&Member, &DVec3)| {
        change.norm()
            <= MOST_CORRECTED * (member.species.acceleration.norm() + accelerations.largest)
    };
    let keeps = |each: &[DVec3]| keeps_energy(group, &touches, each, valid_for);
    if end.iter().zip(&changes).all(is_small) {
        let pairs = accelerations.each.iter().zip(changes);
        let corrected: Vec<DVec3> = pairs.map(|(middle, change)| middle + change).collect();
        // Between contacts that all but lock each other, a gap of rounding leads to large moves.
        if keeps(&corrected) {
            accelerations.each = corrected;
            return Ending { accelerations, missed, keeps_energy: true };
        }
    }
    let keeps_energy = keeps(&accelerations.each);
    Ending { accelerations, missed, keeps_energy }
}

/// Whether spheres that fly so for `valid_for` \[s\] rise no higher than their kinetic energy allows, and the
/// energy error of the path is small enough to be corrected. Contact forces at surfaces at rest do no work; with
/// moving surfaces or drag every path passes.
fn keeps_energy(group: &Group, touches: &[Touch], accelerations: &[DVec3], valid_for: f64) -> bool {
    let has_drag = group.members.iter().any(|member| member.species.drag_rate > 0.0);
    if has_drag || touches.iter().any(Touch::does_work) {
        return true;
    }
    let [mut before, mut after, mut lifted, mut moved] = [Sum::default(); 4];
    for (member, &acceleration) in group.members.iter().zip(accelerations) {
        let Member { position, velocity, species, .. } = member;
        let end = member.after(acceleration, valid_for);
        let work = species.mass * species.acceleration.dot(end.position - *position);
        before.add(0.5 * species.mass * velocity.length_squared());
        after.add(0.5 * species.mass * end.velocity.length_squared());
        lifted.add(-work);
        moved.add(work.abs());
    }
    let [before, after, lifted, moved] = [before, after, lifted, moved].map(|sum| sum.value());
    let gained = (after - before) + lifted;
    lifted <= before + IDLE * moved && gained.abs() <= MOST_GAINED * after + IDLE * moved
}
