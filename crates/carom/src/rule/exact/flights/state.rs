//! The flights of all spheres: the state that the rule keeps between frames.

use std::collections::BTreeMap;

use educe::Educe;
use glam::DVec3;

use super::body::Body;
use super::clusters::{Cluster, Clusters, Support, Supported};
use super::components::Components;
use super::contact_work::{ContactWork, WorkDone};
use super::curve::Curve;
use super::flight_log::FlightLog;
use super::growth::Growth;
use super::rotation::Rotation;
use super::species::{Species, SpeciesOfSpheres};
use super::wells::Wells;
use crate::bodies::Motion;
use crate::contact_time::Reach;
use crate::detect::contact::Bodies;
use crate::integrate::gauss_legendre;
use crate::non_additivity::NonAdditivity;
use crate::polynomial_flight::PolynomialAcceleration;
use crate::rule::periodic;
use crate::shear::Shear;
use crate::surface::{Form, Role, Surface, SurfaceMotion};
use crate::system::System;

/// The flights of all spheres, and the clusters that persistent contacts make of them.
#[derive(Debug, Educe, Default)]
#[educe(Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Flights {
    /// Bodies by slot: in the order of places, so that neighbours share memory.
    pub bodies: Vec<Body>,
    pub species: Vec<Species>,
    /// Numbers of species without spheres.
    spare_species: Vec<u32>,
    /// The species of spheres in a zone, by their species outside.
    stepped_species: BTreeMap<u32, u32>,
    /// Place of each slot in the arrays of the world, and back.
    pub index_of: Vec<u32>,
    pub slot_of: Vec<u32>,
    pub clusters: Clusters,
    /// Rotations by index; empty where no friction acts.
    pub rotations: Vec<Rotation>,
    /// Curves by index; empty where no sphere flies on one.
    pub curves: Vec<Curve>,
    /// The sets of spheres that take their steps together.
    pub components: Components,
    /// How radii grow; `None` where none does.
    pub growth: Option<Growth>,
    /// Wells around spheres; `None` without a potential between them.
    pub wells: Option<Wells>,
    /// Where spheres of named materials touch.
    pub non_additivity: NonAdditivity,
    /// A sphere, by index, on which a force was not finite.
    pub lost: Option<u32>,
    /// Whether some forces are held constant for a time.
    pub hold_forces: bool,
    /// Whether some forces have no closed form, so that they change with the state.
    pub forces_vary: bool,
    /// Work of persistent contacts since the last report.
    contact_work: WorkDone,
    /// Log of persistent contacts and curved flights, during a step that keeps one.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub(super) log: Option<FlightLog>,
}

impl Flights {
    /// The flights of all spheres: `flight_of` returns a known one by index; the others begin from the state in the
    /// world's arrays at a time \[s\].
    pub fn new(
        system: &System,
        motion: &Motion,
        flight_of: impl Fn(usize) -> Result<Body, f64>,
    ) -> Self {
        let SpeciesOfSpheres { species, number_of, hold_forces, forces_vary } =
            SpeciesOfSpheres::of(system);
        let count = number_of.len();
        let rub_under_drag =
            || system.has_friction() && species.iter().any(|it| it.drag_rate > 0.0);
        let may_bend =
            || !system.holds_forces_of_all() && (touch_may_bend(system) || rub_under_drag());
        let are_curved = species.iter().any(|it| it.is_curved) || may_bend();
        let components =
            Components::of(system, |index| species[number_of[index] as usize].is_curved);
        let period = system.settings.boundary.period();
        let shear = Shear::of(system.settings);
        let body = |index: usize| {
            let state = [motion.position[index], motion.velocity[index]];
            let begun = |time| {
                let [position, velocity] = match shear {
                    Some(shear) => shear.wrapped(state, time),
                    None => [periodic::wrapped(state[0], period), state[1]],
                };
                Body { position, velocity, time, species: 0, generation: 0 }
            };
            let flight = flight_of(index).unwrap_or_else(begun);
            Body { species: number_of[index], ..flight }
        };
        let index_of: Vec<u32> = (0..count as u32).collect();
        Self {
            bodies: (0..count).map(body).collect(),
            species,
            spare_species: Vec::new(),
            stepped_species: BTreeMap::new(),
            slot_of: index_of.clone(),
            index_of,
            clusters: Clusters::default(),
            rotations: Vec::new(),
            curves: if are_curved { vec![Curve::default(); count] } else { Vec::new() },
            components,
            growth: None,
            wells: None,
            non_additivity: system.material_pairs.non_additivity.clone(),
            lost: None,
            hold_forces,
            forces_vary,
            contact_work: WorkDone::NONE,
            log: None,
        }
    }

