//! Storage of spheres: an array for each quantity.

use educe::Educe;
use glam::{DQuat, DVec3};

use crate::friction::Friction;
use crate::groups::Groups;
use crate::id::SphereId;
use crate::restitution::{BodyRestitution, RestitutionLaw};
use crate::rotation;
use crate::sphere::{Mass, SOLID_BALL, Sphere};

/// The state of spheres, which a step changes.
#[derive(Debug, Educe, Default, PartialEq)]
#[educe(Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Motion {
    /// Centres \[m\].
    pub position: Vec<DVec3>,
    /// Velocities \[m/s\].
    pub velocity: Vec<DVec3>,
    /// Orientations and angular velocities.
    pub spin: Spin,
}

/// Orientations and angular velocities. Both arrays are empty while no sphere was ever rotated.
#[derive(Debug, Educe, Default, PartialEq)]
#[educe(Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Spin {
    /// Rotation from the coordinate system of each sphere to the world's, of length 1.
    pub orientation: Vec<DQuat>,
    /// Angular velocities \[rad/s\].
    pub angular_velocity: Vec<DVec3>,
}

impl Motion {
    /// Copies the states of all spheres, without an allocation where the arrays have room.
    pub fn copy_all(&mut self, from: &Self) {
        self.position.clone_from(&from.position);
        self.velocity.clone_from(&from.velocity);
        self.spin.orientation.clone_from(&from.spin.orientation);
        self.spin.angular_velocity.clone_from(&from.spin.angular_velocity);
    }

    /// The states of the spheres at these indices.
    pub fn of_some(&self, indices: &[u32]) -> Self {
        let Spin { orientation, angular_velocity } = &self.spin;
        Self {
            position: some(&self.position, indices),
            velocity: some(&self.velocity, indices),
            spin: Spin {
                orientation: some(orientation, indices),
                angular_velocity: some(angular_velocity, indices),
            },
        }
    }

    /// Copies position and velocity of one sphere.
    pub fn copy(&mut self, from: &Self, index: usize) {
        self.position[index] = from.position[index];
        self.velocity[index] = from.velocity[index];
    }
}

impl Spin {
    /// Grows both arrays to `count` spheres; new entries have no rotation.
    pub fn make_room(&mut self, count: usize) {
        self.orientation.resize(count, DQuat::IDENTITY);
        self.angular_velocity.resize(count, DVec3::ZERO);
    }

    /// Whether a sphere is rotated or rotates.
    pub fn is_any(&self) -> bool {
        self.orientation.iter().any(|&it| it != DQuat::IDENTITY)
            || self.angular_velocity.iter().any(|&it| it != DVec3::ZERO)
    }

    /// Advances all rotations by `h` \[s\]: no torque acts in free flight.
    pub fn advance(&mut self, h: f64) {
        for (orientation, &angular_velocity) in
            self.orientation.iter_mut().zip(&self.angular_velocity)
        {
            *orientation = rotation::turned(*orientation, angular_velocity, h);
        }
    }

    /// Appends the rotation of a sphere, as number `count`.
    fn push(&mut self, count: usize, sphere: &Sphere) {
        push(&mut self.orientation, count, sphere.orientation.normalize(), DQuat::IDENTITY);
        push(&mut self.angular_velocity, count, sphere.angular_velocity, DVec3::ZERO);
        self.make_whole(count + 1);
    }

    /// Overwrites the rotation of one of `count` spheres.
    fn set(&mut self, count: usize, index: usize, sphere: &Sphere) {
        set(&mut self.orientation, count, index, sphere.orientation.normalize(), DQuat::IDENTITY);
        set(&mut self.angular_velocity, count, index, sphere.angular_velocity, DVec3::ZERO);
        self.make_whole(count);
    }

    /// Extends the shorter of both arrays, so that both have `count` entries.
    fn make_whole(&mut self, count: usize) {
        if self.orientation.len() != self.angular_velocity.len() {
            self.make_room(count);
        }
    }
}

/// Properties of spheres, which a step reads.
#[derive(Debug, Educe, Default, PartialEq)]
#[educe(Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Properties {
    /// Ascending.
    pub id: Vec<SphereId>,
    /// Radii \[m\].
    pub radius: Vec<f64>,
    /// Masses \[kg\].
    pub mass: Vec<f64>,
    pub restitution: Vec<f64>,
    /// Empty while no sphere has a law.
    pub restitution_law: Vec<Option<RestitutionLaw>>,
    /// Empty while all spheres leave friction to the other body.
    pub friction: Vec<Friction>,
    /// Moments of inertia divided by m r²; empty while all spheres are solid balls.
    pub inertia_factor: Vec<f64>,
    /// \[N\]; empty while no sphere is under a force of its own.
    pub applied_force: Vec<DVec3>,
    /// Empty while all spheres are in the first group and collide with all.
    pub groups: Vec<Groups>,
    /// \[m/s\]; empty while no radius grows.
    pub growth_speed: Vec<f64>,
    /// Empty while all are 0.
    pub material: Vec<u8>,
    /// Empty while all are 0.
    pub user_data: Vec<u64>,
}

