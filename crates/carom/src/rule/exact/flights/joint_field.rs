//! The forces on spheres that take their steps together.

use glam::DVec3;

use super::between::ForcesBetween;
use super::components::{Component, PlacedSpring};
use super::curve_contacts::{ContactSphere, CurveBody, CurveContact, CurveContacts, Moving};
use super::free_field::FreeField;
use super::image_beside::{shift_beside_sphere, shift_beside_surface};
use super::moving_surface::MovingSurface;
use super::species::Species;
use super::state::Flights;
use super::tie::{Tie, TieEnd, TiePath};
use super::touched::Touched;
use crate::detect::contact::Bodies;
use crate::forces::SpringEnd;
use crate::integrate::field::{Field, Start, Values};
use crate::integrate::gauss_radau::Step;
use crate::norm::Norm;
use crate::polynomial_flight::PolynomialFlight;
use crate::respond::friction_of;
use crate::rule::exact::features::Feature;
use crate::system::System;

/// Largest angle by which a surface turns, or that part of the period of its motion, in a step \[rad\]: the nodes of a
/// step would not see the rest.
const MOST_TURNED: f64 = 2.0;

/// The forces on the spheres of a component whose forces are not held.
pub(super) struct JointField<'a> {
    flights: &'a Flights,
    /// Slots of the spheres that it acts on.
    pub flying: Vec<u32>,
    /// Forces on each sphere by itself.
    pub alone: Vec<FreeField<'a>>,
    /// Slots of the other members, whose motion is given.
    others: Vec<u32>,
    /// Place of each member in `flying` followed by `others`.
    place_of: Vec<usize>,
    /// Springs between those places.
    ties: Vec<Tie<'a>>,
    /// What contacts need of the flying spheres, by place.
    pub spheres: Vec<ContactSphere>,
    /// Persistent contacts between those places; those of different clusters have no sphere in common.
    pub contacts: Vec<CurveContacts<'a>>,
    /// Surfaces that spheres touch.
    pub touched: Vec<Touched<'a>>,
    /// Forces between all spheres of the world, where all are members.
    pub between: Option<ForcesBetween<'a>>,
    period: DVec3,
    /// How often the forces on a sphere were evaluated.
    pub evaluations: u64,
}

impl<'a> JointField<'a> {
    /// The field without its ties.
    pub fn of(system: &System<'a>, flights: &'a Flights, component: &Component) -> Self {
        let slot_of = |&index: &u32| flights.slot_of[index as usize];
        let slots: Vec<u32> = component.members.iter().map(slot_of).collect();
        let flies = |slot: &u32| flights.species_of(*slot).is_curved;
        let (flying, others): (Vec<u32>, Vec<u32>) = slots.iter().partition(|slot| flies(slot));
        let (mut next, mut next_other) = (0, flying.len());
        let place = |slot| {
            let place = if flies(slot) { &mut next } else { &mut next_other };
            *place += 1;
            *place - 1
        };
        let place_of = slots.iter().map(place).collect();
        let sphere = |&slot: &u32| {
            let index = flights.index_of[slot as usize] as usize;
            let Species { radius, mass, .. } = *flights.species_of(slot);
            ContactSphere { radius, mass, inertia_factor: system.spheres.inertia_factor(index) }
        };
        let field = |&slot: &u32| FreeField::of(system, flights.index_of[slot as usize] as usize);
        Self {
            flights,
            alone: flying.iter().map(field).collect(),
            spheres: flying.iter().map(sphere).collect(),
            flying,
            others,
            place_of,
            ties: Vec::new(),
            contacts: Vec::new(),
            touched: Vec::new(),
            between: ForcesBetween::of(system),
            period: system.settings.boundary.period(),
            evaluations: 0,
        }
    }