    /// Reorders the spheres by their slots in `order`.
    pub fn reorder(&mut self, order: &[u32]) {
        let mut new_slots = vec![0; order.len()];
        for (new, &old) in (0u32..).zip(order) {
            new_slots[old as usize] = new;
        }
        self.bodies = order.iter().map(|&slot| self.bodies[slot as usize]).collect();
        self.index_of = order.iter().map(|&slot| self.index_of[slot as usize]).collect();
        for (slot, &index) in (0u32..).zip(&self.index_of) {
            self.slot_of[index as usize] = slot;
        }
        self.clusters.renumber(|slot| new_slots[slot as usize]);
    }

    /// Whether spheres may fly on curves.
    #[inline]
    pub fn are_curved(&self) -> bool {
        !self.curves.is_empty()
    }

    /// The species of all spheres, if there is one, and their relative motion is straight.
    #[inline(always)]
    pub fn only_species(&self) -> Option<&Species> {
        match &self.species[..] {
            [species] if species.drag_rate == 0.0 && !species.is_curved => Some(species),
            _ => None,
        }
    }

    pub fn species_of(&self, slot: u32) -> &Species {
        &self.species[self.bodies[slot as usize].species as usize]
    }

    /// The species of the sphere without contact forces.
    pub fn free_species_of(&self, slot: u32) -> &Species {
        &self.species[self.species_of(slot).free as usize]
    }

    /// Centre \[m\] and velocity \[m/s\] of a sphere at `time` \[s\].
    #[inline(always)]
    pub fn state_of(&self, slot: u32, time: f64) -> (DVec3, DVec3) {
        let body = &self.bodies[slot as usize];
        let species = &self.species[body.species as usize];
        if species.is_curved {
            return self.state_on_curve(slot, time);
        }
        body.state_at(species, time)
    }

    /// The flight of the sphere at an index of the world's arrays. Where forces of persistent contacts
    /// or forces held constant act on it, another flight begins at `time` \[s\], free of them.
    pub fn free_flight_of(&self, index: usize, time: f64) -> Body {
        let slot = self.slot_of[index];
        let mut body = self.bodies[slot as usize];
        if self.hold_forces || self.species_of(slot).cluster.is_some() {
            let (position, velocity) = self.state_of(slot, time);
            body.begin_flight(position, velocity, time);
        }
        body
    }

    /// Angular velocity of a sphere at `time` \[rad/s\]; zero where no friction acts.
    pub fn angular_velocity_of(&self, slot: u32, time: f64) -> DVec3 {
        let rotation = self.rotations.get(self.index_of[slot as usize] as usize);
        rotation.map_or(DVec3::ZERO, |rotation| rotation.angular_velocity_at(time))
    }

    /// Ends all torque on a sphere from `time` \[s\] on, where friction acts.
    pub fn end_torque(&mut self, slot: u32, time: f64) {
        if let Some(rotation) = self.rotations.get_mut(self.index_of[slot as usize] as usize) {
            rotation.end_torque(time);
        }
    }

    /// Sets the angular velocity \[rad/s\] and angular acceleration \[rad/s²\] of a sphere from `time` \[s\] on,
    /// where friction acts.
    pub fn rotate(&mut self, slot: u32, rotation: [DVec3; 2], time: f64) {
        if let Some(it) = self.rotations.get_mut(self.index_of[slot as usize] as usize) {
            it.begin(rotation, time);
        }
    }

