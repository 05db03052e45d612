//! Friction of two bodies in contact.

use glam::DVec3;

use crate::compliant_impact::CompliantImpact;
use crate::error::InvalidValue;
use crate::norm::Norm;
use crate::settings::CombineRule;
use crate::validate;

/// Friction at the surface of a body. A coefficient that is `None` is taken from the other body; if both are
/// `None`, it is 0.
///
/// Friction acts under the rules `exact` and `contact`. Rolling friction acts under `exact` where a ball rolls,
/// under `contact` where it slides, too.
///
/// ```
/// use carom::{DVec3, Friction, Sphere};
///
/// let ball = Sphere::new(DVec3::ZERO, 0.03)
///     .with_friction(Friction::sliding(0.2).with_rolling(0.01).with_spinning(0.04));
/// assert_eq!(ball.friction.sliding, Some(0.2));
/// ```
#[derive(Debug, Clone, Copy, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Friction {
    /// Coulomb's coefficient, >= 0: the tangential force is at most this part of the normal force.
    pub sliding: Option<f64>,
    /// Coefficient of rolling friction, >= 0: the torque against rolling is at most this part of the
    /// normal force, times the radius. A ball that rolls on a level plane slows down by 5/7 of this times g.
    pub rolling: Option<f64>,
    /// Coefficient of spinning friction, >= 0: the torque about the normal is at most this part of the
    /// normal force, times the radius.
    pub spinning: Option<f64>,
    /// Coefficient of tangential restitution in [0, 1]: where friction suffices, an impact reverses this part of
    /// the tangential speed. 1 for a superball.
    pub tangential_restitution: Option<f64>,
}

impl From<f64> for Friction {
    /// Coulomb friction with this coefficient.
    fn from(sliding: f64) -> Self {
        Self::sliding(sliding)
    }
}

impl Friction {
    /// Coulomb friction with this coefficient; the other coefficients are `None`.
    pub fn sliding(coefficient: f64) -> Self {
        Self { sliding: Some(coefficient), ..Self::default() }
    }

    /// Returns the friction with this coefficient of rolling friction.
    pub fn with_rolling(self, coefficient: f64) -> Self {
        Self { rolling: Some(coefficient), ..self }
    }

    /// Returns the friction with this coefficient of spinning friction.
    pub fn with_spinning(self, coefficient: f64) -> Self {
        Self { spinning: Some(coefficient), ..self }
    }

    /// Returns the friction with this coefficient of tangential restitution.
    pub fn with_tangential_restitution(self, coefficient: f64) -> Self {
        Self { tangential_restitution: Some(coefficient), ..self }
    }

    /// Whether there is any: a tangential force or a torque.
    pub(crate) fn acts(&self) -> bool {
        let coefficients = [self.sliding, self.rolling, self.spinning];
        coefficients.iter().flatten().any(|&coefficient| coefficient > 0.0)
    }

    pub(crate) fn validate(&self) -> Result<(), InvalidValue> {
        let non_negative = |field, value: Option<f64>| {
            value.map_or(Ok(()), |value| validate::non_negative(field, value))
        };
        non_negative("friction", self.sliding)?;
        non_negative("rolling_friction", self.rolling)?;
        non_negative("spinning_friction", self.spinning)?;
        let restitution = self.tangential_restitution;
        restitution.map_or(Ok(()), |it| validate::unit_interval("tangential_restitution", it))
    }
}

/// Friction of a contact.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct ContactFriction {
    pub sliding: f64,
    pub rolling: f64,
    pub spinning: f64,
    pub tangential_restitution: f64,
    /// Frequency ratio of a compliant surface, which replaces the tangential restitution; 0 for none.
    pub cushion: f64,
}

/// A slip in an impact.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Slip {
    /// Speed \[m/s\].
    pub speed: f64,
    /// Impulse along the normal, divided by the mass that it has to turn round \[m/s\].
    pub change: f64,
    /// Coefficient of restitution.
    pub restitution: f64,
    /// Velocity that a unit impulse gives the contact across the normal, divided by that along it.
    pub mobility_ratio: f64,
}

impl ContactFriction {
    /// Whether an impact may leave something of the slip.
    pub fn reverses(&self) -> bool {
        self.tangential_restitution > 0.0 || self.cushion > 0.0
    }

    /// Returns the part of a slip that an impact reverses.
    pub fn reversal(&self, slip: &Slip) -> f64 {
        match self.compliant(slip) {
            Some(impact) => impact.reversal().value,
            None => self.tangential_restitution,
        }
    }

    /// Returns the slip after an impact of a sphere on a surface, where friction suffices \[m/s\].
    ///
    /// - `change`: what the impulse along the normal adds to the velocity \[m/s\], and the restitution
    /// - `masses`: 1/m and 1/(k m) \[1/kg\]
    pub fn slip_after(
        &self,
        slip: DVec3,
        (change, restitution): (f64, f64),
        [inverse_mass, inverse_inertia]: [f64; 2],
    ) -> DVec3 {
        let mobility_ratio = 1.0 + inverse_inertia / inverse_mass;
        let speed = slip.norm();
        -self.reversal(&Slip { speed, change, restitution, mobility_ratio }) * slip
    }

    /// Returns the impact of a slip on a compliant surface; `None` on another one.
    pub fn compliant(&self, slip: &Slip) -> Option<CompliantImpact> {
        let &Slip { speed, change, restitution, mobility_ratio } = slip;
        (self.cushion > 0.0).then(|| CompliantImpact {
            incidence: (1.0 + restitution) * speed / (self.sliding * change),
            restitution,
            mobility_ratio,
            frequency_ratio: self.cushion,
        })
    }

    /// Whether there is any: a tangential force or a torque.
    pub fn acts(&self) -> bool {
        [self.sliding, self.rolling, self.spinning].iter().any(|&it| it > 0.0)
    }

    /// Friction of the contact of two bodies.
    pub fn of(bodies: [Friction; 2], rule: CombineRule) -> Self {
        let [first, second] = bodies;
        let combine = |first: Option<f64>, second: Option<f64>| match (first, second) {
            (Some(first), Some(second)) => rule.combine(first, second),
            (first, second) => first.or(second).unwrap_or(0.0),
        };
        Self {
            sliding: combine(first.sliding, second.sliding),
            rolling: combine(first.rolling, second.rolling),
            spinning: combine(first.spinning, second.spinning),
            tangential_restitution: combine(
                first.tangential_restitution,
                second.tangential_restitution,
            ),
            cushion: 0.0,
        }
    }
}
