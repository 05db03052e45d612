//! Changes of one collider in many worlds.

use carom::{Collider, ColliderId, DQuat, DVec3, Friction, Motion, Pose, World};

use crate::failure::Failure;

/// A quantity of a collider that has a row for each world.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ColliderQuantity {
    Position,
    Rotation,
    Velocity,
    AngularVelocity,
    Restitution,
    Friction,
    RollingFriction,
    SpinningFriction,
    TangentialRestitution,
}

/// A quantity and its values, one world after another.
pub type ColliderColumn = (ColliderQuantity, Vec<f64>);

impl ColliderQuantity {
    const ALL: [(Self, &str); 9] = [
        (Self::Position, "position"),
        (Self::Rotation, "rotation"),
        (Self::Velocity, "velocity"),
        (Self::AngularVelocity, "angular_velocity"),
        (Self::Restitution, "restitution"),
        (Self::Friction, "friction"),
        (Self::RollingFriction, "rolling_friction"),
        (Self::SpinningFriction, "spinning_friction"),
        (Self::TangentialRestitution, "tangential_restitution"),
    ];

    /// Returns the quantity with a name.
    ///
    /// # Errors
    /// [`Failure`] if none has it.
    pub fn named(name: &str) -> Result<Self, Failure> {
        let known = Self::ALL.into_iter().find(|(_, known)| *known == name);
        known.map(|(quantity, _)| quantity).ok_or_else(|| Failure::unknown("quantity", name))
    }

    fn width(self) -> usize {
        match self {
            Self::Rotation => 4,
            Self::Position | Self::Velocity | Self::AngularVelocity => 3,
            _ => 1,
        }
    }

    /// Returns the shape of the array for `count` worlds.
    pub fn shape(self, count: usize) -> Vec<usize> {
        match self.width() {
            1 => vec![count],
            width => vec![count, width],
        }
    }

    /// Returns a collider with these values of the quantity.
    fn changed(self, collider: Collider, values: &[f64]) -> Collider {
        let value = values[0];
        let with_friction = |change: fn(&mut Friction) -> &mut Option<f64>| {
            let mut friction = collider.friction;
            *change(&mut friction) = (!value.is_nan()).then_some(value);
            collider.clone().with_friction(friction)
        };
        match self {
            Self::Position => {
                let pose = Pose { position: DVec3::from_slice(values), ..collider.pose };
                collider.with_pose(pose)
            }
            Self::Rotation => {
                let pose = Pose { rotation: DQuat::from_slice(values), ..collider.pose };
                collider.with_pose(pose)
            }
            Self::Velocity => {
                let turning = collider.angular_velocity;
                collider.moving(DVec3::from_slice(values), turning)
            }
            Self::AngularVelocity => {
                let velocity = collider.velocity;
                collider.moving(velocity, DVec3::from_slice(values))
            }
            Self::Restitution => collider.with_restitution(value),
            Self::Friction => with_friction(|it| &mut it.sliding),
            Self::RollingFriction => with_friction(|it| &mut it.rolling),
            Self::SpinningFriction => with_friction(|it| &mut it.spinning),
            Self::TangentialRestitution => with_friction(|it| &mut it.tangential_restitution),
        }
    }
}

/// Returns a collider of a world with this motion, and the values in `row` of the columns.
///
/// # Errors
/// [`Failure`] if there is no such collider, or it refuses a value.
pub fn changed(
    world: &World,
    id: ColliderId,
    (motion, columns): (Option<&Motion>, &[ColliderColumn]),
    row: usize,
) -> Result<Collider, Failure> {
    let mut collider = world.collider(id)?;
    if let Some(motion) = motion {
        collider = collider.with_motion(motion.parts().iter().cloned());
    }
    for (quantity, values) in columns {
        let width = quantity.width();
        collider = quantity.changed(collider, &values[row * width..(row + 1) * width]);
    }
    world.check_collider(id, &collider)?;
    Ok(collider)
}
