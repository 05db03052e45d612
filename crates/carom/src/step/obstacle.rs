//! What a step cannot be combined with.

use crate::state::State;

/// Whether something is there that a quantity cannot be combined with, and what the quantity must be then.
pub(super) type Obstacle = (bool, &'static str);

/// Obstacles to spheres that fly straight and do not turn.
pub(super) fn of_forces(state: &State) -> [Obstacle; 3] {
    let now = state.now();
    let spheres = &state.spheres;
    let is_under_force = state.forces.iter().len() > 0
        || now.system.has_interactions()
        || !spheres.applied_forces().is_empty();
    let has_friction = now.system.frictions().any(|friction| friction.acts());
    let turns = spheres.angular_velocities().iter().any(|it| it.length_squared() > 0.0);
    [
        (is_under_force, "zero where forces act on spheres"),
        (has_friction, "zero where friction acts"),
        (turns, "zero where spheres turn"),
    ]
}

/// The requirement of the first obstacle that is there.
pub(super) fn first(obstacles: impl IntoIterator<Item = Obstacle>) -> Option<&'static str> {
    obstacles.into_iter().find_map(|(stands, requirement)| stands.then_some(requirement))
}
