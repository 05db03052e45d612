//! The stages of a sub-step for contacts of spheres with surfaces, at rest or moving.

use glam::DVec3;

use super::batch::Impulses;
use super::coulomb::slip;
use super::materials::ContactMaterial;
use super::swept::{FAR, FREE};
use crate::contact_time;
use crate::detect::{Separation, sphere_facet_plane, sphere_surface};
use crate::flight::Flight;
use crate::friction::ContactFriction;
use crate::respond;
use crate::restitution::ContactRestitution;
use crate::rule::contact::places::flat::{is_flat, turning_plane};
use crate::rule::contact::places::{Place, Places};
use crate::rule::contact::slots::Run;
use crate::rule::contact::sub_step::{GROWTH, SubStep};
use crate::surface::{Form, SurfaceMotion};

/// A centre counts as in front of a plane, or behind it, beyond this part of the radius.
const LEAST_IN_FRONT: f64 = 0.5;

/// A contact of a surface, which is body 1, and a sphere, which is body 2.
#[derive(Debug, Clone, Copy)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct SurfaceContact {
    /// Slot of the sphere, from the start of the run.
    pub slot: u32,
    pub surface: u32,
    /// Unit normal out of the surface.
    pub normal: DVec3,
    /// Centre of the sphere at the start of the sub-step \[m\].
    pub start: DVec3,
    /// Whether the path of the sphere in the sub-step is too short to pass an edge of the surface.
    is_slow: bool,
    /// How far the sphere may go from its place at the last search before it can be in the region of the surface
    /// \[m\]; where it is above a face, minus how far before it can be beside that; 0 where neither is known.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub clearance: f64,
    /// Whether the sphere came from behind an open surface, and is there or still overlaps it: nothing acts.
    pub passes: bool,
    /// Velocity of the surface where they touch \[m/s\].
    pub velocity: DVec3,
    /// Velocity of the material relative to the surface, along it \[m/s\]; zero without friction.
    pub belt: DVec3,
    /// Angular velocity of the surface \[rad/s\].
    pub angular_velocity: DVec3,
    /// Acceleration of the sphere relative to a turning surface, without forces \[m/s²\].
    swing: DVec3,
    /// Minus the least normal velocity after the sub-step \[m/s\].
    pub bias: f64,
    /// Speed of approach of an impact \[m/s\]; 0 if there is none.
    pub approach: f64,
    /// Slip at which friction ends \[m/s\]: the velocity of the belt, unless an impact turns slip round.
    slip: DVec3,
    /// When in the sub-step a bounce happens \[s\].
    pub time: f64,
    /// Restitution of the last impact, if it depends on the speed.
    pub restitution: f64,
    /// Restitution that depends on the speed.
    pub law: Option<ContactRestitution>,
    pub friction: ContactFriction,
    /// Speed that the surface adds in an impact \[m/s\], and the part added in this one.
    pub kick: f64,
    pub kicked: f64,
    pub impulses: Impulses,
}

impl SurfaceContact {
    /// A contact of known bodies, not measured yet.
    pub fn new(slot: u32, surface: u32, material: ContactMaterial) -> Self {
        let ContactMaterial { restitution, friction } = material;
        Self {
            slot,
            surface,
            normal: DVec3::Y,
            start: DVec3::ZERO,
            is_slow: false,
            clearance: 0.0,
            passes: false,
            velocity: DVec3::ZERO,
            belt: DVec3::ZERO,
            angular_velocity: DVec3::ZERO,
            swing: DVec3::ZERO,
            bias: FREE,
            approach: 0.0,
            slip: DVec3::ZERO,
            time: 0.0,
            restitution: restitution.at(0.0),
            law: restitution.by_speed(),
            friction,
            kick: 0.0,
            kicked: 0.0,
            impulses: Impulses::default(),
        }
    }

    /// Restitution, at whatever speed.
    pub fn material_restitution(&self) -> ContactRestitution {
        self.law.unwrap_or(ContactRestitution::Constant(self.restitution))
    }

