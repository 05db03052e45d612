//! How a world is stepped: values chosen per scene.

use crate::error::InvalidValue;
use crate::integrate::Integrator;
use crate::rule::Rule;
use crate::validate;

/// How a world is stepped.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// The step rule.
    pub rule: Rule,
    /// The integrator the rule moves spheres with.
    pub integrator: Integrator,
    /// Restitution of a contact, from that of its two bodies.
    pub restitution_rule: RestitutionRule,
    /// Whether spheres collide with one another; fixed colliders they always collide with.
    pub spheres_collide: bool,
}

impl Default for Settings {
    /// Rule `bisect`, semi-implicit Euler, product of restitutions, spheres collide.
    fn default() -> Self {
        Self {
            rule: Rule::default(),
            integrator: Integrator::default(),
            restitution_rule: RestitutionRule::default(),
            spheres_collide: true,
        }
    }
}

impl Settings {
    pub(crate) fn validate(&self) -> Result<(), InvalidValue> {
        match self.rule {
            Rule::Discrete => Ok(()),
            Rule::Bisect(parameters) => {
                validate::non_negative("tolerance", parameters.tolerance)?;
                validate::at_least_one("max_halvings", parameters.max_halvings)?;
                validate::at_least_one("max_impacts", parameters.max_impacts)
            }
        }
    }
}

/// Coefficient of restitution of a contact, from those of the two bodies.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
pub enum RestitutionRule {
    /// `e1 e2`: with a sphere of 1, the collider's value governs.
    #[default]
    Product,
    /// The smaller of the two.
    Minimum,
    /// The larger of the two.
    Maximum,
    /// `(e1 + e2) / 2`.
    Average,
}

impl RestitutionRule {
    /// Restitution of a contact between bodies of restitution `e1` and `e2`.
    pub fn combine(self, e1: f64, e2: f64) -> f64 {
        match self {
            Self::Product => e1 * e2,
            Self::Minimum => e1.min(e2),
            Self::Maximum => e1.max(e2),
            Self::Average => 0.5 * (e1 + e2),
        }
    }
}
