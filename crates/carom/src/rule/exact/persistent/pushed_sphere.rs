//! A sphere on a plane at rest under the push of other spheres: how it slides, rolls and spins
//! (`docs/physics/persistent-contacts.md`).

use glam::DVec3;

use super::accelerations::IDLE;
use crate::friction::ContactFriction;
use crate::norm::Norm;

/// Force and torque of the contacts with other spheres.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Push {
    /// Force \[N\].
    pub force: DVec3,
    /// About the centre \[N m\].
    pub torque: DVec3,
}

/// Motion of a sphere under a push, with the force of the plane.
#[derive(Debug, Clone, Copy)]
pub(super) struct Response {
    /// Along the plane \[m/s²\].
    pub acceleration: DVec3,
    /// Angular acceleration \[rad/s²\].
    pub angular_acceleration: DVec3,
    /// Force of the plane along its normal \[N\]; negative where the push lifts the sphere.
    pub normal_force: f64,
    /// Friction of the plane \[N\].
    pub friction: DVec3,
}

/// A sphere on a plane at rest, with the velocities that friction opposes.
#[derive(Debug, Clone, Copy)]
pub(super) struct PushedSphere {
    /// Unit normal out of the plane; zero for a flying sphere, which slides along nothing.
    pub normal: DVec3,
    /// Radius \[m\].
    pub radius: f64,
    /// Mass \[kg\].
    pub mass: f64,
    /// Moment of inertia divided by m r².
    pub inertia_factor: f64,
    /// Acceleration without contacts \[m/s²\].
    pub acceleration: DVec3,
    pub friction: ContactFriction,
    /// Direction in which its surface slides along the plane; `None` where it does not.
    pub slides: Option<DVec3>,
    /// Direction in which it moves along the plane; `None` where it does not.
    pub moves: Option<DVec3>,
    /// Sign of its spin about the normal; zero where it does not spin.
    pub spin: f64,
}

/// Tangential forces on a sphere that does not slide \[N\].
#[derive(Clone, Copy)]
struct Drive {
    /// Force along the plane on a sphere that rolls without rolling friction.
    force: DVec3,
    /// Friction that keeps it rolling then.
    held: DVec3,
    /// The largest friction.
    limit: f64,
    pressing: f64,
}

impl PushedSphere {
    /// Returns how the sphere moves under a push. With f and τ of the push and P the force of the plane,
    /// m a = f + m g + F along the plane and κ m r² α = τ − r n × F:
    ///
    /// - sliding, `F = −μ P s/|s|`
    /// - rolling, `(1 + κ) m a = f + m g + τ × n/r − μ_r P v/|v|` and `α = n × a/r` across the normal
    ///
    /// It rolls while that takes no more friction than μ P, else it begins to slide.
    pub fn response(&self, push: Push) -> Response {
        let Self { normal, radius, inertia_factor, friction, .. } = *self;
        let total = push.force + self.mass * self.acceleration;
        let normal_force = -total.dot(normal);
        let pressing = normal_force.max(0.0);
        let (drawn, limit) = (self.across(total), friction.sliding * pressing);
        let twist = push.torque.cross(normal) / radius;
        let held = (twist - inertia_factor * drawn) / (1.0 + inertia_factor);
        let begins = held.norm() > limit * (1.0 + IDLE);
        let friction_force = match self.slides {
            Some(direction) => Some(-limit * direction),
            None => begins.then(|| limit * held / held.norm()),
        };
        let drive = Drive { force: drawn + twist, held, limit, pressing };
        let spin_up = self.spin_up(push.torque.dot(normal), pressing);
        match friction_force {
            Some(friction) => {
                let turning = self.across(push.torque) - radius * normal.cross(friction);
                Response {
                    acceleration: (drawn + friction) / self.mass,
                    angular_acceleration: turning / self.moment() + spin_up,
                    normal_force,
                    friction,
                }
            }
            None => {
                let (acceleration, friction) = self.rolling_under(&drive);
                let turning = normal.cross(acceleration) / radius;
                let angular_acceleration = turning + spin_up;
                Response { acceleration, angular_acceleration, normal_force, friction }
            }
        }
    }

    /// Acceleration of a sphere that rolls or rests \[m/s²\], and the friction that it takes \[N\].
    fn rolling_under(&self, drive: &Drive) -> (DVec3, DVec3) {
        let share = 1.0 / (1.0 + self.inertia_factor);
        let way = self.moves.unwrap_or(drive.force);
        let direction = if way == DVec3::ZERO { way } else { way / way.norm() };
        let loss = self.rolling_loss(drive, direction);
        let stays = self.moves.is_none() && drive.force.norm() <= loss;
        let against = if stays { drive.force } else { loss * direction };
        (share * (drive.force - against) / self.mass, drive.held - share * against)
    }

    /// Rolling friction \[N\]; at most what sliding friction can balance.
    fn rolling_loss(&self, drive: &Drive, direction: DVec3) -> f64 {
        let wanted = self.friction.rolling * drive.pressing;
        let along = drive.held.dot(direction);
        let room = (drive.limit * drive.limit - drive.held.length_squared()).max(0.0);
        wanted.min((1.0 + self.inertia_factor) * (along + (along * along + room).sqrt()))
    }

    /// Angular acceleration about the normal \[rad/s²\] under a torque about it \[N m\] and spinning friction.
    fn spin_up(&self, torque: f64, pressing: f64) -> DVec3 {
        let limit = self.friction.spinning * self.radius * pressing;
        let left = match self.spin {
            0.0 => torque.signum() * (torque.abs() - limit).max(0.0),
            spin => torque - spin.signum() * limit,
        };
        left / self.moment() * self.normal
    }

    fn moment(&self) -> f64 {
        self.inertia_factor * self.mass * self.radius * self.radius
    }

    fn across(&self, vector: DVec3) -> DVec3 {
        vector - vector.dot(self.normal) * self.normal
    }
}
