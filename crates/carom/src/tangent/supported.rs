//! The derivative of a flight in persistent contact with a plane.

use glam::DVec3;

use super::coefficients::Combined;
use super::dry_motion::{DryMotion, Moved};
use super::dual::{Dual, vector};
use super::state::{NUMBERS, SphereTangent};
use super::variation::{SphereVariation, Variation};
use crate::flight::Propagator;
use crate::forces::LinearForce;
use crate::id::{ColliderId, SphereId};
use crate::real::Vector;

/// Fraction of the speeds that make a slip, below which the slip is rounding.
const SLIP: f64 = 1e-12;
/// Fraction by which a pull has to exceed what friction can hold.
const MORE: f64 = 1e-9;
/// Largest error of the velocities at the end of a flight as a fraction of them, and of the velocity that friction takes
/// in the error of its time: the world stops a slip up to a contact duration early.
const OFF: f64 = 1e-4;
/// Largest error of an acceleration as a fraction of the free one: the world takes its mean over a turn of 10⁻³ rad.
const TURN: f64 = 2e-3;

/// A flight of a sphere in contact with one plane at rest: without friction, or sliding, rolling or resting with
/// spin (`docs/physics/persistent-contacts.md`, "Friction").
#[derive(Debug, Clone)]
pub(super) struct SupportedFlight {
    /// Index of the sphere in the arrays of the world.
    pub place: usize,
    pub id: SphereId,
    pub collider: ColliderId,
    /// Unit normal out of the plane.
    pub normal: DVec3,
    pub radius: f64,
    pub inertia_factor: f64,
    pub velocity: DVec3,
    pub angular_velocity: DVec3,
    /// Forces other than those of the contact.
    pub linear: LinearForce,
    /// Derivatives of their acceleration by the radius of the sphere, and by its mass.
    pub by_inputs: [DVec3; 2],
    pub sliding: Combined,
    pub rolling: f64,
    pub spinning: f64,
    pub mode: Mode,
    /// Length \[s\].
    pub time: f64,
    /// Start, counted from the start of the derivatives \[s\].
    pub began: f64,
    pub ending: Ending,
    /// Accelerations after the flight.
    pub after: Rates,
}

/// How a sphere moves along a plane.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Mode {
    /// The sphere slides without friction.
    Gliding,
    Sliding,
    Rolling,
    Resting,
}

/// What ends a flight in persistent contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Ending {
    /// An event that does not depend on the flight itself.
    Given,
    /// The end of the sliding.
    Slip,
    /// The end of the rolling.
    Roll,
    /// The end of the spinning.
    Spin,
}

/// Accelerations of a sphere.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rates {
    /// Acceleration by everything but drag \[m/s²\], and drag rate \[1/s\].
    pub linear: LinearForce,
    /// Angular acceleration \[rad/s²\].
    pub angular_acceleration: DVec3,
}

impl Rates {
    /// Returns the acceleration at a velocity \[m/s²\].
    pub fn acceleration(&self, velocity: DVec3) -> DVec3 {
        self.linear.acceleration - self.linear.drag_rate * velocity
    }
}

/// A small change of all inputs of a flight.
#[derive(Debug, Clone, Copy, Default)]
struct Change {
    sphere: SphereTangent,
    radius: f64,
    sliding: f64,
    acceleration: DVec3,
    /// Change of the position of the surface at the start of the flight.
    surface_position: DVec3,
    surface_velocity: DVec3,
}

/// Motion along the plane, relative to it, and the accelerations that act on it.
struct Pressed {
    velocity: Vector<Dual>,
    angular_velocity: Vector<Dual>,
    radius: Dual,
    /// Acceleration that presses the sphere on the plane, and the pull along the plane \[m/s²\].
    pressing: Dual,
    pull: Vector<Dual>,
    /// Velocity along the normal \[m/s\], which the contact stops.
    parting: Dual,
    sliding: Dual,
}

/// State at the end of the flight.
struct End {
    way: Vector<Dual>,
    velocity: Vector<Dual>,
    angular_velocity: Vector<Dual>,
    time: Dual,
}

