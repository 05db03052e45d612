//! Sets quantities of spheres to values from Python.

use carom::{DQuat, DVec3, Groups, Sphere, SphereId, SphereMotion, World};

use crate::failure::Failure;
use crate::quantity::{Column, Quantity};

/// Sets a quantity of all spheres; if a value is refused, none is set.
pub fn set_all(world: &mut World, quantity: Quantity, values: &[f64]) -> Result<(), Failure> {
    let about = |error: carom::Error| Failure::from(error).about(quantity.name());
    let vectors = || values.chunks_exact(3).map(DVec3::from_slice);
    let ids = world.spheres().ids().to_vec();
    let old = world.spheres();
    match quantity {
        Quantity::Positions | Quantity::Velocities => {
            let kept = match quantity {
                Quantity::Positions => old.velocities(),
                _ => old.positions(),
            };
            let motion = |((id, new), &kept): ((SphereId, DVec3), &DVec3)| match quantity {
                Quantity::Positions => SphereMotion { id, position: new, velocity: kept },
                _ => SphereMotion { id, position: kept, velocity: new },
            };
            let motions: Vec<_> = ids.into_iter().zip(vectors()).zip(kept).map(motion).collect();
            world.set_motions(&motions).map_err(about)
        }
        Quantity::AppliedForces => {
            let forces: Vec<DVec3> = vectors().collect();
            world.set_applied_forces(&forces).map_err(about)
        }
        _ => {
            let before = world.snapshot();
            let values = values.chunks_exact(quantity.width());
            for (index, (id, values)) in ids.into_iter().zip(values).enumerate() {
                let sphere = changed(world.spheres().get(index), quantity, values);
                if let Err(error) = world.set_sphere(id, sphere) {
                    world.restore(&before);
                    return Err(about(error));
                }
            }
            Ok(())
        }
    }
}

/// Returns a sphere with another value of a quantity. Applied forces are not part of a sphere.
pub fn changed(sphere: Sphere, quantity: Quantity, values: &[f64]) -> Sphere {
    let value = values[0];
    match quantity {
        Quantity::Positions => sphere.with_position(DVec3::from_slice(values)),
        Quantity::Velocities => sphere.with_velocity(DVec3::from_slice(values)),
        Quantity::Radii => sphere.with_radius(value),
        Quantity::Masses => sphere.with_mass(value),
        Quantity::Restitutions => sphere.with_restitution(value),
        Quantity::InertiaFactors => sphere.with_inertia_factor(value),
        Quantity::Orientations => sphere.with_orientation(DQuat::from_slice(values)),
        Quantity::AngularVelocities => sphere.with_angular_velocity(DVec3::from_slice(values)),
        Quantity::AppliedForces => sphere,
        Quantity::Frictions
        | Quantity::RollingFrictions
        | Quantity::SpinningFrictions
        | Quantity::TangentialRestitutions => {
            let mut friction = sphere.friction;
            if let Some(coefficient) = quantity.coefficient(&mut friction) {
                *coefficient = (!value.is_nan()).then_some(value);
            }
            sphere.with_friction(friction)
        }
    }
}

/// A whole number that all spheres have and forces know nothing of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Label {
    Groups,
    CollidesWith,
    UserData,
}

impl Label {
    pub const ALL: [Self; 3] = [Self::Groups, Self::CollidesWith, Self::UserData];

    /// Returns the name in Python.
    pub fn name(self) -> &'static str {
        match self {
            Self::Groups => "groups",
            Self::CollidesWith => "collides_with",
            Self::UserData => "user_data",
        }
    }

    /// Returns the label with a name.
    ///
    /// # Errors
    /// [`Failure`] if none has it.
    pub fn named(name: &str) -> Result<Self, Failure> {
        let label = Self::ALL.into_iter().find(|label| label.name() == name);
        label.ok_or_else(|| Failure::unknown("label", name))
    }

    /// Returns the label of a sphere.
    pub fn of(self, sphere: &Sphere) -> u64 {
        match self {
            Self::Groups => sphere.groups.groups.into(),
            Self::CollidesWith => sphere.groups.collides_with.into(),
            Self::UserData => sphere.user_data,
        }
    }

    /// Returns a sphere with another label.
    ///
    /// # Errors
    /// [`Failure`] if it has more bits than there are groups.
    pub fn changed(self, sphere: Sphere, label: u64) -> Result<Sphere, Failure> {
        if self == Self::UserData {
            return Ok(sphere.with_user_data(label));
        }
        let bits = u32::try_from(label).map_err(|_| {
            Failure::value(self.name(), format_args!("must be in [0, 2^32), not {label}"))
        })?;
        let groups = match self {
            Self::Groups => Groups { groups: bits, ..sphere.groups },
            _ => Groups { collides_with: bits, ..sphere.groups },
        };
        Ok(sphere.with_groups(groups))
    }
}

/// Sets a label of all spheres; if one is refused, none is set.
pub fn set_labels(world: &mut World, label: Label, labels: &[u64]) -> Result<(), Failure> {
    let spheres = world.spheres();
    let changed = |(index, &value): (usize, &u64)| label.changed(spheres.get(index), value);
    let changed: Vec<Sphere> = labels.iter().enumerate().map(changed).collect::<Result<_, _>>()?;
    let ids = spheres.ids().to_vec();
    for (id, sphere) in ids.into_iter().zip(changed) {
        world.set_sphere(id, sphere)?;
    }
    Ok(())
}

/// Returns the sphere at an index of the columns.
pub fn sphere_at(columns: &[Column], index: usize) -> Sphere {
    columns.iter().fold(Sphere::new(DVec3::ZERO, 1.0), |sphere, (quantity, values)| {
        let width = quantity.width();
        changed(sphere, *quantity, &values[width * index..width * (index + 1)])
    })
}
