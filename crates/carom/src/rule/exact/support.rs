//! Lasting contacts: which ones stay, with which forces, and for how long those hold.

use std::collections::BTreeMap;

use glam::DVec3;

use super::axis_motion::AxisMotion;
use super::contact_duration::{ContactScale, MOST_MISSED};
use super::group::{Group, Member};
use super::stage::Stage;
use super::touch::{TOUCHING, Touch, beyond};
use crate::detect::contact::Bodies;
use crate::flight::Propagator;
use crate::norm::Norm;
use crate::respond::{TouchingContact, contact_forces_within, least_change, restitution_of};
use crate::sum::Sum;
use crate::surface::{Form, Rectangle};
use crate::work::Work;

/// A contact with a normal acceleration below this part of the free accelerations neither presses
/// nor opens, but for rounding.
pub(super) const IDLE: f64 = 1e-12;
/// Spheres in lasting contact whose speed is below this part of the speeds they came with are at
/// rest, but for rounding.
pub(super) const REST: f64 = 1e-12;
/// How far the normal of a lasting contact turns before its force is found anew \[rad\]. The path
/// between is a parabola through the middle of the turn; its gap to the true one is of the third
/// order, below 1e-10 of the radius of the curve.
const TURN: f64 = 1e-3;
/// Part of a radius by which a piece of path may close the gap of a persistent contact: more than what
/// rounding opens.
const MOST_CLOSED: f64 = 1e-10;
/// A force that is found from the gap at the end of a turn differs from that of the middle by no more
/// than this part of the accelerations at work.
const MOST_CORRECTED: f64 = 1e-2;
/// Part of the kinetic energy at the end of a piece of path that may be its error.
const MOST_GAINED: f64 = 0.1;
/// Below this turn \[rad\] a force that ends within a piece of the path ends at its beginning.
const SHORTEST_TURN: f64 = 1e-6;

/// Spheres that lasting contacts bear from now on.
#[derive(Debug, Clone)]
pub(super) struct Support {
    /// Slots of the spheres, in the order of their indices, with the acceleration of each, of
    /// everything but drag \[m/s²\].
    pub members: Vec<(u32, DVec3)>,
    /// Ascending.
    pub contacts: Vec<Bodies>,
    /// When the forces have to be found anew, on the world's clock \[s\].
    pub renewal: f64,
}

/// Finds the contacts of a group that stay closed and what they do; brings their gaps and normal
/// velocities to zero.
pub(super) fn find(stage: &Stage, group: &mut Group) -> Vec<Support> {
    let slow = slow(stage, group);
    let (mut lasting, known_forces) = staying(stage.work, &group.members, &slow);
    let mut known_forces = Some(known_forces);
    while !lasting.is_empty() {
        let has_moved = correct(stage, group, &mut lasting);
        // Contacts that push nothing were left out: the forces of the others are the same, unless drag
        // has changed with the velocities.
        let has_drag = group.members.iter().any(|member| member.kind.drag_rate > 0.0);
        let known_forces = known_forces.take().filter(|_| !(has_moved || has_drag));
        let forces = known_forces.unwrap_or_else(|| forces(stage.work, &group.members, &lasting));
        let accelerations = rest(stage, group, borne(&group.members, &lasting, &forces));
        let frame_left = (stage.start + stage.length - group.time).max(0.0);
        let turning = turning_time(&group.members, &lasting, &accelerations, frame_left);
        let (accelerations, hold) = if turning == f64::INFINITY {
            (accelerations, turning)
        } else {
            match through_the_middle(stage, group, &lasting, (&accelerations, &forces), turning) {
                Ok((middle, hold)) => (rest(stage, group, middle), hold),
                Err(released) => {
                    let mut released = released.into_iter();
                    lasting.retain(|_| !released.next().unwrap_or(false));
                    continue;
                }
            }
        };
        if hold < f64::INFINITY {
            lean(&group.members, &slow, &accelerations, &mut lasting);
        }
        let hold = hold.min(sliding_time(stage, group, &lasting, &accelerations));
        // What holds for less than a contact's duration is in doubt only by rounding.
        let hold = hold.max(stage.parameters.contact_duration);
        return connected(group, &lasting, &accelerations, group.time + hold);
    }
    Vec::new()
}