impl SupportedFlight {
    /// Returns the mode of the motion; `None` if friction does not suffice for rolling.
    pub fn mode_of(&self) -> Option<Mode> {
        let Self { normal, radius, inertia_factor, velocity, angular_velocity, .. } = *self;
        let sliding = self.sliding.value;
        if sliding == 0.0 {
            return Some(Mode::Gliding);
        }
        let pressing = -self.linear.acceleration.dot(normal);
        let pull = self.linear.acceleration + pressing * normal;
        let rim = radius * angular_velocity.cross(normal);
        let slip = velocity - rim;
        let holds = (1.0 + 1.0 / inertia_factor) * sliding * pressing;
        if slip.length() > SLIP * (velocity.length() + rim.length())
            || pull.length() > holds * (1.0 + MORE)
        {
            return Some(Mode::Sliding);
        }
        let loss = self.rolling * pressing;
        if velocity == DVec3::ZERO && pull.length() <= loss && loss > 0.0 {
            return Some(Mode::Resting);
        }
        let way = if velocity == DVec3::ZERO { pull } else { velocity };
        let needed = inertia_factor * pull + loss * way.normalize_or_zero();
        let most = (1.0 + inertia_factor) * sliding * pressing;
        (needed.length() <= most * (1.0 + MORE)).then_some(Mode::Rolling)
    }

    /// Returns the accelerations at the start by Coulomb's law, not averaged over a turn as in a step of the world.
    pub fn rates(&self) -> Option<Rates> {
        let Self { normal, radius, inertia_factor, velocity, angular_velocity, .. } = *self;
        let pressing = -self.linear.acceleration.dot(normal);
        let pull = self.linear.acceleration + pressing * normal;
        let against = |way: DVec3| {
            let way = if way == DVec3::ZERO { pull } else { way };
            -way.normalize_or_zero()
        };
        let (acceleration, turning) = match self.mode_of()? {
            Mode::Gliding => (pull, DVec3::ZERO),
            Mode::Sliding => {
                let slip = velocity - radius * angular_velocity.cross(normal);
                let friction = self.sliding.value * pressing * against(slip);
                (pull + friction, -normal.cross(friction) / (inertia_factor * radius))
            }
            Mode::Rolling => {
                let loss = self.rolling * pressing * against(velocity);
                let acceleration = (pull + loss) / (1.0 + inertia_factor);
                (acceleration, normal.cross(acceleration) / radius)
            }
            Mode::Resting => (DVec3::ZERO, DVec3::ZERO),
        };
        let spin = angular_velocity.dot(normal);
        let spin_loss = self.spinning * pressing / (inertia_factor * radius);
        let spinning = if spin == 0.0 { 0.0 } else { -spin.signum() * spin_loss };
        let linear = LinearForce { acceleration, ..self.linear };
        Some(Rates { linear, angular_acceleration: turning + spinning * normal })
    }

    /// Returns the cause of the end of the flight, given that `next` follows it in this mode.
    pub fn ending_before(&self, next: &Self, mode: Mode) -> Ending {
        let spin = |it: &Self| it.angular_velocity.dot(it.normal);
        match (self.mode, mode) {
            (Mode::Sliding, Mode::Rolling | Mode::Resting) => Ending::Slip,
            (Mode::Rolling, Mode::Resting) => Ending::Roll,
            _ if self.spinning > 0.0 && spin(self) != 0.0 && spin(next) == 0.0 => Ending::Spin,
            _ => Ending::Given,
        }
    }

    /// Returns whether an acceleration \[m/s²\] is that on the plane without other contacts.
    pub fn is_alone(&self, acceleration: DVec3) -> bool {
        let alone = self.rates().map(|it| it.linear.acceleration - acceleration);
        alone.is_some_and(|it| it.length() <= MORE * self.linear.acceleration.length())
    }

