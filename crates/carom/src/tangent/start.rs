//! State of the spheres before a step, from which the step is reconstructed.

use std::collections::BTreeMap;
use std::sync::Arc;

use glam::DVec3;

use super::error::DerivativeError;
use super::input_rates::InputRates;
use super::known;
use super::supported::Rates;
use crate::colliders::Colliders;
use crate::detect::instant::Instant;
use crate::flight::Flight;
use crate::forces::{self, LinearForce};
use crate::id::{ColliderId, SphereId};
use crate::report::{BodyPair, Impact, StepReport};
use crate::rule::exact::Arrival;
use crate::system::System;
use crate::world::World;

/// Largest error of a reconstructed position as a fraction of coordinates and displacement: above rounding, and
/// below the effect of any other motion than a flight.
pub(super) const ROUNDING: f64 = 1e-9;

/// State of a world before a step.
pub(super) struct Start {
    pub ids: Vec<SphereId>,
    pub bodies: Vec<Flying>,
    /// How linear forces depend on the radius and the mass, by index of the sphere, where they do.
    pub inputs: BTreeMap<usize, InputRates>,
    pub colliders: Arc<Colliders>,
    /// Start of the step on the world's clock \[s\].
    pub time: f64,
}

/// A sphere in flight.
#[derive(Debug, Clone, Copy)]
pub(super) struct Flying {
    pub position: DVec3,
    pub velocity: DVec3,
    pub angular_velocity: DVec3,
    pub linear: LinearForce,
    /// The plane that supports the sphere, if any.
    pub held: Option<Held>,
    /// Whether forces without a closed form act on the sphere.
    pub is_curved: bool,
    /// Acceleration at the end of the last curved flight \[m/s²\]; `None` after an impact.
    pub acceleration: Option<DVec3>,
    /// Time since the start of the step \[s\].
    pub since: f64,
    /// Largest error of the position \[m\].
    pub tolerance: f64,
}

/// Persistent contact of a sphere with a plane, and its accelerations there.
#[derive(Debug, Clone, Copy)]
pub(super) struct Held {
    pub surface: u32,
    pub collider: ColliderId,
    pub normal: DVec3,
    /// Velocity of its material \[m/s\]: it does not change.
    pub velocity: DVec3,
    pub acceleration: DVec3,
    pub angular_acceleration: DVec3,
    /// All planes that hold the sphere, this one included.
    pub planes: [Option<Plane>; 3],
    /// Whether the sphere, or one that it touches, has other contacts.
    pub has_others: bool,
    /// Whether the sphere touches others.
    pub touches_spheres: bool,
}

/// One of the planes that hold a sphere.
#[derive(Debug, Clone, Copy)]
pub(super) struct Plane {
    pub surface: u32,
    pub collider: ColliderId,
    pub normal: DVec3,
}

impl Start {
    /// Copies the motion of all spheres of a world.
    ///
    /// # Errors
    /// A feature of the world whose derivatives are not known.
    pub fn of(world: &World) -> Result<Self, DerivativeError> {
        known::check(world)?;
        let Instant { system, motion, time } = world.now();
        let is_curved = known::curved(&system);
        let spins = &motion.spin.angular_velocity;
        let flying = |place: usize| Flying {
            angular_velocity: spins.get(place).copied().unwrap_or_default(),
            is_curved: is_curved[place],
            ..Flying::at(&system, place, [motion.position[place], motion.velocity[place]])
        };
        let alone = (0..is_curved.len()).filter(|&place| !is_curved[place]);
        let inputs = alone.filter_map(|place| Some((place, InputRates::of(&system, place)?)));
        let inputs = inputs.collect();
        let bodies = (0..motion.position.len()).map(flying).collect();
        Ok(Self {
            ids: system.spheres.id.clone(),
            bodies,
            inputs,
            colliders: world.shared_colliders(),
            time,
        })
    }

    /// Adds spheres that are added within the step.
    pub fn add(&mut self, arrivals: &[Arrival], system: &System) {
        if arrivals.is_empty() {
            return;
        }
        let is_curved = known::curved(system);
        for it in arrivals {
            let Ok(place) = system.spheres.id.binary_search(&it.id) else { continue };
            let mut body = Flying::at(system, place, [it.position, it.velocity]);
            body.angular_velocity = it.angular_velocity;
            (body.is_curved, body.since) = (is_curved[place], (it.time - self.time).max(0.0));
            let inputs = InputRates::of(system, place).filter(|_| !body.is_curved);
            self.inputs.extend(inputs.map(|inputs| (place, inputs)));
            self.ids.push(it.id);
            self.bodies.push(body);
        }
    }

    /// Refuses a step in which spheres were removed or stepped in zones.
    pub fn check(
        &self,
        report: &StepReport,
        system: &System,
        end: f64,
    ) -> Result<(), DerivativeError> {
        if self.ids != system.spheres.id {
            return Err(DerivativeError::Changed);
        }
        if report.zone_account.joined > 0 || report.zone_account.spheres > 0 {
            let sphere = self.ids.first().copied();
            let lost =
                |sphere| DerivativeError::PersistentContact { sphere, from: self.time, to: end };
            return sphere.map_or(Ok(()), |sphere| Err(lost(sphere)));
        }
        Ok(())
    }

    /// Returns the indices of the spheres of an impact in the arrays of the world.
    pub fn places(&self, impact: &Impact) -> [Option<usize>; 2] {
        let place = |id: SphereId| self.ids.binary_search(&id).ok();
        match impact.between {
            BodyPair::Spheres(first, second) => [place(first), place(second)],
            BodyPair::Collider { sphere, .. } => [None, place(sphere)],
        }
    }
}

impl Flying {
    /// Returns a sphere that begins a free flight without spin at the start of the step.
    fn at(system: &System, place: usize, [position, velocity]: [DVec3; 2]) -> Self {
        Self {
            position,
            velocity,
            angular_velocity: DVec3::ZERO,
            linear: linear_on(system, place),
            held: None,
            is_curved: false,
            acceleration: None,
            since: 0.0,
            tolerance: ROUNDING * (system.spheres.radius[place] + position.length()),
        }
    }

    /// Returns the flight under some forces from now on.
    pub fn flight(&self, LinearForce { acceleration, drag_rate }: LinearForce) -> Flight {
        Flight { position: self.position, velocity: self.velocity, acceleration, drag_rate }
    }
}

impl Held {
    /// Returns whether a plane of a collider with this normal is among those that hold the sphere.
    pub fn has(&self, collider: ColliderId, normal: DVec3) -> bool {
        let is_that = |it: &Plane| it.collider == collider && it.normal.dot(normal) > 0.5;
        self.planes.iter().flatten().any(is_that)
    }

    /// Returns the accelerations of the sphere under its drag and these forces.
    pub fn rates(&self, linear: LinearForce) -> Rates {
        let Self { acceleration, angular_acceleration, .. } = *self;
        Rates { linear: LinearForce { acceleration, ..linear }, angular_acceleration }
    }
}

/// Returns the linear forces on a sphere.
fn linear_on(system: &System, place: usize) -> LinearForce {
    let (radius, mass) = (system.spheres.radius[place], system.spheres.mass[place]);
    let (mut linear, _) = forces::total_linear(system.forces, radius, mass);
    linear.acceleration += system.spheres.applied_acceleration(place).unwrap_or_default();
    linear
}
