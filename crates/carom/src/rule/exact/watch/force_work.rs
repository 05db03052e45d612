//! Work of forces along the flights of spheres: of nonconservative ones, and of held ones beyond their potentials.

use glam::DVec3;

use super::seen::Seen;
use super::watched_spring::WatchedSpring;
use crate::bodies::Properties;
use crate::flight::Flight;
use crate::force_work::ForceWork;
use crate::forces::{self, SphereState};
use crate::integrate::gauss_legendre::integral;
use crate::sensor::FlightSegment;
use crate::shear::Shear;
use crate::system::System;

/// Work of forces during a watch.
#[derive(Debug, Clone, Default)]
pub(crate) struct ForceTally {
    pub work: ForceWork,
    springs: Vec<WatchedSpring>,
    /// Numbers of the springs at each sphere, by its index; empty without springs.
    springs_at: Vec<Vec<u32>>,
    /// Time up to which the work of interactions is counted, on the world's clock \[s\]; `None` where it is not.
    interactions_until: Option<f64>,
}

impl ForceTally {
    /// Starts to count for all springs and interactions at `now` \[s\], and keeps the work so far.
    pub fn restart(&mut self, system: &System, now: f64) {
        let are_watched = system.has_nonconservative_interactions() || system.moves_all_together();
        self.interactions_until = are_watched.then_some(now);
        self.springs.clear();
        self.springs_at.clear();
        let holds_all = system.holds_forces_of_all();
        for spring in system.springs().filter(|it| it.damping > 0.0 || !holds_all) {
            let Some(spring) = WatchedSpring::of(*spring, system, now) else { continue };
            self.springs_at.resize(system.spheres.id.len(), Vec::new());
            let number = self.springs.len() as u32;
            spring.ends().for_each(|end| self.springs_at[end as usize].push(number));
            self.springs.push(spring);
        }
    }

    /// Counts the work on a sphere along a segment of its flight, without that of springs and interactions.
    pub fn follow(&mut self, segment: &FlightSegment, seen: &Seen, system: &System) {
        if segment.to <= segment.from {
            return;
        }
        let Properties { applied_force, mass, .. } = system.spheres;
        let index = segment.index as usize;
        let [start, end] = [segment.from, segment.to].map(|time| segment.flight_from(time));
        let way = end.position - start.position;
        if let Some(shear) = Shear::of(system.settings) {
            let along = |state: &Flight| state.velocity.x - shear.velocity_at(state.position).x;
            let (before, after) = (along(&start), along(&end));
            self.work.shear += 0.5 * mass[index] * (after - before) * (after + before);
        }
        let (radius, mass) = (segment.radius, mass[index]);
        let state_of = |flight: &Flight| {
            let (position, velocity) = (flight.position, flight.velocity);
            SphereState { position, velocity, radius, mass }
        };
        if let Some(force) = seen.held_force {
            let potential = |flight, time| {
                forces::conservative_potential(system.forces, &state_of(flight), time)
            };
            let [before, after] = [potential(&start, segment.from), potential(&end, segment.to)];
            self.work.integration += force.dot(way) + after - before;
        }
        self.work.forces += seen.working_force.dot(way);
        if seen.is_stepped {
            return;
        }
        let applied = applied_force.get(index).map_or(0.0, |force| force.dot(way));
        self.work.applied += applied;
        let state_at = |time: f64| state_of(&segment.flight_from(time));
        let range = [segment.from, segment.to];
        if segment.curve.is_some() {
            if forces::are_conservative(system.forces) {
                return;
            }
            self.work.forces += integral(range, |time| {
                let state = state_at(time);
                forces::total_nonconservative(system.forces, &state, time).dot(state.velocity)
            });
            return;
        }
        // In a flight `x'' = a - γ x'` the work of drag is the gain of kinetic energy less the work of a.
        let (linear, is_all) = forces::nonconservative_linear(system.forces, radius, mass);
        self.work.forces += mass * linear.acceleration.dot(way);
        if segment.flight.drag_rate > 0.0 {
            let gained = end.velocity - start.velocity;
            let gained = 0.5 * gained.dot(end.velocity + start.velocity);
            self.work.forces += mass * (gained - segment.flight.acceleration.dot(way));
        }
        if !is_all {
            let work = integral(range, |time| {
                let state = state_at(time);
                forces::nonconservative_others(system.forces, &state, time).dot(state.velocity)
            });
            self.work.forces += work;
            if seen.held_force.is_some() {
                self.work.integration -= work;
            }
        }
    }

    /// Counts the work of the springs at a sphere up to `now` \[s\], along the flights that were seen.
    pub fn follow_springs(&mut self, index: u32, seen: &[Seen], system: &System, now: f64) {
        let Some(numbers) = self.springs_at.get(index as usize) else { return };
        for &number in numbers {
            self.work += self.springs[number as usize].work_until(now, seen, system);
        }
    }

    /// Counts the work of interactions up to `now` \[s\], along the flights that were seen: that of nonconservative ones
    /// on spheres that fly on curves, since the forces on other spheres are held, and what held forces did beyond the
    /// conservative ones.
    pub fn follow_interactions(&mut self, seen: &[Seen], system: &System, now: f64) {
        let Some(until) = self.interactions_until.filter(|&until| until < now) else { return };
        self.interactions_until = Some(now);
        let is_any_curved = seen.iter().any(|it| it.curve.is_some());
        if is_any_curved && system.has_nonconservative_interactions() {
            self.work.forces += integral([until, now], |time| {
                power_on_curves(seen, time, |states, forces| {
                    system.nonconservative_interactions(states, time, forces);
                })
            });
        }
        if seen.iter().all(|it| it.held_force.is_none()) {
            return;
        }
        if is_any_curved {
            self.work.integration += integral([until, now], |time| {
                power_on_curves(seen, time, |states, forces| {
                    system.conservative_interactions(states, time, forces);
                })
            });
        }
        let potential = |time: f64| {
            let (positions, velocities) = states_at(seen, time);
            system.conservative_interaction_potential([&positions, &velocities], time)
        };
        self.work.integration += potential(now) - potential(until);
    }

    /// Counts the work of all springs up to `now` \[s\].
    pub fn follow_all_springs(&mut self, seen: &[Seen], system: &System, now: f64) {
        for spring in &mut self.springs {
            self.work += spring.work_until(now, seen, system);
        }
    }
}

/// Centres \[m\] and velocities \[m/s\] of all spheres at a time \[s\].
fn states_at(seen: &[Seen], time: f64) -> (Vec<DVec3>, Vec<DVec3>) {
    seen.iter().map(|it| it.state_at(time)).unzip()
}

/// Power \[W\], at a time \[s\], of forces between spheres on those that fly on curves.
fn power_on_curves(
    seen: &[Seen],
    time: f64,
    find_forces: impl Fn([&[DVec3]; 2], &mut Vec<DVec3>),
) -> f64 {
    let (positions, velocities) = states_at(seen, time);
    let mut forces = Vec::new();
    find_forces([&positions, &velocities], &mut forces);
    let powers = forces.iter().zip(&velocities).map(|(force, velocity)| force.dot(*velocity));
    let is_curved = |(_, seen): &(f64, &Seen)| seen.curve.is_some();
    powers.zip(seen).filter(is_curved).map(|(power, _)| power).sum()
}
