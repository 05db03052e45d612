//! Curves: the flights of spheres under forces without a closed form, one step of an integrator after another.

use glam::DVec3;

use super::between::ForcesBetween;
use super::body::Body;
use super::components::{Component, PlacedSpring};
use super::curve::{Curve, CurveStep};
use super::species::Species;
use super::state::Flights;
use super::tie::{Tie, TieEnd, TiePath};
use crate::contact_time::{PolynomialTrack, Track};
use crate::forces::{self, Force, SphereState, SpringEnd};
use crate::integrate::gauss_radau::{self, Field, Pace, Start, Step, Values};
use crate::norm::Norm;
use crate::polynomial_flight::{PolynomialAcceleration, PolynomialFlight};
use crate::settings::nearest_image;
use crate::system::System;

/// Where forces are steady, a step lasts at most this many times the time in which a sphere moves by its radius,
/// since forces may differ farther away.
const STEADY_RADII: f64 = 16.0;

/// Bounds for the steps of curves.
#[derive(Debug, Clone, Copy)]
pub(crate) struct StepLimits {
    /// When all of them have to end at the latest, on the world's clock \[s\].
    pub until: f64,
    /// Longest step where nothing is known of a force \[s\].
    pub tick: f64,
    /// Whether a step lasts a whole tick, whatever its error and however springs change within it.
    pub is_rough: bool,
}

/// Steps of the spheres of a component that have no persistent contacts.
pub(crate) struct JointStep {
    /// Of each sphere, by slot.
    pub curves: Vec<(u32, Curve)>,
    /// How often the forces on a sphere were evaluated.
    pub evaluations: u64,
}

impl Flights {
    /// The polynomial flight of a sphere and its end on the world's clock \[s\]; `None` if its forces have a closed
    /// form or it has persistent contacts.
    pub fn curve_of(&self, slot: u32) -> Option<(PolynomialFlight, f64)> {
        let body = &self.bodies[slot as usize];
        let step = self.step_of(slot, body)?;
        let Body { position, velocity, .. } = *body;
        Some((PolynomialFlight { position, velocity, acceleration: step.acceleration }, step.end))
    }

    /// End of the sphere's present step, on the world's clock \[s\]; infinite if it is in none.
    #[inline]
    pub fn step_end(&self, slot: u32) -> f64 {
        let body = &self.bodies[slot as usize];
        self.step_of(slot, body).map_or(f64::INFINITY, |step| step.end)
    }

    pub(super) fn step_of(&self, slot: u32, body: &Body) -> Option<&CurveStep> {
        if !self.species[body.species as usize].is_curved {
            return None;
        }
        let step = self.curves[self.index_of[slot as usize] as usize].0.as_ref();
        step.filter(|step| step.generation == body.generation)
    }

    /// The component of a sphere, by its number, if its step must be computed before the sphere can be predicted.
    pub fn unknown_component_of(&self, slot: u32) -> Option<u32> {
        let body = &self.bodies[slot as usize];
        if !self.species[body.species as usize].is_curved {
            return None;
        }
        let number = self.components.of_sphere(self.index_of[slot as usize])?;
        let is_known = self.step_of(slot, body).is_some() && !self.components.is_due(number);
        (!is_known).then_some(number)
    }

    /// Whether a sphere takes its steps together with others.
    #[inline]
    pub fn has_companions(&self, slot: u32) -> bool {
        self.are_curved() && self.components.has_companions(self.index_of[slot as usize])
    }

    /// Centre \[m\] and velocity \[m/s\] of a sphere on a curve at `time` \[s\].
    #[inline(never)]
    pub(super) fn state_on_curve(&self, slot: u32, time: f64) -> (DVec3, DVec3) {
        let body = &self.bodies[slot as usize];
        match self.curve_of(slot) {
            Some((flight, _)) => flight.after(time - body.time),
            // An event has just ended its flight.
            None => body.state_at(&self.species[body.species as usize], time),
        }
    }

    /// The path of a sphere from `time` \[s\] on.
    pub fn track_from(&self, slot: u32, time: f64) -> Track {
        let body = &self.bodies[slot as usize];
        match self.curve_of(slot) {
            Some((flight, _)) => {
                Track::Polynomial(Box::new(PolynomialTrack::new(flight, time - body.time)))
            }
            None => Track::Flight(body.flight_from(self.species_of(slot), time)),
        }
    }

