//! How surfaces move.

use glam::DVec3;

use crate::pose::Pose;

/// How a surface moves: it turns about `origin`, which moves itself.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct SurfaceMotion {
    /// Now \[m\].
    pub origin: DVec3,
    /// Velocity \[m/s\].
    pub velocity: DVec3,
    /// Along the axis of rotation \[rad/s\].
    pub angular_velocity: DVec3,
    /// Velocity of the material along the surface, relative to its place, now \[m/s\]: that of a belt.
    pub belt: DVec3,
    /// How the motion of the place changes, if it does.
    pub drive: Option<Drive>,
}

/// How the motion of a surface changes.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Drive {
    /// Acceleration of the origin \[m/s²\].
    pub acceleration: DVec3,
    /// Angular acceleration \[rad/s²\].
    pub angular_acceleration: DVec3,
    /// A bound of the rate at which it repeats or turns \[rad/s\].
    pub rate: f64,
    /// How long the accelerations stay continuous \[s\]; infinite unless they jump at some time.
    pub smooth_for: f64,
    /// Whether it turns at some time.
    pub turns: bool,
}

impl SurfaceMotion {
    /// Motion of a surface at rest.
    pub const REST: Self = Self {
        origin: DVec3::ZERO,
        velocity: DVec3::ZERO,
        angular_velocity: DVec3::ZERO,
        belt: DVec3::ZERO,
        drive: None,
    };

    /// Whether its place never changes.
    pub fn is_at_rest(&self) -> bool {
        let is_slow = self.velocity == DVec3::ZERO && self.angular_velocity == DVec3::ZERO;
        is_slow && self.drive.is_none()
    }

    /// Returns the velocity \[m/s\] of the surface at one of its points.
    pub fn velocity_at(&self, point: DVec3) -> DVec3 {
        self.velocity + self.angular_velocity.cross(point - self.origin)
    }

    /// Velocity \[m/s\] of the material relative to the surface, where that has this normal.
    pub fn belt_across(&self, normal: DVec3) -> DVec3 {
        self.belt - self.belt.dot(normal) * normal
    }

    /// Returns whether the motion turns directions.
    pub fn turns(&self) -> bool {
        self.angular_velocity != DVec3::ZERO || self.drive.is_some_and(|it| it.turns)
    }

    /// Acceleration \[m/s²\], as seen from the surface, of what flies at a point without forces, with this velocity \[m/s\].
    pub fn swing(&self, point: DVec3, velocity: DVec3) -> DVec3 {
        if !self.turns() {
            return DVec3::ZERO;
        }
        let turning = self.angular_velocity;
        let beside = velocity - self.velocity_at(point);
        -turning.cross(2.0 * beside + turning.cross(point - self.origin))
    }

    /// Acceleration \[m/s²\] in space of what is at a point with this velocity \[m/s\] and does not accelerate as seen
    /// from the surface: with Coriolis' part, `A + α × r + ω × (ω × r) + 2 ω × (v - u)`.
    pub fn carrying(&self, point: DVec3, velocity: DVec3) -> DVec3 {
        let swing = -self.swing(point, velocity);
        match self.drive {
            Some(Drive { acceleration, angular_acceleration, .. }) => {
                swing + acceleration + angular_acceleration.cross(point - self.origin)
            }
            None => swing,
        }
    }

    /// A direction that turns along, after `h` \[s\].
    pub fn turned(&self, direction: DVec3, h: f64) -> DVec3 {
        if !self.turns() {
            return direction;
        }
        Pose::at(DVec3::ZERO).moved(DVec3::ZERO, self.angular_velocity, h).rotation * direction
    }

    /// Returns where a point \[m\] that moves with the surface is after `h` \[s\].
    pub fn carried(&self, point: DVec3, h: f64) -> DVec3 {
        if !self.turns() {
            return point + h * self.velocity;
        }
        self.origin + h * self.velocity + self.turned(point - self.origin, h)
    }

    /// Returns where a point \[m\] was that has moved with the surface for `h` \[s\].
    pub fn carried_back(&self, point: DVec3, h: f64) -> DVec3 {
        if !self.turns() {
            return point - h * self.velocity;
        }
        self.origin + self.turned(point - h * self.velocity - self.origin, -h)
    }

    /// Velocity \[m/s\] after `h` \[s\] of the surface at a point that is there then.
    pub fn velocity_after(&self, point: DVec3, h: f64) -> DVec3 {
        if !self.turns() {
            return self.velocity;
        }
        self.velocity + self.angular_velocity.cross(point - h * self.velocity - self.origin)
    }
}
