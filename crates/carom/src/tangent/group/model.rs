//! What is given in the impact of a group, and its small changes.

use super::plan::Plan;
use crate::friction::ContactFriction;
use crate::id::ColliderId;
use crate::real::Vector;
use crate::restitution::ContactRestitution;
use crate::rule::exact::NormalCurvature;
use crate::tangent::coefficients::{Combined, RestitutionRates};
use crate::tangent::dual::{Dual, vector};
use crate::tangent::saltation::Colliding;
use crate::tangent::variation::{ColliderVariation, SphereVariation};
use glam::DVec3;

/// A group of touching bodies before its impact.
#[derive(Debug, Clone)]
pub(in crate::tangent) struct Model {
    pub members: Vec<Colliding>,
    pub contacts: Vec<Contact>,
    pub colliders: Vec<ColliderId>,
    /// Number of the contact whose bodies meet; all others have touched before.
    pub meeting: usize,
    /// Which contacts bear the impact.
    pub plan: Plan,
}

/// Two touching bodies.
#[derive(Debug, Clone, Copy)]
pub(in crate::tangent) struct Contact {
    /// Numbers of the spheres among the members; body 1 may be a surface.
    pub first: Option<usize>,
    pub second: usize,
    /// Number of the collider, if body 1 is a surface.
    pub collider: Option<usize>,
    /// Unit vector from body 1 to body 2.
    pub normal: DVec3,
    pub curvature: NormalCurvature,
    pub restitution: RestitutionRates,
    /// Restitution before anything else than the speed counts.
    pub law: ContactRestitution,
    pub sliding: Combined,
    pub friction: ContactFriction,
    /// Whether forces press the sphere onto a plane.
    pub is_pressed: bool,
    /// Whether they do, and no other contact of the sphere pushes it onto the plane or off it.
    pub is_held: bool,
}

/// A small change of all that is given.
#[derive(Debug, Clone)]
pub(in crate::tangent) struct Change {
    /// Without accelerations.
    pub spheres: Vec<SphereVariation>,
    pub colliders: Vec<ColliderVariation>,
}

/// What is given, in dual numbers, at the time of the changed impact.
pub(in crate::tangent) struct Given {
    pub places: Vec<Vector<Dual>>,
    pub velocities: Vec<Vector<Dual>>,
    pub spins: Vec<Vector<Dual>>,
    pub masses: Vec<Dual>,
    pub radii: Vec<Dual>,
    pub normals: Vec<Vector<Dual>>,
    /// Velocity of body 1 of each contact, if it is a surface.
    pub surfaces: Vec<Vector<Dual>>,
    pub restitutions: Vec<Dual>,
    pub sliding: Vec<Dual>,
    /// Changes of gaps that have to stay as they are \[m\].
    pub gaps: Vec<f64>,
    /// Delay of the impact \[s\].
    pub later: f64,
}

impl Model {
    /// Returns no change.
    pub fn no_change(&self) -> Change {
        let spheres = vec![SphereVariation::default(); self.members.len()];
        Change { spheres, colliders: vec![ColliderVariation::default(); self.colliders.len()] }
    }

    /// Returns the largest speed of a sphere \[m/s\].
    pub fn fastest(&self) -> f64 {
        self.members.iter().map(|it| it.velocity.length()).fold(0.0, f64::max)
    }

    /// Returns the velocity of body 2 of a contact relative to body 1 \[m/s\].
    pub fn relative_velocity(&self, contact: &Contact) -> DVec3 {
        let first = contact.first.map_or(DVec3::ZERO, |first| self.members[first].velocity);
        self.members[contact.second].velocity - first
    }

    /// Returns the change of the gap of a contact \[m\] at the undisturbed time.
    fn opened(&self, contact: &Contact, change: &Change) -> f64 {
        let second = change.spheres[contact.second];
        let [position, radius] = match (contact.first, contact.collider) {
            (Some(first), _) => {
                let first = change.spheres[first];
                [first.position, DVec3::splat(first.radius)]
            }
            (None, collider) => {
                let place = collider.map_or(DVec3::ZERO, |it| change.colliders[it].position);
                [place, DVec3::ZERO]
            }
        };
        (second.position - position).dot(contact.normal) - radius.x - second.radius
    }