    /// The species of a sphere without the forces of its persistent contacts, at `time` \[s\].
    pub fn free_species_at(&self, slot: u32, time: f64) -> Species {
        let free = *self.free_species_of(slot);
        match self.curve_of(slot) {
            Some((flight, _)) => {
                let body = &self.bodies[slot as usize];
                let age = time - body.time;
                // Drag in closed form is no part of the acceleration of a species.
                let drag = free.drag_rate * flight.after(age).1;
                Species { acceleration: flight.acceleration.at(age) + drag, ..free }
            }
            None => free,
        }
    }

    /// The acceleration \[m/s²\] without contact forces of the sphere at a slot at `time` \[s\] in this state
    /// \[m\], \[m/s\], with the others where they are.
    pub fn acceleration_of(
        &self,
        system: &System,
        slot: u32,
        [position, velocity]: [DVec3; 2],
        time: f64,
    ) -> DVec3 {
        let index = self.index_of[slot as usize];
        let field = FreeField::of(system, index as usize);
        let alone = field.acceleration_and_size(time, position, velocity).0;
        if system.moves_all_together() {
            let state = [position, velocity];
            return alone + self.force_between(system, index, state, time) / field.mass;
        }
        let Some(number) = self.components.of_sphere(index) else { return alone };
        let Component { members, springs, .. } = self.components.get(number);
        let state_of = |place: u32| match members[place as usize] {
            this if this == index => [position, velocity],
            other => self.state_of(self.slot_of[other as usize], time).into(),
        };
        let period = system.settings.boundary.period();
        springs.iter().fold(alone, |sum, placed| {
            let ends = [Some(placed.first), placed.second];
            let is_at = |end: Option<u32>| end.is_some_and(|it| members[it as usize] == index);
            if !ends.into_iter().any(is_at) {
                return sum;
            }
            let states = [state_of(placed.first), placed.state_of_second(state_of)];
            let [[from, velocity], [to, other]] = states;
            let offset = nearest_image(to - from, period);
            let sign = if is_at(ends[0]) { 1.0 } else { -1.0 };
            sum + sign * placed.spring.pull(offset, other - velocity) / field.mass
        })
    }

    /// Force \[N\] between a sphere, by its index, and all others at `time` \[s\], with this sphere in a given state \[m\],
    /// \[m/s\].
    fn force_between(
        &self,
        system: &System,
        index: u32,
        [position, velocity]: [DVec3; 2],
        time: f64,
    ) -> DVec3 {
        let states = self.slot_of.iter().map(|&slot| self.state_of(slot, time));
        let (mut positions, mut velocities): (Vec<DVec3>, Vec<DVec3>) = states.unzip();
        (positions[index as usize], velocities[index as usize]) = (position, velocity);
        let mut forces = Vec::new();
        system.forces_between([&positions, &velocities], time, &mut forces);
        forces[index as usize]
    }

