//! Spheres: what one is, and how many are stored.

use std::f64::consts::PI;

use glam::DVec3;

use crate::error::InvalidValue;
use crate::id::SphereId;
use crate::validate;

/// Mass, or the density to compute it from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Mass {
    /// Mass \[kg\], > 0.
    Kilograms(f64),
    /// Density \[kg/m³\], > 0; the mass is density times the sphere's volume.
    Density(f64),
}

impl From<f64> for Mass {
    /// This many kilograms.
    fn from(kilograms: f64) -> Self {
        Self::Kilograms(kilograms)
    }
}

/// One sphere, as it is added to a world and read from it.
///
/// ```
/// use carom::{DVec3, Sphere};
///
/// let sphere = Sphere::new(DVec3::new(0.0, 2.0, 0.0), 0.5)
///     .with_velocity(DVec3::X)
///     .with_density(1000.0)
///     .with_restitution(0.8);
/// assert_eq!(sphere.kilograms(), 1000.0 * carom::volume(0.5));
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Sphere {
    /// Centre \[m\].
    pub position: DVec3,
    /// Velocity \[m/s\].
    pub velocity: DVec3,
    /// Radius \[m\], > 0.
    pub radius: f64,
    /// Mass or density; a world answers with [`Mass::Kilograms`].
    pub mass: Mass,
    /// Coefficient of restitution in \[0, 1\].
    pub restitution: f64,
}

impl Sphere {
    /// A sphere at rest, of 1 kg, that leaves the restitution to what it meets (its own is 1).
    pub fn new(position: DVec3, radius: f64) -> Self {
        Self {
            position,
            velocity: DVec3::ZERO,
            radius,
            mass: Mass::Kilograms(1.0),
            restitution: 1.0,
        }
    }

    /// The same sphere with its centre at this place \[m\].
    pub fn with_position(self, position: DVec3) -> Self {
        Self { position, ..self }
    }

    /// The same sphere with this radius \[m\].
    pub fn with_radius(self, radius: f64) -> Self {
        Self { radius, ..self }
    }

    /// The same sphere with this velocity \[m/s\].
    pub fn with_velocity(self, velocity: DVec3) -> Self {
        Self { velocity, ..self }
    }

    /// The same sphere with this mass: a number \[kg\], or a [`Mass`].
    pub fn with_mass(self, mass: impl Into<Mass>) -> Self {
        Self { mass: mass.into(), ..self }
    }

    /// The same sphere with the mass of this density \[kg/m³\].
    pub fn with_density(self, density: f64) -> Self {
        Self { mass: Mass::Density(density), ..self }
    }

    /// The same sphere with this coefficient of restitution.
    pub fn with_restitution(self, restitution: f64) -> Self {
        Self { restitution, ..self }
    }

    /// Mass \[kg\], however it was given.
    pub fn kilograms(&self) -> f64 {
        match self.mass {
            Mass::Kilograms(kilograms) => kilograms,
            Mass::Density(density) => density * volume(self.radius),
        }
    }

    pub(crate) fn validate(&self) -> Result<(), InvalidValue> {
        validate::finite("position", self.position)?;
        validate::finite("velocity", self.velocity)?;
        validate::positive("radius", self.radius)?;
        match self.mass {
            Mass::Kilograms(mass) => validate::positive("mass", mass)?,
            // So small or large a sphere that its mass is no number is refused here, too.
            Mass::Density(density) => {
                validate::positive("density", density)?;
                validate::positive("density times volume", self.kilograms())?;
            }
        }
        validate::unit_interval("restitution", self.restitution)
    }
}

/// Volume of a sphere \[m³\], 4/3 π r³.
pub fn volume(radius: f64) -> f64 {
    4.0 / 3.0 * PI * (radius * radius * radius)
}

/// Where spheres are and how they move: what a step changes.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Motion {
    /// Centres \[m\].
    pub position: Vec<DVec3>,
    /// Velocities \[m/s\].
    pub velocity: Vec<DVec3>,
}

impl Motion {
    /// Takes over the states of all spheres, without allocating where there is place already.
    pub fn copy_all(&mut self, from: &Self) {
        self.position.clone_from(&from.position);
        self.velocity.clone_from(&from.velocity);
    }

    /// Takes over the state of one sphere.
    pub fn copy(&mut self, from: &Self, index: usize) {
        self.position[index] = from.position[index];
        self.velocity[index] = from.velocity[index];
    }
}

