//! Curves: the flights of spheres under forces without a closed form, one step of an integrator after another.

use glam::DVec3;

use super::body::Body;
use super::curve::{Curve, CurveStep};
use super::species::Species;
use super::state::Flights;
use crate::contact_time::{PolynomialTrack, Track};
use crate::forces::{self, Force, SphereState};
use crate::integrate::gauss_radau::{self, Field, Pace, Start, Values};
use crate::norm::Norm;
use crate::polynomial_flight::{PolynomialAcceleration, PolynomialFlight};
use crate::system::System;

/// Where forces are steady, a step is no longer than so many times the time in which a sphere moves by its
/// radius: they may be others there.
const STEADY_RADII: f64 = 16.0;

/// Bounds for the steps of curves.
#[derive(Debug, Clone, Copy)]
pub(crate) struct StepLimits {
    /// When all of them have to end at the latest, on the world's clock \[s\].
    pub until: f64,
    /// How long they are at most where nothing can be said of a force \[s\].
    pub tick: f64,
}

impl Flights {
    /// The flight of a sphere as a polynomial, if its forces have no closed form and nothing bears it, and
    /// when that ends, on the world's clock \[s\].
    pub fn curve_of(&self, slot: u32) -> Option<(PolynomialFlight, f64)> {
        let body = &self.bodies[slot as usize];
        let step = self.step_of(slot, body)?;
        let Body { position, velocity, .. } = *body;
        Some((PolynomialFlight { position, velocity, acceleration: step.acceleration }, step.end))
    }

    /// When the step that a sphere is in ends, on the world's clock \[s\]; infinite if it is in none.
    #[inline]
    pub fn step_end(&self, slot: u32) -> f64 {
        let body = &self.bodies[slot as usize];
        self.step_of(slot, body).map_or(f64::INFINITY, |step| step.end)
    }

    fn step_of(&self, slot: u32, body: &Body) -> Option<&CurveStep> {
        if !self.species[body.species as usize].is_curved {
            return None;
        }
        let step = self.curves[self.index_of[slot as usize] as usize].0.as_ref();
        step.filter(|step| step.generation == body.generation)
    }

    /// Whether the flight of a sphere has to be found before it can be predicted.
    pub fn is_unknown(&self, slot: u32) -> bool {
        let body = &self.bodies[slot as usize];
        self.species[body.species as usize].is_curved && self.step_of(slot, body).is_none()
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

    /// How a sphere moves from `time` \[s\] on.
    pub fn track_from(&self, slot: u32, time: f64) -> Track {
        let body = &self.bodies[slot as usize];
        match self.curve_of(slot) {
            Some((flight, _)) => {
                Track::Polynomial(Box::new(PolynomialTrack::new(flight, time - body.time)))
            }
            None => Track::Flight(body.flight_from(self.species_of(slot), time)),
        }
    }

    /// A sphere without the forces of its persistent contacts, as it is at `time` \[s\].
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

    /// The step of a sphere from the beginning of its flight on.
    pub fn step_from_start(&self, system: &System, slot: u32, limits: StepLimits) -> Curve {
        let body = &self.bodies[slot as usize];
        let index = self.index_of[slot as usize] as usize;
        let before = self.curves[index].0.as_ref();
        let mut field = FreeField::of(system, index);
        let (positions, velocities) = ([body.position], [body.velocity]);
        let acceleration = field.acceleration_at(body.time, body.position, body.velocity);
        let brief = time_of_a_radius(system.spheres.radius[index], body.velocity, acceleration);
        let brief = if brief.is_finite() && brief > 0.0 { brief } else { limits.tick };
        let start = Start {
            positions: &positions,
            velocities: &velocities,
            time: body.time,
            until: limits.until,
            steady: STEADY_RADII * brief,
            rough: limits.tick,
        };
        let pace = before.map_or(Pace::of(brief), |step| step.pace);
        // What was before is the beginning of what comes only if no event was between.
        let continues = before.filter(|step| step.end == body.time);
        let before = continues.map(|step| [step.acceleration]);
        let before = before.as_ref().map(|it| &it[..]);
        let step = gauss_radau::step(&start, before, pace, &mut field);
        Curve(Some(CurveStep {
            generation: body.generation,
            acceleration: step.accelerations[0],
            end: step.end,
            pace: step.pace,
        }))
    }

    /// Puts the step of a sphere in its place. One whose forces are not finite is noted as lost.
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
    /// Those that are not linear.
    others: Vec<&'a dyn Force>,
}

impl<'a> FreeField<'a> {
    /// Those on the sphere at an index of the world's arrays.
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

    /// Acceleration \[m/s²\] at a time \[s\] of the sphere at a place \[m\] with a velocity \[m/s\].
    pub fn acceleration_at(&self, time: f64, position: DVec3, velocity: DVec3) -> DVec3 {
        self.acceleration_and_size(time, position, velocity).0
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

impl Field for FreeField<'_> {
    fn evaluate(&mut self, time: f64, positions: &[DVec3], velocities: &[DVec3], at: &mut Values) {
        let (acceleration, size) = self.acceleration_and_size(time, positions[0], velocities[0]);
        (at.accelerations[0], at.sizes[0]) = (acceleration, size);
    }
}