    /// The step of a component, by its number, from the beginning of the flights of its members on.
    pub fn step_from_start(&self, system: &System, number: u32, limits: StepLimits) -> JointStep {
        let component = self.components.get(number);
        let mut field = JointField::of(system, self, component);
        let slots = std::mem::take(&mut field.flying);
        let Some(&first) = slots.first() else {
            return JointStep { curves: Vec::new(), evaluations: 0 };
        };
        let bodies: Vec<&Body> = slots.iter().map(|&slot| &self.bodies[slot as usize]).collect();
        let positions: Vec<DVec3> = bodies.iter().map(|body| body.position).collect();
        let velocities: Vec<DVec3> = bodies.iter().map(|body| body.velocity).collect();
        let time = self.bodies[first as usize].time;
        field.begin(component, [&positions, &velocities], time);
        if limits.is_rough {
            field.ties.iter_mut().for_each(|tie| *tie = tie.with_changes());
        }
        let brief = field.brief([&positions, &velocities], time).unwrap_or(limits.tick);
        // A close passage of two spheres multiplies the rounding of their places.
        let may_be_close = field.between.is_some();
        let carried = |&slot: &u32| match self.last_step(slot) {
            Some(step) if may_be_close && step.end == time => step.left,
            _ => [DVec3::ZERO; 2],
        };
        let carried: Vec<[DVec3; 2]> = slots.iter().map(carried).collect();
        let start = Start {
            positions: &positions,
            velocities: &velocities,
            carried: &carried,
            time,
            until: limits.until,
            steady: STEADY_RADII * brief,
            rough: limits.tick,
        };
        let before: Option<Vec<&CurveStep>> =
            slots.iter().map(|&slot| self.last_step(slot)).collect();
        let paces = before.iter().flatten().map(|step| step.pace);
        let shorter = |a: Pace, b: Pace| if b.trial < a.trial { b } else { a };
        let mut pace = paces.reduce(shorter).unwrap_or(Pace::of(brief));
        if limits.is_rough {
            pace = Pace { trial: pace.trial.max(limits.tick), shortest: limits.tick };
        }
        // The last step predicts this one only if no event was between, and if it was no rough step, which may be
        // of any length.
        let leads_here = |step: &&CurveStep| !limits.is_rough && step.leads_to(time);
        let continues = before.filter(|steps| steps.iter().all(leads_here));
        let before: Option<Vec<PolynomialAcceleration>> =
            continues.map(|steps| steps.iter().map(|step| step.acceleration).collect());
        let step = gauss_radau::step(&start, before.as_deref(), pace, &mut field);
        let change = field.first_change(&start, &step);
        let end =
            change.map_or(step.end, |change| (time + change).max(time.next_up()).min(step.end));
        let curve_of = |(body, acceleration): (&&Body, PolynomialAcceleration)| {
            let Body { position, velocity, generation, .. } = **body;
            let flight = PolynomialFlight { position, velocity, acceleration };
            let (left, pace) = (flight.left_after(end - time), step.pace);
            CurveStep { generation, acceleration, end, is_smooth: change.is_none(), pace, left }
        };
        let steps = bodies.iter().zip(step.accelerations).map(curve_of);
        let curves = slots.iter().copied().zip(steps.map(|step| Curve(Some(step)))).collect();
        JointStep { curves, evaluations: field.evaluations }
    }

    /// The last step of a sphere on a curve, even if its flight ended early.
    fn last_step(&self, slot: u32) -> Option<&CurveStep> {
        self.curves[self.index_of[slot as usize] as usize].0.as_ref()
    }

    /// The rest of a sphere's step, if a flight that begins at `time` \[s\] in this state \[m\], \[m/s\] continues
    /// it: if the step has the same state there.
    pub fn rest_of_step(&self, slot: u32, state: [DVec3; 2], time: f64) -> Option<Curve> {
        let body = &self.bodies[slot as usize];
        let step = self.step_of(slot, body).filter(|step| time < step.end)?;
        let goes_on = <[DVec3; 2]>::from(self.state_on_curve(slot, time)) == state;
        let acceleration = step.acceleration.from(time - body.time);
        let left = [DVec3::ZERO; 2];
        goes_on.then(|| Curve(Some(CurveStep { acceleration, left, ..step.clone() })))
    }

    /// Continues a sphere's new flight along the rest of a step.
    pub fn set_rest_of_step(&mut self, slot: u32, mut rest: Curve) {
        if let Some(step) = &mut rest.0 {
            step.generation = self.bodies[slot as usize].generation;
        }
        self.curves[self.index_of[slot as usize] as usize] = rest;
    }

    /// Sets the step of a sphere. A sphere whose forces are not finite is noted as lost.
    pub fn set_curve(&mut self, slot: u32, mut curve: Curve) {
        let index = self.index_of[slot as usize];
        if let Some(step) = &mut curve.0
            && !step.acceleration.is_finite()
        {
            self.lost = Some(index);
            step.acceleration = PolynomialAcceleration::none(step.acceleration.length);
        }
        self.curves[index as usize] = curve;
    }
}

/// Time in which a sphere moves by its radius \[s\].
fn time_of_a_radius(radius: f64, velocity: DVec3, acceleration: DVec3) -> f64 {
    let by_speed = radius / velocity.norm();
    by_speed.min((2.0 * radius / acceleration.norm()).sqrt())
}