/// The touches that may stay closed: those whose bodies would be back in contact within a contact's
/// duration.
fn slow(stage: &Stage, group: &Group) -> Vec<Touch> {
    let members = &group.members;
    let is_slow = |touch: &&Touch| {
        let free = touch.first.map_or(DVec3::ZERO, |first| free_acceleration(&members[first]));
        let free = free.norm() + free_acceleration(&members[touch.second]).norm();
        let acceleration = free + bias(touch, members).abs();
        let is_elastic = restitution_of(touch.bodies, stage.system) == 1.0;
        let scale = ContactScale { acceleration, is_elastic, ..group.scale(touch) };
        let duration = stage.duration_of(&scale, group.time);
        is_back_within(duration, touch.normal_velocity(members), acceleration)
    };
    group.touches.iter().filter(is_slow).copied().collect()
}

/// Of slow touches, those that stay closed, for their forces press; with the forces \[N\].
fn staying(work: &Work, members: &[Member], slow: &[Touch]) -> (Vec<Touch>, Vec<f64>) {
    if slow.is_empty() {
        return (Vec::new(), Vec::new());
    }
    let forces = forces(work, members, slow);
    let mut is_borne = vec![false; members.len()];
    for (touch, &force) in slow.iter().zip(&forces) {
        if force > 0.0 {
            touch.places().for_each(|place| is_borne[place] = true);
        }
    }
    let accelerations = borne(members, slow, &forces);
    let stays = |(&touch, force): (&Touch, f64)| {
        let all_borne = is_borne[touch.second] && touch.first.is_none_or(|first| is_borne[first]);
        let persists = force > 0.0 || (all_borne && is_idle(&accelerations, &touch, members));
        persists.then_some((touch, force))
    };
    slow.iter().zip(forces).filter_map(stays).unzip()
}

/// Whether a contact does not open, but for rounding.
fn is_idle(accelerations: &Accelerations, touch: &Touch, members: &[Member]) -> bool {
    accelerations.along(touch, members) <= IDLE * accelerations.scale_at(touch, members)
}

/// Adds slow touches that open now and would close under the accelerations of the middle of a turn:
/// for this piece of the path their bodies lean on each other without a force, and the gap that is
/// missing is of the third order in the turn, like that of the piece.
fn lean(
    members: &[Member],
    slow: &[Touch],
    accelerations: &Accelerations,
    lasting: &mut Vec<Touch>,
) {
    let leans = |touch: &&Touch| {
        let closing = -accelerations.along(touch, members);
        closing > 0.0
            && closing <= TURN * accelerations.scale_at(touch, members)
            && !lasting.iter().any(|known| known.bodies == touch.bodies)
    };
    let leaning: Vec<Touch> = slow.iter().filter(leans).copied().collect();
    lasting.extend(leaning);
    lasting.sort_unstable_by_key(|touch| touch.bodies);
}

/// Whether what parts with a speed \[m/s\] against an acceleration \[m/s²\] is back within a `duration`
/// \[s\]: thrown up with u against a, a body is back after 2 u / a.
pub(super) fn is_back_within(duration: f64, speed: f64, acceleration: f64) -> bool {
    acceleration > 0.0 && speed <= 0.5 * acceleration * duration
}

/// Acceleration of a sphere without contact forces \[m/s²\].
pub(super) fn free_acceleration(member: &Member) -> DVec3 {
    member.kind.acceleration - member.kind.drag_rate * member.velocity
}

/// Acceleration of the gap \[m/s²\] that comes from the turning of the normal: `v²/R` where the
/// bodies slide along a curve, and the swing of a surface that turns.
fn bias(touch: &Touch, members: &[Member]) -> f64 {
    let tangential = touch.across(touch.relative_velocity(members));
    let sliding = touch.bend.turning(tangential);
    let curve = sliding.map_or(0.0, |(turning, distance)| turning.length_squared() / distance);
    let spin = touch.surface_spin;
    if spin == DVec3::ZERO {
        return curve;
    }
    // Of the gap n·(x - p), with n' = w × n.
    curve + 2.0 * spin.cross(touch.normal).dot(tangential) + touch.surface_pull.dot(touch.normal)
}