impl Properties {
    /// The groups of a sphere.
    #[inline]
    pub fn groups(&self, index: usize) -> Groups {
        self.groups.get(index).copied().unwrap_or_default()
    }

    /// Acceleration \[m/s²\] of a sphere by the force that is applied to it alone.
    #[inline]
    pub fn applied_acceleration(&self, index: usize) -> Option<DVec3> {
        self.applied_force.get(index).map(|&force| force / self.mass[index])
    }

    /// The properties of the spheres at these indices, which ascend.
    pub fn of_some(&self, indices: &[u32]) -> Self {
        Self {
            id: some(&self.id, indices),
            radius: some(&self.radius, indices),
            mass: some(&self.mass, indices),
            restitution: some(&self.restitution, indices),
            restitution_law: some(&self.restitution_law, indices),
            friction: some(&self.friction, indices),
            inertia_factor: some(&self.inertia_factor, indices),
            applied_force: some(&self.applied_force, indices),
            groups: some(&self.groups, indices),
            growth_speed: some(&self.growth_speed, indices),
            material: some(&self.material, indices),
            user_data: some(&self.user_data, indices),
        }
    }

    /// Restitution of a sphere.
    pub fn restitution(&self, index: usize) -> BodyRestitution {
        BodyRestitution::of(self.restitution[index], self.restitution_law(index))
    }

    fn restitution_law(&self, index: usize) -> Option<RestitutionLaw> {
        self.restitution_law.get(index).copied().flatten()
    }

    /// Material of a sphere; 0 for none.
    #[inline]
    pub fn material(&self, index: usize) -> u8 {
        self.material.get(index).copied().unwrap_or(0)
    }

    /// Speed at which the radius of a sphere grows \[m/s\].
    #[inline]
    pub fn growth_speed(&self, index: usize) -> f64 {
        self.growth_speed.get(index).copied().unwrap_or(0.0)
    }

    /// Friction of a sphere; `None` in a field that it leaves to the other body.
    pub fn friction(&self, index: usize) -> Friction {
        self.friction.get(index).copied().unwrap_or_default()
    }

    /// Moment of inertia of a sphere, divided by m r².
    pub fn inertia_factor(&self, index: usize) -> f64 {
        self.inertia_factor.get(index).copied().unwrap_or(SOLID_BALL)
    }

    /// Moment of inertia of a sphere \[kg m²\], about any axis through its centre.
    pub fn moment_of_inertia(&self, index: usize) -> f64 {
        let radius = self.radius[index];
        self.inertia_factor(index) * self.mass[index] * radius * radius
    }
}

/// All spheres of a world, one array per quantity, in ascending order of id.
#[derive(Debug, Educe, Default, PartialEq)]
#[educe(Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Spheres {
    pub(crate) properties: Properties,
    pub(crate) motion: Motion,
}

impl Spheres {
    /// Number of spheres: the length of every array below.
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

    /// Laws of restitution; empty while no sphere has one.
    pub fn restitution_laws(&self) -> &[Option<RestitutionLaw>] {
        &self.properties.restitution_law
    }

    /// Numbers of materials; empty while all are 0.
    pub fn materials(&self) -> &[u8] {
        &self.properties.material
    }

    /// Rotations from the coordinate system of each sphere to the world's; empty while no sphere was
    /// ever turned.
    pub fn orientations(&self) -> &[DQuat] {
        &self.motion.spin.orientation
    }

    /// Angular velocities \[rad/s\]; empty while no sphere was ever turned.
    pub fn angular_velocities(&self) -> &[DVec3] {
        &self.motion.spin.angular_velocity
    }

    /// Friction of each sphere, with `None` where it leaves a coefficient to the other body; empty
    /// while all do.
    pub fn frictions(&self) -> &[Friction] {
        &self.properties.friction
    }

    /// Moments of inertia divided by m r²; empty while all spheres are solid balls.
    pub fn inertia_factors(&self) -> &[f64] {
        &self.properties.inertia_factor
    }

    /// Forces \[N\] applied to single spheres; empty if there are none
    /// ([`World::set_applied_forces`](crate::World::set_applied_forces)).
    pub fn applied_forces(&self) -> &[DVec3] {
        &self.properties.applied_force
    }

    /// The groups of each sphere; empty while all are in the first one and collide with all.
    pub fn groups(&self) -> &[Groups] {
        &self.properties.groups
    }

    /// Speeds at which radii grow \[m/s\]; empty while none does.
    pub fn growth_speeds(&self) -> &[f64] {
        &self.properties.growth_speed
    }

    /// A number of the program for each sphere; empty while all are 0.
    pub fn user_data(&self) -> &[u64] {
        &self.properties.user_data
    }

