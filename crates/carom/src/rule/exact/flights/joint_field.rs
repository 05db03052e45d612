//! The forces on spheres that take their steps together.

use glam::DVec3;

use super::between::ForcesBetween;
use super::components::{Component, PlacedSpring};
use super::curve_contacts::{ContactSphere, CurveBody, CurveContact, CurveContacts, Moving};
use super::free_field::FreeField;
use super::friction_choice::OPENS;
use super::friction_state::FrictionState;
use super::image_beside::{shift_beside_sphere, shift_beside_surface};
use super::species::Species;
use super::state::Flights;
use super::tie::{Tie, TieEnd, TiePath};
use crate::detect::contact::Bodies;
use crate::forces::SpringEnd;
use crate::integrate::crossing::first_positive;
use crate::integrate::field::{Field, Start, Values};
use crate::integrate::gauss_radau::{self, NODES, Step};
use crate::norm::Norm;
use crate::polynomial_flight::{ORDERS, PolynomialAcceleration, PolynomialFlight, TERMS};
use crate::respond::friction_of;
use crate::rule::exact::features::{Feature, time_on_curve};
use crate::surface::Form;
use crate::system::System;

/// Part of a step after which a contact that pulls from the start opens, and a sphere at the end of a face leaves it.
const SOONEST: f64 = 1e-6;

/// What persistent contacts do in a step.
pub(super) struct HeldOver {
    /// Accelerations without contacts, by place; empty without contacts.
    pub free: Vec<PolynomialAcceleration>,
    /// Time from the start \[s\] at which a contact of each cluster opens, or a sphere reaches
    /// another part of a surface; infinite where none does.
    pub releases: Vec<f64>,
    /// Time from the start \[s\] at which friction changes how it acts in a contact; infinite if it does not.
    pub change: f64,
    /// Whether friction jams spheres, so that no forces hold their contacts.
    pub is_jammed: bool,
}

/// A bound of what a contact can do.
struct Bound {
    /// Place of its cluster, if the contact opens there; else friction changes how it acts.
    opens: Option<usize>,
    least: f64,
    /// What is bounded, at the nodes of a step.
    values: [f64; TERMS],
}

/// The motion of some spheres, whose angles follow their centres.
fn moving<'a>([positions, velocities]: [&'a [DVec3]; 2], count: usize) -> Moving<'a> {
    let (velocities, angular_velocities) = velocities.split_at(count);
    Moving { positions: &positions[..count], velocities, angular_velocities }
}

