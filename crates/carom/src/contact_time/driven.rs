//! Paths relative to a body that moves by a motion of its own.

use std::cell::Cell;

use glam::{DQuat, DVec3};

use super::path::{Path, State};
use super::roundoff::Magnitudes;
use crate::collider_motion::{Course, Kinematics, MotionBounds};
use crate::norm::Norm;

/// A path in the coordinates of a body that moves by a motion. With ξ from the origin of the body and R the rotation
/// since the start,
///
/// ```text
/// y = R⁻¹ ξ      y' = R⁻¹ (ξ' - ω×ξ)      y'' = R⁻¹ (ξ'' - 2 ω×ξ' + ω×(ω×ξ) - ω'×ξ)
/// ```
#[derive(Debug, Clone)]
pub(super) struct Driven<'a, P> {
    /// Path from the place of the body's origin at time 0.
    path: P,
    course: &'a Course,
    start: Kinematics,
    /// Where positions count from, in the coordinates of the body \[m\].
    about: DVec3,
    /// Time of the last evaluation \[s\], with the motion of the body then.
    last: Cell<(f64, Kinematics)>,
}

/// Position, velocity and acceleration of the path relative to the origin of the body, with the motion of that.
struct Relative {
    arm: DVec3,
    velocity: DVec3,
    acceleration: DVec3,
    /// Acceleration of the path alone \[m/s²\].
    own: DVec3,
    size: Magnitudes,
    body: Kinematics,
}

impl Relative {
    /// `ξ'' - 2 ω×ξ' + ω×(ω×ξ) - ω'×ξ`
    fn felt(&self) -> DVec3 {
        let (spin, growth) = (self.body.angular_velocity, self.body.angular_acceleration);
        self.acceleration
            - spin.cross(2.0 * self.velocity - spin.cross(self.arm))
            - growth.cross(self.arm)
    }
}

/// Upper bounds of a path relative to the origin of the body, over some time.
struct Most {
    arm: f64,
    speed: f64,
    acceleration: f64,
    jerk: f64,
    body: MotionBounds,
}

impl Most {
    /// Returns a bound of the size of `y''`.
    fn felt(&self) -> f64 {
        let MotionBounds { spin, spin_growth, .. } = self.body;
        self.acceleration + 2.0 * spin * self.speed + (spin * spin + spin_growth) * self.arm
    }

    /// Returns a bound of the size of `y'''`: that of the derivatives of each term, and of ω times
    /// `y''`.
    fn felt_jerk(&self) -> f64 {
        let MotionBounds { spin, spin_growth, spin_jerk, .. } = self.body;
        self.jerk
            + 2.0 * spin * self.acceleration
            + (3.0 * spin_growth + spin * spin) * self.speed
            + (spin_jerk + 2.0 * spin * spin_growth) * self.arm
            + spin * self.felt()
    }
}

impl<'a, P: Path> Driven<'a, P> {
    /// A path from the origin of a body that moves by this course from its time 0 on; positions count from `about`
    /// \[m\], as it is then.
    pub fn new(path: P, course: &'a Course, about: DVec3) -> Self {
        let start = course.state(0.0);
        Self { path, course, start, about, last: Cell::new((0.0, start)) }
    }

    fn body_at(&self, t: f64) -> Kinematics {
        let (time, state) = self.last.get();
        if time == t {
            return state;
        }
        let state = self.course.state(t);
        self.last.set((t, state));
        state
    }

    fn relative(&self, t: f64) -> Relative {
        let State { position, velocity, acceleration, size } = self.path.state_at(t);
        let body = self.body_at(t);
        Relative {
            arm: position - (body.offset - self.start.offset),
            velocity: velocity - body.velocity,
            acceleration: acceleration - body.acceleration,
            own: acceleration,
            size,
            body,
        }
    }

    /// Returns the inverse of the rotation since the start.
    fn back(&self, body: &Kinematics) -> Option<DQuat> {
        self.course.turns().then(|| self.start.rotation * body.rotation.conjugate())
    }

    fn most(&self, now: &Relative, [from, to]: [f64; 2]) -> Most {
        let ahead = to - from;
        let body = self.course.bounds(from, ahead);
        let growth = self.path.growth(to);
        let own = now.own.norm() + growth * ahead;
        let acceleration = own + body.acceleration;
        let speed = now.velocity.norm();
        Most {
            arm: now.arm.norm() + ahead * (speed + 0.5 * acceleration * ahead),
            speed: speed + acceleration * ahead,
            acceleration,
            jerk: self.path.decay_rate() * own + growth + body.jerk,
            body,
        }
    }
}

impl<P: Path> Path for Driven<'_, P> {
    fn state_at(&self, t: f64) -> State {
        let now = self.relative(t);
        let Kinematics { angular_velocity: spin, .. } = now.body;
        let turned = |vector: DVec3| self.back(&now.body).map_or(vector, |back| back * vector);
        let (rate, arm) = (spin.norm(), now.arm.norm());
        let swing = rate * arm;
        let moved = (now.body.offset - self.start.offset).norm();
        let gone = self.course.rate() * t;
        let speed = now.body.velocity.norm();
        let pull = now.body.acceleration.norm() + now.body.angular_acceleration.norm() * arm;
        State {
            position: turned(now.arm) - self.about,
            velocity: turned(now.velocity - spin.cross(now.arm)),
            acceleration: turned(now.felt()),
            size: now.size
                + Magnitudes {
                    // Phases are rounded as the time is.
                    length: moved + speed * t + arm + swing * t,
                    speed: (speed + swing) * (1.0 + gone),
                    acceleration: (pull + rate * (2.0 * now.velocity.norm() + swing))
                        * (1.0 + gone),
                },
        }
    }

    fn max_acceleration(&self, direction: DVec3, from: f64, to: f64) -> f64 {
        let now = self.relative(from);
        let most = self.most(&now, [from, to]);
        let direction = self.back(&now.body).map_or(direction, |it| it.conjugate() * direction);
        let by_jerk = direction.dot(now.felt()) + most.felt_jerk() * (to - from);
        let by_size = if self.course.turns() {
            most.felt()
        } else {
            self.path.max_acceleration(direction, from, to) + most.body.acceleration
        };
        by_jerk.min(by_size)
    }

    fn max_acceleration_anywhere(&self, from: f64, to: f64) -> f64 {
        self.most(&self.relative(from), [from, to]).felt()
    }

    fn growth(&self, to: f64) -> f64 {
        self.most(&self.relative(0.0), [0.0, to]).felt_jerk()
    }

    fn window(&self) -> f64 {
        self.course.rate().recip()
    }
}