    /// Returns whether acceleration \[m/s²\] and final velocities agree with the flight of the world.
    pub fn is_that(&self, acceleration: DVec3, [velocity, angular_velocity]: [DVec3; 2]) -> bool {
        let end = self.end(&Change::default());
        let mean = (end.velocity.value() - self.velocity) / self.time;
        let pressing = self.linear.acceleration.length();
        let is_same = |found: DVec3, given: DVec3, scale: f64| (found - given).length() <= scale;
        let speeds = self.velocity.length() + velocity.length();
        let turns = self.angular_velocity.length() + angular_velocity.length();
        let speed = OFF * (speeds + self.radius * turns);
        let ends_then =
            (end.time.value - self.time).abs() * pressing <= speed + OFF * self.time * pressing;
        let has_drag = self.linear.drag_rate > 0.0;
        ends_then
            && is_same(end.velocity.value(), velocity, speed)
            && is_same(end.angular_velocity.value(), angular_velocity, speed / self.radius)
            && (has_drag
                || self.time == 0.0
                || is_same(mean, acceleration, TURN * pressing + speed / self.time))
    }

    /// Returns whether `next` continues this flight, so that the two can be joined.
    pub fn goes_on_with(&self, next: &Self) -> bool {
        let turns = self.mode == Mode::Sliding || self.mode == Mode::Rolling;
        let pressing = self.linear.acceleration.dot(self.normal);
        let pull = self.linear.acceleration - pressing * self.normal;
        self.ending == Ending::Given
            && self.mode == next.mode
            && (self.collider, self.normal) == (next.collider, next.normal)
            && (!turns || pull.length() <= SLIP * pressing.abs())
    }

    /// Applies the derivative of the flight to the derivatives of the spheres in one direction.
    pub fn pass(&self, direction: &Variation, spheres: &mut [SphereTangent]) {
        let sphere = direction.sphere(self.id);
        let collider = direction.collider(self.collider);
        let change = Change {
            sphere: spheres[self.place],
            radius: sphere.radius,
            sliding: self.sliding.change([collider.friction, sphere.friction]),
            acceleration: direction.acceleration + sphere.acceleration + self.by_inputs(&sphere),
            surface_position: collider.position + self.began * collider.velocity,
            surface_velocity: collider.velocity,
        };
        spheres[self.place] = self.apply(&change);
    }

    /// Replaces derivatives with respect to the motion at the end by derivatives with respect to the motion at the start,
    /// and adds the derivatives with respect to all other inputs to a gradient.
    pub fn pass_back(&self, spheres: &mut [SphereTangent], gradient: &mut Variation) {
        let after = spheres[self.place];
        let by = |change: Change| self.apply(&change).dot(&after);
        let along = |change: &dyn Fn(DVec3) -> Change| {
            DVec3::from_array(DVec3::AXES.map(|axis| by(change(axis))))
        };
        let nothing = Change::default();
        let by_acceleration = along(&|acceleration| Change { acceleration, ..nothing });
        gradient.acceleration += by_acceleration;
        let by_sliding = by(Change { sliding: 1.0, ..nothing });
        let sphere = gradient.sphere_mut(self.id);
        sphere.acceleration += by_acceleration;
        sphere.mass += self.by_inputs[1].dot(by_acceleration);
        sphere.radius += self.by_inputs[0].dot(by_acceleration);
        sphere.radius += by(Change { radius: 1.0, ..nothing });
        sphere.friction += self.sliding.by_bodies[1] * by_sliding;
        let by_place = along(&|surface_position| Change { surface_position, ..nothing });
        let by_velocity = along(&|surface_velocity| Change { surface_velocity, ..nothing });
        let collider = gradient.collider_mut(self.collider);
        collider.position += by_place;
        collider.rotation = DVec3::NAN;
        collider.velocity += by_velocity + self.began * by_place;
        collider.friction += self.sliding.by_bodies[0] * by_sliding;
        let mut before = SphereTangent::default();
        for number in 0..NUMBERS {
            *before.number_mut(number) =
                by(Change { sphere: SphereTangent::unit(number), ..nothing });
        }
        spheres[self.place] = before;
    }

    /// Returns the change of the acceleration by forces that depend on the radius and the mass.
    fn by_inputs(&self, sphere: &SphereVariation) -> DVec3 {
        let amounts = [sphere.radius, sphere.mass].into_iter().zip(self.by_inputs);
        amounts.filter(|it| it.0 != 0.0).map(|(amount, by)| amount * by).sum()
    }

