//! Reconstruction of the impacts of groups, and of contacts that nothing presses.

use glam::DVec3;

use super::coefficients::{Combined, RestitutionRates, restitution_of, sliding_of};
use super::error::DerivativeError;
use super::group::{
    Answer, Contact, First, GroupSaltation, LooseContact, Model, Plan, answer, layers_of,
    plastic_at,
};
use super::replay::{Piece, Replay};
use super::saltation::Colliding;
use super::start::{Flying, Held};
use crate::detect::contact::Bodies;
use crate::id::{ColliderId, SphereId};
use crate::report::{BodyPair, ImpactGroup, StepReport};
use crate::respond;
use crate::rule::exact::{GroupImpact, HeldMotion, StruckTouch};
use crate::rule::periodic;
use crate::settings::ImpactLaw;
use crate::surface::Form;
use crate::world::World;

/// A rate of opening below this part of the fastest speed is zero but for rounding.
const NOTHING: f64 = 1e-9;
/// Largest difference of the answer from that of the world, as a part of the fastest speed.
const SAME: f64 = 1e-7;
/// Contacts of one sphere do not push each other if the product of their normals is at most this.
const ACROSS: f64 = 1e-9;
/// Largest difference of two times that are one, as a part of the time of the world.
const SAME_TIME: f64 = 8.0 * f64::EPSILON;

/// Persistent contact of each member after an impact, if any.
type Afterwards = Vec<Option<(HeldMotion, Held)>>;