/// Touches and the masses of the members \[kg\], as the solvers take them.
fn contacts_and_masses(members: &[Member], touches: &[Touch]) -> (Vec<TouchingContact>, Vec<f64>) {
    let contacts = touches.iter().map(Touch::contact).collect();
    (contacts, members.iter().map(|member| member.kind.mass).collect())
}

/// Forces \[N\] of contacts, each >= 0.
fn forces(work: &Work, members: &[Member], touches: &[Touch]) -> Vec<f64> {
    let (contacts, masses) = contacts_and_masses(members, touches);
    let mut accelerations: Vec<DVec3> = members.iter().map(free_acceleration).collect();
    let bias: Vec<f64> = touches.iter().map(|touch| bias(touch, members)).collect();
    contact_forces_within(work, &contacts, &masses, &mut accelerations, &bias).forces
}

/// Accelerations of the members of a group.
struct Accelerations {
    /// Of everything but drag \[m/s²\].
    each: Vec<DVec3>,
    /// The largest part that a contact force has in one \[m/s²\].
    largest: f64,
}

impl Accelerations {
    /// Accelerations at work at a contact \[m/s²\].
    fn scale_at(&self, touch: &Touch, members: &[Member]) -> f64 {
        free_acceleration(&members[touch.second]).norm() + self.largest
    }

    /// Acceleration of a gap \[m/s²\].
    fn along(&self, touch: &Touch, members: &[Member]) -> f64 {
        let total = |place: usize| {
            self.each[place] - members[place].kind.drag_rate * members[place].velocity
        };
        let first = touch.first.map_or(DVec3::ZERO, total);
        (total(touch.second) - first).dot(touch.normal) + bias(touch, members)
    }
}

/// Accelerations under contact forces \[N\].
fn borne(members: &[Member], touches: &[Touch], forces: &[f64]) -> Accelerations {
    let mut each: Vec<DVec3> = members.iter().map(|member| member.kind.acceleration).collect();
    let mut largest = 0.0f64;
    for (touch, &force) in touches.iter().zip(forces) {
        let part = force / members[touch.second].kind.mass;
        each[touch.second] += part * touch.normal;
        largest = largest.max(part);
        if let Some(first) = touch.first {
            let part = force / members[first].kind.mass;
            each[first] -= part * touch.normal;
            largest = largest.max(part);
        }
    }
    Accelerations { each, largest }
}

/// Time \[s\] in which the normal of some contact turns by [`TURN`]; infinite where none does. How
/// a surface turns is known for what is left of the frame \[s\].
fn turning_time(
    members: &[Member],
    touches: &[Touch],
    accelerations: &Accelerations,
    frame_left: f64,
) -> f64 {
    let mut time = f64::INFINITY;
    for touch in touches {
        let spin = touch.surface_spin.norm();
        if spin > 0.0 {
            time = time.min(TURN / spin).min(frame_left);
        }
        let acceleration = |place: usize| {
            accelerations.each[place] - members[place].kind.drag_rate * members[place].velocity
        };
        let relative = acceleration(touch.second) - touch.first.map_or(DVec3::ZERO, acceleration);
        let velocity = touch.across(touch.relative_velocity(members));
        let (Some((velocity, distance)), Some((acceleration, _))) =
            (touch.bend.turning(velocity), touch.bend.turning(touch.across(relative)))
        else {
            continue;
        };
        let scale = IDLE * (accelerations.largest + relative.norm());
        if velocity.norm() > 0.0 {
            time = time.min(TURN * distance / velocity.norm());
        }
        if velocity.norm() > 0.0 || acceleration.norm() > scale {
            let radii = touch.places().map(|place| members[place].kind.radius);
            let length = 0.25 * radii.fold(distance, f64::min);
            let acceleration = acceleration.norm().max(scale);
            time = time.min((2.0 * TURN * length / acceleration).sqrt());
        }
    }
    time
}