    /// Impulses that the contact keeps from search to search. An impact leaves none.
    pub fn kept(&self) -> Impulses {
        let normal = if self.bias < 0.0 { 0.0 } else { self.impulses.normal };
        Impulses { normal, ..self.impulses }
    }

    /// Whether the region of the surface, which is at rest, is known to be farther from a centre of the sphere than a
    /// distance \[m\].
    pub fn is_clear(&self, run: &Run, center: DVec3, distance: f64) -> bool {
        let left = self.clearance - distance;
        left > 0.0 && self.is_within(run, center, left)
    }

    /// Whether a centre of the sphere is nearer than a distance to its place at the last search \[m\].
    fn is_within(&self, run: &Run, center: DVec3, distance: f64) -> bool {
        let from = run.reference.get(self.slot as usize);
        from.is_some_and(|it| (center - it.vector()).length_squared() < distance * distance)
    }

    /// [`sphere_surface`] of the surface, which has this form, and the sphere.
    pub fn separation(
        &self,
        run: &Run,
        form: &Form,
        (center, radius): (DVec3, f64),
    ) -> Option<Separation> {
        match form {
            Form::Facet(facet)
                if self.clearance < 0.0 && self.is_within(run, center, -self.clearance) =>
            {
                let is_in_front = facet.height_of(center) >= 0.0;
                is_in_front.then(|| sphere_facet_plane(facet, center, radius))
            }
            _ => sphere_surface(form, center, radius),
        }
    }

    /// Slip at which friction ends \[m/s\].
    pub fn slip(&self) -> DVec3 {
        self.slip
    }

    /// Whether the contact is an impact with a bounce.
    pub fn is_bounce(&self) -> bool {
        self.bias < 0.0 && self.approach > 0.0
    }

    /// The impulse of a bounce \[N s\] on a sphere of this mass \[kg\], without the part with which others press it
    /// to the surface; `None` without a bounce.
    pub fn bounce(&self, mass: f64) -> Option<DVec3> {
        let bounces = self.is_bounce() && self.impulses.normal > 0.0;
        let own = mass * (1.0 + self.restitution) * self.approach + mass * self.kicked;
        bounces.then(|| self.impulse() * (own / self.impulses.normal).min(1.0))
    }

    /// Work of the kick of the surface on a sphere of this mass \[kg\], at the time of the bounce \[J\].
    pub fn kick_work(&self, mass: f64) -> f64 {
        if self.kicked == 0.0 || !self.is_bounce() || self.impulses.normal <= 0.0 {
            return 0.0;
        }
        mass * self.kicked * (self.restitution * self.approach + 0.5 * self.kicked)
    }

    /// Work of the moving surface and of its belt \[J\].
    pub fn work(&self) -> f64 {
        let angular = DVec3::from_array(self.impulses.angular);
        let by_belt = DVec3::from_array(self.impulses.tangential).dot(self.belt);
        self.impulse().dot(self.velocity) + angular.dot(self.angular_velocity) + by_belt
    }

    /// Impulse on the sphere \[N s\].
    pub fn impulse(&self) -> DVec3 {
        self.impulses.normal * self.normal + DVec3::from_array(self.impulses.tangential)
    }
}

/// Prepares the contacts of a run: normals, gaps, target velocities, and the impulses to start from, which it
/// applies.
pub(crate) fn prepare(
    run: &mut Run,
    contacts: &mut [SurfaceContact],
    places: &Places,
    sub_step: &SubStep,
) {
    for own in contacts.chunk_by_mut(|first, second| first.slot == second.slot) {
        for contact in &mut *own {
            contact.aim(run, places, sub_step);
        }
        leave_doubles(own);
        leave_first_bounce(own);
        own.iter_mut().for_each(|contact| contact.warm_start(run, sub_step));
    }
}

/// Angle \[rad\] between the normals of flush faces, at most, rounding included; also the relative difference of the
/// speeds that a sphere may keep towards them.
const FLUSH: f64 = 2e-9;

