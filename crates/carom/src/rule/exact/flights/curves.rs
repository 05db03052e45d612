//! Curves: the flights of spheres under forces without a closed form, one step of an integrator after another.

use glam::DVec3;

use super::body::Body;
use super::components::Component;
use super::curve::{Curve, CurveStep};
use super::edge_crossing;
use super::free_field::FreeField;
use super::joint_field::JointField;
use super::species::Species;
use super::state::Flights;
use crate::contact_time::{PolynomialTrack, Track};
use crate::integrate::field::Start;
use crate::integrate::gauss_radau::{self, Pace, Step};
use crate::polynomial_flight::{PolynomialAcceleration, PolynomialFlight};
use crate::settings::nearest_image;
use crate::system::System;

/// Where forces are steady, a step lasts at most this many times the time in which a sphere moves by its radius,
/// since forces may differ farther away.
const STEADY_RADII: f64 = 16.0;

/// Most steps that are tried towards an edge of a force, where each finds it better than the one before.
const MOST_TRIALS: u32 = 4;

/// Bounds for the steps of curves.
#[derive(Debug, Clone, Copy)]
pub(crate) struct StepLimits {
    /// Time at which all steps have to end at the latest, on the world's clock \[s\].
    pub until: f64,
    /// When surfaces are where the system says, on the world's clock \[s\].
    pub surfaces_at: f64,
    /// Longest step where nothing is known of a force \[s\].
    pub tick: f64,
    /// Whether a step lasts a whole tick, whatever its error and however springs change within it.
    pub is_rough: bool,
}

impl StepLimits {
    /// The pace of a step after those of this pace.
    fn pace(&self, before: Pace) -> Pace {
        match self.is_rough {
            true => Pace { trial: before.trial.max(self.tick), shortest: self.tick },
            false => before,
        }
    }
}

/// Steps of the spheres of a component whose forces are not held.
#[derive(Default)]
pub(crate) struct JointStep {
    /// Curve of each sphere, by slot.
    pub curves: Vec<(u32, Curve)>,
    /// How often the forces on a sphere were evaluated.
    pub evaluations: u64,
    /// Units of work that the forces of contacts took.
    pub contact_work: u64,
    /// Angular accelerations of the spheres on which friction has a torque, by slot \[rad/s²\].
    pub turning: Vec<(u32, PolynomialAcceleration)>,
    /// Time at which a persistent contact of each cluster opens, on the world's clock \[s\];
    /// infinite if none does.
    pub releases: Vec<f64>,
    /// Whether its error is small.
    pub is_accurate: bool,
    /// Whether friction jams spheres, so that no forces hold their contacts.
    pub is_jammed: bool,
}