/// Accelerations in the middle of a turn that takes `turning` \[s\], and how long they hold \[s\];
/// or the contacts that part before.
fn through_the_middle(
    stage: &Stage,
    group: &Group,
    touches: &[Touch],
    (start, forces_before): (&Accelerations, &[f64]),
    turning: f64,
) -> Result<(Accelerations, f64), Vec<bool>> {
    let mut hold = turning;
    loop {
        let middle: Vec<Member> = group
            .members
            .iter()
            .zip(&start.each)
            .map(|(member, &acceleration)| member.after(acceleration, 0.5 * hold))
            .collect();
        let time = group.time + 0.5 * hold;
        let measured: Vec<Option<Touch>> =
            touches.iter().map(|touch| touch.measured_at(stage, &middle, time)).collect();
        let still: Vec<Touch> = measured.iter().flatten().copied().collect();
        let forces = forces(stage.work, &middle, &still);
        let accelerations = borne(&middle, &still, &forces);
        // Where contacts are redundant one may do without a force, and does not open for that.
        let opens = |touch: &Touch| !is_idle(&accelerations, touch, &middle);
        let mut in_middle = forces.iter();
        let released: Vec<bool> = measured
            .iter()
            .zip(forces_before)
            .map(|(measured, &before)| match measured {
                Some(touch) => in_middle.next() == Some(&0.0) && before > 0.0 && opens(touch),
                None => true,
            })
            .collect();
        let is_shortest = 0.5 * hold < turning * (SHORTEST_TURN / TURN);
        if !released.contains(&true) {
            let end = ending_in_contact(stage, group, touches, accelerations, hold);
            if end.keeps_energy && end.is_followed {
                return Ok((end.accelerations, hold));
            }
            if is_shortest {
                let is_jammed = !end.keeps_energy && is_at_rest(&group.members, touches);
                return Ok(if is_jammed {
                    (stopped(end.accelerations, touches), f64::INFINITY)
                } else {
                    (end.accelerations, hold)
                });
            }
        } else if is_shortest {
            return Err(released);
        }
        hold *= 0.5;
    }
}

/// A piece of path that ends in contact.
struct Ending {
    accelerations: Accelerations,
    /// Whether the forces of the middle alone keep the contacts to a part of a radius, so that the
    /// piece is short enough.
    is_followed: bool,
    /// Whether no energy appears on it.
    keeps_energy: bool,
}

/// Whether no sphere in contact moves.
fn is_at_rest(members: &[Member], touches: &[Touch]) -> bool {
    touches.iter().flat_map(Touch::places).all(|place| members[place].velocity == DVec3::ZERO)
}

/// The accelerations where spheres in contact have none: a motion that from rest would gain energy is
/// the rounding of a cluster that is jammed.
fn stopped(mut accelerations: Accelerations, touches: &[Touch]) -> Accelerations {
    for place in touches.iter().flat_map(Touch::places) {
        accelerations.each[place] = DVec3::ZERO;
    }
    accelerations
}

/// Accelerations under which the gaps of contacts after `hold` \[s\] are what they are now, or a little
/// less where they are open: constraint forces that are found from positions, as in SHAKE (Ryckaert,
/// Ciccotti and Berendsen, J. Comput. Phys. 23, 327 (1977)).
fn ending_in_contact(
    stage: &Stage,
    group: &Group,
    touches: &[Touch],
    mut accelerations: Accelerations,
    hold: f64,
) -> Ending {
    let members = group.members.iter().zip(&accelerations.each);
    let end: Vec<Member> =
        members.map(|(member, &acceleration)| member.after(acceleration, hold)).collect();
    let mut is_followed = true;
    let mut at_end = |touch: &Touch| {
        let after = touch.measured_at(stage, &end, group.time + hold)?;
        let ContactScale { radius, length, .. } = group.scale(touch);
        let closed = (0.5 * touch.gap).clamp(0.0, MOST_CLOSED * radius);
        let excess = after.gap - (touch.gap - closed);
        is_followed &= excess.abs() <= MOST_MISSED * radius;
        Some((after, if excess.abs() > TOUCHING * length { excess } else { 0.0 }))
    };
    let (touches, excess): (Vec<Touch>, Vec<f64>) = touches.iter().filter_map(&mut at_end).unzip();
    let moves = corrections(stage.work, &end, &touches, &excess);
    let needed =
        |(way, member): (DVec3, &Member)| way / Propagator::over(hold, member.kind.drag_rate).fall;
    let changes: Vec<DVec3> = moves.into_iter().zip(&end).map(needed).collect();
    // Of the order of the turn; where contacts hardly differ, rounding may ask for any.
    let is_small = |(member, change): (&Member, &DVec3)| {
        change.norm() <= MOST_CORRECTED * (member.kind.acceleration.norm() + accelerations.largest)
    };
    let keeps = |each: &[DVec3]| keeps_energy(group, &touches, each, hold);
    if end.iter().zip(&changes).all(is_small) {
        let pairs = accelerations.each.iter().zip(changes);
        let corrected: Vec<DVec3> = pairs.map(|(middle, change)| middle + change).collect();
        // Between contacts that all but lock each other, a gap of rounding asks for large moves.
        if keeps(&corrected) {
            accelerations.each = corrected;
            return Ending { accelerations, is_followed, keeps_energy: true };
        }
    }
    let keeps_energy = keeps(&accelerations.each);
    Ending { accelerations, is_followed, keeps_energy }
}

