//! Restitution of a contact: a number, or a law of the speed of approach.

use crate::error::InvalidValue;
use crate::settings::CombineRule;
use crate::validate;

/// Coefficient of restitution that depends on the speed of approach v along the normal.
///
/// ```
/// use carom::RestitutionLaw;
///
/// let bronze = RestitutionLaw::PowerLaw { restitution: 1.0, speed: 0.1, exponent: 0.25 };
/// assert_eq!(bronze.at(0.05), 1.0);
/// assert!((bronze.at(1.6) - 0.5).abs() < 1e-15);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum RestitutionLaw {
    /// Plastic impacts: `e = e0 (v/v0)^-p` above the speed v0, e0 below it. The exponent p is 1/4 for spheres that
    /// yield.
    ///
    /// Source: K. L. Johnson, Contact Mechanics, Cambridge 1985, section 11.5.
    PowerLaw {
        /// e0 in \[0, 1\].
        restitution: f64,
        /// v0 \[m/s\], > 0.
        speed: f64,
        /// p in \[0, 1\].
        exponent: f64,
    },
    /// Viscoelastic spheres: with `x = (v/v0)^(1/10)`, the Padé approximant of
    /// `e = 1 - 1.15345 x² + 0.79827 x⁴ - ...` that holds at every speed. With the dissipative constant A, Young's
    /// modulus Y, Poisson's ratio ν, the reduced radius R and the reduced mass m, `v0 = β^-5`, where
    /// `β = (3/2) A (2 Y √R / (3 m (1 - ν²)))^(2/5)`.
    ///
    /// Source: Müller and Pöschel, Phys. Rev. E 84, 021302 (2011), for Schwager and Pöschel, Phys. Rev. E 78, 051304
    /// (2008).
    Viscoelastic {
        /// v0 \[m/s\], > 0: there e is 0.3987.
        speed: f64,
    },
    /// `e = e0` from the speed v0 on, and 1 below it, so that a gas does not collapse.
    Cutoff {
        /// e0 in \[0, 1\].
        restitution: f64,
        /// v0 \[m/s\], > 0.
        speed: f64,
    },
}

/// Coefficients of the numerator of the Padé approximant, from the constant on.
const NUMERATOR: [f64; 2] = [1.0, 0.501086];
/// Coefficients of its denominator.
const DENOMINATOR: [f64; 5] = [1.0, 0.501086, 1.15345, 0.577977, 0.532178];

impl RestitutionLaw {
    /// Coefficient at this speed of approach \[m/s\], >= 0; in \[0, 1\].
    pub fn at(&self, speed: f64) -> f64 {
        match *self {
            Self::PowerLaw { restitution, speed: least, exponent } => {
                if speed <= least {
                    restitution
                } else {
                    restitution * libm::pow(speed / least, -exponent)
                }
            }
            Self::Viscoelastic { speed: unit } => {
                let x = tenth_root(speed / unit);
                polynomial(&NUMERATOR, x) / polynomial(&DENOMINATOR, x)
            }
            Self::Cutoff { restitution, speed: least } => {
                if speed < least {
                    1.0
                } else {
                    restitution
                }
            }
        }
    }

    /// Derivative of [`Self::at`] by the speed \[s/m\], at a speed > 0.
    pub(crate) fn slope(&self, speed: f64) -> f64 {
        match *self {
            Self::PowerLaw { speed: least, exponent, .. } if speed > least => {
                -exponent * self.at(speed) / speed
            }
            Self::Viscoelastic { speed: unit } => {
                let x = tenth_root(speed / unit);
                let (above, below) = (polynomial(&NUMERATOR, x), polynomial(&DENOMINATOR, x));
                let change =
                    derivative(&NUMERATOR, x) * below - above * derivative(&DENOMINATOR, x);
                change / (below * below) * (0.1 * x / speed)
            }
            _ => 0.0,
        }
    }

    pub(crate) fn validate(&self) -> Result<(), InvalidValue> {
        let (restitution, speed) = match *self {
            Self::PowerLaw { restitution, speed, .. } | Self::Cutoff { restitution, speed } => {
                (restitution, speed)
            }
            Self::Viscoelastic { speed } => (1.0, speed),
        };
        validate::unit_interval("restitution_law.restitution", restitution)?;
        validate::positive("restitution_law.speed", speed)?;
        match *self {
            Self::PowerLaw { exponent, .. } => {
                validate::unit_interval("restitution_law.exponent", exponent)
            }
            _ => Ok(()),
        }
    }
}