    /// Returns the change of the motion at the end.
    fn apply(&self, change: &Change) -> SphereTangent {
        let End { way, velocity, angular_velocity, time } = self.end(change);
        let later = time.change;
        let gained = self.after.acceleration(velocity.value());
        let along = |vector: DVec3| vector - vector.dot(self.normal) * self.normal;
        let Change { sphere, surface_velocity, .. } = *change;
        let start = along(sphere.position - change.surface_position);
        let moved = along(way.change() - later * velocity.value());
        let shift = change.surface_position + self.time * surface_velocity;
        SphereTangent {
            position: start + moved + shift + change.radius * self.normal,
            velocity: along(velocity.change() - later * gained) + surface_velocity,
            angular_velocity: angular_velocity.change() - later * self.after.angular_acceleration,
        }
    }

    /// Returns the motion at the end, relative to the plane.
    fn end(&self, change: &Change) -> End {
        let sphere = self.pressed(change);
        let [spin, spin_time] = self.spin(&sphere);
        let given = Dual::constant(self.time);
        let (dry, time) = match (self.mode, self.ending) {
            (Mode::Sliding, Ending::Slip) => (true, self.slip(&sphere).stopping_time()),
            (Mode::Rolling, Ending::Roll) => (true, self.roll(&sphere).stopping_time()),
            (_, Ending::Spin) => (false, spin_time),
            _ => (false, given),
        };
        let [way, velocity, turning] = match self.mode {
            Mode::Gliding => self.glided(&sphere, time.change),
            Mode::Sliding => self.slid(&sphere, time, dry),
            Mode::Rolling => self.rolled(&sphere, time, dry),
            Mode::Resting => [vector(DVec3::ZERO, DVec3::ZERO); 3],
        };
        let normal = vector(self.normal, DVec3::ZERO);
        let spin = match (self.ending, self.spinning > 0.0) {
            (Ending::Spin, _) => Dual::constant(0.0),
            (_, true) if spin.value == 0.0 => Dual::constant(0.0),
            (_, true) => spin - self.spin_loss(&sphere, spin.value) * time,
            (_, false) => spin,
        };
        End { way, velocity, angular_velocity: turning + normal * spin, time }
    }

    fn pressed(&self, change: &Change) -> Pressed {
        let normal = vector(self.normal, DVec3::ZERO);
        let relative = change.sphere.velocity - change.surface_velocity;
        let velocity = vector(self.velocity, relative);
        let parting = Dual::new(0.0, relative.dot(self.normal));
        let acceleration = vector(self.linear.acceleration, change.acceleration);
        let pressing = acceleration.dot(normal) * -1.0;
        // The air is at rest, but the plane may move.
        let drag = vector(DVec3::ZERO, self.linear.drag_rate * change.surface_velocity);
        let pull = acceleration + normal * pressing - drag;
        let across = |it: Vector<Dual>| it - normal * it.dot(normal);
        Pressed {
            velocity: across(velocity),
            angular_velocity: vector(self.angular_velocity, change.sphere.angular_velocity),
            radius: Dual::new(self.radius, change.radius),
            pressing,
            pull: across(pull),
            parting,
            sliding: Dual::new(self.sliding.value, change.sliding),
        }
    }

    /// Returns the angular velocity about the normal at the start \[rad/s\], and the time at which friction stops
    /// it \[s\].
    fn spin(&self, sphere: &Pressed) -> [Dual; 2] {
        let spin = sphere.angular_velocity.dot(vector(self.normal, DVec3::ZERO));
        if self.ending != Ending::Spin {
            return [spin, Dual::constant(self.time)];
        }
        [spin, spin / self.spin_loss(sphere, spin.value)]
    }

    /// Returns the deceleration by friction of an angular velocity about the normal \[rad/s²\].
    fn spin_loss(&self, sphere: &Pressed, spin: f64) -> Dual {
        let loss = sphere.pressing * self.spinning / (sphere.radius * self.inertia_factor);
        loss * spin.signum()
    }