    /// Adds the persistent contacts of clusters, of spheres in these states \[m\], \[m/s\] at the second of two times
    /// \[s\]; at the first, surfaces are where the system says.
    pub fn hold(
        &mut self,
        system: &System<'a>,
        (component, clusters): (&Component, &[u32]),
        [positions, velocities]: [&[DVec3]; 2],
        [known_at, time]: [f64; 2],
    ) {
        let flights = self.flights;
        let friction_of = |bodies: Bodies| friction_of(bodies, system).sliding;
        let place_of = |index: u32| {
            let place = component.members.iter().position(|&member| member == index)?;
            Some(self.place_of[place])
        };
        let mut touched = Vec::new();
        for (cluster, &number) in clusters.iter().enumerate() {
            let mut contacts: Vec<CurveContact> = Vec::new();
            let held = flights.clusters.get(number);
            for &bodies in &held.contacts {
                let friction = friction_of(bodies);
                let mut add = |first, second, shift| {
                    contacts.push(CurveContact { first, second, shift, friction });
                };
                match bodies {
                    Bodies::Pair(first, second) => {
                        let places = place_of(first).zip(place_of(second));
                        let Some((first, second)) = places else { continue };
                        let offset = positions[second] - positions[first];
                        let shift = shift_beside_sphere(offset, self.period);
                        add(CurveBody::Sphere(first), second, shift);
                    }
                    Bodies::Surface { sphere, surface } => {
                        let Some(second) = place_of(sphere) else { continue };
                        let surface = &system.surfaces[surface as usize];
                        let (form, moving) = (&surface.form, MovingSurface::of(surface, known_at));
                        let shift = match moving {
                            Some(_) if self.period != DVec3::INFINITY => {
                                let (form, _) = surface.after(time - known_at);
                                shift_beside_surface(&form, positions[second], self.period)
                            }
                            _ => shift_beside_surface(form, positions[second], self.period),
                        };
                        let sides: Vec<DVec3> = held.sides_of(bodies).collect();
                        let (is_on_ring, sphere) = (!sides.is_empty(), second);
                        touched.push(Touched { cluster, sphere, shift, form, moving, is_on_ring });
                        let of_sides = sides.iter().map(|&side| Feature::side_of(form, side));
                        let state = [positions[second] + shift, velocities[second]];
                        let seen = moving.map_or(state, |it| it.seen_from(state, time));
                        let under = || Feature::under(form, seen, self.alone[second].radius);
                        let of_all = if is_on_ring { None } else { Some(under()) };
                        let features = of_sides.chain(of_all).flatten();
                        features.for_each(|it| add(CurveBody::part_of(it, moving), second, shift));
                    }
                }
            }
            contacts.sort_by_key(|contact| contact.second);
            self.contacts.push(CurveContacts::new(contacts));
        }
        self.touched = touched;
    }

    /// Whether friction acts in some contact.
    pub fn has_friction(&self) -> bool {
        self.contacts.iter().any(CurveContacts::have_friction)
    }

    /// Chooses what friction does in a step of some length \[s\] that begins at `time` \[s\] with this motion: that of all
    /// centres, then of all angles \[rad\].
    pub fn choose_friction(
        &mut self,
        [positions, velocities]: [&[DVec3]; 2],
        time: f64,
        length: f64,
    ) {
        if self.has_friction() {
            let mut free = Values::of(positions.len());
            self.evaluate_forces(time, positions, velocities, &mut free);
            let moving = Moving::of(time, [positions, velocities], self.spheres.len());
            for contacts in &mut self.contacts {
                contacts.choose_states(moving, &self.spheres, &free, length);
            }
        }
    }

    /// The places of the spheres on which friction has a torque.
    pub fn turned(&self) -> Vec<usize> {
        let contacts = self.contacts.iter().flat_map(|contacts| &contacts.contacts);
        let rough = contacts.filter(|contact| contact.friction > 0.0);
        let mut places: Vec<usize> = rough.flat_map(|it| it.ends().map(|it| it.0)).collect();
        places.sort_unstable();
        places.dedup();
        places
    }

    /// How long from a time on \[s\] the motion of the surfaces that spheres touch is smooth and turns little.
    pub fn smooth_for(&self, time: f64) -> f64 {
        let moving = self.touched.iter().filter_map(|touched| touched.moving);
        moving.map(|it| it.smooth_for(time, MOST_TURNED)).fold(f64::INFINITY, f64::min)
    }

