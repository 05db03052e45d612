//! Worlds that several claims start from.

use carom::{
    Collider, DQuat, DVec3, Discrete, Error, Gravity, Integrator, Pose, Rule, Settings, Shape,
    World,
};

/// Length of a frame where the length does not matter \[s\].
pub const FRAME: f64 = 1.0 / 60.0;
/// Acceleration of gravity \[m/s²\].
pub const G: f64 = 9.81;

/// Creates an empty world under a rule.
pub fn world(rule: Rule) -> Result<World, Error> {
    World::new(Settings::default().with_rule(rule))
}

/// Creates an empty world under the rule `discrete` with this integrator.
pub fn world_with(integrator: Integrator) -> Result<World, Error> {
    world(Discrete::default().with_integrator(integrator).into())
}

/// Creates a world with gravity and a floor at height 0 with this restitution.
pub fn world_with_floor(rule: Rule, restitution: f64) -> Result<World, Error> {
    let mut world = world(rule)?;
    world.add_force(Gravity::new(DVec3::new(0.0, -G, 0.0)))?;
    world.add_collider(half_space(DVec3::ZERO, DVec3::Y).with_restitution(restitution))?;
    Ok(world)
}

/// Creates a half-space whose surface contains `point` and faces `normal`.
pub fn half_space(point: DVec3, normal: DVec3) -> Collider {
    let rotation = DQuat::from_rotation_arc(DVec3::Y, normal);
    Collider::new(Shape::HalfSpace, Pose::at(point).rotated(rotation))
}

/// Adds six half-spaces around a cube with this edge about the origin.
pub fn add_walls(world: &mut World, edge: f64) -> Result<(), Error> {
    for normal in [DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::NEG_Y, DVec3::Z, DVec3::NEG_Z] {
        world.add_collider(half_space(-0.5 * edge * normal, normal))?;
    }
    Ok(())
}

/// Steps to `time` \[s\] in whole frames.
pub fn run_until(world: &mut World, time: f64, h: f64) -> Result<(), Error> {
    // The number of frames is rounded up; 1e-9 of a frame is a rounding error.
    while world.time() < time - 1e-9 * h {
        world.step(h)?;
    }
    Ok(())
}