/// Whether spheres that fly so for `hold` \[s\] rise no higher than their kinetic energy lifts them, and
/// gain or lose so little by the error of the path that it can be made up for in that. Contact forces
/// at surfaces at rest do no work; where surfaces move, or with drag, nothing is asked.
fn keeps_energy(group: &Group, touches: &[Touch], accelerations: &[DVec3], hold: f64) -> bool {
    let has_drag = group.members.iter().any(|member| member.kind.drag_rate > 0.0);
    if has_drag || touches.iter().any(Touch::does_work) {
        return true;
    }
    let [mut before, mut after, mut lifted, mut moved] = [Sum::default(); 4];
    for (member, &acceleration) in group.members.iter().zip(accelerations) {
        let Member { position, velocity, kind, .. } = member;
        let end = member.after(acceleration, hold);
        let work = kind.mass * kind.acceleration.dot(end.position - *position);
        before.add(0.5 * kind.mass * velocity.length_squared());
        after.add(0.5 * kind.mass * end.velocity.length_squared());
        lifted.add(-work);
        moved.add(work.abs());
    }
    let [before, after, lifted, moved] = [before, after, lifted, moved].map(|sum| sum.value());
    let gained = (after - before) + lifted;
    lifted <= before + IDLE * moved && gained.abs() <= MOST_GAINED * after + IDLE * moved
}

/// Stops what moves and accelerates by no more than rounding.
fn rest(stage: &Stage, group: &mut Group, mut accelerations: Accelerations) -> Accelerations {
    let (fastest, time) = (group.fastest, group.time);
    for (member, acceleration) in group.members.iter_mut().zip(&mut accelerations.each) {
        let Member { position, velocity, kind, .. } = member;
        let scale = kind.acceleration.norm() + accelerations.largest;
        let contact = ContactScale::default().with(*position, *velocity, kind);
        let gained = scale * stage.duration_of(&contact, time);
        if acceleration.norm() <= IDLE * scale && velocity.norm() <= REST * (fastest + gained) {
            (*velocity, *acceleration) = (DVec3::ZERO, DVec3::ZERO);
        }
    }
    accelerations
}

/// Time \[s\] until a sphere may slide off the part of a rectangle that it is in contact with.
fn sliding_time(
    stage: &Stage,
    group: &Group,
    touches: &[Touch],
    accelerations: &Accelerations,
) -> f64 {
    let mut time = f64::INFINITY;
    for touch in touches {
        let Bodies::Surface { surface, .. } = touch.bodies else { continue };
        let (form, _) = stage.surface_at(surface, group.time);
        let Form::Rectangle(rectangle) = form else { continue };
        let member = &group.members[touch.second];
        let center = member.position + touch.shift;
        let velocity = member.velocity - touch.surface_velocity;
        let motion = |axis: DVec3| AxisMotion {
            velocity: velocity.dot(axis),
            acceleration: accelerations.each[touch.second].dot(axis),
            drag_rate: member.kind.drag_rate,
        };
        time = time.min(time_on_face(&rectangle, center, motion));
    }
    time
}