/// The tenth root of a ratio >= 0. A ratio that overflowed counts as the largest number.
fn tenth_root(ratio: f64) -> f64 {
    libm::pow(ratio.min(f64::MAX), 0.1)
}

/// Value of a polynomial, given its coefficients from the constant on.
fn polynomial(coefficients: &[f64], x: f64) -> f64 {
    coefficients.iter().rev().fold(0.0, |sum, coefficient| sum * x + coefficient)
}

/// Derivative of a polynomial.
fn derivative(coefficients: &[f64], x: f64) -> f64 {
    let terms = coefficients.iter().enumerate().skip(1).rev();
    terms.fold(0.0, |sum, (power, coefficient)| sum * x + power as f64 * coefficient)
}

/// Restitution of a body.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) enum BodyRestitution {
    Constant(f64),
    BySpeed(RestitutionLaw),
}

impl BodyRestitution {
    /// Returns the restitution of a body with this coefficient, which a law replaces.
    pub fn of(coefficient: f64, law: Option<RestitutionLaw>) -> Self {
        law.map_or(Self::Constant(coefficient), Self::BySpeed)
    }

    /// Coefficient at a speed of approach \[m/s\], >= 0.
    pub fn at(&self, speed: f64) -> f64 {
        match self {
            Self::Constant(coefficient) => *coefficient,
            Self::BySpeed(law) => law.at(speed),
        }
    }

    fn slope(&self, speed: f64) -> f64 {
        match self {
            Self::Constant(_) => 0.0,
            Self::BySpeed(law) => law.slope(speed),
        }
    }

    /// Whether it is 1 at every speed.
    pub fn is_elastic(&self) -> bool {
        *self == Self::Constant(1.0)
    }
}

/// Restitution of a contact.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) enum ContactRestitution {
    Constant(f64),
    /// Restitutions of two bodies, at least one of which has a law.
    BySpeed([BodyRestitution; 2], CombineRule),
}

/// Restitution of a contact at one speed of approach.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Coefficient {
    pub value: f64,
    /// Whether it is 1 at every speed. A contact that is elastic at low speeds alone comes to rest as others do.
    pub is_elastic: bool,
}

impl Coefficient {
    /// A coefficient that does not depend on the speed.
    #[inline]
    pub fn constant(value: f64) -> Self {
        Self { value, is_elastic: value == 1.0 }
    }
}

impl Default for ContactRestitution {
    fn default() -> Self {
        Self::Constant(0.0)
    }
}

impl ContactRestitution {
    /// Combines those of two bodies.
    pub fn of(bodies: [BodyRestitution; 2], rule: CombineRule) -> Self {
        match bodies {
            [BodyRestitution::Constant(first), BodyRestitution::Constant(second)] => {
                Self::Constant(rule.combine(first, second))
            }
            _ => Self::BySpeed(bodies, rule),
        }
    }

    /// Returns the restitution of a contact that has one of its own.
    pub fn given(restitution: BodyRestitution) -> Self {
        Self::of([restitution, BodyRestitution::Constant(1.0)], CombineRule::Product)
    }

    /// Coefficient at a speed of approach \[m/s\]; a body that moves away counts as one at rest.
    pub fn at(&self, speed: f64) -> f64 {
        match self {
            Self::Constant(coefficient) => *coefficient,
            Self::BySpeed([first, second], rule) => {
                let speed = speed.max(0.0);
                rule.combine(first.at(speed), second.at(speed))
            }
        }
    }

    /// Coefficient at a speed of approach \[m/s\], and whether it is elastic.
    pub fn coefficient(&self, speed: f64) -> Coefficient {
        Coefficient { value: self.at(speed), is_elastic: self.is_elastic() }
    }

    /// Derivative of the coefficient by the speed of approach \[s/m\].
    pub fn slope(&self, speed: f64) -> f64 {
        match self {
            Self::Constant(_) => 0.0,
            Self::BySpeed([first, second], rule) => {
                let by_bodies = rule.derivatives([first.at(speed), second.at(speed)]);
                by_bodies[0] * first.slope(speed) + by_bodies[1] * second.slope(speed)
            }
        }
    }

    /// Whether it is 1 at every speed.
    pub fn is_elastic(&self) -> bool {
        *self == Self::Constant(1.0)
    }

    /// The law, if it depends on the speed.
    pub fn by_speed(self) -> Option<Self> {
        matches!(self, Self::BySpeed(..)).then_some(self)
    }
}