    /// Returns the motion of the slip along the plane.
    fn slip(&self, sphere: &Pressed) -> DryMotion {
        let normal = vector(self.normal, DVec3::ZERO);
        let Pressed { velocity, pull, sliding, pressing, .. } = *sphere;
        let velocity = velocity - sphere.angular_velocity.cross(normal) * sphere.radius;
        let share = sliding * (1.0 + 1.0 / self.inertia_factor);
        let motion = DryMotion { velocity, pull, loss: share * pressing };
        pushed(motion, share * sphere.parting)
    }

    /// Returns the motion of the rolling velocity.
    fn roll(&self, sphere: &Pressed) -> DryMotion {
        let normal = vector(self.normal, DVec3::ZERO);
        let share = 1.0 / (1.0 + self.inertia_factor);
        let slip = sphere.velocity - sphere.angular_velocity.cross(normal) * sphere.radius;
        let velocity = sphere.velocity - slip * Dual::constant(self.inertia_factor * share);
        let loss = Dual::constant(share * self.rolling);
        let pull = sphere.pull * Dual::constant(share);
        let motion = DryMotion { velocity, pull, loss: loss * sphere.pressing };
        pushed(motion, loss * sphere.parting)
    }

    /// Returns displacement, velocity and angular velocity across the normal after a motion without friction that ends
    /// later by this \[s\].
    fn glided(&self, sphere: &Pressed, later: f64) -> [Vector<Dual>; 3] {
        let over = Propagator::over(self.time, self.linear.drag_rate);
        let [decay, drift, fall] = [over.decay, over.drift, over.fall].map(Dual::constant);
        let Pressed { velocity, pull, .. } = *sphere;
        let later = Dual::new(0.0, later);
        let faster = velocity * decay + pull * drift;
        let gained = pull - faster * Dual::constant(self.linear.drag_rate);
        let way = velocity * drift + pull * fall + faster * later;
        [way, faster + gained * later, self.turning(sphere)]
    }

    /// Returns displacement, velocity and angular velocity after sliding: `v' = (1 - h) p + h s'` with the slip s,
    /// the pull p and `h = k/(1 + k)`.
    fn slid(&self, sphere: &Pressed, time: Dual, ends: bool) -> [Vector<Dual>; 3] {
        let motion = self.slip(sphere);
        let Moved { velocity: slip, way } = motion.after(time, ends);
        let normal = vector(self.normal, DVec3::ZERO);
        let start = sphere.velocity - sphere.angular_velocity.cross(normal) * sphere.radius;
        let share = Dual::constant(self.inertia_factor / (1.0 + self.inertia_factor));
        let rest = Dual::constant(1.0 / (1.0 + self.inertia_factor));
        let pull = sphere.pull;
        let change = slip - start;
        let moved = sphere.velocity * time
            + pull * (rest * time * time * 0.5)
            + (way - start * time) * share;
        let velocity = sphere.velocity + pull * (rest * time) + change * share;
        let turned = normal.cross(change - pull * time) * (rest / sphere.radius);
        [moved, velocity, self.turning(sphere) - turned]
    }

    /// Returns displacement, velocity and angular velocity after rolling.
    fn rolled(&self, sphere: &Pressed, time: Dual, ends: bool) -> [Vector<Dual>; 3] {
        let Moved { velocity, way } = self.roll(sphere).after(time, ends);
        let normal = vector(self.normal, DVec3::ZERO);
        let turning = normal.cross(velocity) * (Dual::constant(1.0) / sphere.radius);
        [way, velocity, turning]
    }

    /// Returns the angular velocity across the normal at the start.
    fn turning(&self, sphere: &Pressed) -> Vector<Dual> {
        let normal = vector(self.normal, DVec3::ZERO);
        let turning = sphere.angular_velocity;
        turning - normal * turning.dot(normal)
    }
}

/// Returns a motion with another impulse of friction: a velocity into the plane adds pressure until the contact has
/// stopped it.
fn pushed(motion: DryMotion, less: Dual) -> DryMotion {
    if less.change == 0.0 || motion.velocity.length_squared().value == 0.0 {
        return motion;
    }
    DryMotion { velocity: motion.velocity + motion.velocity.direction() * less, ..motion }
}