/// A surface at rest that a sphere touches.
struct Touched<'a> {
    /// Place of its cluster.
    cluster: usize,
    /// Place of the sphere.
    sphere: usize,
    /// Shift from the centre of the sphere to its image beside the surface \[m\].
    shift: DVec3,
    form: &'a Form,
    /// Whether the sphere is on a ring of the surface.
    is_on_ring: bool,
}

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
    spheres: Vec<ContactSphere>,
    /// Persistent contacts between those places; those of different clusters have no sphere in common.
    pub contacts: Vec<CurveContacts>,
    /// Surfaces at rest that spheres touch.
    touched: Vec<Touched<'a>>,
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

    /// Adds the persistent contacts of clusters, of spheres in these states \[m\], \[m/s\].
    pub fn hold(
        &mut self,
        system: &System<'a>,
        (component, clusters): (&Component, &[u32]),
        [positions, velocities]: [&[DVec3]; 2],
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
                        let form = &system.surfaces[surface as usize].form;
                        let shift = shift_beside_surface(form, positions[second], self.period);
                        let sides: Vec<DVec3> = held.sides_of(bodies).collect();
                        let is_on_ring = !sides.is_empty();
                        touched.push(Touched { cluster, sphere: second, shift, form, is_on_ring });
                        let of_sides = sides.iter().map(|&side| Feature::side_of(form, side));
                        let state = [positions[second] + shift, velocities[second]];
                        let under = || Feature::under(form, state, self.alone[second].radius);
                        let of_all = if is_on_ring { None } else { Some(under()) };
                        let features = of_sides.chain(of_all).flatten();
                        features.for_each(|it| add(CurveBody::Feature(it), second, shift));
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
            let moving = moving([positions, velocities], self.spheres.len());
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
    /// Follows the persistent contacts over a step.
    pub fn held_over(&mut self, start: &Start, step: &Step) -> HeldOver {
        if self.contacts.is_empty() {
            let (free, releases) = (Vec::new(), Vec::new());
            return HeldOver { free, releases, change: f64::INFINITY, is_jammed: false };
        }
        let count = self.alone.len();
        let length = step.accelerations[0].length;
        let mut free = vec![[DVec3::ZERO; TERMS]; count];
        let mut bounds = Vec::new();
        let mut is_jammed = false;
        for (node, &s) in NODES.iter().enumerate() {
            let state = |place: usize| {
                let (position, velocity) = (start.positions[place], start.velocities[place]);
                let acceleration = step.accelerations[place];
                PolynomialFlight { position, velocity, acceleration }.after(s * length)
            };
            let all = 0..step.accelerations.len();
            let (positions, velocities): (Vec<DVec3>, Vec<DVec3>) = all.map(state).unzip();
            let mut values = Values::of(positions.len());
            self.evaluate_forces(start.time + s * length, &positions, &velocities, &mut values);
            free.iter_mut().zip(&values.accelerations).for_each(|(free, &at)| free[node] = at);
            self.add_contacts([&positions, &velocities], &mut values);
            is_jammed |= self.contacts.iter().any(CurveContacts::are_jammed);
            let states = [&positions[..], &velocities[..]];
            if node == 0 {
                bounds = self.bounds(&values);
            }
            let at_node = self.margins(states);
            bounds.iter_mut().zip(at_node).for_each(|(bound, at)| bound.values[node] = at);
        }
        let carried = [DVec3::ZERO; 2];
        let polynomial = |values: [DVec3; TERMS]| {
            let coefficients = gauss_radau::through_nodes(values);
            let through_all = PolynomialAcceleration { length, coefficients, carried };
            if through_all.is_finite() {
                return through_all;
            }
            // A rough step reaches to where forces are not finite.
            let mut coefficients = [DVec3::ZERO; TERMS];
            coefficients[0] = values[0];
            PolynomialAcceleration { length, coefficients, carried }
        };
        let free = free.into_iter().map(polynomial).collect();
        let mut releases = vec![f64::INFINITY; self.contacts.len()];
        let mut change = f64::INFINITY;
        for Bound { opens, least, values } in bounds {
            let part = first_below(gauss_radau::through_nodes(values), least);
            let time = part.map_or(f64::INFINITY, |part| part * length);
            let first = opens.map_or(&mut change, |cluster| &mut releases[cluster]);
            *first = first.min(time);
        }
        for &Touched { cluster, sphere, shift, form, is_on_ring } in &self.touched {
            let (position, velocity) = (start.positions[sphere] + shift, start.velocities[sphere]);
            let acceleration = step.accelerations[sphere];
            let flight = PolynomialFlight { position, velocity, acceleration };
            let time = time_on_curve(form, &flight, is_on_ring);
            if time < length {
                releases[cluster] = releases[cluster].min(time.max(SOONEST * length));
            }
        }
        HeldOver { free, releases, change, is_jammed }
    }

    /// The bounds of what contacts can do, at the start of a step with these accelerations \[m/s²\].
    fn bounds(&self, at: &Values) -> Vec<Bound> {
        let mut bounds = Vec::new();
        for (cluster, contacts) in self.contacts.iter().enumerate() {
            let bound = |opens, least: f64| Bound { opens, least, values: [0.0; TERMS] };
            for (number, contact) in contacts.contacts.iter().enumerate() {
                let second = contact.second;
                let least = OPENS * self.alone[second].mass * at.sizes[second];
                bounds.push(bound(Some(cluster), -least));
                match contacts.states[number] {
                    FrictionState::None => {}
                    FrictionState::Rolls => bounds.push(bound(None, 0.0)),
                    FrictionState::Slides { most_back, most, .. } => {
                        bounds.push(bound(None, -most_back));
                        if most < f64::INFINITY {
                            bounds.push(bound(None, -most));
                        }
                    }
                }
            }
        }
        bounds
    }

    /// How far all contacts are from what they can do, in the order of their bounds: the normal force \[N\], then what
    /// friction may add \[N\], or the slip along its first direction \[m/s\].
    fn margins(&self, states: [&[DVec3]; 2]) -> Vec<f64> {
        let moving = moving(states, self.spheres.len());
        let mut margins = Vec::new();
        for contacts in &self.contacts {
            for (number, &state) in contacts.states.iter().enumerate() {
                margins.push(contacts.forces[number].0);
                match state {
                    FrictionState::None => {}
                    FrictionState::Rolls => margins.push(contacts.margin_of_rolling(number)),
                    FrictionState::Slides { direction, most, .. } => {
                        let slip = contacts.slip(number, moving, &self.spheres).dot(direction);
                        margins.push(slip);
                        if most < f64::INFINITY {
                            margins.push(-slip);
                        }
                    }
                }
            }
        }
        margins
    }

    /// Adds the accelerations of persistent contacts.
    fn add_contacts(&mut self, states: [&[DVec3]; 2], at: &mut Values) {
        let moving = moving(states, self.spheres.len());
        for contacts in &mut self.contacts {
            contacts.add(moving, &self.spheres, at);
        }
    }
}

impl Field for JointField<'_> {
    fn evaluate(&mut self, time: f64, positions: &[DVec3], velocities: &[DVec3], at: &mut Values) {
        self.evaluate_forces(time, positions, velocities, at);
        self.add_contacts([positions, velocities], at);
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

/// First `s` in `[0, 1]` at which a polynomial is below a bound, a moment later at least than 0.
fn first_below(coefficients: [f64; TERMS], bound: f64) -> Option<f64> {
    let value = |s: f64| coefficients.iter().rev().fold(0.0, |sum, c| sum * s + c);
    let slope = |s: f64| {
        let terms = coefficients.iter().zip(ORDERS).skip(1).rev();
        terms.fold(0.0, |sum, (c, k)| sum * s + k * c)
    };
    if value(0.0) < bound {
        return Some(SOONEST);
    }
    let terms = coefficients.iter().zip(ORDERS);
    let curvature = terms.map(|(c, k)| k * (k - 1.0).max(0.0) * c.abs()).sum();
    first_positive(|s| [bound - value(s), -slope(s)], curvature, 1.0)
}