    /// Returns what is given, changed.
    pub fn given(&self, change: &Change) -> Given {
        let meeting = &self.contacts[self.meeting];
        let closing = self.relative_velocity(meeting).dot(meeting.normal);
        let later = -self.opened(meeting, change) / closing;
        let mut given = Given {
            places: Vec::new(),
            velocities: Vec::new(),
            spins: Vec::new(),
            masses: Vec::new(),
            radii: Vec::new(),
            normals: Vec::new(),
            surfaces: Vec::new(),
            restitutions: Vec::new(),
            sliding: Vec::new(),
            gaps: Vec::new(),
            later,
        };
        for (sphere, by) in self.members.iter().zip(&change.spheres) {
            let (place, struck) = sphere.at_impact(&by.motion(), [by.radius, by.mass], later);
            given.places.push(place);
            given.velocities.push(struck.velocity);
            given.spins.push(struck.angular_velocity);
            given.masses.push(struck.mass);
            given.radii.push(struck.radius);
        }
        for contact in &self.contacts {
            self.add_contact(contact, change, &mut given);
        }
        self.add_restitutions(change, &mut given);
        for (number, contact) in self.contacts.iter().enumerate() {
            if number != self.meeting && !contact.is_held {
                let moved = later * self.relative_velocity(contact).dot(contact.normal);
                given.gaps.push(self.opened(contact, change) + moved);
            }
        }
        given
    }

    fn add_contact(&self, contact: &Contact, change: &Change, given: &mut Given) {
        let second = given.places[contact.second];
        let surface = contact.collider.map(|it| change.colliders[it]).unwrap_or_default();
        let normal = match contact.first {
            Some(first) => {
                let apart = self.members[first].radius + self.members[contact.second].radius;
                let moved = second.change() - given.places[first].change();
                vector(apart * contact.normal, moved).direction()
            }
            None => {
                let along = second.change() - surface.position;
                let across = along - along.dot(contact.normal) * contact.normal;
                vector(contact.normal, contact.curvature.rate(across))
            }
        };
        given.normals.push(normal);
        given.surfaces.push(vector(DVec3::ZERO, surface.velocity));
        let first = contact.first.map(|it| change.spheres[it]).unwrap_or_default();
        let by_first = if contact.first.is_some() { first.friction } else { surface.friction };
        let sliding = contact.sliding.change([by_first, change.spheres[contact.second].friction]);
        given.sliding.push(Dual::new(contact.sliding.value, sliding));
    }

    /// Adds the restitutions of all contacts; those that depend on the speed take that of the bodies that meet.
    fn add_restitutions(&self, change: &Change, given: &mut Given) {
        let slower = given.rate(&self.contacts[self.meeting], self.meeting).change;
        for contact in &self.contacts {
            let first = match (contact.first, contact.collider) {
                (Some(first), _) => change.spheres[first].restitution,
                (None, Some(collider)) => change.colliders[collider].restitution,
                (None, None) => 0.0,
            };
            let second = change.spheres[contact.second].restitution;
            let by_bodies = contact.restitution.combined.change([first, second]);
            let by_speed = -contact.restitution.by_speed * slower;
            let value = contact.restitution.combined.value;
            given.restitutions.push(Dual::new(value, by_bodies + by_speed));
        }
    }
}

impl Given {
    /// Returns the rate of opening of a contact with a number \[m/s\].
    pub fn rate(&self, contact: &Contact, number: usize) -> Dual {
        self.rate_at(contact, number, &self.velocities)
    }

    /// Returns the rate of opening of a contact at velocities of the spheres \[m/s\].
    pub fn rate_at(&self, contact: &Contact, number: usize, velocities: &[Vector<Dual>]) -> Dual {
        let first = contact.first.map_or(self.surfaces[number], |first| velocities[first]);
        (velocities[contact.second] - first).dot(self.normals[number])
    }
}
