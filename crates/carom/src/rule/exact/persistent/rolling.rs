//! A sphere that is pressed onto a plane where friction acts: it slides, rolls, spins and stops
//! (`docs/physics/persistent-contacts.md`).

use glam::DVec3;

use super::accelerations::IDLE;
use super::piece::TURN;
use crate::friction::ContactFriction;
use crate::norm::Norm;

/// Directions count as one if the sine of the angle between them is smaller: rounding.
const SAME_DIRECTION: f64 = 1e-13;

/// A sphere on a plane in a place at rest.
#[derive(Debug, Clone, Copy)]
pub(super) struct PressedSphere {
    /// Unit normal out of the plane.
    pub normal: DVec3,
    /// Velocity of the material of the plane, along it \[m/s\].
    pub belt: DVec3,
    /// Radius \[m\].
    pub radius: f64,
    /// Moment of inertia divided by m r².
    pub inertia_factor: f64,
    /// Along the plane \[m/s\].
    pub velocity: DVec3,
    /// Angular velocity \[rad/s\].
    pub angular_velocity: DVec3,
    /// Normal force divided by the mass, > 0 \[m/s²\].
    pub pressing: f64,
    /// Applied force along the plane divided by the mass \[m/s²\].
    pub pull: DVec3,
    pub friction: ContactFriction,
}

/// The motion of a sphere under friction.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rolling {
    /// Along the plane \[m/s\].
    pub velocity: DVec3,
    /// Angular velocity \[rad/s\].
    pub angular_velocity: DVec3,
    /// Along the plane \[m/s²\].
    pub acceleration: DVec3,
    /// Angular acceleration \[rad/s²\].
    pub angular_acceleration: DVec3,
    /// How long that holds \[s\].
    pub valid_for: f64,
}

impl Rolling {
    pub const AT_REST: Self = Self {
        velocity: DVec3::ZERO,
        angular_velocity: DVec3::ZERO,
        acceleration: DVec3::ZERO,
        angular_acceleration: DVec3::ZERO,
        valid_for: f64::INFINITY,
    };

    /// Whether the sphere stays at its place, spinning or not.
    pub fn is_at_rest(&self) -> bool {
        [self.velocity, self.acceleration] == [DVec3::ZERO; 2]
    }
}

/// The motion of a sphere on a plane, whose material may move along it: that on a plane at rest, seen from the
/// material.
pub(super) fn on_plane(sphere: &PressedSphere, contact_duration: f64) -> Rolling {
    let belt = sphere.belt;
    if belt == DVec3::ZERO {
        return on_plane_at_rest(sphere, contact_duration);
    }
    let beside = PressedSphere { velocity: sphere.velocity - belt, belt: DVec3::ZERO, ..*sphere };
    let rolling = on_plane_at_rest(&beside, contact_duration);
    Rolling { velocity: rolling.velocity + belt, ..rolling }
}

/// The motion of a sphere on a plane at rest: it slides while its surface moves along the plane, else it rolls or rests. A
/// slip or spin that friction would end within a contact's duration \[s\] has ended.
///
/// With n the normal, g what presses, p the pull, k the inertia factor:
///
/// - slip `s = v - r w × n`; sliding, `v' = p - mu g s/|s|` and `s' = p - (1 + 1/k) mu g s/|s|`
/// - rolling, `v' = (p - mu_r g v/|v|) / (1 + k)`, and `w = n × v / r` across the normal
/// - spinning, `w·n' = -mu_s g / (k r)` against it
///
/// Source: Coulomb's law and the torques `mu_r r N`, `mu_s r N`; derived in
/// `docs/physics/persistent-contacts.md`, "Friction".
fn on_plane_at_rest(sphere: &PressedSphere, contact_duration: f64) -> Rolling {
    let PressedSphere { normal, radius, inertia_factor, pressing, .. } = *sphere;
    let rolling = if sphere.slides(contact_duration) {
        sphere.sliding(contact_duration)
    } else {
        sphere.rolling(contact_duration)
    };
    let spin = sphere.angular_velocity.dot(normal);
    let spin_loss = sphere.friction.spinning * pressing / (inertia_factor * radius);
    if spin.abs() <= spin_loss * contact_duration {
        return rolling;
    }
    let loss = if spin_loss > 0.0 { -spin.signum() * spin_loss } else { 0.0 };
    Rolling {
        angular_velocity: rolling.angular_velocity + spin * normal,
        angular_acceleration: rolling.angular_acceleration + loss * normal,
        valid_for: rolling.valid_for.min(spin.abs() / spin_loss),
        ..rolling
    }
}