impl Flights {
    /// The polynomial flight of a sphere and its end on the world's clock \[s\]; `None` if its forces have a closed
    /// form or are held.
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
        let step = self.curves[self.index_of[slot as usize] as usize].0.as_deref();
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
        self.are_curved()
            && (self.components.has_companions(self.index_of[slot as usize])
                || self.cluster_on_curves(slot).is_some())
    }

    /// The number of the cluster of a sphere, if its spheres fly on curves.
    pub fn cluster_on_curves(&self, slot: u32) -> Option<u32> {
        let species = self.species_of(slot);
        species.cluster.filter(|_| species.is_curved)
    }

    /// The numbers of all components that clusters on curves connect with one, ascending, and of these clusters.
    pub fn connected_components(&self, number: u32) -> [Vec<u32>; 2] {
        let (mut components, mut clusters) = (vec![number], Vec::new());
        let mut next = 0;
        while let Some(&number) = components.get(next) {
            next += 1;
            for &index in &self.components.get(number).members {
                let cluster = self.cluster_on_curves(self.slot_of[index as usize]);
                let Some(cluster) = cluster.filter(|it| !clusters.contains(it)) else { continue };
                clusters.push(cluster);
                for &member in &self.clusters.get(cluster).members {
                    let other = self.components.of_sphere(self.index_of[member as usize]);
                    components.extend(other.filter(|it| !components.contains(it)));
                }
            }
        }
        components.sort_unstable();
        clusters.sort_unstable();
        [components, clusters]
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
        if !free.is_curved {
            return free;
        }
        let body = &self.bodies[slot as usize];
        match self.step_of(slot, body) {
            Some(step) => {
                let age = time - body.time;
                let acceleration =
                    step.held.as_deref().map_or(&step.acceleration, |held| &held.free).at(age);
                // Drag in closed form is no part of the acceleration of a species.
                let drag = free.drag_rate * self.state_on_curve(slot, time).1;
                Species { acceleration: acceleration + drag, ..free }
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
        let own = self.index_of[slot as usize];
        self.acceleration_among(system, slot, time, |index| match index == own {
            true => [position, velocity],
            false => self.state_of(self.slot_of[index as usize], time).into(),
        })
    }

    /// The acceleration \[m/s²\] without contact forces of the sphere at a slot where the spheres, by index, are in
    /// these states \[m\], \[m/s\] at `time` \[s\].
    pub fn acceleration_among(
        &self,
        system: &System,
        slot: u32,
        time: f64,
        state_of: impl Fn(u32) -> [DVec3; 2],
    ) -> DVec3 {
        let index = self.index_of[slot as usize];
        let field = FreeField::of(system, index as usize);
        let [position, velocity] = state_of(index);
        let alone = field.acceleration_and_size(time, position, velocity).0;
        if system.moves_all_together() {
            let states = (0..self.slot_of.len() as u32).map(|index| state_of(index).into());
            let (positions, velocities): (Vec<DVec3>, Vec<DVec3>) = states.unzip();
            let mut forces = Vec::new();
            system.forces_between([&positions, &velocities], time, &mut forces);
            return alone + forces[index as usize] / field.mass;
        }
        let Some(number) = self.components.of_sphere(index) else { return alone };
        let Component { members, springs, .. } = self.components.get(number);
        let state_of = |place: u32| state_of(members[place as usize]);
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

    /// The step of a component, with these clusters of its spheres, from the beginning of the flights of its members
    /// on.
    pub fn step_from_start(
        &self,
        system: &System,
        (component, clusters): (&Component, &[u32]),
        limits: StepLimits,
    ) -> JointStep {
        let mut field = JointField::of(system, self, component);
        let slots = std::mem::take(&mut field.flying);
        let Some(&first) = slots.first() else { return JointStep::default() };
        let bodies = slots.iter().map(|&slot| &self.bodies[slot as usize]);
        let (mut positions, mut velocities): (Vec<DVec3>, Vec<DVec3>) =
            bodies.map(|body| (body.position, body.velocity)).unzip();
        let time = self.bodies[first as usize].time;
        let times = [limits.surfaces_at, time];
        field.hold(system, (component, clusters), [&positions, &velocities], times);
        let count = slots.len();
        if field.has_friction() {
            // Angles from the start follow the centres.
            positions.resize(2 * count, DVec3::ZERO);
            velocities.extend(slots.iter().map(|&slot| self.angular_velocity_of(slot, time)));
        }
        let states = [&positions[..], &velocities[..]];
        field.begin(component, states, time);
        if limits.is_rough {
            field.ignore_changes();
        }
        let brief = field.brief(states, time).unwrap_or(limits.tick);
        let carried = self.left_by_last_steps((&slots, clusters), time, positions.len());
        let mut start = Start {
            positions: &positions,
            velocities: &velocities,
            carried: &carried,
            time,
            until: limits.until.min((time + field.smooth_for(time)).max(time.next_up())),
            steady: STEADY_RADII * brief,
            rough: limits.tick,
        };
        let before: Option<Vec<&CurveStep>> =
            slots.iter().map(|&slot| self.last_step(slot)).collect();
        let known_pace = shortest_pace(before.iter().flatten()).unwrap_or(Pace::of(brief));
        let pace = limits.pace(known_pace);
        field.choose_friction(states, time, pace.trial);
        // A rough step may be of any length.
        let before = before.filter(|_| !limits.is_rough);
        let turned = if positions.len() > count { &slots[..] } else { &[] };
        let before = before.and_then(|steps| self.accelerations_up_to(&steps, turned, time));
        let (step, of_edge) = step_to_an_edge(&mut start, before.as_deref(), pace, &mut field);
        let held = field.held_over(&start, &step);
        let releases = held.releases.into_iter().map(|release| time + release).collect();
        let of_friction = Some(held.change).filter(|it| it.is_finite() && !limits.is_rough);
        let changes = [field.first_change(&start, &step), of_friction, of_edge];
        let change = changes.into_iter().flatten().reduce(f64::min);
        let end = change.map_or(step.end, |it| (time + it).clamp(time.next_up(), step.end));
        let turning = |&place: &usize| (slots[place], step.accelerations[count + place]);
        // A rough step says nothing of the next one.
        let pace = if limits.is_rough { known_pace } else { step.pace };
        let mut held_curves = held.curves.into_iter();
        let curve_of = |(&slot, acceleration): (&u32, PolynomialAcceleration)| {
            let Body { position, velocity, generation, .. } = self.bodies[slot as usize];
            let flight = PolynomialFlight { position, velocity, acceleration };
            let left = flight.left_after(end - time);
            let (is_smooth, held) = (change.is_none(), held_curves.next().map(Box::new));
            let step = CurveStep { generation, acceleration, end, is_smooth, pace, left, held };
            (slot, Curve(Some(Box::new(step))))
        };
        JointStep {
            turning: field.turned().iter().map(turning).collect(),
            curves: slots.iter().zip(step.accelerations).map(curve_of).collect(),
            evaluations: field.evaluations,
            contact_work: field.contacts.iter().map(|it| it.work).sum(),
            releases,
            is_accurate: step.is_accurate,
            is_jammed: held.is_jammed,
        }
    }

    /// The parts of the states \[m\], \[m/s\] that the last steps of spheres left to the next ones, where they led to
    /// `time` \[s\]; none for the others of `count`, or where contacts keep the gaps of the states as they are.
    fn left_by_last_steps(
        &self,
        (slots, clusters): (&[u32], &[u32]),
        time: f64,
        count: usize,
    ) -> Vec<[DVec3; 2]> {
        let left_by = |&slot: &u32| {
            let last = self.last_step(slot).filter(|step| step.end == time);
            last.map_or([DVec3::ZERO; 2], |step| step.left)
        };
        let flying = if clusters.is_empty() { slots } else { &[] };
        let mut left: Vec<[DVec3; 2]> = flying.iter().map(left_by).collect();
        left.resize(count, [DVec3::ZERO; 2]);
        left
    }

    /// The accelerations over steps, and behind them the angular ones of these spheres: they predict a step from `time`
    /// \[s\] on, if no event was between.
    fn accelerations_up_to(
        &self,
        steps: &[&CurveStep],
        turned: &[u32],
        time: f64,
    ) -> Option<Vec<PolynomialAcceleration>> {
        if !steps.iter().all(|step| step.leads_to(time)) {
            return None;
        }
        let of_centres = steps.iter().map(|step| step.acceleration);
        let turning = turned.iter().zip(steps);
        Some(of_centres.chain(turning.map(|(&slot, step)| self.turning_over(slot, step))).collect())
    }

    /// The angular acceleration of a sphere over its last step.
    fn turning_over(&self, slot: u32, step: &CurveStep) -> PolynomialAcceleration {
        let length = step.acceleration.length;
        let rotation = self.rotations.get(self.index_of[slot as usize] as usize);
        let known = rotation.and_then(|rotation| rotation.last_step(length));
        known.cloned().unwrap_or(PolynomialAcceleration::none(length))
    }

    /// The last step of a sphere on a curve, even if its flight ended early.
    fn last_step(&self, slot: u32) -> Option<&CurveStep> {
        self.curves[self.index_of[slot as usize] as usize].0.as_deref()
    }

    /// The rest of a sphere's step, if a flight that begins at `time` \[s\] in this state \[m\], \[m/s\] continues
    /// it: if the step has the same state there.
    pub fn rest_of_step(&self, slot: u32, state: [DVec3; 2], time: f64) -> Option<Curve> {
        let body = &self.bodies[slot as usize];
        let step = self.step_of(slot, body).filter(|step| time < step.end)?;
        let goes_on = <[DVec3; 2]>::from(self.state_on_curve(slot, time)) == state;
        let age = time - body.time;
        let acceleration = step.acceleration.from(age);
        let held = step.held.as_deref().map(|held| Box::new(held.from(age)));
        let left = [DVec3::ZERO; 2];
        goes_on
            .then(|| Curve(Some(Box::new(CurveStep { acceleration, held, left, ..step.clone() }))))
    }

    /// Continues a sphere's new flight along the rest of a step.
    pub fn set_rest_of_step(&mut self, slot: u32, mut rest: Curve) {
        if let Some(step) = &mut rest.0 {
            step.generation = self.bodies[slot as usize].generation;
        }
        self.curves[self.index_of[slot as usize] as usize] = rest;
    }

    /// Ends the flight of a sphere, whose persistent contacts end.
    pub(super) fn end_curve(&mut self, slot: u32) {
        self.curves[self.index_of[slot as usize] as usize].end();
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

/// Takes a step that ends at the first edge of a force that a sphere passes, if it reaches one: what is beyond has no part
/// in it. Returns also the time \[s\] from the start at which it still passes one.
fn step_to_an_edge(
    start: &mut Start,
    before: Option<&[PolynomialAcceleration]>,
    pace: Pace,
    field: &mut JointField,
) -> (Step, Option<f64>) {
    let mut trials = 0;
    loop {
        let step = gauss_radau::step(start, before, pace, field);
        let crossing = edge_crossing::first_crossing(&field.alone, start, &step);
        let until = crossing.map(|it| (start.time + it).max(start.time.next_up()));
        match until.filter(|&until| until < step.end && trials < MOST_TRIALS) {
            Some(until) => start.until = until,
            None => return (step, crossing),
        }
        trials += 1;
    }
}

/// The pace of the shortest trial among steps.
fn shortest_pace<'a>(steps: impl Iterator<Item = &'a &'a CurveStep>) -> Option<Pace> {
    steps.map(|step| step.pace).reduce(|a, b| if b.trial < a.trial { b } else { a })
}
