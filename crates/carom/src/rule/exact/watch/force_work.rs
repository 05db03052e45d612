//! Work of nonconservative forces along the flights of spheres.

use glam::DVec3;

use super::seen::Seen;
use crate::bodies::Properties;
use crate::flight::Flight;
use crate::force_work::ForceWork;
use crate::forces::{self, SphereState, Spring, SpringEnd};
use crate::integrate::gauss_legendre::integral;
use crate::sensor::FlightSegment;
use crate::settings::nearest_image;
use crate::shear::Shear;
use crate::system::System;

/// Work of nonconservative forces during a watch.
#[derive(Debug, Clone, Default)]
pub(crate) struct ForceTally {
    pub work: ForceWork,
    dampers: Vec<Damper>,
    /// Numbers of the dampers at each sphere, by its index; empty without dampers.
    dampers_at: Vec<Vec<u32>>,
    /// Time up to which the work of interactions on curved flights is counted, on the world's clock \[s\]; `None`
    /// without nonconservative ones.
    interactions_until: Option<f64>,
}

/// The damper of a spring.
#[derive(Debug, Clone)]
struct Damper {
    spring: Spring,
    /// Indices of the spheres at its ends.
    first: u32,
    second: Option<u32>,
    /// Time up to which its work is counted, on the world's clock \[s\].
    until: f64,
}

impl ForceTally {
    /// Starts to count for all springs and interactions at `now` \[s\], and keeps the work so far.
    pub fn restart(&mut self, system: &System, now: f64) {
        let ids = &system.spheres.id;
        self.interactions_until = system.has_nonconservative_interactions().then_some(now);
        self.dampers.clear();
        self.dampers_at.clear();
        for &spring in system.springs().filter(|spring| spring.damping > 0.0) {
            let ends: Vec<u32> = spring
                .spheres()
                .flat_map(|id| ids.binary_search(&id))
                .map(|it| it as u32)
                .collect();
            let second = match (spring.to, &ends[..]) {
                (SpringEnd::Sphere(_), &[_, second]) => Some(second),
                (SpringEnd::Point(_), &[_]) => None,
                _ => continue,
            };
            self.dampers_at.resize(ids.len(), Vec::new());
            let number = self.dampers.len() as u32;
            ends.iter().for_each(|&end| self.dampers_at[end as usize].push(number));
            self.dampers.push(Damper { spring, first: ends[0], second, until: now });
        }
    }

    /// Counts the work on a sphere along a segment of its flight, without that of dampers.
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
        self.work.forces += seen.held_force.dot(way);
        if seen.is_stepped {
            return;
        }
        let applied = applied_force.get(index).map_or(0.0, |force| force.dot(way));
        self.work.applied += applied;
        let (radius, mass) = (segment.radius, mass[index]);
        let state_at = |time: f64| {
            let flight = segment.flight_from(time);
            let (position, velocity) = (flight.position, flight.velocity);
            SphereState { position, velocity, radius, mass }
        };
        let range = [segment.from, segment.to];
        if segment.curve.is_some() {
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
            self.work.forces += integral(range, |time| {
                let state = state_at(time);
                forces::nonconservative_others(system.forces, &state, time).dot(state.velocity)
            });
        }
    }

    /// Counts the work of the dampers at a sphere up to `now` \[s\], along the flights that were seen.
    pub fn follow_dampers(&mut self, index: u32, seen: &[Seen], system: &System, now: f64) {
        let Some(numbers) = self.dampers_at.get(index as usize) else { return };
        for &number in numbers {
            self.work.forces += self.dampers[number as usize].work_until(now, seen, system);
        }
    }

    /// Counts the work of interactions on spheres that fly on curves up to `now` \[s\], along the flights that were
    /// seen. The forces on other spheres are held.
    pub fn follow_interactions(&mut self, seen: &[Seen], system: &System, now: f64) {
        let Some(until) = self.interactions_until.filter(|&until| until < now) else { return };
        self.interactions_until = Some(now);
        if seen.iter().all(|it| it.curve.is_none()) {
            return;
        }
        self.work.forces += integral([until, now], |time| {
            let (positions, velocities): (Vec<DVec3>, Vec<DVec3>) =
                seen.iter().map(|it| it.state_at(time)).unzip();
            let mut forces = Vec::new();
            system.nonconservative_interactions([&positions, &velocities], time, &mut forces);
            let powers =
                forces.iter().zip(&velocities).map(|(force, velocity)| force.dot(*velocity));
            let is_curved = |(_, seen): &(f64, &Seen)| seen.curve.is_some();
            powers.zip(seen).filter(is_curved).map(|(power, _)| power).sum()
        });
    }

    /// Counts the work of all dampers up to `now` \[s\].
    pub fn follow_all_dampers(&mut self, seen: &[Seen], system: &System, now: f64) {
        for damper in &mut self.dampers {
            self.work.forces += damper.work_until(now, seen, system);
        }
    }
}

impl Damper {
    /// Returns the work \[J\] since the last call, up to `now` \[s\].
    fn work_until(&mut self, now: f64, seen: &[Seen], system: &System) -> f64 {
        let range = [self.until, now];
        if now <= self.until {
            return 0.0;
        }
        self.until = now;
        let period = system.settings.boundary.period();
        let state = |index: u32, time: f64| seen[index as usize].state_at(time);
        integral(range, |time| {
            let (from, velocity) = state(self.first, time);
            let (to, other) = match (self.second, self.spring.to) {
                (Some(second), _) => state(second, time),
                (None, SpringEnd::Point(point)) => (point, DVec3::ZERO),
                (None, SpringEnd::Sphere(_)) => return 0.0,
            };
            let relative = other - velocity;
            -self.spring.damping_pull(nearest_image(to - from, period), relative).dot(relative)
        })
    }
}
