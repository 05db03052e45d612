//! The law of one impact, in numbers or dual numbers: Newton's law along the normal, then Walton's law across it.

use super::dual::Number;
use crate::friction::{ContactFriction, Slip};
use crate::real::Vector;

/// A sphere in an impact.
#[derive(Debug, Clone, Copy)]
pub(super) struct StruckSphere<N> {
    pub velocity: Vector<N>,
    pub angular_velocity: Vector<N>,
    pub radius: N,
    pub mass: N,
    /// Moment of inertia divided by m r².
    pub inertia_factor: f64,
}

/// Body 1 of an impact.
#[derive(Debug, Clone, Copy)]
pub(super) enum FirstBody<N> {
    Sphere(StruckSphere<N>),
    /// A surface with this velocity where it is touched \[m/s\].
    Surface(Vector<N>),
}

/// Coefficients of the contact.
#[derive(Debug, Clone, Copy)]
pub(super) struct Coefficients<N> {
    /// Restitution at the present speed of approach.
    pub restitution: N,
    /// Derivative of the restitution by the speed of approach \[s/m\].
    pub restitution_by_speed: f64,
    /// Coefficient of Coulomb friction.
    pub sliding: N,
    /// Friction across the normal, without its derivative.
    pub friction: ContactFriction,
    /// Speed that the surface adds along the normal \[m/s\].
    pub kick: f64,
}

impl<N: Number> StruckSphere<N> {
    /// Returns the velocity of the surface across the normal that the rotation causes, for a normal that points
    /// away from the centre.
    fn rim_velocity(&self, normal: Vector<N>) -> Vector<N> {
        (self.angular_velocity * self.radius).cross(normal)
    }

    /// Returns the velocity that a unit impulse across the normal gives the surface \[1/kg\].
    fn mobility(&self) -> N {
        N::constant(1.0 + 1.0 / self.inertia_factor) / self.mass
    }

    /// Applies an impulse \[N s\]. `turning` is the cross product of the normal with it, the same for both bodies,
    /// which changes the spin.
    fn push(&mut self, impulse: Vector<N>, turning: Vector<N>) {
        let one = N::constant(1.0);
        self.velocity = self.velocity + impulse * (one / self.mass);
        let moment_per_radius = self.mass * self.radius * self.inertia_factor;
        self.angular_velocity = self.angular_velocity - turning * (one / moment_per_radius);
    }
}

impl<N: Number> FirstBody<N> {
    fn velocity(&self) -> Vector<N> {
        match self {
            Self::Sphere(sphere) => sphere.velocity,
            Self::Surface(velocity) => *velocity,
        }
    }
}

/// Answers the impact of two bodies, whose normal points from body 1 to body 2. The formulas are those of
/// `docs/physics/impacts.md`, "Impact of two spheres" and "Friction".
pub(super) fn collide<N: Number>(
    first: &mut FirstBody<N>,
    second: &mut StruckSphere<N>,
    normal: Vector<N>,
    coefficients: &Coefficients<N>,
) {
    let one = N::constant(1.0);
    let relative = second.velocity - first.velocity();
    let closing = relative.dot(normal);
    let lightness = match first {
        FirstBody::Sphere(sphere) => one / sphere.mass + one / second.mass,
        FirstBody::Surface(_) => one / second.mass,
    };
    let faster = N::new(0.0, -coefficients.restitution_by_speed * closing.change());
    let restitution = coefficients.restitution + faster;
    let gained = N::constant(coefficients.kick) - (one + restitution) * closing;
    let impulse = gained / lightness;
    let along = normal * impulse;
    let coefficients = Coefficients { restitution, ..*coefficients };
    let across = friction(first, second, normal, (relative, gained), &coefficients);
    let turning = normal.cross(across);
    second.push(along + across, turning);
    if let FirstBody::Sphere(sphere) = first {
        sphere.push((along + across) * N::constant(-1.0), turning);
    }
}

/// Returns the impulse of friction on body 2 \[N s\]. `relative` is the velocity of body 2 relative to body 1,
/// `gained` the change of that along the normal \[m/s\].
fn friction<N: Number>(
    first: &FirstBody<N>,
    second: &StruckSphere<N>,
    normal: Vector<N>,
    (relative, gained): (Vector<N>, N),
    coefficients: &Coefficients<N>,
) -> Vector<N> {
    let (one, nothing) = (N::constant(1.0), normal * N::constant(0.0));
    if coefficients.sliding.value() <= 0.0 {
        return nothing;
    }
    let (rim, mobility, lightness) = match first {
        FirstBody::Sphere(sphere) => (
            sphere.rim_velocity(normal) + second.rim_velocity(normal),
            sphere.mobility() + second.mobility(),
            one / sphere.mass + one / second.mass,
        ),
        FirstBody::Surface(_) => {
            (second.rim_velocity(normal), second.mobility(), one / second.mass)
        }
    };
    let limit = coefficients.sliding * (gained / lightness);
    let slip = relative - normal * relative.dot(normal) - rim;
    if limit.value() <= 0.0 {
        return nothing;
    }
    let speed = match slip.length_squared() {
        it if it.value() > 0.0 => it.sqrt(),
        _ => N::constant(0.0),
    };
    let share = (one + reversal(coefficients, (speed, gained), mobility / lightness)) / mobility;
    if speed.value() == 0.0 {
        // A small slip does not reach the limit of friction.
        return slip * share * N::constant(-1.0);
    }
    let stops = share * speed;
    let size = if stops.value() <= limit.value() { stops } else { limit };
    slip * (size / speed) * N::constant(-1.0)
}

/// Returns the part of a slip of this speed \[m/s\] that the impact reverses.
fn reversal<N: Number>(
    coefficients: &Coefficients<N>,
    (speed, gained): (N, N),
    mobility_ratio: N,
) -> N {
    let &Coefficients { restitution, sliding, ref friction, .. } = coefficients;
    let slip = Slip {
        speed: speed.value(),
        change: gained.value(),
        restitution: restitution.value(),
        mobility_ratio: mobility_ratio.value(),
    };
    let Some(impact) = friction.compliant(&slip) else {
        return N::constant(friction.tangential_restitution);
    };
    let found = impact.reversal();
    let incidence = (N::constant(1.0) + restitution) * speed / (sliding * gained);
    let [by_incidence, by_restitution] = found.by;
    let change = by_incidence * incidence.change() + by_restitution * restitution.change();
    N::new(found.value, change)
}
