//! Forces on single balls.

use std::collections::BTreeMap;

use bevy_ecs::message::MessageWriter;
use bevy_ecs::prelude::*;
use carom::{Body, DVec3};

use crate::components::{ExternalForce, PhysicsBody};
use crate::convert::to_carom;
use crate::messages::{PhysicsError, logged};
use crate::physics::CaromWorld;

/// Applies the forces of all [`ExternalForce`] components.
pub fn apply_forces(
    mut physics: ResMut<CaromWorld>,
    forces: Query<(&PhysicsBody, &ExternalForce)>,
    mut errors: MessageWriter<PhysicsError>,
) {
    let of_sphere = |(body, force): (&PhysicsBody, &ExternalForce)| match body.body {
        Body::Sphere(id) => Some((id, to_carom(force.0))),
        Body::Collider(_) => None,
    };
    let given: BTreeMap<_, _> = forces.iter().filter_map(of_sphere).collect();
    let applied: Vec<DVec3> = if given.is_empty() {
        Vec::new()
    } else {
        let ids = physics.spheres().ids().iter();
        ids.map(|id| given.get(id).copied().unwrap_or_default()).collect()
    };
    if physics.spheres().applied_forces() == applied {
        return;
    }
    if let Err(error) = physics.set_applied_forces(&applied) {
        errors.write(logged(None, error));
    }
}