    /// Begins a step with the spheres in these states \[m\], \[m/s\] at a time \[s\].
    pub fn begin(&mut self, component: &'a Component, states: [&[DVec3]; 2], time: f64) {
        let tie = |placed: &'a PlacedSpring| {
            let first = self.place_of[placed.first as usize];
            let second = match (placed.second, placed.spring.to) {
                (Some(second), _) => TieEnd::Sphere(self.place_of[second as usize]),
                (None, SpringEnd::Point(point)) => TieEnd::Point(point),
                (None, SpringEnd::Sphere(_)) => return None,
            };
            let ends = [self.state_of(first, states, time), self.state_at(second, states, time)];
            Some(Tie::begin(&placed.spring, (first, second), ends, self.period))
        };
        self.ties = component.springs.iter().filter_map(tie).collect();
    }

    /// Centre \[m\] and velocity \[m/s\] of the sphere at a place.
    fn state_of(
        &self,
        place: usize,
        [positions, velocities]: [&[DVec3]; 2],
        time: f64,
    ) -> [DVec3; 2] {
        match self.others.get(place.wrapping_sub(self.alone.len())) {
            Some(&other) => self.flights.state_of(other, time).into(),
            None => [positions[place], velocities[place]],
        }
    }

    /// Centre \[m\] and velocity \[m/s\] of the second end of a tie.
    fn state_at(&self, end: TieEnd, states: [&[DVec3]; 2], time: f64) -> [DVec3; 2] {
        match end {
            TieEnd::Sphere(place) => self.state_of(place, states, time),
            TieEnd::Point(point) => [point, DVec3::ZERO],
        }
    }

    /// Adds the accelerations by forces between all spheres, with the flying ones in these states \[m\], \[m/s\] at a
    /// time \[s\].
    fn add_between(&mut self, states: [&[DVec3]; 2], time: f64, at: &mut Values) {
        let Some(mut between) = self.between.take() else { return };
        if self.others.is_empty() {
            // All spheres fly, in the order of the world.
            let count = self.alone.len();
            between.add(time, states.map(|of| &of[..count]), at);
        } else {
            let state = |&place: &usize| self.state_of(place, states, time).into();
            let (positions, velocities): (Vec<DVec3>, Vec<DVec3>) =
                self.place_of.iter().map(state).unzip();
            let mut of_all = Values::of(positions.len());
            between.add(time, [&positions, &velocities], &mut of_all);
            for (index, &place) in self.place_of.iter().enumerate() {
                if place < self.alone.len() {
                    at.accelerations[place] += of_all.accelerations[index];
                    at.sizes[place] += of_all.sizes[index];
                }
            }
        }
        self.evaluations += between.cost();
        self.between = Some(between);
    }

    /// Follows springs through their changes, and no edges of forces, for a step of any length.
    pub fn ignore_changes(&mut self) {
        self.ties.iter_mut().for_each(|tie| *tie = tie.with_changes());
        self.alone.iter_mut().for_each(FreeField::ignore_edges);
    }

    /// The shortest time in which one of its spheres moves by its radius \[s\]; `None` if none does.
    pub fn brief(&mut self, [positions, velocities]: [&[DVec3]; 2], time: f64) -> Option<f64> {
        let mut values = Values::of(positions.len());
        self.evaluate(time, positions, velocities, &mut values);
        let of_each = self.alone.iter().zip(velocities).zip(values.accelerations);
        let times = of_each.map(|((alone, &velocity), acceleration)| {
            alone.time_of_a_radius(velocity, acceleration)
        });
        times.reduce(f64::min).filter(|time| time.is_finite() && *time > 0.0)
    }

    /// First time, from the start of a step \[s\], at which a spring changes how it acts; `None` if none does.
    pub fn first_change(&self, start: &Start, step: &Step) -> Option<f64> {
        let path = |place: usize| match self.others.get(place.wrapping_sub(self.alone.len())) {
            Some(&other) => {
                let body = &self.flights.bodies[other as usize];
                TiePath::Flight(body.flight_from(self.flights.species_of(other), start.time))
            }
            None => TiePath::Polynomial(PolynomialFlight {
                position: start.positions[place],
                velocity: start.velocities[place],
                acceleration: step.accelerations[place],
            }),
        };
        let changes = self.ties.iter().filter_map(|tie| {
            let second = match tie.second {
                TieEnd::Sphere(place) => path(place),
                TieEnd::Point(point) => TiePath::Point(point),
            };
            tie.change([path(tie.first), second], self.period, step.end - start.time)
        });
        changes.reduce(f64::min)
    }
}

impl JointField<'_> {
    /// Adds the accelerations of persistent contacts.
    pub fn add_contacts(&mut self, time: f64, states: [&[DVec3]; 2], at: &mut Values) {
        let moving = Moving::of(time, states, self.spheres.len());
        for contacts in &mut self.contacts {
            contacts.add(moving, &self.spheres, at);
        }
    }
}

impl Field for JointField<'_> {
    fn evaluate(&mut self, time: f64, positions: &[DVec3], velocities: &[DVec3], at: &mut Values) {
        self.evaluate_forces(time, positions, velocities, at);
        self.add_contacts(time, [positions, velocities], at);
    }

    fn evaluate_forces(
        &mut self,
        time: f64,
        positions: &[DVec3],
        velocities: &[DVec3],
        at: &mut Values,
    ) {
        let count = self.alone.len();
        self.evaluations += count as u64;
        at.accelerations[count..].fill(DVec3::ZERO);
        at.sizes[count..].fill(0.0);
        for (place, alone) in self.alone.iter().enumerate() {
            let (position, velocity) = (positions[place], velocities[place]);
            let (acceleration, size) = alone.acceleration_and_size(time, position, velocity);
            (at.accelerations[place], at.sizes[place]) = (acceleration, size);
        }
        let states = [positions, velocities];
        self.add_between(states, time, at);
        for tie in &self.ties {
            let [from, velocity] = self.state_of(tie.first, states, time);
            let [to, other] = self.state_at(tie.second, states, time);
            let pull = tie.pull([from, to], [velocity, other]);
            let second = match tie.second {
                TieEnd::Sphere(place) => Some((place, -pull)),
                TieEnd::Point(_) => None,
            };
            for (place, force) in [(tie.first, pull)].into_iter().chain(second) {
                if let Some(alone) = self.alone.get(place) {
                    let own = force / alone.mass;
                    at.accelerations[place] += own;
                    at.sizes[place] += own.norm();
                }
            }
        }
    }
}