/// Frees the second of two flush faces where a sphere is above their seam.
fn leave_doubles(own: &mut [SurfaceContact]) {
    for number in 1..own.len() {
        let (before, after) = own.split_at_mut(number);
        let contact = &mut after[0];
        let is_double = |other: &SurfaceContact| {
            let apart = (other.bias - contact.bias).abs();
            other.bias != FREE
                && apart <= FLUSH * (other.bias.abs() + contact.bias.abs())
                && (other.normal - contact.normal).length_squared() <= FLUSH * FLUSH
                && other.velocity == contact.velocity
        };
        if contact.bias != FREE && before.iter().any(is_double) {
            (contact.bias, contact.approach, contact.kicked) = (FREE, 0.0, 0.0);
        }
    }
}

/// Frees a bouncing sphere with a long path from the surfaces that it would reach or pass after its first bounce if
/// it flew straight on: it moves elsewhere and stops at the next surface.
fn leave_first_bounce(own: &mut [SurfaceContact]) {
    let bounces = own.iter().filter(|contact| contact.is_bounce());
    let Some(first) = bounces.map(|contact| contact.time).min_by(f64::total_cmp) else { return };
    for contact in own {
        let is_first = contact.is_bounce() && contact.time == first;
        let touches = contact.bias == 0.0 || contact.impulses.normal > 0.0;
        if !is_first && !touches && !contact.is_slow {
            (contact.bias, contact.approach, contact.kicked) = (FREE, 0.0, 0.0);
        }
    }
}

impl SurfaceContact {
    /// Computes normal, gap and target velocity.
    fn aim(&mut self, run: &Run, places: &Places, sub_step: &SubStep) {
        let slot = self.slot as usize;
        let (center, radius) = (run.position[slot].vector(), run.position[slot].number());
        let before = run.before[slot].vector();
        if self.bias < 0.0 && (before - self.velocity).dot(self.normal) >= 0.0 {
            // The impulse that stopped an impact is not needed once the two part.
            self.impulses.normal = self.impulses.normal.min(self.impulses.previous);
        }
        self.start = center;
        (self.approach, self.bias, self.kicked) = (0.0, FREE, 0.0);
        if self.is_clear(run, center, 0.0) && sub_step.h * before.length() <= FAR * radius {
            self.is_slow = true;
            return;
        }
        let place @ (form, motion) = places.at_start(self.surface);
        self.angular_velocity = motion.angular_velocity;
        let turns = motion.turns_form(form);
        self.swing = if turns { motion.swing(center, before) } else { DVec3::ZERO };
        self.is_slow = sub_step.h * (before - motion.velocity_at(center)).length() <= FAR * radius;
        let separation = self.separation(run, form, (center, radius));
        if self.passes && separation.is_some() {
            return;
        }
        if let Some(Separation { distance, normal, point }) = separation {
            (self.normal, self.velocity) = if turns {
                turning_plane(motion, (normal, point), (center, radius + distance), sub_step.h)
            } else {
                (normal, motion.velocity + motion.turning_in_place(form, point))
            };
            self.bias = distance.max(0.0) / sub_step.h;
            self.watch_for_impact(run, distance, sub_step);
        }
        let is_apart = separation.is_none_or(|it| it.distance > 0.0);
        let is_curved = !matches!(form, Form::HalfSpace { .. }) || !motion.is_at_rest();
        if is_apart && is_curved && (!self.is_slow || self.approach > 0.0) {
            self.aim_at_impact(run, place, sub_step);
        }
        self.aim_slip(run, motion, sub_step.h);
    }

    /// Computes the slip at which friction ends, in a sub-step of `h` \[s\].
    fn aim_slip(&mut self, run: &Run, motion: &SurfaceMotion, h: f64) {
        let slot = self.slot as usize;
        let is_felt = motion.belt != DVec3::ZERO && self.friction.sliding > 0.0;
        self.belt = DVec3::ZERO;
        if is_felt {
            let belt = motion.turned(motion.belt, h);
            self.belt = belt - belt.dot(self.normal) * self.normal;
        }
        self.slip = self.belt;
        if self.approach > 0.0 && self.friction.reverses() && !run.spin.is_empty() {
            let (before, spin) = (run.before[slot].vector(), run.spin_before[slot].vector());
            let slip = slip(before - self.velocity, self.normal, spin) - self.belt;
            let change = (1.0 + self.restitution) * self.approach + self.kicked;
            let masses = [run.velocity[slot].number(), run.spin[slot].number()];
            self.slip = self.friction.slip_after(slip, (change, self.restitution), masses);
            if is_felt {
                self.slip += self.belt;
            }
        }
    }