/// The forces on one sphere.
pub(crate) struct FreeField<'a> {
    /// Constant acceleration \[m/s²\].
    uniform: DVec3,
    /// \[1/s\]
    drag_rate: f64,
    radius: f64,
    mass: f64,
    /// Forces that are not linear.
    others: Vec<&'a dyn Force>,
}

impl<'a> FreeField<'a> {
    /// The forces on the sphere with this index of the world's arrays.
    pub fn of(system: &System<'a>, index: usize) -> Self {
        let (radius, mass) = (system.spheres.radius[index], system.spheres.mass[index]);
        let (linear, _) = forces::total_linear(system.forces, radius, mass);
        let applied = system.spheres.applied_acceleration(index).unwrap_or(DVec3::ZERO);
        Self {
            uniform: linear.acceleration + applied,
            drag_rate: linear.drag_rate,
            radius,
            mass,
            others: forces::without_linear_form(system.forces, radius, mass),
        }
    }

    fn acceleration_and_size(&self, time: f64, position: DVec3, velocity: DVec3) -> (DVec3, f64) {
        let Self { uniform, drag_rate, radius, mass, .. } = *self;
        let state = SphereState { position, velocity, radius, mass };
        let start = (uniform - drag_rate * velocity, uniform.norm() + drag_rate * velocity.norm());
        self.others.iter().fold(start, |(sum, size), force| {
            let own = force.on(&state, time) / mass;
            (sum + own, size + own.norm())
        })
    }
}

/// The forces on the spheres of a component that have no persistent contacts.
struct JointField<'a> {
    flights: &'a Flights,
    /// Slots of the spheres that it acts on.
    flying: Vec<u32>,
    /// Forces on each sphere by itself.
    alone: Vec<FreeField<'a>>,
    /// Slots of the other members, whose motion is given.
    others: Vec<u32>,
    /// Place of each member in `flying` followed by `others`.
    place_of: Vec<usize>,
    /// Springs between those places.
    ties: Vec<Tie<'a>>,
    /// Forces between all spheres of the world, where all are members.
    between: Option<ForcesBetween<'a>>,
    period: DVec3,
    /// How often the forces on a sphere were evaluated.
    evaluations: u64,
}

impl<'a> JointField<'a> {
    /// The field without its ties.
    fn of(system: &System<'a>, flights: &'a Flights, component: &Component) -> Self {
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
        let field = |&slot: &u32| FreeField::of(system, flights.index_of[slot as usize] as usize);
        Self {
            flights,
            alone: flying.iter().map(field).collect(),
            flying,
            others,
            place_of,
            ties: Vec::new(),
            between: ForcesBetween::of(system),
            period: system.settings.boundary.period(),
            evaluations: 0,
        }
    }

    /// Begins a step with the spheres in these states \[m\], \[m/s\] at a time \[s\].
    fn begin(&mut self, component: &'a Component, states: [&[DVec3]; 2], time: f64) {
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
        match self.others.get(place.wrapping_sub(positions.len())) {
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
            between.add(time, states, at);
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

    /// The shortest time in which one of its spheres moves by its radius \[s\]; `None` if none does.
    fn brief(&mut self, [positions, velocities]: [&[DVec3]; 2], time: f64) -> Option<f64> {
        let mut values = Values::of(positions.len());
        self.evaluate(time, positions, velocities, &mut values);
        let of_each = self.alone.iter().zip(velocities).zip(values.accelerations);
        let times = of_each.map(|((alone, &velocity), acceleration)| {
            time_of_a_radius(alone.radius, velocity, acceleration)
        });
        times.reduce(f64::min).filter(|time| time.is_finite() && *time > 0.0)
    }

    /// First time, from the start of a step \[s\], at which a spring changes how it acts; `None` if none does.
    fn first_change(&self, start: &Start, step: &Step) -> Option<f64> {
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

impl Field for JointField<'_> {
    fn evaluate(&mut self, time: f64, positions: &[DVec3], velocities: &[DVec3], at: &mut Values) {
        self.evaluations += self.alone.len() as u64;
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