    /// Moment of inertia of the sphere at an index \[kg m²\], about any axis through its centre.
    ///
    /// # Panics
    /// If there is none.
    pub fn moment_of_inertia(&self, index: usize) -> f64 {
        self.properties.moment_of_inertia(index)
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
            restitution_law: self.properties.restitution_law(index),
            friction: self.properties.friction(index),
            orientation: self.orientations().get(index).copied().unwrap_or_default(),
            angular_velocity: self.angular_velocities().get(index).copied().unwrap_or_default(),
            inertia_factor: self.properties.inertia_factor(index),
            groups: self.properties.groups(index),
            growth_speed: self.properties.growth_speed(index),
            material: self.properties.material(index),
            user_data: self.user_data().get(index).copied().unwrap_or_default(),
        }
    }

    /// Appends a sphere that passed [`Sphere::validate`]; its id must be the largest so far.
    pub(crate) fn push(&mut self, id: SphereId, sphere: &Sphere) {
        let count = self.len();
        let Self { properties, motion } = self;
        properties.id.push(id);
        properties.radius.push(sphere.radius);
        properties.mass.push(sphere.kilograms());
        properties.restitution.push(sphere.restitution);
        push(&mut properties.restitution_law, count, sphere.restitution_law, None);
        push(&mut properties.friction, count, sphere.friction, Friction::default());
        push(&mut properties.inertia_factor, count, sphere.inertia_factor, SOLID_BALL);
        push(&mut properties.applied_force, count, DVec3::ZERO, DVec3::ZERO);
        push(&mut properties.groups, count, sphere.groups, Groups::DEFAULT);
        push(&mut properties.growth_speed, count, sphere.growth_speed, 0.0);
        push(&mut properties.material, count, sphere.material, 0);
        push(&mut properties.user_data, count, sphere.user_data, 0);
        motion.position.push(sphere.position);
        motion.velocity.push(sphere.velocity);
        motion.spin.push(count, sphere);
    }

    /// Overwrites a sphere with one that passed [`Sphere::validate`]; the force applied to it stays.
    pub(crate) fn set(&mut self, index: usize, sphere: &Sphere) {
        let count = self.len();
        let Self { properties, motion } = self;
        properties.radius[index] = sphere.radius;
        properties.mass[index] = sphere.kilograms();
        properties.restitution[index] = sphere.restitution;
        set(&mut properties.restitution_law, count, index, sphere.restitution_law, None);
        set(&mut properties.friction, count, index, sphere.friction, Friction::default());
        set(&mut properties.inertia_factor, count, index, sphere.inertia_factor, SOLID_BALL);
        set(&mut properties.groups, count, index, sphere.groups, Groups::DEFAULT);
        set(&mut properties.growth_speed, count, index, sphere.growth_speed, 0.0);
        set(&mut properties.material, count, index, sphere.material, 0);
        set(&mut properties.user_data, count, index, sphere.user_data, 0);
        motion.position[index] = sphere.position;
        motion.velocity[index] = sphere.velocity;
        motion.spin.set(count, index, sphere);
    }

    /// Removes spheres; later ones move up, so that ids stay ascending.
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
        keep(&mut properties.restitution_law, &stays);
        keep(&mut properties.friction, &stays);
        keep(&mut properties.inertia_factor, &stays);
        keep(&mut properties.applied_force, &stays);
        keep(&mut properties.groups, &stays);
        keep(&mut properties.growth_speed, &stays);
        keep(&mut properties.material, &stays);
        keep(&mut properties.user_data, &stays);
        keep(&mut motion.position, &stays);
        keep(&mut motion.velocity, &stays);
        keep(&mut motion.spin.orientation, &stays);
        keep(&mut motion.spin.angular_velocity, &stays);
    }
}

/// Appends the value of sphere number `count` to an array that is empty while all values are the default.
fn push<T: Copy + PartialEq>(values: &mut Vec<T>, count: usize, value: T, usual: T) {
    if !values.is_empty() || value != usual {
        values.resize(count, usual);
        values.push(value);
    }
}

/// Sets one of `count` values in an array that is empty while all values are the default.
fn set<T: Copy + PartialEq>(values: &mut Vec<T>, count: usize, index: usize, value: T, usual: T) {
    if !values.is_empty() || value != usual {
        values.resize(count, usual);
        values[index] = value;
    }
}

/// Some items of an array that may be empty.
fn some<T: Copy>(items: &[T], indices: &[u32]) -> Vec<T> {
    let of_all = indices.iter().map(|&index| items.get(index as usize).copied());
    of_all.flatten().collect()
}

/// Keeps the items whose flag is set.
fn keep<T>(items: &mut Vec<T>, stays: &[bool]) {
    let mut stays = stays.iter();
    items.retain(|_| stays.next().is_some_and(|stays| *stays));
}
