//! What leaves the plane of a world of two dimensions.

use crate::error::{Error, InvalidValue, Subject};
use crate::forces;
use crate::state::State;

/// Returns an error for a world of two dimensions in which something is not in the plane z = 0.
///
/// # Errors
/// [`Error::Invalid`] with the first sphere that is elsewhere or moves out of the plane.
pub(super) fn check(state: &State) -> Result<(), Error> {
    if state.settings.dimensions != 2 {
        return Ok(());
    }
    let off_plane =
        (0..state.spheres.len()).find_map(|index| Some((index, off_plane(state, index)?)));
    let Some((index, invalid)) = off_plane else { return Ok(()) };
    Err(invalid.about(Subject::Sphere(state.spheres.ids()[index])))
}

/// What of a sphere, by its index, is not in the plane.
fn off_plane(state: &State, index: usize) -> Option<InvalidValue> {
    let spheres = &state.spheres;
    let spin = spheres.angular_velocities().get(index).copied().unwrap_or_default();
    let (radius, mass) = (spheres.radii()[index], spheres.masses()[index]);
    let acceleration = forces::total_linear(&state.forces, radius, mass).0.acceleration;
    let (place, velocity) = (spheres.positions()[index], spheres.velocities()[index]);
    let in_plane = "in the plane z = 0 in two dimensions";
    let fields = [
        ("position", in_plane, place.z == 0.0, place),
        ("velocity", in_plane, velocity.z == 0.0, velocity),
        ("acceleration", in_plane, acceleration.z == 0.0, acceleration),
        ("angular_velocity", "along z in two dimensions", spin.x == 0.0 && spin.y == 0.0, spin),
    ];
    let (field, requirement, _, value) = fields.into_iter().find(|(_, _, is_flat, _)| !is_flat)?;
    Some(InvalidValue { field, requirement, value: value.to_string() })
}