impl Replay<'_> {
    /// Removes and returns the impact of a group of the report, if other contacts than those of planes that bear the
    /// spheres touch there besides the bodies that meet.
    pub fn group_of(&mut self, report: &StepReport, group: &ImpactGroup) -> Option<GroupImpact> {
        let time = self.start.time + report.impacts[group.first].time;
        let near = SAME_TIME * time.abs().max(self.start.time.abs());
        while self.groups.front().is_some_and(|it| it.time < time - near) {
            self.groups.pop_front();
        }
        let found = self.groups.front().filter(|it| (it.time - time).abs() <= near)?;
        let surface_of = |it: &StruckTouch| match it.bodies {
            Bodies::Surface { surface, .. } => {
                Some(&self.start.colliders.surfaces()[surface as usize])
            }
            Bodies::Pair(..) => None,
        };
        let collider_of = |it: &StruckTouch| surface_of(it).map(|it| it.collider);
        let struck = found.touches.iter().find(|it| it.impulse > 0.0);
        let counts = |it: &StruckTouch| match surface_of(it) {
            // Faces of one collider share edges and corners, and planes bear spheres.
            Some(surface) => {
                let is_plane = matches!(surface.form, Form::HalfSpace { .. } | Form::Rectangle(_));
                !is_plane && struck.and_then(collider_of) != Some(surface.collider)
            }
            None => it.impulse == 0.0,
        };
        let counts = group.count > 1 || found.touches.iter().any(counts);
        let impact = self.groups.pop_front();
        impact.filter(|_| counts)
    }

    /// Advances the spheres of a group to the time of its impact, and applies it.
    pub fn collide_group(
        &mut self,
        group: &GroupImpact,
        law: ImpactLaw,
    ) -> Result<(), DerivativeError> {
        let second = group.members[group.touches[0].second].index as usize;
        let several =
            DerivativeError::Simultaneous { sphere: self.start.ids[second], time: group.time };
        if law != ImpactLaw::Reflection || !group.is_plain {
            return Err(several);
        }
        let time = group.time - self.start.time;
        let (members, afterwards) = self.members_of(group, time)?;
        let (contacts, colliders) = self.contacts_of(group).ok_or_else(|| self.lost(second))?;
        let meeting = meeting_of(group).ok_or_else(|| several.clone())?;
        let mut model = Model { members, contacts, colliders, meeting, plan: Plan::default() };
        self.set_restitutions(group, &mut model);
        model.plan.layers = layers_of(&model).ok_or_else(|| several.clone())?;
        let no_change = model.no_change();
        let velocities = |answer: &Answer| -> Vec<DVec3> {
            answer.velocities.iter().map(|it| it.value()).collect()
        };
        if model.contacts.iter().any(|it| it.sliding.value > 0.0) {
            let rubbed = velocities(&answer(&model, &no_change));
            model.plan.plastic = plastic_at(&model, &rubbed);
        }
        let found = velocities(&answer(&model, &no_change));
        let fastest = model.fastest();
        let is_same = group
            .members
            .iter()
            .zip(&found)
            .all(|(it, found)| (it.after[0] - *found).length() <= SAME * fastest);
        let saltation = GroupSaltation::of(&model, self.elapsed + time);
        let saltation = saltation.filter(|_| is_same).ok_or(several)?;
        self.pieces.push(Piece::Group(Box::new(saltation)));
        for ((member, it), next) in model.members.iter().zip(&group.members).zip(afterwards) {
            let body = &mut self.start.bodies[member.place];
            [body.velocity, body.angular_velocity] = it.after;
            body.held = None;
            if let Some((motion, held)) = next {
                self.hold(member.place, &motion, held)?;
            }
        }
        Ok(())
    }

    /// Advances the members of a group to the time of its impact. Returns them with what holds them afterwards.
    fn members_of(
        &mut self,
        group: &GroupImpact,
        time: f64,
    ) -> Result<(Vec<Colliding>, Afterwards), DerivativeError> {
        let period = self.system.settings.boundary.period();
        let (mut members, mut afterwards) = (Vec::new(), Vec::new());
        for it in &group.members {
            let place = it.index as usize;
            self.advance(place, time)?;
            self.fly(place, time, None)?;
            let next = self.held_after(place, time)?;
            let body = &mut self.start.bodies[place];
            let off = periodic::wrapped(it.position - body.position, period);
            body.position += off;
            if body.is_curved || off.length() > body.tolerance {
                return Err(self.lost(place));
            }
            [body.velocity, body.angular_velocity] = it.before;
            let Flying { held, velocity, angular_velocity, .. } = *body;
            let before = held.map(|held| (held, [velocity, angular_velocity]));
            let after =
                next.map(|(motion, held)| (held, [motion.velocity, motion.angular_velocity]));
            let rates = [self.rates_in(place, before)?, self.rates_in(place, after)?];
            let id = self.start.ids[place];
            let body = &self.start.bodies[place];
            members.push(Colliding::of(&self.system, (place, id), body, rates));
            afterwards.push(next);
        }
        Ok((members, afterwards))
    }

    /// Returns the contacts of a group without their restitution, and its colliders; `None` if one of these moves.
    fn contacts_of(&self, group: &GroupImpact) -> Option<(Vec<Contact>, Vec<ColliderId>)> {
        let mut colliders = Vec::new();
        let mut contacts = Vec::new();
        for it in &group.touches {
            let collider = match it.bodies {
                Bodies::Pair(..) => None,
                Bodies::Surface { surface, .. } => {
                    let surface = &self.start.colliders.surfaces()[surface as usize];
                    let is_still =
                        surface.motion.is_at_rest() && surface.motion.belt == DVec3::ZERO;
                    is_still.then_some(())?;
                    let known = colliders.iter().position(|id| *id == surface.collider);
                    Some(known.unwrap_or_else(|| {
                        colliders.push(surface.collider);
                        colliders.len() - 1
                    }))
                }
            };
            let is_pressed = self.is_pressed(group, it);
            let pushes = |other: &StruckTouch| {
                let has = other.first == Some(it.second) || other.second == it.second;
                let is_across = other.normal.dot(it.normal).abs() <= ACROSS;
                other.bodies != it.bodies && has && !is_across
            };
            contacts.push(Contact {
                first: it.first,
                second: it.second,
                collider,
                normal: it.normal,
                curvature: it.curvature,
                restitution: RestitutionRates::default(),
                law: respond::restitution_of(it.bodies, &self.system),
                sliding: sliding_of(&self.system, it.bodies),
                friction: respond::friction_of(it.bodies, &self.system),
                is_pressed,
                is_held: is_pressed && !group.touches.iter().any(pushes),
            });
        }
        Some((contacts, colliders))
    }

    /// Returns whether forces press a sphere onto a plane.
    fn is_pressed(&self, group: &GroupImpact, touch: &StruckTouch) -> bool {
        let Bodies::Surface { surface, .. } = touch.bodies else { return false };
        let held = self.start.bodies[group.members[touch.second].index as usize].held;
        let collider = self.start.colliders.surfaces()[surface as usize].collider;
        let is_plane = |it: Held| it.collider == collider && it.normal.dot(touch.normal) > 0.5;
        held.is_some_and(is_plane)
    }

    /// Sets the restitutions, as the impact took them.
    fn set_restitutions(&self, group: &GroupImpact, model: &mut Model) {
        let meeting = &model.contacts[model.meeting];
        let speed = -model.relative_velocity(meeting).dot(meeting.normal);
        for (contact, it) in model.contacts.iter_mut().zip(&group.touches) {
            let rates = restitution_of(&self.system, it.bodies, speed);
            let is_given = (rates.combined.value - it.restitution).abs() <= NOTHING;
            let value = it.restitution.clamp(0.0, 1.0);
            let by_bodies = if is_given { rates.combined.by_bodies } else { [0.0; 2] };
            let by_speed = if is_given { rates.by_speed } else { 0.0 };
            contact.restitution =
                RestitutionRates { combined: Combined { value, by_bodies }, by_speed };
        }
    }

    /// Adds the contacts at the end of the step that nothing presses: those of spheres that a plane bears alone, with others
    /// and with other surfaces.
    pub fn add_loose_contacts(&mut self, world: &World) {
        let bodies = &self.start.bodies;
        if !bodies.iter().any(|body| body.held.is_some_and(|held| held.has_others)) {
            return;
        }
        for contact in world.contacts() {
            let place = |id: SphereId| self.start.ids.binary_search(&id).ok();
            let (first, id) = match contact.between {
                BodyPair::Spheres(first, second) => {
                    let Some(place) = place(first) else { continue };
                    (First::Sphere(place, first), second)
                }
                BodyPair::Collider { collider, sphere } => (First::Surface(collider), sphere),
            };
            let Some(second) = place(id) else { continue };
            let held = self.start.bodies[second].held;
            let is_plane = held.is_some_and(|held| match first {
                First::Surface(collider) => match self.corner_of(second, &held).flatten() {
                    Some(corner) => corner.has(collider, contact.normal),
                    None => collider == held.collider && contact.normal.dot(held.normal) > 0.5,
                },
                First::Sphere(..) => false,
            });
            if !is_plane {
                let time = self.elapsed + self.end - self.start.time;
                let second = (second, id);
                let loose = LooseContact { first, second, normal: contact.normal, time };
                self.pieces.push(Piece::Loose(Box::new(loose)));
            }
        }
    }
}

/// Returns the number of the contact whose bodies meet; `None` if there are several, or some part.
fn meeting_of(group: &GroupImpact) -> Option<usize> {
    let velocity = |member: usize| group.members[member].before[0];
    let fastest = (0..group.members.len()).map(|it| velocity(it).length()).fold(0.0, f64::max);
    let rate = |it: &StruckTouch| {
        let first = it.first.map_or(DVec3::ZERO, velocity);
        (velocity(it.second) - first).dot(it.normal)
    };
    let moving = group.touches.iter().enumerate().map(|(number, it)| (number, rate(it)));
    let mut moving = moving.filter(|it| it.1.abs() > NOTHING * fastest);
    let (number, rate) = moving.next()?;
    (rate < 0.0 && moving.next().is_none()).then_some(number)
}