    /// Begins the rotation of a sphere on a curve over a step from `time` \[s\] on, with this angular acceleration
    /// \[rad/s²\].
    pub fn rotate_over_step(&mut self, slot: u32, turning: PolynomialAcceleration, time: f64) {
        if let Some(it) = self.rotations.get_mut(self.index_of[slot as usize] as usize) {
            it.begin_step(turning, time);
        }
    }

    /// The rotation of the sphere with this index of the world's arrays. Torques of its persistent contacts end at
    /// `time` \[s\].
    pub fn free_rotation_of(&self, index: usize, time: f64) -> Rotation {
        let mut rotation = self.rotations[index].clone();
        if self.hold_forces || self.species_of(self.slot_of[index]).cluster.is_some() {
            rotation.end_torque(time);
        }
        rotation
    }

    /// Changes the acceleration \[m/s²\] of a sphere that is a species of its own, and the work of its contacts.
    pub fn set_acceleration(&mut self, slot: u32, acceleration: DVec3, contact_work: ContactWork) {
        let species = self.bodies[slot as usize].species;
        let species = &mut self.species[species as usize];
        (species.acceleration, species.contact_work) = (acceleration, contact_work);
    }

    /// Bounds of the flight of a sphere up to its `end` on the world's clock \[s\], or over its step if it is on a curve.
    pub fn reach_of(&self, slot: u32, end: f64) -> Reach {
        let body = &self.bodies[slot as usize];
        let species = self.species_of(slot);
        match self.step_of(slot, body) {
            Some(step) => {
                let state = [body.position, body.velocity];
                Reach::of_polynomial(state, &step.acceleration, species.radius)
            }
            None => Reach::of(body.flight(species), species.radius, end - body.time),
        }
    }

    /// Bounds of the flight of a sphere between two times on the world's clock \[s\], or over its step if it is on a curve,
    /// and when they begin.
    pub fn reach_within(&self, slot: u32, [start, end]: [f64; 2]) -> (Reach, f64) {
        let body = &self.bodies[slot as usize];
        let species = self.species_of(slot);
        if species.is_curved {
            return (self.reach_of(slot, self.step_end(slot)), body.time);
        }
        (Reach::of(body.flight_from(species, start), species.radius, end - start), start)
    }

    /// Bounds of the flight of a sphere between two times on the world's clock \[s\], within its step if it is on a curve.
    pub fn reach_between(&self, slot: u32, [start, end]: [f64; 2]) -> Reach {
        let body = &self.bodies[slot as usize];
        let species = self.species_of(slot);
        match self.step_of(slot, body) {
            Some(step) => {
                let state = self.state_on_curve(slot, start);
                let acceleration = step.acceleration.within(start - body.time, end - start);
                Reach::of_polynomial(state.into(), &acceleration, species.radius)
            }
            None => Reach::of(body.flight_from(species, start), species.radius, end - start),
        }
    }

    /// Sets the acceleration of a sphere without the forces of its persistent contacts \[m/s²\].
    pub fn set_free_acceleration(&mut self, slot: u32, acceleration: DVec3) {
        let free = self.species_of(slot).free;
        self.species[free as usize].acceleration = acceleration;
    }