impl PressedSphere {
    /// Whether neither the sphere nor the material of the plane moves, and no force acts along the plane.
    pub fn is_at_rest(&self) -> bool {
        [self.velocity, self.angular_velocity, self.pull, self.belt] == [DVec3::ZERO; 4]
    }

    /// The sphere when it rolls with a velocity \[m/s\] and spins as before.
    pub fn rolling_with(&self, velocity: DVec3) -> Self {
        let spin = self.angular_velocity.dot(self.normal) * self.normal;
        let turning = self.turning_with(velocity - self.belt);
        Self { velocity, angular_velocity: turning + spin, ..*self }
    }

    /// Velocity with which its surface slides along the plane \[m/s\].
    fn slip(&self) -> DVec3 {
        self.velocity - self.radius * self.angular_velocity.cross(self.normal)
    }

    /// Deceleration of the slip by friction \[m/s²\].
    fn slip_loss(&self) -> f64 {
        (1.0 + 1.0 / self.inertia_factor) * self.friction.sliding * self.pressing
    }

    /// Sliding friction, or the friction that keeps the sphere rolling, divided by the mass \[m/s²\].
    pub fn friction_now(&self, slides: bool) -> DVec3 {
        if slides {
            let limit = self.friction.sliding * self.pressing;
            return -limit * direction_of(self.slip(), self.pull);
        }
        let share = 1.0 / (1.0 + self.inertia_factor);
        let loss = self.rolling_loss(self.velocity);
        -share * (self.inertia_factor * self.pull + loss * direction_of(self.velocity, self.pull))
    }

    /// Angular acceleration \[rad/s²\] under friction \[m/s²\], and under the torques against rolling and
    /// spinning.
    pub fn angular_acceleration_under(&self, friction: DVec3, slides: bool) -> DVec3 {
        let moment = 1.0 / self.inertia_factor;
        let mut torque = -self.turning_with(friction);
        if !slides {
            let rolls = direction_of(self.velocity, self.pull);
            torque -= self.rolling_loss(self.velocity) * self.turning_with(rolls);
        }
        let spin = self.angular_velocity.dot(self.normal);
        if spin != 0.0 {
            let loss = self.friction.spinning * self.pressing / self.radius;
            torque -= spin.signum() * loss * self.normal;
        }
        moment * torque
    }

    /// Whether the surface of the sphere slides along the plane, or begins to, for longer than a contact's duration
    /// \[s\].
    pub fn slides(&self, contact_duration: f64) -> bool {
        let slip = self.slip().norm();
        slip > self.slip_loss() * contact_duration
            || self.pull.norm() > self.slip_loss() * (1.0 + IDLE)
    }

    /// Angular velocity \[rad/s\] of rolling with a velocity \[m/s\], or the rates of change of both.
    fn turning_with(&self, velocity: DVec3) -> DVec3 {
        self.normal.cross(velocity) / self.radius
    }

    fn sliding(&self, contact_duration: f64) -> Rolling {
        let slip = self.slip();
        let piece = Piece::of(slip, self.pull, self.slip_loss(), contact_duration);
        // Friction that changes the slip, without the effect of the pull.
        let friction = self.friction.sliding * self.pressing * piece.against;
        let turning = -self.turning_with(friction) / self.inertia_factor;
        Rolling {
            velocity: self.velocity,
            angular_velocity: self.across(self.angular_velocity),
            acceleration: self.pull + friction,
            angular_acceleration: turning,
            valid_for: piece.valid_for,
        }
    }