/// Time \[s\] until a sphere about `center` \[m\] may slide off the part of a rectangle that it is in
/// contact with, by its motion along the axes of the rectangle.
pub(super) fn time_on_face(
    rectangle: &Rectangle,
    center: DVec3,
    motion: impl Fn(DVec3) -> AxisMotion,
) -> f64 {
    let mut time = f64::INFINITY;
    let distances = beyond(rectangle, center);
    for (axis, beyond) in [rectangle.axis_x, rectangle.axis_z].into_iter().zip(distances) {
        if beyond >= 0.0 {
            continue;
        }
        let place = (center - rectangle.center).dot(axis);
        let half_length = place.abs() - beyond;
        time = time.min(motion(axis).leaves(-half_length - place, half_length - place));
    }
    time
}

/// The spheres and contacts that hang together, each set by itself.
fn connected(
    group: &Group,
    touches: &[Touch],
    accelerations: &Accelerations,
    renewal: f64,
) -> Vec<Support> {
    let mut root: Vec<usize> = (0..group.members.len()).collect();
    let mut is_borne = vec![false; root.len()];
    for touch in touches {
        is_borne[touch.second] = true;
        if let Some(first) = touch.first {
            is_borne[first] = true;
            let (a, b) = (root_of(&root, first), root_of(&root, touch.second));
            root[a.max(b)] = a.min(b);
        }
    }
    let mut supports: BTreeMap<usize, Support> = BTreeMap::new();
    let of = |supports: &mut BTreeMap<usize, Support>, place: usize| {
        let empty = || Support { members: Vec::new(), contacts: Vec::new(), renewal };
        let root = root_of(&root, place);
        supports.entry(root).or_insert_with(empty);
        root
    };
    for (place, member) in group.members.iter().enumerate().filter(|(place, _)| is_borne[*place]) {
        let root = of(&mut supports, place);
        if let Some(support) = supports.get_mut(&root) {
            support.members.push((member.slot, accelerations.each[place]));
        }
    }
    for touch in touches {
        let root = of(&mut supports, touch.second);
        if let Some(support) = supports.get_mut(&root) {
            support.contacts.push(touch.bodies);
        }
    }
    supports.into_values().collect()
}

/// The smallest place that hangs together with this one.
fn root_of(root: &[usize], mut place: usize) -> usize {
    while root[place] != place {
        place = root[place];
    }
    place
}

/// Moves apart what overlaps in persistent contact, where normals turn, and brings normal velocities
/// to zero; measures the contacts anew. Tells whether something was moved.
pub(super) fn correct(stage: &Stage, group: &mut Group, touches: &mut Vec<Touch>) -> bool {
    let overlaps = |touch: &Touch| touch.gap < -TOUCHING * group.scale(touch).length;
    let moves_apart = touches.iter().any(Touch::bends) && touches.iter().any(overlaps);
    if moves_apart {
        let moves = separations(stage.work, &group.members, touches);
        for (member, by) in group.members.iter_mut().zip(moves) {
            member.position += by;
        }
        let (members, time) = (&group.members, group.time);
        *touches = touches.iter().filter_map(|it| it.measured_at(stage, members, time)).collect();
    }
    stop_along_normals(stage.work, &mut group.members, touches);
    moves_apart
}

/// The least moves of the members, weighted by mass, after which none of the contacts overlaps: the
/// problem of contact forces, with moves for accelerations.
fn separations(work: &Work, members: &[Member], touches: &[Touch]) -> Vec<DVec3> {
    let (contacts, masses) = contacts_and_masses(members, touches);
    let gaps: Vec<f64> = touches.iter().map(|touch| touch.gap).collect();
    let mut moves = vec![DVec3::ZERO; members.len()];
    if contact_forces_within(work, &contacts, &masses, &mut moves, &gaps).complete {
        moves
    } else {
        vec![DVec3::ZERO; members.len()]
    }
}

/// Brings the normal velocities of contacts to zero.
fn stop_along_normals(work: &Work, members: &mut [Member], touches: &[Touch]) {
    let speeds: Vec<f64> = touches.iter().map(|touch| touch.normal_velocity(members)).collect();
    let changes = corrections(work, members, touches, &speeds);
    for (member, by) in members.iter_mut().zip(changes) {
        member.velocity += by;
    }
}

/// The least change of the members, weighted by mass, that takes away `excess` along the normals.
fn corrections(work: &Work, members: &[Member], touches: &[Touch], excess: &[f64]) -> Vec<DVec3> {
    let (contacts, masses) = contacts_and_masses(members, touches);
    least_change(work, &contacts, &masses, excess)
}
