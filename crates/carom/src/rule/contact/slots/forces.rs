//! Forces on the spheres in slots.

use glam::DVec3;

use super::row::Row;
use super::{Slots, accelerated};
use crate::forces::{self, SphereState};
use crate::integrate::damped::{is_damped, velocity_after};
use crate::rule::periodic;
use crate::system::System;

impl Slots {
    /// Computes the accelerations of the linear forces now. Returns whether there are other forces.
    pub fn read_forces(&mut self, system: &System) -> bool {
        let spheres = system.spheres;
        let mut has_others = system.has_interactions();
        let mut last = None;
        self.acceleration.clear();
        for &index in &self.index {
            let i = index as usize;
            let like = (spheres.radius[i], spheres.mass[i]);
            let (linear, is_all) = match last {
                Some((known, linear)) if known == like => linear,
                _ => forces::total_linear(system.forces, like.0, like.1),
            };
            last = Some((like, (linear, is_all)));
            has_others |= !is_all;
            let own = spheres.applied_acceleration(i).unwrap_or(DVec3::ZERO);
            self.acceleration.push(Row::new(linear.acceleration + own, linear.drag_rate));
        }
        self.linear.clear();
        self.damped.clear();
        if has_others {
            self.linear.clone_from(&self.acceleration);
        }
        has_others
    }

    /// Whether forces damp the motion of a sphere in less than the sub-step.
    pub fn is_damped(&self, slot: usize) -> bool {
        self.damped.get(self.index[slot] as usize).is_some_and(|it| *it)
    }

    /// Whether forces damp the motion of any sphere in less than the sub-step.
    pub fn are_any_damped(&self) -> bool {
        self.damped.contains(&true)
    }

    /// Adds the accelerations of the other forces in the middle of a sub-step of `h` \[s\] that starts at this time on
    /// the world's clock \[s\]. Where forces damp the motion of a sphere in less than that, its acceleration is that of an
    /// implicit step.
    pub fn add_other_forces(&mut self, system: &System, time: f64, h: f64) {
        self.find_middle(system, time, h);
        let middle = time + 0.5 * h;
        let between = match system.has_interactions() {
            true => self.forces_between(system, middle),
            false => Vec::new(),
        };
        let may_damp = system.has_nonconservative_forces();
        self.damped.clear();
        self.damped.resize(self.len(), false);
        for slot in 0..self.len() {
            let (linear, row, state) =
                (self.linear[slot], self.velocity[slot], self.middle_of(slot));
            let index = self.index[slot] as usize;
            let between = between.get(index).copied().unwrap_or(DVec3::ZERO);
            let without_drag = |velocity: DVec3| {
                let state = SphereState { velocity, ..state };
                let own = forces::total_of_others(system.forces, &state, middle);
                linear.vector() + (own + between) * row.number()
            };
            let first = without_drag(state.velocity);
            self.acceleration[slot] = linear.with_vector(first);
            if !may_damp || !is_damped(h, (state.velocity, first), without_drag) {
                continue;
            }
            let before = row.vector();
            let all = |velocity| without_drag(velocity) - linear.number() * velocity;
            if let Some(after) = velocity_after(h, before, all) {
                self.acceleration[slot] = Row::new((after - before) / h, 0.0);
                self.middle[1][index] = 0.5 * (before + after);
                self.damped[index] = true;
            }
        }
    }

    /// Finds where spheres are in the middle of a sub-step if nothing accelerates them, and how fast under the forces
    /// of its start (the midpoint rule; without forces that depend on velocities, the leapfrog scheme).
    fn find_middle(&mut self, system: &System, time: f64, h: f64) {
        let count = self.len();
        self.middle.iter_mut().for_each(|states| states.resize(count, DVec3::ZERO));
        for (slot, &index) in self.index.iter().enumerate() {
            self.middle[0][index as usize] = self.position[slot].vector();
            self.middle[1][index as usize] = self.velocity[slot].vector();
        }
        let between = match system.has_damped_interactions() {
            true => self.forces_between(system, time),
            false => Vec::new(),
        };
        for (slot, &index) in self.index.iter().enumerate() {
            let (row, linear) = (self.velocity[slot], self.linear[slot]);
            let force = self.other_force(system, &between, slot, time);
            let acceleration = linear.vector() + force * row.number();
            let [positions, velocities] = &mut self.middle;
            positions[index as usize] += 0.5 * h * row.vector();
            velocities[index as usize] =
                accelerated(row, linear.with_vector(acceleration), 0.5 * h);
        }
    }

    /// The force on a sphere in its present state of [`Self::middle`] \[N\], of forces that are not linear and of those
    /// between spheres, by index.
    fn other_force(&self, system: &System, between: &[DVec3], slot: usize, time: f64) -> DVec3 {
        let own = forces::total_of_others(system.forces, &self.middle_of(slot), time);
        between.get(self.index[slot] as usize).map_or(own, |&it| own + it)
    }

    /// The state of a sphere in the middle of the sub-step.
    pub fn middle_of(&self, slot: usize) -> SphereState {
        let index = self.index[slot] as usize;
        let [positions, velocities] = &self.middle;
        SphereState {
            position: periodic::wrapped(positions[index], self.period),
            velocity: velocities[index],
            radius: self.position[slot].number(),
            mass: 1.0 / self.velocity[slot].number(),
        }
    }

    /// The forces between spheres in their states of [`Self::middle`] \[N\], by index.
    fn forces_between(&self, system: &System, time: f64) -> Vec<DVec3> {
        let mut forces = Vec::new();
        let [positions, velocities] = &self.middle;
        system.forces_between([positions, velocities], time, &mut forces);
        forces
    }
}