    /// Counts the work of the persistent contacts of a sphere in its flight up to `time` \[s\], where that
    /// flight ends. Their force is constant over it.
    pub fn count_contact_work(&mut self, slot: u32, time: f64) {
        let species = *self.species_of(slot);
        let from = self.bodies[slot as usize].time.max(self.contact_work.until);
        let along_way = || {
            let change = species.acceleration - self.free_species_of(slot).acceleration;
            let way = self.state_of(slot, time).0 - self.state_of(slot, from).0;
            species.mass * change.dot(way)
        };
        match species.contact_work {
            ContactWork::None => {}
            ContactWork::Friction { moment, collider_power } => {
                let [along, by_curve] = match species.is_curved {
                    true => self.contact_work_on_curve(slot, [from, time]),
                    false => [along_way(), 0.0],
                };
                let [before, after] = [from, time].map(|at| self.angular_velocity_of(slot, at));
                let turning = 0.5 * moment * (after - before).dot(after + before);
                let by_colliders = (time - from) * collider_power + by_curve;
                self.contact_work.friction += along + turning - by_colliders;
                self.contact_work.colliders += by_colliders;
            }
            ContactWork::Colliders => {
                self.contact_work.colliders += match species.is_curved {
                    true => self.contact_work_on_curve(slot, [from, time])[0],
                    false => along_way(),
                };
            }
        }
    }

    /// The work of the persistent contacts of a sphere along a part of its curve, from one time to another \[s\], and that
    /// of moving surfaces among it \[J\].
    fn contact_work_on_curve(&self, slot: u32, range: [f64; 2]) -> [f64; 2] {
        let body = &self.bodies[slot as usize];
        let step = self.step_of(slot, body).filter(|_| range[0] < range[1]);
        let Some((step, held)) = step.and_then(|step| step.held.as_ref().map(|it| (step, it)))
        else {
            return [0.0; 2];
        };
        let force = step.acceleration.minus(&held.free);
        let mass = self.species_of(slot).mass;
        let along = gauss_legendre::integral(range, |time| {
            mass * force.at(time - body.time).dot(self.state_on_curve(slot, time).1)
        });
        [along, held.collider_work(range.map(|time| time - body.time))]
    }

    /// Adds the energy that impulses in persistent contacts gave at once \[J\].
    pub fn add_contact_work(&mut self, work: f64) {
        self.contact_work.friction += work;
    }

    /// Adds work of colliders that is done at once \[J\].
    pub fn add_collider_work(&mut self, work: f64) {
        self.contact_work.colliders += work;
    }

    /// Returns the work that persistent contacts have done up to `time` \[s\] since it was taken last: that of
    /// friction and that of colliders that move \[J\].
    pub fn take_contact_work(&mut self, time: f64) -> [f64; 2] {
        let members = self.clusters.iter().flat_map(|cluster| &cluster.members);
        let all: Vec<u32> = members.copied().collect();
        all.into_iter().for_each(|slot| self.count_contact_work(slot, time));
        let WorkDone { friction, colliders, .. } = self.contact_work;
        self.contact_work = WorkDone { until: time, ..WorkDone::NONE };
        [friction, colliders]
    }

    /// Notes that all flights begin at another time and the work up to now is reported.
    pub fn restart_contact_work(&mut self) {
        self.contact_work = WorkDone::NONE;
    }

    /// Removes the contact forces on a sphere at `time` \[s\], and its cluster. Returns whether there was one.
    pub fn set_free(&mut self, slot: u32, time: f64) -> bool {
        let species = *self.species_of(slot);
        let Some(cluster) = species.cluster else { return false };
        self.count_contact_work(slot, time);
        self.clusters.remove(cluster);
        self.spare_species.push(self.bodies[slot as usize].species);
        self.bodies[slot as usize].species = species.free;
        self.end_torque(slot, time);
        if species.is_curved {
            self.end_curve(slot);
        }
        self.note_support(slot, time, false);
        true
    }

    /// Puts a sphere without contact forces into a zone: it flies straight from this place \[m\] with this velocity
    /// \[m/s\], since a time \[s\].
    pub fn enter_zone(&mut self, slot: u32, [position, velocity]: [DVec3; 2], time: f64) {
        self.make_stepped(slot);
        self.bodies[slot as usize].begin_flight(position, velocity, time);
    }

    /// Marks spheres whose flights are known, by index, as members of a zone.
    pub fn set_stepped(&mut self, indices: &[u32]) {
        indices.iter().for_each(|&index| self.make_stepped(self.slot_of[index as usize]));
    }