    /// Notes an impact, if there is one within the sub-step.
    fn watch_for_impact(&mut self, run: &Run, distance: f64, sub_step: &SubStep) {
        let slot = self.slot as usize;
        let speed = -(run.before[slot].vector() - self.velocity).dot(self.normal);
        let pressing = -run.acceleration[slot].vector().dot(self.normal);
        let along = (pressing - self.swing.dot(self.normal)).max(0.0);
        let threshold = if self.impulses.normal > 0.0 {
            sub_step.resting_speed + sub_step.resting_speed_at(self.swing)
        } else if run.bears[slot] {
            sub_step.shaken_speed(along)
        } else {
            sub_step.surface_impact_speed(along)
        };
        let fall = 0.5 * pressing * sub_step.h;
        if speed > threshold && distance < sub_step.h * (speed + fall) {
            // gap = s t + a t²/2
            let gap = distance.max(0.0);
            let speed_there = (speed * speed + 2.0 * pressing * gap).max(0.0).sqrt();
            let time = 2.0 * gap / (speed + speed_there);
            self.note_impact((speed + pressing * time, pressing), run, time, sub_step);
        } else if self.impulses.normal == 0.0 && distance > sub_step.h * (speed + fall) {
            // On its parabola the sphere does not get as far as with its last velocity.
            self.bias += fall.max(0.0);
        }
    }

    /// Computes the contact for the impact of the sphere within the sub-step, wherever on the surface that is;
    /// without an impact the contact does not press.
    fn aim_at_impact(&mut self, run: &Run, place: Place, sub_step: &SubStep) {
        let (form, motion) = place;
        let slot = self.slot as usize;
        let radius = run.position[slot].number();
        let flight = Flight {
            position: run.position[slot].vector(),
            velocity: run.before[slot].vector(),
            acceleration: run.acceleration[slot].vector(),
            drag_rate: 0.0,
        };
        (self.bias, self.approach, self.kicked) = (FREE, 0.0, 0.0);
        let time = contact_time::sphere_surface_in_reach(&flight, radius, form, motion, sub_step.h);
        let Some(time) = time else { return self.aim_at_end(&flight, radius, place, sub_step) };
        // Relative to the present place of the surface.
        let (there, velocity) = flight.after(time);
        let moved = motion.carried_back(there, time);
        let Some(separation) = sphere_surface(form, moved, radius) else { return };
        self.normal = motion.turned(separation.normal, time);
        self.velocity = motion.velocity_after(motion.carried(separation.point, time), time);
        let approach = -(velocity - self.velocity).dot(self.normal);
        let pressing = -flight.acceleration.dot(self.normal);
        self.bias = approach.max(0.0) * time / sub_step.h;
        self.note_impact((approach.max(0.0), pressing), run, time, sub_step);
        if motion.turns_form(form) && self.bias >= 0.0 && is_flat(form, separation.normal) {
            // It stays in contact with the plane, which turns on.
            let height = (flight.position - separation.point).dot(separation.normal);
            let plane = (separation.normal, separation.point);
            (self.normal, self.velocity) =
                turning_plane(motion, plane, (flight.position, height), sub_step.h);
            self.bias = (height - radius).max(0.0) / sub_step.h;
        }
    }

    /// Makes the contact hold a sphere without an impact out of the surface at the end of its path, should others
    /// push it there; not if it has passed the surface by then, where others may send it back.
    fn aim_at_end(&mut self, flight: &Flight, radius: f64, place: Place, sub_step: &SubStep) {
        let (form, motion) = place;
        let h = sub_step.h;
        let (there, velocity) = flight.after(h);
        let separation = sphere_surface(form, motion.carried_back(there, h), radius);
        let Some(Separation { distance, normal: own, point }) = separation else { return };
        let normal = motion.turned(own, h);
        let surface_velocity = motion.velocity_after(motion.carried(point, h), h);
        let leaving = (velocity - surface_velocity).dot(normal);
        // A plane across its path, or around the edge that it has passed, would keep it from coming back.
        let was_behind = (flight.position - point).dot(own) < LEAST_IN_FRONT * radius;
        if was_behind || (leaving > 0.0 && !is_flat(form, own)) {
            return;
        }
        (self.normal, self.velocity) = (normal, surface_velocity);
        self.bias = distance.max(0.0) / h - leaving;
    }