/// What spheres are: what a step reads.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Properties {
    /// Ascending.
    pub id: Vec<SphereId>,
    /// \[m\]
    pub radius: Vec<f64>,
    /// \[kg\]
    pub mass: Vec<f64>,
    pub restitution: Vec<f64>,
    /// \[N\]; empty while no sphere is under a force of its own.
    pub applied_force: Vec<DVec3>,
}

impl Properties {
    /// Acceleration \[m/s²\] of a sphere by the force that is applied to it alone.
    #[inline]
    pub fn applied_acceleration(&self, index: usize) -> Option<DVec3> {
        self.applied_force.get(index).map(|&force| force / self.mass[index])
    }
}

/// All spheres of a world, one array per quantity, in ascending order of id.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Spheres {
    pub(crate) properties: Properties,
    pub(crate) motion: Motion,
}

impl Spheres {
    /// How many there are: the length of every array below.
    pub fn len(&self) -> usize {
        self.ids().len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.ids().is_empty()
    }

    /// Ids, ascending.
    pub fn ids(&self) -> &[SphereId] {
        &self.properties.id
    }

    /// Centres \[m\].
    pub fn positions(&self) -> &[DVec3] {
        &self.motion.position
    }

    /// Velocities \[m/s\].
    pub fn velocities(&self) -> &[DVec3] {
        &self.motion.velocity
    }

    /// Radii \[m\].
    pub fn radii(&self) -> &[f64] {
        &self.properties.radius
    }

    /// Masses \[kg\].
    pub fn masses(&self) -> &[f64] {
        &self.properties.mass
    }

    /// Coefficients of restitution.
    pub fn restitutions(&self) -> &[f64] {
        &self.properties.restitution
    }

    /// Forces \[N\] applied to single spheres; empty if there are none
    /// ([`World::set_applied_forces`](crate::World::set_applied_forces)).
    pub fn applied_forces(&self) -> &[DVec3] {
        &self.properties.applied_force
    }

    /// Index of a sphere in the arrays; it changes when spheres are removed.
    pub fn index_of(&self, id: SphereId) -> Option<usize> {
        self.ids().binary_search(&id).ok()
    }

    /// The sphere at an index.
    ///
    /// # Panics
    /// If there is none.
    pub fn get(&self, index: usize) -> Sphere {
        Sphere {
            position: self.motion.position[index],
            velocity: self.motion.velocity[index],
            radius: self.properties.radius[index],
            mass: Mass::Kilograms(self.properties.mass[index]),
            restitution: self.properties.restitution[index],
        }
    }

    /// Appends a sphere that passed [`Sphere::validate`]; its id must be the largest so far.
    pub(crate) fn push(&mut self, id: SphereId, sphere: &Sphere) {
        self.properties.id.push(id);
        self.properties.radius.push(sphere.radius);
        self.properties.mass.push(sphere.kilograms());
        self.properties.restitution.push(sphere.restitution);
        if !self.properties.applied_force.is_empty() {
            self.properties.applied_force.push(DVec3::ZERO);
        }
        self.motion.position.push(sphere.position);
        self.motion.velocity.push(sphere.velocity);
    }

    /// Overwrites a sphere with one that passed [`Sphere::validate`]; the force applied to it stays.
    pub(crate) fn set(&mut self, index: usize, sphere: &Sphere) {
        self.properties.radius[index] = sphere.radius;
        self.properties.mass[index] = sphere.kilograms();
        self.properties.restitution[index] = sphere.restitution;
        self.motion.position[index] = sphere.position;
        self.motion.velocity[index] = sphere.velocity;
    }

    /// Takes spheres out; those after them move up, so that ids stay ascending.
    pub(crate) fn remove_all(&mut self, ids: &[SphereId]) {
        let mut going = ids.to_vec();
        going.sort_unstable();
        let stays: Vec<bool> =
            self.ids().iter().map(|id| going.binary_search(id).is_err()).collect();
        let Self { properties, motion } = self;
        keep(&mut properties.id, &stays);
        keep(&mut properties.radius, &stays);
        keep(&mut properties.mass, &stays);
        keep(&mut properties.restitution, &stays);
        keep(&mut properties.applied_force, &stays);
        keep(&mut motion.position, &stays);
        keep(&mut motion.velocity, &stays);
    }
}

/// Keeps the items that stay.
fn keep<T>(items: &mut Vec<T>, stays: &[bool]) {
    let mut stays = stays.iter();
    items.retain(|_| stays.next().is_some_and(|stays| *stays));
}