    fn rolling(&self, contact_duration: f64) -> Rolling {
        let share = 1.0 / (1.0 + self.inertia_factor);
        let mut velocity = self.velocity - self.inertia_factor * share * self.slip();
        let wanted = self.friction.rolling * self.pressing;
        if velocity.norm() <= (wanted + self.pull.norm()) * contact_duration {
            velocity = DVec3::ZERO;
        }
        let loss = self.rolling_loss(velocity);
        if velocity == DVec3::ZERO && self.pull.norm() <= loss {
            return Rolling::AT_REST;
        }
        let piece = Piece::of(velocity, share * self.pull, share * loss, contact_duration);
        let acceleration = share * (self.pull + loss * piece.against);
        Rolling {
            velocity,
            angular_velocity: self.turning_with(velocity),
            acceleration,
            angular_acceleration: self.turning_with(acceleration),
            valid_for: piece.valid_for,
        }
    }

    /// The part of the acceleration of a sphere that does not turn which rolling friction takes \[m/s²\]: at most
    /// what sliding friction can balance.
    fn rolling_loss(&self, velocity: DVec3) -> f64 {
        let wanted = self.friction.rolling * self.pressing;
        let held = self.inertia_factor * self.pull;
        let most = (1.0 + self.inertia_factor) * self.friction.sliding * self.pressing;
        // |held + loss d| = most, with d the direction of rolling.
        let along = held.dot(direction_of(velocity, self.pull));
        let room = (most * most - held.length_squared()).max(0.0);
        wanted.min((along * along + room).sqrt() - along)
    }

    fn across(&self, vector: DVec3) -> DVec3 {
        vector - vector.dot(self.normal) * self.normal
    }
}

/// The direction of a velocity, or of the pull where there is none.
fn direction_of(velocity: DVec3, pull: DVec3) -> DVec3 {
    let way = if velocity == DVec3::ZERO { pull } else { velocity };
    if way == DVec3::ZERO { way } else { way / way.norm() }
}

/// A piece of a motion `u' = p - c u/|u|` under dry friction.
struct Piece {
    /// The mean of `-u/|u|`.
    against: DVec3,
    /// How long that holds \[s\].
    valid_for: f64,
}

impl Piece {
    /// The piece from a velocity \[m/s\] on, under a pull and a loss \[m/s²\]: to where friction has ended the
    /// velocity, exactly, or where the direction has turned by [`TURN`]. Over the piece the velocity
    /// changes by as much as it does on the true path.
    fn of(velocity: DVec3, pull: DVec3, loss: f64, contact_duration: f64) -> Self {
        let speed = velocity.norm();
        if loss == 0.0 {
            return Self { against: -direction_of(velocity, pull), valid_for: f64::INFINITY };
        }
        if speed <= loss * contact_duration {
            // A sphere that begins to move follows the pull.
            return Self { against: -direction_of(DVec3::ZERO, pull), valid_for: f64::INFINITY };
        }
        let direction = velocity / speed;
        let along = pull.dot(direction);
        let aside = (pull - along * direction).norm();
        if aside <= SAME_DIRECTION * (pull.norm() + loss) {
            let valid_for = if along < loss { speed / (loss - along) } else { f64::INFINITY };
            return Self { against: -direction, valid_for };
        }
        let stops = stopping_time(velocity, pull, loss);
        let turns = (TURN * speed / aside).max(contact_duration);
        let valid_for = turns.min(stops);
        let end = if stops <= turns { DVec3::ZERO } else { after(velocity, pull, loss, valid_for) };
        let against = ((end - velocity) / valid_for - pull) / loss;
        Self { against, valid_for }
    }
}

/// When a velocity \[m/s\] ends under a pull and a loss \[m/s²\] \[s\]: `|u| (c + p cos)` falls steadily, with
/// the angle between u and p.
fn stopping_time(velocity: DVec3, pull: DVec3, loss: f64) -> f64 {
    let room = (loss - pull.norm()) * (loss + pull.norm());
    if room <= 0.0 {
        return f64::INFINITY;
    }
    (loss * velocity.norm() + velocity.dot(pull)) / room
}

/// A velocity after `h` \[s\], by one step of the method of Runge and Kutta, in which its direction hardly
/// turns: the error is below rounding.
fn after(velocity: DVec3, pull: DVec3, loss: f64, h: f64) -> DVec3 {
    let rate = |velocity: DVec3| pull - loss * (velocity / velocity.norm());
    let first = rate(velocity);
    let second = rate(velocity + 0.5 * h * first);
    let third = rate(velocity + 0.5 * h * second);
    let fourth = rate(velocity + h * third);
    velocity + h / 6.0 * (first + 2.0 * (second + third) + fourth)
}