    fn make_stepped(&mut self, slot: u32) {
        let free = self.bodies[slot as usize].species;
        let next = self.species.len() as u32;
        let number = *self.stepped_species.entry(free).or_insert(next);
        if number == next {
            let species = self.species[free as usize];
            self.species.push(Species {
                acceleration: DVec3::ZERO,
                drag_rate: 0.0,
                is_stepped: true,
                is_curved: false,
                ..species
            });
        }
        self.bodies[slot as usize].species = number;
    }

    /// Takes a sphere out of a zone: it flies freely from this place \[m\] with this velocity \[m/s\], since a time
    /// \[s\].
    pub fn leave_zone(&mut self, slot: u32, [position, velocity]: [DVec3; 2], time: f64) {
        let free = self.species_of(slot).free;
        let body = &mut self.bodies[slot as usize];
        body.species = free;
        body.begin_flight(position, velocity, time);
    }

    /// Whether a sphere is in a zone.
    #[inline]
    pub fn is_stepped(&self, slot: u32) -> bool {
        self.species_of(slot).is_stepped
    }

    /// Makes a cluster of free spheres from `time` \[s\] on.
    pub fn set_supported(&mut self, support: Support, time: f64) {
        let Support { members, contacts, sides, renewal, is_curved, belt_work } = support;
        // Contacts were said to take all that their spheres gained as they began to persist.
        self.add_contact_work(-belt_work);
        self.add_collider_work(belt_work);
        let slots = members.iter().map(|member| member.slot).collect();
        let cluster = Cluster { members: slots, contacts, sides, renewal, is_curved };
        let cluster = self.clusters.add(cluster);
        for Supported { slot, acceleration, rotation, contact_work } in members {
            if let Some(rotation) = rotation {
                self.rotate(slot, rotation, time);
            }
            let free = *self.species_of(slot);
            if is_curved {
                let index = self.index_of[slot as usize];
                self.components.add_single(index, self.index_of.len());
            }
            let species =
                Species { acceleration, cluster: Some(cluster), contact_work, is_curved, ..free };
            let number = match self.spare_species.pop() {
                Some(number) => {
                    self.species[number as usize] = species;
                    number
                }
                None => {
                    self.species.push(species);
                    self.species.len() as u32 - 1
                }
            };
            self.bodies[slot as usize].species = number;
            self.note_support(slot, time, false);
        }
    }

    /// Whether two bodies have been in persistent contact up to now.
    #[inline]
    pub fn are_held_together(&self, bodies: Bodies) -> bool {
        let (Bodies::Pair(sphere, _) | Bodies::Surface { sphere, .. }) = bodies;
        let cluster = self.species_of(self.slot_of[sphere as usize]).cluster;
        cluster.is_some_and(|cluster| self.clusters.get(cluster).has(bodies))
    }

    /// Whether a sphere is in persistent contact with a surface.
    #[inline]
    pub fn is_held_by(&self, slot: u32, surface: u32) -> bool {
        self.are_held_together(Bodies::Surface { sphere: self.index_of[slot as usize], surface })
    }

    /// How many other spheres are in persistent contact with a sphere, directly or through others.
    pub fn companions(&self, slot: u32) -> usize {
        let cluster = self.species_of(slot).cluster;
        cluster.map_or(0, |number| self.clusters.get(number).members.len() - 1)
    }
}

/// Whether persistent contacts with some surface may bend flights: its normal turns, it moves otherwise than steadily, or
/// it draws spheres along.
fn touch_may_bend(system: &System) -> bool {
    let is_flat = |form: &Form| matches!(form, Form::HalfSpace { .. } | Form::Facet(_));
    let is_steady = |motion: &SurfaceMotion| motion.drive.is_none() && !motion.turns();
    let has_friction = system.has_friction();
    let draws = |it: &Surface| has_friction && it.carries();
    let may_bend = |it: &Surface| !is_flat(&it.form) || !is_steady(&it.motion) || draws(it);
    system.surfaces.iter().any(|it| it.role == Role::Deflects && may_bend(it))
}
