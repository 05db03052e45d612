//! What leaves the plane of a world of two dimensions.

use glam::DVec3;

use crate::collider::{Collider, Shape};
use crate::emitter::EmitterState;
use crate::error::{Error, InvalidValue, Subject};
use crate::forces::{Spring, SpringEnd};
use crate::id::{ColliderId, EmitterId, ForceId, SpringId};
use crate::rotation;
use crate::sphere::Sphere;
use crate::state::State;
use crate::validate;

const IN_PLANE: &str = "in the plane z = 0 in two dimensions";
const ALONG_Z: &str = "along z in two dimensions";

/// Returns an error for a world of two dimensions in which something is not in the plane z = 0, or leads out of it.
///
/// # Errors
/// [`Error::Invalid`] with the first sphere that is elsewhere or moves out of the plane, or the emitter, force, spring
/// or collider that drives spheres out of it.
pub(super) fn check(state: &State) -> Result<(), Error> {
    if state.settings.dimensions != 2 {
        return Ok(());
    }
    for index in 0..state.spheres.len() {
        let id = state.spheres.ids()[index];
        check_sphere(state, &state.spheres.get(index), Subject::Sphere(id))?;
    }
    let applied = state.spheres.applied_forces().iter().zip(state.spheres.ids());
    for (&force, &id) in applied {
        check_plane("applied_force", force).map_err(|it| it.about(Subject::Sphere(id)))?;
    }
    for (number, EmitterState { emitter, .. }) in state.emitters.iter() {
        check_sphere(state, &emitter.emitted(), Subject::Emitter(EmitterId(number)))?;
    }
    for (number, spring) in state.springs.iter() {
        check_spring(spring).map_err(|it| it.about(Subject::Spring(SpringId(number))))?;
    }
    for (number, collider) in state.colliders.list().iter() {
        check_collider(collider).map_err(|it| it.about(Subject::Collider(ColliderId(number))))?;
    }
    Ok(())
}

/// Checks the motion of a sphere that is in the world or is emitted, and the forces on it.
fn check_sphere(state: &State, sphere: &Sphere, subject: Subject) -> Result<(), Error> {
    let own = check_plane("position", sphere.position)
        .and_then(|()| check_plane("velocity", sphere.velocity))
        .and_then(|()| check_spin("angular_velocity", sphere.angular_velocity));
    own.map_err(|invalid| invalid.about(subject))?;
    let (present, time) = (sphere.state(), state.clock.seconds());
    for (number, force) in state.forces.iter() {
        let on_sphere = force.on(&present, time);
        check_plane("force", on_sphere).map_err(|it| it.about(Subject::Force(ForceId(number))))?;
    }
    Ok(())
}

fn check_spring(spring: &Spring) -> Result<(), InvalidValue> {
    match spring.to {
        SpringEnd::Point(point) => check_plane("anchor", point),
        SpringEnd::Sphere(_) => Ok(()),
    }
}

/// Checks the velocities of a collider, and that a flat or round one turns spheres back in the plane. A flat one that
/// is parallel to the plane meets none.
fn check_collider(collider: &Collider) -> Result<(), InvalidValue> {
    if collider.trigger {
        return Ok(());
    }
    check_plane("velocity", collider.velocity)?;
    check_plane("surface_velocity", collider.pose.rotation * collider.surface_velocity)?;
    check_spin("angular_velocity", collider.angular_velocity)?;
    match collider.shape {
        Shape::Sphere { .. } => check_plane("position", collider.pose.position),
        Shape::HalfSpace | Shape::Rectangle { .. } | Shape::Disc { .. } => {
            let [_, normal, _] = rotation::axes(collider.pose.rotation.normalize());
            let is_parallel = normal.x == 0.0 && normal.y == 0.0;
            if is_parallel { Ok(()) } else { check_plane("normal", normal) }
        }
        _ => Ok(()),
    }
}

fn check_plane(field: &'static str, value: DVec3) -> Result<(), InvalidValue> {
    validate::require(value.z == 0.0, field, IN_PLANE, value)
}

fn check_spin(field: &'static str, value: DVec3) -> Result<(), InvalidValue> {
    validate::require(value.x == 0.0 && value.y == 0.0, field, ALONG_Z, value)
}