    /// Notes an impact after a `time` \[s\] with this speed of approach \[m/s\], before drag; it is a bounce if the
    /// sphere, which accelerates towards the surface \[m/s²\], is still leaving it at the end.
    fn note_impact(
        &mut self,
        (approach, pressing): (f64, f64),
        run: &Run,
        time: f64,
        sub_step: &SubStep,
    ) {
        let slot = self.slot as usize;
        let (radius, drag_rate) = (run.position[slot].number(), run.acceleration[slot].number());
        let slowed = |speed: f64, time: f64| speed / (1.0 + drag_rate * time);
        let approach = slowed(approach, time);
        self.approach = approach;
        if let Some(law) = self.law {
            self.restitution = law.at(approach);
        }
        let pressing = pressing - self.swing.dot(self.normal);
        let kick = if approach > 0.0 { respond::kick(self.kick, pressing, radius) } else { 0.0 };
        let left = sub_step.h - time;
        let rebound = slowed(self.restitution * approach + kick - pressing * left, left);
        // A contact that already presses does not bounce: it would lose its starting impulse.
        if rebound > 0.0 && self.impulses.normal == 0.0 {
            (self.bias, self.time, self.kicked) = (-rebound, time, kick);
        }
    }

    /// Applies the impulses of the warm start to the sphere.
    fn warm_start(&mut self, run: &mut Run, sub_step: &SubStep) {
        self.start(1.0 / run.velocity[self.slot as usize].number(), sub_step);
        let Impulses { normal, tangential, angular, .. } = &mut self.impulses;
        if *normal == 0.0 {
            (*tangential, *angular) = ([0.0; 3], [0.0; 3]);
            return;
        }
        let kept = DVec3::from_array(*tangential);
        let across = kept - self.normal * kept.dot(self.normal);
        *tangential = across.to_array();
        let (along, angular) = (*normal * self.normal, DVec3::from_array(*angular));
        push(run, self.slot, self.normal, [along, across]);
        turn(run, self.slot, angular);
    }

    /// The normal impulse to start from, for a sphere of this mass \[kg\].
    fn start(&mut self, mass: f64, sub_step: &SubStep) {
        let Impulses { normal, previous, .. } = &mut self.impulses;
        let carried = *normal;
        let growth = sub_step.growth + sub_step.growth_at(self.swing);
        let most = *previous * GROWTH + mass * growth;
        *previous = carried;
        *normal = if self.bias == FREE { 0.0 } else { carried.min(most) };
    }
}

/// Moves a sphere. Returns the work against conservative forces \[J\].
pub(crate) fn move_by(run: &mut Run, slot: usize, way: DVec3) -> f64 {
    run.position[slot] = run.position[slot].with_vector(run.position[slot].vector() + way);
    run.work_of_move(slot, way)
}

/// Applies impulses along the normal and across it to a sphere.
pub(super) fn push(run: &mut Run, slot: u32, normal: DVec3, [along, across]: [DVec3; 2]) {
    let velocity = &mut run.velocity[slot as usize];
    let impulse = along + across;
    *velocity = velocity.with_vector(velocity.vector() + velocity.number() * impulse);
    if let Some(spin) = run.spin.get_mut(slot as usize) {
        *spin = spin.with_vector(spin.vector() - spin.number() * normal.cross(across));
    }
}

/// Applies an angular impulse to a sphere.
pub(super) fn turn(run: &mut Run, slot: u32, angular: DVec3) {
    let radius = run.position[slot as usize].number();
    if let Some(spin) = run.spin.get_mut(slot as usize) {
        *spin = spin.with_vector(spin.vector() + spin.number() / radius * angular);
    }
}
